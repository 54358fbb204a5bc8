"""Readings of particles near a place, wherever they are owned."""

import numpy as np

from mpslab.kernels import column


def read_near(flow, places, reach, read):
    """What `read` makes of the particles near some places, the same on all ranks.

    Parameters
    ----------
    flow : mpslab.run.flow.Flow
    places : sequence of float [m]
        Along the tank.
    reach : float [m]
    read : callable
        Gets a `ParticleSet` in the order of gid, on rank 0 alone, and returns a list.

    Returns
    -------
    list
        Empty where there are no places.
    """
    if not places:
        return []
    domain = flow.domain
    particles = domain.gather(_near(flow, places, reach))
    return domain.from_all(None if particles is None else read(particles))[0]


def _near(flow, places, reach):
    """This rank's particles within the reach of a place."""
    starts, ends = np.sort(places) - reach, np.sort(places) + reach
    apart = starts[1:] > ends[:-1]
    starts, ends = starts[np.append(True, apart)], ends[np.append(apart, True)]
    rows = np.empty(len(flow.particles), np.int32)
    return flow.particles.take(rows[: column.within(flow.particles.position, starts, ends, rows)])
