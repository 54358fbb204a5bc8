"""Linked cells: sort particles into the boxes of a grid."""
from libc.math cimport floor


cdef inline int along(double x, double lower, double per, int count) noexcept nogil:
    """Cell of a place along an axis; outside, the outermost cell; the first for not-a-number.

    `per` is how many cells there are in a metre: a product, because fast mathematics may round a
    quotient differently in different places.
    """
    cdef double c = floor((x - lower) * per)
    c = c if c > 0.0 else 0.0
    return <int>(c if c < count - 1.0 else count - 1.0)


cdef inline double folded(double y, double width) noexcept nogil:
    """A place across the tank, brought back into the period; width = 0 for none."""
    return y - width * floor(y / width) if width > 0.0 else y


def assign(const double[:, ::1] position, const double[::1] lower, const double[::1] per,
           const int[::1] count, double width, int[::1] cell, int[::1] box):
    """Cell number of each particle, z fastest, within the least box of cells that holds them all.

    width : period along y, 0 for none; with a period, the box takes in all of it
    box : (3,) out, cells of the box along each axis
    """
    cdef Py_ssize_t i
    cdef int x, y, z
    cdef int[3] least = [count[0], count[1], count[2]]
    cdef int[3] most = [0, 0, 0]
    with nogil:
        for i in range(position.shape[0]):
            x = along(position[i, 0], lower[0], per[0], count[0])
            y = along(folded(position[i, 1], width), lower[1], per[1], count[1])
            z = along(position[i, 2], lower[2], per[2], count[2])
            least[0], most[0] = min(least[0], x), max(most[0], x)
            least[1], most[1] = min(least[1], y), max(most[1], y)
            least[2], most[2] = min(least[2], z), max(most[2], z)
        if width > 0.0:
            least[1], most[1] = 0, count[1] - 1
        for i in range(3):
            box[i] = max(most[i] - least[i] + 1, 1)
        for i in range(position.shape[0]):
            x = along(position[i, 0], lower[0], per[0], count[0]) - least[0]
            y = along(folded(position[i, 1], width), lower[1], per[1], count[1]) - least[1]
            z = along(position[i, 2], lower[2], per[2], count[2]) - least[2]
            cell[i] = (x * box[1] + y) * box[2] + z


def count(const int[::1] cell, int[::1] start):
    """start[c] = how many particles are in cells before c."""
    cdef Py_ssize_t i
    cdef int c, here, total = 0
    with nogil:
        start[:] = 0
        for i in range(cell.shape[0]):
            start[cell[i]] += 1
        for c in range(start.shape[0]):
            here = start[c]
            start[c] = total
            total += here


def sort(const int[::1] cell, const long long[::1] gid, int[::1] start, int[::1] order):
    """order = the particles cell by cell, in a cell by gid; `start` comes from `count`, changes."""
    cdef Py_ssize_t i, place
    cdef int c, first
    with nogil:
        for i in range(cell.shape[0]):
            c = cell[i]
            place = start[c]
            start[c] += 1
            order[place] = <int>i
        for place in range(1, cell.shape[0]):
            i, c = place, order[place]
            while i > 0 and cell[order[i - 1]] == cell[c] and gid[order[i - 1]] > gid[c]:
                order[i] = order[i - 1]
                i -= 1
            order[i] = c


def ascend(const int[::1] cell):
    """Whether the cells ascend from each particle to the next, or stay."""
    cdef Py_ssize_t i
    cdef bint sorted_ = True
    with nogil:
        for i in range(1, cell.shape[0]):
            sorted_ &= cell[i - 1] <= cell[i]
    return sorted_


cdef inline Py_ssize_t block_of(const double[:, ::1] position, Py_ssize_t i,
                                const double[::1] lower, const double[::1] per,
                                const int[::1] count, const int[::1] blocks) noexcept nogil:
    """The block of 2 x 2 x 2 cells that a place is in; along an axis with one block, that."""
    cdef int x = along(position[i, 0], lower[0], per[0], count[0]) >> 1
    cdef int y = along(position[i, 1], lower[1], per[1], count[1]) >> 1 if blocks[1] > 1 else 0
    cdef int z = along(position[i, 2], lower[2], per[2], count[2]) >> 1
    return (x * blocks[1] + y) * blocks[2] + z


def mark(const double[:, ::1] position, const unsigned char[::1] mask, const double[::1] lower,
         const double[::1] per, const int[::1] count, const int[::1] blocks,
         unsigned char[::1] marks):
    """marks (blocks,) = 1 for those with particles of the mask in them."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(position.shape[0]):
            if mask[i]:
                marks[block_of(position, i, lower, per, count, blocks)] = 1


def marked(const double[:, ::1] position, const unsigned char[::1] mask, const double[::1] lower,
           const double[::1] per, const int[::1] count, const int[::1] blocks,
           const unsigned char[::1] marks, unsigned char[::1] out):
    """out (n,) = whether a particle of the mask is in a block that is marked."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(position.shape[0]):
            out[i] = marks[block_of(position, i, lower, per, count, blocks)] if mask[i] else 0
