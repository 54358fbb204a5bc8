"""Walls whose layers behind the first one have a copy of its pressure, ``scheme.walls = "copied"``.

The pressure of the first layer is an unknown, as with ``"solved"``; dp/dn = 0 behind it.  So a
gradient that sees farther than the first layer is held up by all the layers that it sees.
"""

import numpy as np

from mpslab.kernels import walls as kernels
from mpslab.particles import FACE


def fill(particles, neighbors, width):
    """Give each filler the pressure of the nearest face, in place; roles under which they act.

    Parameters
    ----------
    particles : ParticleSet
    neighbors : NeighborList
        With rows for all particles.
    width : float [m]
        Period across the tank, 0 when not periodic.

    Returns
    -------
    role : (n,) int8
        FACE for the fillers with a face in reach of the list; the others stay FILLER, at p = 0.
    """
    role, face = particles.role.copy(), np.empty(len(particles), np.int32)
    kernels.nearest_face(particles.position, role, neighbors.indptr, neighbors.indices, width, face)
    copies = face >= 0
    particles.pressure[copies] = particles.pressure[face[copies]]
    role[copies] = FACE
    return role
