"""Friction of the water: its viscosity, and the eddies that the particles do not resolve."""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.kernels import viscosity as kernels


def velocity_seen(near, scheme, refresh):
    """Velocities as friction sees them, (n, 4) [m/s], the fourth number 0.

    Where walls have friction, a solid has the velocity of the water mirrored in its own. Not with
    eddies: there the water's profile at a wall is finer than the particles, and the friction of a
    velocity that falls to nothing within half a spacing is far too large (docs/recipe.md).

    Parameters
    ----------
    near : Neighbourhood
    scheme : table of the case
    refresh : callable
        Brings the ghosts' rows of an array up to date.
    """
    velocity = padded(near.particles.velocity)
    if scheme.wall_slip or scheme.smagorinsky > 0.0:
        return velocity
    out = np.empty_like(velocity)
    kernels.mirror(
        near.row, near.solid, near.other, near.inverse, near.particles.role, near.stencil,
        velocity, np.empty(len(out)), out,
    )  # fmt: skip
    refresh(out)
    return out


def eddies(near, velocity, scheme, refresh):
    """Eddy viscosity of Smagorinsky (1963), nu_e = (C_s d0)^2 |S|, (n,) [m2/s]; None with C_s = 0.

    Parameters
    ----------
    near : Neighbourhood
    velocity : (n, 4) float64 [m/s]
        From `velocity_seen`.
    scheme, refresh : as there
    """
    if scheme.smagorinsky == 0.0:
        return None
    eddy = np.zeros(len(velocity))
    kernels.strain_rate(
        near.row, near.solid, near.other, near.offset, near.particles.role, near.stencil,
        velocity, near.correction, scheme.wall_slip, eddy,
    )  # fmt: skip
    eddy *= (scheme.smagorinsky * near.stencil.spacing) ** 2
    refresh(eddy)
    return eddy


def acceleration(near, laplacian_stencil, velocity, eddy, fluid, scheme):
    """div(2 (nu + nu_e) D) of the fluid particles, D their rate of strain, (n, 3) [m/s2].

    Each pair resists its stretching (Monaghan & Gingold 1983). Where the water is incompressible
    this is the nu <lap u> of equation (1) of the paper; but it has no stress at a free surface,
    where the Laplacian of MPS has du/dn = 0 and so takes half of the energy that a wave should
    lose (Colagrossi, Antuono, Souto-Iglesias & Le Touze 2011).

    Parameters
    ----------
    near : Neighbourhood
    laplacian_stencil : Stencil
    velocity : (n, 4) float64 [m/s]
        From `velocity_seen`.
    eddy : (n,) float64 or None
        From `eddies` [m2/s].
    fluid, scheme : tables of the case
    """
    out, viscosity = np.zeros((len(velocity), 3)), np.full(len(velocity), fluid.viscosity)
    if eddy is not None:
        viscosity += eddy
    kernels.acceleration(
        near.row, near.solid, near.other, near.offset, near.inverse, near.particles.role,
        laplacian_stencil, velocity, viscosity, scheme.wall_slip, out,
    )  # fmt: skip
    return out
