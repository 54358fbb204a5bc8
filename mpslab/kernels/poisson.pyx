"""Assembly of the Poisson equation of pressure."""
from mpslab.kernels.pair cimport LANES, coefficient


def assemble(const int[::1] row_of, const int[::1] other, const float[::1] inverse,
             const int[::1] rows, const int[::1] unknown, stencil, pair_terms, double scale,
             int[::1] row, int[::1] column, float[::1] value, double[::1] diagonal,
             double[::1] excess):
    """Rows of  -scale <lap p>  for the particles `rows`.

    `unknown` is the number of the row of each particle; -1 at the free surface, where p = 0; -2 for
    a particle that is not in the equation, which acts as dp/dn = 0.  Off-diagonal entries are
    -scale L(r_ij); the diagonal is the sum of scale L(r_ij) over all neighbours in the equation and
    those at the free surface.  Entries are rounded to single precision before they are summed: a
    product then reads half as much, and away from the free surface a row still adds up to zero.
    `excess` is the sum of each row: the pull of the free surface.

    row_of, other, inverse : pairs, see mpslab.kernels.measure
    row : (m + 1,) out; column, value : (entries,) out, long enough; diagonal, excess : (m,) out
    """
    cdef double radius = stencil.radius
    cdef double one = pair_terms[0], first = pair_terms[1], third = pair_terms[2]
    cdef double total, free
    cdef float a, none = 0
    cdef float[LANES] pair
    cdef Py_ssize_t m, i, k, begin, end, lane
    cdef int u, entry = 0
    with nogil:
        for m in range(rows.shape[0]):
            i = rows[m]
            row[m] = entry
            total = free = 0.0
            end = row_of[i]
            while end < row_of[i + 1]:
                begin, end = end, min(end + LANES, row_of[i + 1])
                for lane in range(LANES):
                    pair[lane] = <float>(scale * coefficient(inverse[begin + lane], radius, one,
                                                             first, third))
                for k in range(begin, end):
                    u = unknown[other[k]]
                    a = pair[k - begin] if u > -2 else none
                    total += a
                    free += a if u < 0 else none
                    column[entry] = u
                    value[entry] = -a
                    entry += (a != none) & (u >= 0)
            diagonal[m] = total
            excess[m] = free
        row[diagonal.shape[0]] = entry
    return entry


def reach(const int[::1] row, const int[::1] column, unsigned char[::1] reached):
    """Mark the rows that can be reached from marked ones, over symmetric couplings.

    Sweeps back and forth: a row looks for a marked one that it is coupled to, first on the side
    from which the sweep comes.  Particles are numbered upwards, so in the first sweep, down from
    the surface, nearly all rows find one at once.
    """
    cdef Py_ssize_t m, k, rows = reached.shape[0]
    cdef bint found = True
    with nogil:
        while found:
            found = False
            for m in range(rows - 1, -1, -1):
                if not reached[m]:
                    for k in range(row[m + 1] - 1, row[m] - 1, -1):
                        if reached[column[k]]:
                            found = reached[m] = True
                            break
            for m in range(rows):
                if not reached[m]:
                    for k in range(row[m], row[m + 1]):
                        if reached[column[k]]:
                            found = reached[m] = True
                            break
