"""Readings of particles near a place, wherever they are owned."""

import numpy as np


def read_near(flow, places, reach, read):
    """What `read` makes of the particles near some places, the same on all ranks.

    Parameters
    ----------
    flow : mpslab.run.step.Flow
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
    """As `read_near`, of the particles in some rows of this rank's, a mask (n,)."""
    domain = flow.domain
    particles = domain.gather(flow.particles.take(rows))
    return domain.from_all(None if particles is None else read(particles))[0]


def within(particles, places, reach):
    """Mask of the particles within a reach of a place along the tank, (n,) bool."""
    near = np.zeros(len(particles), bool)
    for x in places:
        near |= np.abs(particles.position[:, 0] - x) < reach
    return near
