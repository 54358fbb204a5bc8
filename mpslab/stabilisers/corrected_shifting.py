"""Particle shifting with the matrices of the corrected gradient."""

import numpy as np

from mpslab.kernels import repulsion
from mpslab.stabilisers.shifting import LONGEST

STAGE = "corrected"
KEEPS_VELOCITY = True
NEEDS_CORRECTION = True


def stabilise(particles, before, neighbors, stencil, correction, dt, scheme):
    """dr_i = -(A/R) sum_j (C_i + C_j)/2 r_ij w/r^2 inside the water [m]; velocities stay.

    The sum is what the gradient "corrected" makes of a constant pressure: particles that have
    moved until it vanishes feel no force from the pressure itself, only from its differences.
    With R of the lattice (`Stencil.restoring`) the strength A is the share of a displacement that
    one step takes back (a little less, for the matrices change, too); near 1/2 neighbours
    overshoot together.  The matrices are those of the start of the step.
    """
    move = np.empty_like(particles.position)
    factor = scheme.shifting_strength / stencil.restoring
    repulsion.shifting(
        particles.position, particles.role, particles.surface, neighbors.indptr,
        neighbors.indices, stencil, correction, factor, LONGEST * stencil.spacing,
        move,
    )  # fmt: skip
    particles.position += move
