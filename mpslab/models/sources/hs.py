"""Higher-order source (HS): the rate of change of the number density."""

import numpy as np

from mpslab.kernels.divergence import density_rate


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = (Dn/Dt)*_i/(n0 dt) (Khayyer & Gotoh 2009) [1/s2]."""
    out = np.empty(len(velocity))
    density_rate(near.row, near.other, near.offset, near.inverse, near.stencil, velocity, out)
    return out / (near.stencil.n0 * dt)
