"""Least pressure around a particle."""
from mpslab.kernels.pair cimport distance, has_pressure, wrap


def least_pressure(const double[:, ::1] position, const double[::1] pressure,
                   const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
                   stencil, double[::1] out):
    """p^_i = min of p over the particle itself and its neighbours (equation 3 of the paper) [Pa].

    The layers behind the walls carry no pressure and do not count.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double least
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            least = pressure[i]
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                if has_pressure(role[j]) and pressure[j] < least:
                    if distance(position[j, 0] - position[i, 0],
                                wrap(position[j, 1] - position[i, 1], width),
                                position[j, 2] - position[i, 2], floor) < radius:
                        least = pressure[j]
            out[i] = least
