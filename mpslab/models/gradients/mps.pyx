"""Pressure gradient of the original MPS method."""
import numpy as np

from mpslab.kernels.lanes cimport four, lane, nothing, plus
from mpslab.kernels.pair cimport FLUID, pull

from mpslab.kernels.minimum import least_pressure

CONSERVES_MOMENTUM = False
EXACT_FOR_LINEAR = False


def gradient(near, double[:, ::1] out):
    """<grad p>_i = (Ds/n0) sum_j (p_j - p^_i) r_ij w / r^2 (equations 2 and 3 of the paper)."""
    cdef const int[::1] row = near.row, other = near.other
    cdef const float[:, ::1] offset = near.offset
    cdef const double[::1] pressure = near.particles.pressure
    cdef const signed char[::1] role = near.particles.role
    cdef const unsigned char[::1] loaded = near.loaded
    cdef double factor = near.stencil.dim / near.stencil.n0
    cdef double[::1] least = np.empty(pressure.shape[0])
    least_pressure(row, other, offset, pressure, loaded, least)
    cdef four total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(role.shape[0]):
            total = nothing()
            for k in range(row[i], row[i + 1] if role[i] == FLUID else row[i]):
                j = other[k]
                if loaded[j]:
                    total = plus(total, pressure[j] - least[i], pull(&offset[k, 0]))
            for a in range(3):
                out[i, a] = factor * lane(total, a)
