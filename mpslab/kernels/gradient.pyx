"""Sums over pairs from which gradients of the pressure are made."""
from mpslab.kernels.lanes cimport four, lane, load, nothing, plus, times
from mpslab.kernels.pair cimport FLUID, pull


def by_pairs(const int[::1] row, const int[::1] other, const float[:, ::1] offset,
             const float[::1] inverse, const double[::1] pressure, const double[::1] own,
             const signed char[::1] role, const unsigned char[::1] loaded, double factor,
             bint soft, double[:, ::1] out):
    """factor sum_j (p_j + own_i) r_ij w/r^2 for water, 0 for solids; with `soft`, w/r for w/r^2.

    row, other, offset, inverse : pairs, see mpslab.kernels.measure
    own : (n,) [Pa]
    loaded : (n,) 1 for the particles that act with a pressure
    """
    cdef four total
    cdef Py_ssize_t i, a, end
    with nogil:
        for i in range(role.shape[0]):
            end = row[i + 1] if role[i] == FLUID else row[i]
            if soft:
                total = softly(row[i], end, other, offset, inverse, pressure, own[i], loaded)
            else:
                total = plainly(row[i], end, other, offset, pressure, own[i], loaded)
            for a in range(3):
                out[i, a] = factor * lane(total, a)


cdef inline four plainly(Py_ssize_t begin, Py_ssize_t end, const int[::1] other,
                         const float[:, ::1] offset, const double[::1] pressure, double own,
                         const unsigned char[::1] loaded) noexcept nogil:
    """sum_j (p_j + own) r_ij w/r^2 of a row."""
    cdef four total = nothing()
    cdef Py_ssize_t k, j
    for k in range(begin, end):
        j = other[k]
        if loaded[j]:
            total = plus(total, pressure[j] + own, pull(&offset[k, 0]))
    return total


cdef inline four softly(Py_ssize_t begin, Py_ssize_t end, const int[::1] other,
                        const float[:, ::1] offset, const float[::1] inverse,
                        const double[::1] pressure, double own,
                        const unsigned char[::1] loaded) noexcept nogil:
    """sum_j (p_j + own) r_ij w/r of a row."""
    cdef four total = nothing()
    cdef Py_ssize_t k, j
    for k in range(begin, end):
        j = other[k]
        if loaded[j]:
            total = plus(total, (pressure[j] + own) / inverse[k], pull(&offset[k, 0]))
    return total


def turn(const double[:, :, ::1] c, double factor, double[:, ::1] out):
    """out_i = factor C_i out_i, with matrices in three columns of four numbers."""
    cdef four total
    cdef Py_ssize_t i, a
    with nogil:
        for i in range(out.shape[0]):
            total = times(out[i, 0], load(&c[i, 0, 0]))
            total = plus(total, out[i, 1], load(&c[i, 1, 0]))
            total = plus(total, out[i, 2], load(&c[i, 2, 0]))
            for a in range(3):
                out[i, a] = factor * lane(total, a)
