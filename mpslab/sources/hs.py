"""Higher-order source (HS): the rate of change of the number density."""

from mpslab.kernels.divergence import density_rate


def source(
    position, velocity, role, number_density, indptr, indices, stencil, correction, dt, rate,
    scheme, out,
):
    """b_i = (Dn/Dt)*_i/(n0 dt) (Khayyer & Gotoh 2009) [1/s2]."""
    density_rate(position, velocity, indptr, indices, stencil, out)
    out /= stencil.n0 * dt
