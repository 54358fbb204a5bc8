"""Walls whose layers behind the first one have a copy of its pressure, ``scheme.walls = "copied"``.

The pressure of the first layer is an unknown, as with ``"solved"``; dp/dn = 0 behind it.  So a
gradient that sees farther than the first layer is held up by all the layers that it sees.
"""

import numpy as np

from mpslab.kernels import walls as kernels


def fill(near):
    """Give each filler the pressure of the nearest face, in place; which particles act with one.

    Parameters
    ----------
    near : Neighbourhood
        With rows for all particles.

    Returns
    -------
    loaded : (n,) uint8
        0 for the fillers without a face in reach, which stay at p = 0.
    """
    particles, face = near.particles, np.empty(len(near.particles), np.int32)
    kernels.nearest_face(near.row, near.solid, near.other, near.inverse, particles.role, face)
    copies = face >= 0
    particles.pressure[copies] = particles.pressure[face[copies]]
    return (particles.carries_pressure | copies).astype(np.uint8)
