"""The coarse system of the deflation: groups of rows, and a band of couplings between groups.

Z is the (rows, groups) matrix that is one where a row belongs to a group and zero elsewhere.  A Z
is kept in compressed rows and Z^T A Z as a band: band[g, half + h - g] couples g to h <= g.
"""
from cython cimport floating
from libc.math cimport sqrt

from mpslab.kernels.lanes cimport row_of_doubles


def by_group(const int[::1] row, const int[::1] column, const floating[::1] value,
             const double[::1] diagonal, const int[::1] group, Py_ssize_t begin, Py_ssize_t end,
             int[::1] place, int[::1] start, int[::1] member, double[::1] entry):
    """A Z in the rows from begin to end: the couplings of each row, summed over the groups.

    place : (groups,) scratch, all -1; where a group's sum lies, if not before the row's begin
    start : (m + 1,) out, begin of each row in `member` and `entry`
    member, entry : out, groups and sums, long enough

    Returns the number of sums, and the largest difference between the number of a group that a row
    is coupled to and that of the row's own group.
    """
    cdef Py_ssize_t i, k
    cdef int g, total = 0, half = 0
    with nogil:
        for i in range(begin, end):
            start[i] = total
            place[group[i]] = total
            member[total] = group[i]
            entry[total] = diagonal[i]
            total += 1
            for k in range(row[i], row[i + 1]):
                g = group[column[k]]
                if place[g] < start[i]:
                    place[g] = total
                    member[total] = g
                    entry[total] = 0.0
                    total += 1
                    half = max(half, g - group[i])
                entry[place[g]] += value[k]
        start[end] = total
    return total, half


def couple(const int[::1] start, const int[::1] member, const double[::1] entry,
           const int[::1] group, Py_ssize_t begin, Py_ssize_t end, double[:, ::1] band):
    """Add Z^T A Z of the rows from begin to end to its band."""
    cdef Py_ssize_t i, k, half = band.shape[1] - 1
    cdef int g
    with nogil:
        for i in range(begin, end):
            g = group[i]
            for k in range(start[i], start[i + 1]):
                if member[k] <= g:
                    band[g, half + member[k] - g] += entry[k]


def condense(const int[::1] start, const int[::1] member, const double[::1] entry,
             const int[::1] rows, const int[::1] first, int begin, int end, int[::1] place,
             int[::1] row, int[::1] column, double[::1] value, double[::1] diagonal):
    """Z^T A Z in compressed rows, those of the groups from begin to end; the diagonal by itself.

    rows : rows of A, group by group; first : (groups + 1,) where those of a group begin
    place : (groups,) scratch, all -1
    row : (groups + 1,), column, value, diagonal : out

    Returns the number of entries.
    """
    cdef Py_ssize_t k, n
    cdef int g, h, i, total = 0
    with nogil:
        for g in range(begin, end):
            row[g] = total
            for n in range(first[g], first[g + 1]):
                i = rows[n]
                for k in range(start[i], start[i + 1]):
                    h = member[k]
                    if h == g:
                        diagonal[g] += entry[k]
                        continue
                    if place[h] < row[g]:
                        place[h] = total
                        column[total] = h
                        value[total] = 0.0
                        total += 1
                    value[place[h]] += entry[k]
        for g in range(end, row.shape[0]):
            row[g] = total
    return total


def factorise(double[:, ::1] band, double[::1] inverse):
    """Cholesky factor of a band, in place; `inverse` holds one over its diagonal.

    A group that depends on those before it is left out: its row and `inverse` are zero.
    """
    cdef Py_ssize_t i, j, k, low, half = band.shape[1] - 1
    cdef double total
    with nogil:
        for i in range(band.shape[0]):
            for j in range(max(i - half, 0), i):
                low = max(i - half, 0)
                total = band[i, half + j - i]
                # From `low` on both rows are contiguous.
                for k in range(j - low):
                    total -= band[i, half + low - i + k] * band[j, half + low - j + k]
                band[i, half + j - i] = total * inverse[j]
            total = band[i, half]
            for k in range(half):
                total -= band[i, k] * band[i, k]
            if total <= 1e-12 * band[i, half]:
                inverse[i] = 0.0
                for k in range(half):
                    band[i, k] = 0.0
            else:
                inverse[i] = 1.0 / sqrt(total)


def substitute(const double[:, ::1] band, const double[::1] inverse, double[::1] y):
    """Solve with the factor, forward and backward, in place."""
    cdef Py_ssize_t i, k, low, half = band.shape[1] - 1
    cdef double total
    with nogil:
        for i in range(band.shape[0]):
            low = max(half - i, 0)
            total = y[i]
            for k in range(low, half):
                total -= band[i, k] * y[i - half + k]
            y[i] = total * inverse[i]
        for i in range(band.shape[0] - 1, -1, -1):
            low = max(half - i, 0)
            y[i] *= inverse[i]
            total = y[i]
            for k in range(low, half):
                y[i - half + k] -= band[i, k] * total


def gather(const int[::1] group, const double[::1] r, Py_ssize_t begin, Py_ssize_t end,
           double[::1] y):
    """y = y + Z^T r of the rows from begin to end."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(begin, end):
            y[group[i]] += r[i]


def spread(const int[::1] group, const double[::1] y, double[::1] x):
    """x = x + Z y in all rows, those of ghosts as well."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(x.shape[0]):
            x[i] += y[group[i]]


def take_off(const int[::1] start, const int[::1] member, const double[::1] entry,
             const double[::1] y, Py_ssize_t begin, Py_ssize_t end, double[::1] q):
    """q = q - A Z y in the rows from begin to end."""
    cdef Py_ssize_t i, entries = member.shape[0]
    with nogil:
        for i in range(begin, end):
            if start[i] < start[i + 1]:
                q[i] -= row_of_doubles(&entry[start[i]], &member[start[i]], &y[0],
                                       start[i + 1] - start[i], entries - start[i])
