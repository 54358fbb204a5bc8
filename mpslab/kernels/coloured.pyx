"""Incomplete Cholesky factor and substitution, red slabs first, then the black ones.

Rows are numbered by slab; slab s has the rows first[s] to first[s + 1].  In the order of the
elimination all red (even) slabs come before all black (odd) ones, so a red row has its own slab
only to its left, and a black row has both red neighbours there, and a part of its own slab.
"""


def split(const int[::1] row, const int[::1] column, const float[::1] value,
          const int[::1] slab, int[::1] lower, int[::1] middle, int[::1] left, double[::1] entry):
    """Entries to the left of the diagonal, those of red neighbours first.

    slab : (m,) slab of each row
    lower : (m + 1,) out, begin of each row in `left` and `entry`
    middle : (m,) out, where in a row the entries of its own slab begin
    left, entry : out, columns and values, long enough

    Returns the number of entries.
    """
    cdef Py_ssize_t i, k
    cdef int c, total = 0
    with nogil:
        for i in range(slab.shape[0]):
            lower[i] = total
            if slab[i] % 2:
                for k in range(row[i], row[i + 1]):
                    c = column[k]
                    if slab[c] != slab[i]:
                        left[total] = c
                        entry[total] = value[k]
                        total += 1
            middle[i] = total
            for k in range(row[i], row[i + 1]):
                c = column[k]
                if c < i and slab[c] == slab[i]:
                    left[total] = c
                    entry[total] = value[k]
                    total += 1
        lower[slab.shape[0]] = total
    return total


def factorise(const int[::1] first, int begin, int end, const int[::1] lower,
              const int[::1] middle, const int[::1] left, const double[::1] diagonal,
              double[::1] factor, double[::1] pivot, double[::1] work):
    """A ~ (I + L) D (I + L)^T without fill, no coupling dropped; `factor` turns from A into L.

    begin, end : the slabs of this rank; of a black slab beside them, only the couplings to this
        rank's red rows are known, and no others are needed
    pivot : (m,) out, 1/D
    work : (m,) scratch, all zero; holds a whole row, so that absent entries add nothing

    Returns the number of this rank's pivots that came out below 1e-2 of their diagonal; each of
    them was replaced by the diagonal.
    """
    cdef Py_ssize_t i, k, e
    cdef int colour, s, c, stop, replaced = 0
    cdef bint owned
    cdef double d, f
    with nogil:
        for colour in range(2):
            for s in range(colour, <int>first.shape[0] - 1, 2):
                owned = begin <= s < end
                for i in range(first[s], first[s + 1]):
                    stop = lower[i + 1] if owned or colour == 0 else middle[i]
                    for k in range(lower[i], stop):
                        work[left[k]] = factor[k]
                    d = diagonal[i]
                    # In the order of elimination, work turns from row i of A into row i of L D.
                    for k in range(lower[i], stop):
                        c = left[k]
                        f = 0.0
                        for e in range(lower[c], lower[c + 1]):
                            f += factor[e] * work[left[e]]
                        work[c] -= f
                    for k in range(lower[i], stop):
                        c = left[k]
                        factor[k] = work[c] * pivot[c]
                        d -= factor[k] * work[c]
                        work[c] = 0.0
                    if d < 1e-2 * diagonal[i]:
                        d = diagonal[i]
                        replaced += owned
                    pivot[i] = 1.0 / d
    return replaced


def forward(int colour, const int[::1] first, int begin, int end, const int[::1] lower,
            const int[::1] left, const double[::1] factor, const double[::1] r, double[::1] z):
    """(I + L) z = r in the slabs of one colour from `begin` to `end`."""
    cdef Py_ssize_t i, k
    cdef int s
    cdef double total
    with nogil:
        for s in range(begin + (begin + colour) % 2, end, 2):
            for i in range(first[s], first[s + 1]):
                total = r[i]
                for k in range(lower[i], lower[i + 1]):
                    total -= factor[k] * z[left[k]]
                z[i] = total


def backward(int colour, const int[::1] first, int begin, int end, const int[::1] lower,
             const int[::1] middle, const int[::1] left, const double[::1] factor, double[::1] z):
    """(I + L)^T z = z inside each slab of one colour from `begin` to `end`, in place."""
    cdef Py_ssize_t i, k
    cdef int s
    cdef double total
    with nogil:
        for s in range(begin + (begin + colour) % 2, end, 2):
            for i in range(first[s + 1] - 1, first[s] - 1, -1):
                total = z[i]
                for k in range(middle[i], lower[i + 1]):
                    z[left[k]] -= factor[k] * total


def hand_back(const int[::1] first, const int[::1] lower, const int[::1] middle,
              const int[::1] left, const double[::1] factor, double[::1] z):
    """Subtract what the black rows add to the red ones; between the two colours of `backward`."""
    cdef Py_ssize_t i, k
    cdef int s
    cdef double total
    with nogil:
        for s in range(1, <int>first.shape[0] - 1, 2):
            for i in range(first[s], first[s + 1]):
                total = z[i]
                for k in range(lower[i], middle[i]):
                    z[left[k]] -= factor[k] * total
