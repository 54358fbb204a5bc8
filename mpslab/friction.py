"""Friction of the water: its viscosity, and the eddies that the particles do not resolve."""

import numpy as np

from mpslab.kernels import viscosity as kernels


def acceleration(particles, neighbors, stencils, matrices, fluid, scheme, refresh):
    """nu <lap u> and div(nu_e grad u) of the fluid particles, (n, 3) [m/s2].

    The eddy viscosity is that of Smagorinsky (1963), nu_e = (C_s d0)^2 |S|.

    Parameters
    ----------
    particles : ParticleSet
    neighbors : NeighborList
    stencils : pair of Stencil
        Of the gradient, and of the Laplacian.
    matrices : (n, 6) float64 or None
        Correction matrices of the particles; only for eddies.
    fluid, scheme : tables of the case
    refresh : callable
        Brings an array of the particles up to date where they are ghosts.
    """
    stencil, laplacian_stencil = stencils
    out = np.zeros_like(particles.velocity)
    place = particles.position, particles.velocity, particles.role
    pairs = neighbors.indptr, neighbors.indices
    if fluid.viscosity > 0.0:
        kernels.viscous_acceleration(
            *place, *pairs, laplacian_stencil, fluid.viscosity, scheme.wall_slip, out
        )
    if scheme.smagorinsky > 0.0:
        eddy = np.zeros(len(particles))
        kernels.strain_rate(*place, *pairs, stencil, matrices, scheme.wall_slip, eddy)
        eddy *= (scheme.smagorinsky * stencil.spacing) ** 2
        refresh(eddy)
        kernels.eddy_acceleration(*place, *pairs, laplacian_stencil, eddy, scheme.wall_slip, out)
    return out
