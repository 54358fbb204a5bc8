"""Pressure of walls: from the water in front of them, or from their own first layer.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
pull : (n, 3) f = g - a_wall, so that p_j = p_i + rho f_j . r_ij across a wall [m/s2]
"""
from mpslab.kernels.pair cimport FACE, FILLER, FLUID, coefficient, dot, weight


def flux(const int[::1] row, const int[::1] solid, const int[::1] other,
         const float[:, ::1] offset, const float[::1] inverse, stencil, pair_terms,
         const double[:, ::1] pull, double[::1] out):
    """Sum of L(r_ij) f_j . r_ij over solid neighbours: what walls add to the Laplacian [1/s2]."""
    cdef double radius = stencil.radius
    cdef double one = pair_terms[0], first = pair_terms[1], third = pair_terms[2]
    cdef double total
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(solid.shape[0]):
            total = 0.0
            for k in range(solid[i], row[i + 1]):
                total += (coefficient(inverse[k], radius, one, first, third)
                          * dot(&pull[other[k], 0], &offset[k, 0]))
            out[i] = total


def extrapolate(const int[::1] row, const int[::1] solid, const int[::1] other,
                const float[:, ::1] offset, const float[::1] inverse,
                const signed char[::1] role, stencil, double density,
                const double[:, ::1] pull, bint clip, double[::1] pressure, double[::1] total):
    """p_w = sum_f w (p_f + rho f_w . r_fw) / sum_f w over the water f near a solid w [Pa].

    Zero if there is no water near (Adami, Hu & Adams 2012).  Only water particles have rows.

    clip : whether a negative pressure becomes zero
    total : (n,) scratch
    """
    cdef double radius = stencil.radius
    cdef double w
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(solid.shape[0]):
            total[i] = 0.0
            if role[i] != FLUID:
                pressure[i] = 0.0
        for i in range(solid.shape[0]):
            for k in range(solid[i], row[i + 1]):
                j = other[k]
                w = weight(inverse[k], radius)
                total[j] += w
                pressure[j] += w * (pressure[i] + density * dot(&pull[j, 0], &offset[k, 0]))
        for i in range(solid.shape[0]):
            if total[i] > 0.0:
                pressure[i] = 0.0 if clip and pressure[i] < 0.0 else pressure[i] / total[i]


def nearest_face(const int[::1] row, const int[::1] solid, const int[::1] other,
                 const float[::1] inverse, const signed char[::1] role, int[::1] out):
    """Nearest face among the neighbours of each filler, the first of equals; -1 for none, (n,)."""
    cdef float most
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(solid.shape[0]):
            out[i] = -1
            most = 0
            for k in range(solid[i], row[i + 1] if role[i] == FILLER else solid[i]):
                if role[other[k]] == FACE and inverse[k] > most:
                    most = inverse[k]
                    out[i] = other[k]
