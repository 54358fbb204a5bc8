"""Sparse rows: product, incomplete Cholesky factor, substitution."""
from cython cimport floating

from mpslab.kernels.lanes cimport row_of_doubles, row_of_singles


def multiply(const int[::1] row, const int[::1] column, const floating[::1] value,
             const double[::1] diagonal, const double[::1] x, double[::1] out,
             Py_ssize_t begin=0, Py_ssize_t end=-1):
    """out = A x in the rows from begin to end (-1: all); A is symmetric.

    The diagonal is stored beside the off-diagonal rows.
    """
    cdef Py_ssize_t i, entries = column.shape[0]
    if end < 0:
        end = diagonal.shape[0]
    with nogil:
        for i in range(begin, end):
            out[i] = diagonal[i] * x[i]
            if row[i] == row[i + 1]:
                continue
            if floating is float:
                out[i] += row_of_singles(&value[row[i]], &column[row[i]], &x[0],
                                         row[i + 1] - row[i], entries - row[i])
            else:
                out[i] += row_of_doubles(&value[row[i]], &column[row[i]], &x[0],
                                         row[i + 1] - row[i], entries - row[i])


def dot(const double[::1] x, const double[::1] y):
    """Sum of x_i y_i, in an order that does not depend on where the arrays lie."""
    cdef Py_ssize_t i
    cdef double total = 0.0
    with nogil:
        for i in range(x.shape[0]):
            total += x[i] * y[i]
    return total


def slab_dots(const double[::1] x, const double[::1] y, const int[::1] first, int begin, int end,
              double[::1] out):
    """out[s] = sum of x_i y_i over the rows first[s] to first[s + 1] of the slabs begin to end."""
    cdef Py_ssize_t i
    cdef int s
    cdef double total
    with nogil:
        for s in range(begin, end):
            total = 0.0
            for i in range(first[s], first[s + 1]):
                total += x[i] * y[i]
            out[s] = total


def axpy(double a, const double[::1] x, double[::1] y):
    """y = y + a x."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(x.shape[0]):
            y[i] += a * x[i]


def xpay(const double[::1] x, double a, double[::1] y):
    """y = x + a y."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(x.shape[0]):
            y[i] = x[i] + a * y[i]


def sort_rows(const int[::1] row, int[::1] column, float[::1] value):
    """Put the entries of each row in the order of their columns, in place."""
    cdef Py_ssize_t i
    cdef int k, e, c
    cdef float v
    with nogil:
        for i in range(row.shape[0] - 1):
            for k in range(row[i] + 1, row[i + 1]):
                c, v, e = column[k], value[k], k
                while e > row[i] and column[e - 1] > c:
                    column[e], value[e] = column[e - 1], value[e - 1]
                    e -= 1
                column[e], value[e] = c, v


def lower_ends(const int[::1] row, const int[::1] column, int[::1] end):
    """End of the part left of the diagonal in each row (columns ascend)."""
    cdef Py_ssize_t i
    cdef int k
    with nogil:
        for i in range(end.shape[0]):
            k = row[i]
            while k < row[i + 1] and column[k] < i:
                k += 1
            end[i] = k


def factorise(const int[::1] row, const int[::1] column, const float[::1] value,
              const double[::1] diagonal, const int[::1] end, double[::1] factor,
              double[::1] pivot, double[::1] work):
    """Incomplete Cholesky factor without fill, A ~ (I + L) D (I + L)^T.

    factor : out, laid out as `value`; its lower part holds L
    pivot : (m,) out, 1/D
    work : (m,) scratch, all zero; holds a whole row, so that absent entries add nothing

    Returns the number of pivots that came out below 1e-2 of their diagonal; each of them was
    replaced by the diagonal.
    """
    cdef Py_ssize_t i, k, e
    cdef int c, replaced = 0
    cdef double d, f
    with nogil:
        for i in range(diagonal.shape[0]):
            for k in range(row[i], end[i]):
                work[column[k]] = value[k]
            d = diagonal[i]
            # From left to right, work turns from row i of A into row i of L D.
            for k in range(row[i], end[i]):
                c = column[k]
                f = 0.0
                for e in range(row[c], end[c]):
                    f += factor[e] * work[column[e]]
                work[c] -= f
            for k in range(row[i], end[i]):
                c = column[k]
                factor[k] = work[c] * pivot[c]
                d -= factor[k] * work[c]
                work[c] = 0.0
            if d < 1e-2 * diagonal[i]:
                d = diagonal[i]
                replaced += 1
            pivot[i] = 1.0 / d
    return replaced


def substitute(const int[::1] row, const int[::1] column, const int[::1] end,
               const double[::1] factor, const double[::1] pivot, const double[::1] r,
               double[::1] z):
    """Solve (I + L) D (I + L)^T z = r: forward, then backward."""
    cdef Py_ssize_t i, k
    cdef double total
    with nogil:
        for i in range(pivot.shape[0]):
            total = r[i]
            for k in range(row[i], end[i]):
                total -= factor[k] * z[column[k]]
            z[i] = total
        for i in range(pivot.shape[0]):
            z[i] *= pivot[i]
        for i in range(pivot.shape[0] - 1, -1, -1):
            total = z[i]
            for k in range(row[i], end[i]):
                z[column[k]] -= factor[k] * total
