"""Pressure gradient of CMPS with one power of the distance less, a softer pair force."""
import numpy as np

from mpslab.kernels.minimum import least_pressure
from mpslab.kernels.pair cimport FLUID, distance, has_pressure, weight, wrap

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(const double[:, ::1] position, const double[::1] pressure,
             const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
             stencil, correction, double[:, ::1] out):
    """<grad p>_i = (Ds/m0) sum_j ((p_i + p_j) - (p^_i + p^_j)) r_ij w / r.

    Equation (4) of the paper with r in place of r^2, and m0 = sum w r over the full lattice in
    place of n0 = sum w: so the dimension is that of a gradient, and the sum of p_i + p_j is exact
    on the lattice.  The printed text that we have shows r, but its factor goes with r^2
    (docs/cmps.md).
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.first
    cdef double[::1] least = np.empty(pressure.shape[0])
    cdef double dx, dy, dz, r, c, gx, gy, gz
    cdef Py_ssize_t i, k, j
    least_pressure(position, pressure, role, indptr, indices, stencil, least)
    with nogil:
        for i in range(indptr.shape[0] - 1):
            gx = gy = gz = 0.0
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                c = ((pressure[i] + pressure[j]) - (least[i] + least[j])) * weight(r, radius) / r
                c = c if has_pressure(role[j]) else 0.0
                gx += c * dx
                gy += c * dy
                gz += c * dz
            out[i, 0] = factor * gx
            out[i, 1] = factor * gy
            out[i, 2] = factor * gz
