"""Particle shifting with the matrices of the corrected gradient."""

from mpslab.core.timestep import share
from mpslab.models.stabilisers.shifting import shift

STAGE = "corrected"
KEEPS_VELOCITY = True


def stabilise(near, dt, pace, scheme):
    """dr_i = -(A/R) sum_j (C_i + C_j)/2 r_ij w/r^2 inside the water [m]; velocities stay.

    The sum is what the gradient "corrected" makes of a constant pressure: particles that have moved
    until it vanishes feel no force from the pressure itself, only from its differences. With R of
    the lattice (`Stencil.restoring`) the strength A is the share of a displacement that the step
    takes back (in fact a little less, because the matrices change as well); near 1/2 neighbours
    overshoot together.  The matrices are those of the places where the pressure acted.
    """
    factor = share(scheme.shifting_strength, dt, pace) / near.stencil.restoring
    shift(near, near.correction, factor, dt / pace)
