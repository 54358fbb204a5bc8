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
    factor = share(scheme.shifting_strength, dt, pace) * near.stencil.spacing**2 / near.stencil.n0
    shift(near, padded(np.ascontiguousarray(near.second[:, :, 3])), factor, dt / pace)


def shift(near, sums, factor, paces):
    """Move the water by -factor times sums over its pairs, where the pressure acted.

    Neither the surface nor the particles beside it move.

    Parameters
    ----------
    near : Neighbourhood
    sums : (n, 4) float64 [1/m]
    factor : float [m2]
    paces : float
        How long the step is, in paces.
    """
    moves = (near.particles.fluid & (near.beside_surface == 0)).astype(np.uint8)
    longest = LONGEST * near.stencil.spacing * paces
    repulsion.shift(sums, moves, factor, longest, near.particles.position)
