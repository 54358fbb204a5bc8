"""Laplacian of the original MPS method: exact for quadratics on the lattice."""


def pair_terms(stencil):
    """L(r) = (2 Ds/(lambda0 n0)) (r_e/r - 1) (Koshizuka & Oka 1996) [1/m2]."""
    factor = 2.0 * stencil.dim / (stencil.lambda0 * stencil.n0)
    return -factor, factor * stencil.radius, 0.0
