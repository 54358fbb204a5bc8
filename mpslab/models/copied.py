"""Walls whose layers behind the first one have a copy of its pressure, ``scheme.walls = "copied"``.

The pressure of the first layer is an unknown, as with ``"solved"``; behind it dp/dn = 0.  So with a
gradient that reaches farther than the first layer, all the layers in its reach hold the water up.
"""

import numpy as np

from mpslab.kernels import walls as kernels


def fill(near):
    """Give each filler the pressure of the nearest face, in place; returns which particles act with
    one.

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
