"""Readings of the particles near a place, whichever rank owns them."""

import numpy as np

from mpslab.kernels import column


def read_near(flow, places, reach, read):
    """What `read` returns for the particles near some places, the same on all ranks.

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
    return read_of(flow, within(flow.particles, places, reach), read) if places else []


def read_of(flow, rows, read):
    """As `read_near`, for some rows of this rank's particles: a mask, or their numbers."""
    domain = flow.domain
    particles = domain.gather(flow.particles.take(rows))
    return domain.from_all(None if particles is None else read(particles))[0]


def within(particles, places, reach):
    """Rows of the particles within a reach of a place along the tank, (m,) int32."""
    starts, ends = np.sort(places) - reach, np.sort(places) + reach
    apart = starts[1:] > ends[:-1]
    starts, ends = starts[np.append(True, apart)], ends[np.append(apart, True)]
    rows = np.empty(len(particles), np.int32)
    return rows[: column.within(particles.position, starts, ends, rows)]
