"""Particle shifting: move particles from where they crowd to where they lack."""

import numpy as np

from mpslab.correction import identity
from mpslab.kernels import repulsion

STAGE = "corrected"
LONGEST = 0.05  # of a particle spacing, in one pace


def stabilise(particles, before, neighbors, stencil, correction, dt, pace, scheme):
    """dr_i = -(A d0^2/n0) sum_j r_ij w/r^2 inside the water (after Lind et al. 2012) [m].

    A is the `share` of the step; velocities stay.
    """
    move = np.empty_like(particles.position)
    factor = share(scheme, dt, pace) * stencil.spacing**2 / stencil.n0
    repulsion.shifting(
        particles.position, particles.role, particles.surface, neighbors.indptr,
        neighbors.indices, stencil, identity(len(particles)), factor,
        LONGEST * stencil.spacing * dt / pace, move,
    )  # fmt: skip
    particles.position += move


def share(scheme, dt, pace):
    """Share of a displacement that a step dt [s] takes back: ``shifting_strength`` in each pace."""
    return 1.0 - (1.0 - scheme.shifting_strength) ** (dt / pace)
