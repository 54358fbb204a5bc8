"""Particle shifting: move particles from where they crowd to where they lack."""

import numpy as np

from mpslab.kernels import repulsion

STAGE = "corrected"
LONGEST = 0.05  # of a particle spacing, in one step


def stabilise(particles, before, neighbors, stencil, dt, scheme):
    """Shift the particles inside the water; velocities stay (after Lind et al. 2012)."""
    move = np.empty_like(particles.position)
    repulsion.shifting(
        particles.position, particles.kind, particles.surface, neighbors.indptr,
        neighbors.indices, stencil, scheme.shifting_strength, LONGEST * stencil.spacing, move,
    )  # fmt: skip
    particles.position += move
