"""Friction of walls by the law of the wall, option ``scheme.wall_law``.

Water slows down at a wall within less than a particle.  Each face particle takes the mean velocity
of the water beside it as that half a spacing away from the face, finds the friction velocity that
goes with it, and shares its drag among that water.
"""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.core.particles import FACE
from mpslab.kernels import viscosity as kernels

KARMAN = 0.41
SMOOTH = 9.0  # u+ = ln(9 y+)/0.41: the law of a smooth wall (u+ = ln(y+)/0.41 + 5.4)
ROUGH = 30.0  # u = u* ln(30 y/k_s)/0.41: that of sand grains k_s (Nikuradse 1933)
ROUNDS = 12
SLOWEST = 1e-12  # [m/s]


def grip(near, fluid, roughness, refresh):
    """Drag of each face over the velocity of the water beside it, shared out, (n,) [1/s].

    Parameters
    ----------
    near : Neighbourhood
    fluid : table of the case
    roughness : float [m]
    refresh : callable
        Brings the ghosts' rows of an array up to date.
    """
    particles, stencil = near.particles, near.stencil
    mirrored, weight = np.empty((len(particles), 4)), np.empty(len(particles))
    velocity = padded(particles.velocity)
    kernels.mirror(
        near.row, near.solid, near.other, near.inverse, particles.role, stencil, velocity, weight,
        mirrored,
    )  # fmt: skip
    out = np.zeros(len(particles))
    beside = np.flatnonzero((particles.role == FACE) & (weight > 0.0))
    past = np.linalg.norm(velocity[beside, :3] - mirrored[beside, :3], axis=1)
    star = friction_velocity(past, 0.5 * stencil.spacing, fluid.viscosity, roughness)
    drag = np.divide(star**2, past, out=np.zeros(len(past)), where=past > 0.0)
    one = stencil.radius / stencil.spacing - 1.0  # the weight of a particle in the first row
    out[beside] = drag / (stencil.spacing * np.maximum(weight[beside], one))
    refresh(out)
    return out


def friction_velocity(velocity, height, viscosity, roughness):
    """u* of a velocity at a height above a wall, (n,) float64 [m/s].

    .. math:: u = \\frac{u_*}{0.41} \\ln\\frac{y}{\\nu/(9 u_*) + k_s/30}

    or u* = sqrt(nu u/y) of a laminar layer, if that is larger.

    Parameters
    ----------
    velocity : (n,) float64 [m/s]
    height : float [m]
    viscosity : float [m2/s]
    roughness : float [m]
        Equivalent sand roughness k_s, 0 for a smooth wall.
    """
    laminar = np.sqrt(viscosity * velocity / height)
    star = laminar
    for _ in range(ROUNDS):
        grain = viscosity / (SMOOTH * np.maximum(star, SLOWEST)) + roughness / ROUGH
        # At heights below e grains the logarithm says nothing; the drag then is at its largest.
        star = KARMAN * velocity / np.log(np.maximum(height / grain, np.e))
    return np.maximum(star, laminar)


def acceleration(near, held):
    """-sum_j grip_j w (u_i - u_j) over the faces beside water, (n, 3) [m/s2].

    held : (n,) float64 [1/s]
        From `grip`.
    """
    out = np.zeros((len(near.particles), 3))
    kernels.drag(
        near.row, near.solid, near.other, near.inverse, near.particles.role, near.stencil,
        padded(near.particles.velocity), held, out,
    )  # fmt: skip
    return out
