"""Higher-order source with error-compensating terms (ECS)."""

import numpy as np

from mpslab.kernels.divergence import density_rate


def source(
    position, velocity, role, number_density, indptr, indices, stencil, correction, dt, rate,
    scheme, out,
):
    """b_i = HS + |e_i| (Dn/Dt)_i/(n0 dt) + |dt (Dn/Dt)_i/n0| e_i/dt^2 [1/s2].

    e_i = (n_i - n0)/n0 (Khayyer & Gotoh 2011).  The compensating terms, too, are evaluated at
    the predicted positions, which differ from those of the start by one step.
    """
    density_rate(position, velocity, indptr, indices, stencil, out)
    rate = out / stencil.n0
    error = number_density / stencil.n0 - 1.0
    out[:] = (rate * (1.0 + np.abs(error)) + np.abs(rate) * error) / dt
