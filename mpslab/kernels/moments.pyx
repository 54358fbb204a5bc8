"""Correction matrix of the gradient: the inverse of the second moment of the neighbours."""
from mpslab.kernels.lanes cimport ended, four, load, nothing, store
from mpslab.kernels.matrix cimport inverted
from mpslab.kernels.pair cimport FLUID, plus_turned


def invert(const double[:, :, ::1] second, stencil, double least_determinant,
           double[:, :, ::1] out):
    """C_i = [(Ds/n0) sum_j w r_ij (x) r_ij / r^2]^-1 (Khayyer & Gotoh 2011) [-].

    second : (n, 3, 4), see mpslab.kernels.measure
    least_determinant : below it the matrix is too close to singular and C_i = I
    out : (n, 3, 4), the columns of C_i; the fourth number of each is 0
    """
    cdef double factor = stencil.dim / stencil.n0
    cdef bint flat = stencil.dim == 2
    cdef Py_ssize_t i
    with nogil:
        for i in range(second.shape[0]):
            inverted(&second[i, 0, 0], factor, flat, least_determinant, &out[i, 0, 0])


def without_fillers(const int[::1] row, const int[::1] solid, const int[::1] other,
                    const float[:, ::1] offset, const unsigned char[::1] loaded,
                    double[:, :, ::1] second):
    """Subtract neighbours that carry no pressure from the second moments, in place."""
    cdef Py_ssize_t i, k, a, b
    with nogil:
        for i in range(solid.shape[0]):
            for k in range(solid[i], row[i + 1]):
                if loaded[other[k]]:
                    continue
                for a in range(3):
                    for b in range(3):
                        second[i, a, b] -= offset[k, 3] * offset[k, a] * <double>offset[k, b]


def disorder(const double[:, :, ::1] second, const double[:, :, ::1] c,
             const double[:, ::1] lean, const signed char[::1] role, double[:, ::1] out):
    """S_i + C_i m_i of water, 0 of solids, with m_i = sum_j r_ij w/r^2 [1/m].

    second, c : (n, 3, 4), see mpslab.kernels.measure and `invert`
    lean, out : (n, 4), S_i [1/m], see mpslab.core.neighbourhood; the fourth number of out is 0
    """
    cdef double[4] m
    cdef four e
    cdef Py_ssize_t i, a
    m[3] = 0.0
    with nogil:
        for i in range(out.shape[0]):
            e = nothing()
            if role[i] == FLUID:
                for a in range(3):
                    m[a] = second[i, a, 3]
                e = plus_turned(load(&lean[i, 0]), &c[i, 0, 0], load(m))
            store(&out[i, 0], ended(e, 0.0))
