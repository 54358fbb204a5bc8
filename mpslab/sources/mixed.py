"""Mixed source: the divergence of the velocity and a share of the density deviation."""

from mpslab.kernels.divergence import divergence


def source(
    position, velocity, role, number_density, indptr, indices, stencil, correction, dt, rate,
    scheme, out,
):
    """b_i = -<div u*>_i/dt + s (n_i - n0)/(n0 dt) (Tanaka & Masunaga 2010) [1/s2]."""
    divergence(position, velocity, indptr, indices, stencil, out)
    out /= -dt
    out += (rate / dt) * (number_density / stencil.n0 - 1.0)
