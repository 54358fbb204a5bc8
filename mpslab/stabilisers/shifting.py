"""Particle shifting: move particles from where they crowd to where they lack."""

import numpy as np

from mpslab.correction import identity
from mpslab.kernels import repulsion

STAGE = "corrected"
KEEPS_VELOCITY = True
LONGEST = 0.05  # of a particle spacing, in one step


def stabilise(particles, before, neighbors, stencil, correction, dt, scheme):
    """dr_i = -(A d0^2/n0) sum_j r_ij w/r^2 inside the water (after Lind et al. 2012) [m].

    Velocities stay.
    """
    move = np.empty_like(particles.position)
    factor = scheme.shifting_strength * stencil.spacing**2 / stencil.n0
    repulsion.shifting(
        particles.position, particles.role, particles.surface, neighbors.indptr,
        neighbors.indices, stencil, identity(len(particles)), factor,
        LONGEST * stencil.spacing, move,
    )  # fmt: skip
    particles.position += move
