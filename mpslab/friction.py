"""Friction of the water: its viscosity, and the eddies that the particles do not resolve."""

import numpy as np

from mpslab.kernels import viscosity as kernels


def eddies(particles, neighbors, stencil, matrices, scheme, refresh):
    """Eddy viscosity of Smagorinsky (1963), nu_e = (C_s d0)^2 |S|, (n,) [m2/s]; None without.

    Parameters
    ----------
    particles : ParticleSet
    neighbors : NeighborList
    stencil : Stencil
        Of the gradient.
    matrices : (n, 6) float64
        Correction matrices of the particles.
    scheme : table of the case
    refresh : callable
        Brings an array of the particles up to date where they are ghosts.
    """
    if scheme.smagorinsky == 0.0:
        return None
    eddy = np.zeros(len(particles))
    kernels.strain_rate(
        particles.position, particles.velocity, particles.role, neighbors.indptr,
        neighbors.indices, stencil, matrices, scheme.wall_slip, eddy,
    )  # fmt: skip
    eddy *= (scheme.smagorinsky * stencil.spacing) ** 2
    refresh(eddy)
    return eddy


def acceleration(particles, neighbors, stencil, eddy, fluid, scheme):
    """nu <lap u> and div(nu_e grad u) of the fluid particles, (n, 3) [m/s2].

    Parameters
    ----------
    particles : ParticleSet
    neighbors : NeighborList
    stencil : Stencil
        Of the Laplacian.
    eddy : (n,) float64 or None
        From `eddies` [m2/s].
    fluid, scheme : tables of the case
    """
    out = np.zeros_like(particles.velocity)
    place = particles.position, particles.velocity, particles.role
    pairs = neighbors.indptr, neighbors.indices, stencil
    if fluid.viscosity > 0.0:
        kernels.viscous_acceleration(*place, *pairs, fluid.viscosity, scheme.wall_slip, out)
    if eddy is not None:
        kernels.eddy_acceleration(*place, *pairs, eddy, scheme.wall_slip, out)
    return out
