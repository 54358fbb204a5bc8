"""Particle shifting: move particles from where they are dense to where they are sparse."""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.core.timestep import share
from mpslab.kernels import repulsion

STAGE = "corrected"
KEEPS_VELOCITY = True
LONGEST = 0.05  # of a particle spacing, in one pace


def stabilise(near, dt, pace, scheme):
    """dr_i = -(A d0^2/n0) sum_j r_ij w/r^2 inside the water (after Lind et al. 2012) [m].

    A is the `share` of the step; velocities stay.
    """
    matrices = np.zeros_like(near.second)
    matrices[:, range(3), range(3)] = 1.0
    factor = share(scheme.shifting_strength, dt, pace) * near.stencil.spacing**2 / near.stencil.n0
    shift(near, matrices, factor, dt / pace)


def shift(near, matrices, factor, paces):
    """Move the water by -factor sum_j (C_i + D_j)/2 r_ij w/r^2, summed where it is now.

    Neither the surface nor the particles beside it move.  Sums at the places where the pressure
    acted would be good enough for waves, but not where water is thrown against a wall: there they
    throw particles together.

    Parameters
    ----------
    near : Neighbourhood
    matrices : (n, 3, 4) float64
        C_i; D_j is C_j of water and C_i of solids.
    factor : float [m2]
    paces : float
        How long the step is, in paces.
    """
    particles = near.particles
    move = np.empty_like(particles.position)
    moves = (particles.fluid & (near.beside_surface == 0)).astype(np.uint8)
    repulsion.shift(
        padded(particles.position), near.row, near.solid, near.other, near.stencil, near.smooth,
        matrices, moves, factor, LONGEST * near.stencil.spacing * paces, move,
    )  # fmt: skip
    particles.position += move

