"""Mixed source with the corrected divergence, exact for linear velocities."""

import numpy as np

from mpslab.kernels.divergence import corrected_divergence
from mpslab.kernels.moments import correction_matrix

LEAST_DETERMINANT = 0.05


def source(
    position, velocity, role, number_density, indptr, indices, stencil, correction, dt, rate,
    scheme, out,
):
    """b_i = -<div u*>_i/dt + s (n_i - n_r)/(n_r dt) [1/s2].

    <div u> with the correction matrix of Khayyer & Gotoh (2011), over all neighbours; n_r is the
    number density of relaxed water (`Stencil.relaxed`).
    """
    c = np.empty((len(position), 6))
    correction_matrix(position, role, indptr, indices, stencil, True, LEAST_DETERMINANT, c)
    corrected_divergence(position, velocity, indptr, indices, stencil, c, out)
    out /= -dt
    out += (rate / dt) * (number_density / stencil.relaxed - 1.0)
