"""Friction of the water: its viscosity, and the eddies that the particles do not resolve."""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.kernels import viscosity as kernels


def eddies(near, scheme, refresh):
    """Eddy viscosity of Smagorinsky (1963), nu_e = (C_s d0)^2 |S|, (n,) [m2/s]; None with C_s = 0.

    Parameters
    ----------
    near : Neighbourhood
    scheme : table of the case
    refresh : callable
        Brings the ghosts' rows of an array up to date.
    """
    if scheme.smagorinsky == 0.0:
        return None
    particles, eddy = near.particles, np.zeros(len(near.particles))
    kernels.strain_rate(
        near.row, near.solid, near.other, near.offset, particles.role, near.stencil,
        padded(particles.velocity), near.correction, scheme.wall_slip, eddy,
    )  # fmt: skip
    eddy *= (scheme.smagorinsky * near.stencil.spacing) ** 2
    refresh(eddy)
    return eddy


def acceleration(near, laplacian_stencil, eddy, fluid, scheme):
    """nu <lap u> and div(nu_e grad u) of the fluid particles, (n, 3) [m/s2].

    Parameters
    ----------
    near : Neighbourhood
    laplacian_stencil : Stencil
    eddy : (n,) float64 or None
        From `eddies` [m2/s].
    fluid, scheme : tables of the case
    """
    particles, slip = near.particles, scheme.wall_slip
    out, velocity = np.zeros_like(particles.velocity), padded(particles.velocity)
    place = near.row, near.solid, near.other, near.inverse, particles.role, laplacian_stencil
    if fluid.viscosity > 0.0:
        kernels.viscous_acceleration(*place, velocity, fluid.viscosity, slip, out)
    if eddy is not None:
        kernels.eddy_acceleration(*place, velocity, eddy, slip, out)
    return out
