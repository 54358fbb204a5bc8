"""Mixed source with the corrected divergence, exact for linear velocities."""

import numpy as np

from mpslab.kernels.divergence import corrected_divergence

LEAST_DETERMINANT = 0.05


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = -<div u*>_i/dt + s (n_i - n_r)/(n_r dt) [1/s2].

    <div u> with the correction matrix of Khayyer & Gotoh (2011), over all neighbours; n_r is the
    number density of relaxed water (`Stencil.relaxed`).
    """
    divergence = np.empty(len(velocity))
    corrected_divergence(near.row, near.other, near.offset, near.stencil, velocity,
                         near.inverted(LEAST_DETERMINANT), divergence)  # fmt: skip
    return (rate * (number_density / near.stencil.relaxed - 1.0) - divergence) / dt
