"""Source of the original MPS method: the deviation of the number density, relaxed."""

import numpy as np


def source(
    position, velocity, role, number_density, indptr, indices, stencil, correction, dt, rate,
    scheme, out,
):
    """b_i = relaxation (n*_i - n0)/(n0 dt^2) (Koshizuka & Oka 1996) [1/s2]."""
    np.multiply(number_density / stencil.n0 - 1.0, scheme.relaxation / dt**2, out=out)
