"""Readings of the particles near a place, whichever rank owns them."""

import numpy as np

from mpslab.kernels import column


def read_near(flow, points, reach, read):
    """What `read` returns for the particles near some points, the same on all ranks.

    Parameters
    ----------
    flow : mpslab.run.flow.Flow
    points : sequence of (x, y, z) [m]
    reach : (3,) [m]
        Along each axis; in a periodic tank the nearest image counts.
    read : callable
        Gets a `ParticleSet` in the order of gid, on rank 0 alone, and returns a list.

    Returns
    -------
    list
        Empty where there are no points.
    """
    if not len(points):
        return []
    return read_of(flow, beside(flow.particles, points, reach, flow.stencil.width), read)


def read_of(flow, rows, read):
    """As `read_near`, for some rows of this rank's particles: a mask, or their numbers."""
    domain = flow.domain
    particles = domain.gather(flow.particles.take(rows))
    return domain.from_all(None if particles is None else read(particles))[0]


def within(particles, places, reach):
    """Rows of the particles within a reach of a place along the tank, (m,) int32 [m]."""
    return beside(particles, [(x, 0.0, 0.0) for x in places], (reach, np.inf, np.inf), 0.0)


def beside(particles, points, reach, width):
    """Rows of the particles within a reach (3,) of one of the points (k, 3), (m,) int32 [m]."""
    rows = np.empty(len(particles), np.int32)
    points, reach = np.array(points, float), np.array(reach, float)
    return rows[: column.beside(particles.position, points, reach, width, rows)]
