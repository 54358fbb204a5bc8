"""Assembly of the Poisson equation of pressure."""
from mpslab.kernels.pair cimport distance, has_pressure, wrap

# Neighbours whose coefficients are computed together, in vector lanes, before they are looked at.
cdef enum:
    LANES = 64


def assemble(const double[:, ::1] position, const signed char[::1] role, const int[::1] indptr,
             const int[::1] indices, const int[::1] rows, const int[::1] unknown, stencil,
             pair_terms, double scale, int[::1] row, int[::1] column, float[::1] value,
             double[::1] diagonal, double[::1] excess):
    """Rows of  -scale <lap p>  for the particles `rows`; `unknown` is their number (others: -1).

    Off-diagonal entries are -scale L(r_ij); the diagonal is the sum of scale L(r_ij) over all
    neighbours that carry a pressure, so that free-surface particles act as p = 0 and walls as
    dp/dn = 0.  Entries are rounded to single precision, half of what a product has to read, before
    they are summed: rows still add up to nothing.  `excess` is what a diagonal has above its row:
    the pull of the free surface.

    row : (m + 1,) out; column, value : (entries,) out, long enough; diagonal, excess : (m,) out
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double one = pair_terms[0], inverse = pair_terms[1], cubic = pair_terms[2]
    cdef double a, total, free
    cdef double[LANES] pair
    cdef Py_ssize_t m, i, k, j, begin, end
    cdef int entry = 0
    with nogil:
        for m in range(rows.shape[0]):
            i = rows[m]
            row[m] = entry
            total = free = 0.0
            end = indptr[i]
            while end < indptr[i + 1]:
                begin, end = end, min(end + LANES, indptr[i + 1])
                for k in range(begin, end):
                    j = indices[k]
                    pair[k - begin] = scale * coefficient(
                        distance(position[j, 0] - position[i, 0],
                                 wrap(position[j, 1] - position[i, 1], width),
                                 position[j, 2] - position[i, 2], floor),
                        radius, one, inverse, cubic)
                for k in range(begin, end):
                    j, a = indices[k], <float>pair[k - begin]
                    if a == 0.0 or not has_pressure(role[j]):
                        continue
                    total += a
                    if unknown[j] < 0:
                        free += a
                    else:
                        column[entry] = unknown[j]
                        value[entry] = <float>-a
                        entry += 1
            diagonal[m] = total
            excess[m] = free
        row[diagonal.shape[0]] = entry
    return entry


def reach(const int[::1] row, const int[::1] column, unsigned char[::1] reached):
    """Mark the rows that can be reached from those marked, over symmetric couplings.

    Sweeps forth and back: a row looks for the first one it is coupled to that is marked already.
    """
    cdef Py_ssize_t m, rows = reached.shape[0]
    cdef bint found = True
    with nogil:
        while found:
            found = False
            for m in range(rows):
                found |= touches(m, row, column, reached)
            for m in range(rows - 1, -1, -1):
                found |= touches(m, row, column, reached)


cdef inline bint touches(Py_ssize_t m, const int[::1] row, const int[::1] column,
                         unsigned char[::1] reached) noexcept nogil:
    """Mark a row that is not, if one that it is coupled to is; whether that was so."""
    cdef Py_ssize_t k
    if reached[m]:
        return False
    for k in range(row[m], row[m + 1]):
        if reached[column[k]]:
            reached[m] = 1
            return True
    return False
