"""The correction matrices of a step, shared by the models that work with them."""

import numpy as np

from mpslab.kernels.moments import correction_matrix

# Near the free surface the moment is one-sided and its inverse large: one layer would push the
# next away.  There C = I, and the pair of the conservative gradient is that of p_i + p_j.
LEAST_DETERMINANT = 0.6


def matrices(particles, neighbors, stencil):
    """C_i = [(Ds/n0) sum_j w r_ij (x) r_ij / r^2]^-1 over all neighbours, (n, 6) float64 [-].

    Khayyer & Gotoh (2011); components xx, yy, zz, xy, xz, yz; the identity where the determinant of
    the bracket is below 0.6.
    """
    out = np.empty((len(particles), 6))
    correction_matrix(particles.position, particles.role, neighbors.indptr, neighbors.indices,
                      stencil, True, LEAST_DETERMINANT, out)  # fmt: skip
    return out


def identity(n):
    """Matrices that correct nothing, (n, 6) float64."""
    return np.tile([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], (n, 1))
