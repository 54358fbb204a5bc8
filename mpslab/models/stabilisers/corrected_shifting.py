"""Particle shifting with the matrices of the corrected gradient."""

from mpslab.core.timestep import share
from mpslab.models.stabilisers.shifting import shift

STAGE = "corrected"
KEEPS_VELOCITY = True


def stabilise(near, dt, pace, scheme):
    """dr_i = -(A/R) sum_j (C_i + D_j)/2 r_ij w/r^2 inside the water [m]; velocities stay.

    D_j is C_j of water and C_i of solids. The sum is what the gradient "corrected" makes of a
    constant pressure (`Neighbourhood.disorder`): particles that have moved until it vanishes feel
    no force from the pressure itself, only from its differences. With R of the lattice
    (`Stencil.restoring`) the strength A is the share of a displacement that the step takes back (in
    fact a little less, because the matrices change as well); near 1/2 neighbours overshoot
    together.
    """
    factor = 0.5 * share(scheme.shifting_strength, dt, pace) / near.stencil.restoring
    shift(near, near.disorder, factor, dt / pace)
