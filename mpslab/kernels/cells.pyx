"""Linked cells: sort particles into boxes as wide as the search radius."""
from libc.math cimport floor


def assign(const double[:, ::1] position, const double[::1] lower, const double[::1] width,
           const int[::1] count, int[::1] cell):
    """Cell number of each particle, z fastest; positions outside count to the outermost cell."""
    cdef Py_ssize_t i, a
    cdef int number, c
    with nogil:
        for i in range(position.shape[0]):
            number = 0
            for a in range(3):
                c = <int>floor((position[i, a] - lower[a]) / width[a])
                c = 0 if c < 0 else (count[a] - 1 if c >= count[a] else c)
                number = number * count[a] + c
            cell[i] = number


def sort(const int[::1] cell, int[::1] start, int[::1] member):
    """Counting sort: member[start[c]:start[c + 1]] are the particles of cell c, in order."""
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
        for i in range(cell.shape[0]):
            member[start[cell[i]]] = <int>i
            start[cell[i]] += 1
        for c in range(start.shape[0] - 1, 0, -1):
            start[c] = start[c - 1]
        start[0] = 0
