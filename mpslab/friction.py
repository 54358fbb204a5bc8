"""Friction of the water: its viscosity, and the eddies that the particles do not resolve."""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.kernels import viscosity as kernels


def acceleration(near, laplacian_stencil, fluid, scheme, refresh):
    """nu <lap u> and div(nu_e grad u) of the fluid particles, (n, 3) [m/s2].

    The eddy viscosity is that of Smagorinsky (1963), nu_e = (C_s d0)^2 |S|.

    Parameters
    ----------
    near : Neighbourhood
    laplacian_stencil : Stencil
    fluid, scheme : tables of the case
    refresh : callable
        Brings an array of the particles up to date where they are ghosts.
    """
    particles, slip = near.particles, scheme.wall_slip
    out, velocity = np.zeros_like(particles.velocity), padded(particles.velocity)
    rows = near.row, near.solid, near.other
    if fluid.viscosity > 0.0:
        kernels.viscous_acceleration(
            *rows, near.inverse, particles.role, laplacian_stencil, velocity, fluid.viscosity,
            slip, out,
        )  # fmt: skip
    if scheme.smagorinsky > 0.0:
        eddy = np.zeros(len(particles))
        kernels.strain_rate(
            *rows, near.offset, particles.role, near.stencil, velocity, near.correction, slip, eddy
        )
        eddy *= (scheme.smagorinsky * near.stencil.spacing) ** 2
        refresh(eddy)
        kernels.eddy_acceleration(
            *rows, near.inverse, particles.role, laplacian_stencil, velocity, eddy, slip, out
        )
    return out
