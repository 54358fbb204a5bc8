"""Corrected pressure gradient, exact for linear fields (GC)."""
import numpy as np

from mpslab.kernels.moments import correction_matrix
from mpslab.kernels.pair cimport FLUID, distance, has_pressure, weight, wrap

CONSERVES_MOMENTUM = False
EXACT_FOR_LINEAR = True
LEAST_DETERMINANT = {2: 0.05, 3: 0.05}


def gradient(const double[:, ::1] position, const double[::1] pressure,
             const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
             stencil, correction, double[:, ::1] out):
    """<grad p>_i = C_i (Ds/n0) sum_j (p_j - p_i) r_ij w / r^2 (Khayyer & Gotoh 2011).

    C_i is the inverse moment matrix over the same neighbours.  Forces are not equal and
    opposite, and nothing in them keeps particles apart: a stabiliser has to.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef double[:, ::1] c = np.empty((pressure.shape[0], 6))
    cdef double dx, dy, dz, r, w, gx, gy, gz
    cdef Py_ssize_t i, k, j
    correction_matrix(position, role, indptr, indices, stencil, False,
                      LEAST_DETERMINANT[stencil.dim], c)
    with nogil:
        for i in range(indptr.shape[0] - 1):
            gx = gy = gz = 0.0
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = (pressure[j] - pressure[i]) * weight(r, radius) / (r * r)
                w = w if has_pressure(role[j]) else 0.0
                gx += w * dx
                gy += w * dy
                gz += w * dz
            out[i, 0] = factor * (c[i, 0] * gx + c[i, 3] * gy + c[i, 4] * gz)
            out[i, 1] = factor * (c[i, 3] * gx + c[i, 1] * gy + c[i, 5] * gz)
            out[i, 2] = factor * (c[i, 4] * gx + c[i, 5] * gy + c[i, 2] * gz)
