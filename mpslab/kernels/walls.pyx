"""Pressure of walls: that of the water in front of them, or of their own first layer."""
from libc.math cimport INFINITY

from mpslab.kernels.pair cimport FACE, FILLER, FLUID, distance, weight, wrap
from mpslab.kernels.poisson cimport coefficient


def flux(const double[:, ::1] position, const signed char[::1] role, const int[::1] indptr,
         const int[::1] indices, stencil, pair_terms, const double[:, ::1] pull,
         double[::1] out):
    """sum over the solid neighbours of L(r_ij) f_j . r_ij: the Laplacian's share of walls [1/s2].

    pull : (n, 3) f = g - a_wall, so that p_j = p_i + rho f_j . r_ij across a wall [m/s2]
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double one = pair_terms[0], inverse = pair_terms[1], cubic = pair_terms[2]
    cdef double dx, dy, dz, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                if role[j] == FLUID:
                    continue
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                total += (coefficient(distance(dx, dy, dz, floor), radius, one, inverse, cubic)
                          * (pull[j, 0] * dx + pull[j, 1] * dy + pull[j, 2] * dz))
            out[i] = total


def extrapolate(const double[:, ::1] position, const signed char[::1] role,
                const int[::1] indptr, const int[::1] indices, stencil, double density,
                const double[:, ::1] pull, bint clip, double[::1] pressure, double[::1] total):
    """p_w = sum_f w (p_f + rho f_w . r_fw) / sum_f w over the water f near a solid w [Pa].

    Zero where there is no water near (Adami, Hu & Adams 2012).  Rows are those of the water.

    clip : whether a negative pressure becomes zero
    total : (n,) scratch
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, w
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total[i] = 0.0
            if role[i] != FLUID:
                pressure[i] = 0.0
        for i in range(indptr.shape[0] - 1):
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                if role[j] == FLUID:
                    continue
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                w = weight(distance(dx, dy, dz, floor), radius)
                total[j] += w
                pressure[j] += w * (pressure[i] + density * (
                    pull[j, 0] * dx + pull[j, 1] * dy + pull[j, 2] * dz))
        for i in range(indptr.shape[0] - 1):
            if total[i] > 0.0:
                pressure[i] = 0.0 if clip and pressure[i] < 0.0 else pressure[i] / total[i]


def nearest_face(const double[:, ::1] position, const signed char[::1] role,
                 const int[::1] indptr, const int[::1] indices, double width, int[::1] out):
    """Nearest face among the neighbours of each filler, the first of several; else -1, (n,)."""
    cdef double dx, dy, dz, square, least
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            out[i] = -1
            if role[i] != FILLER:
                continue
            least = INFINITY
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                if role[j] != FACE:
                    continue
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                square = dx * dx + dy * dy + dz * dz
                if square < least:
                    least = square
                    out[i] = <int>j
