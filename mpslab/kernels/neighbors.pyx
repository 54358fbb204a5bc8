"""Neighbour search over the cells of a grid; the particles are in the order of the cells.

The search goes along x, row after row of cells.  From one cell to the next, the particles that may
be neighbours change by one layer of cells: they are copied into scratch, layer after layer, and
each step adds a layer at the end.
"""
from libc.string cimport memcpy

from mpslab.kernels.lanes cimport near_eight, prepare_squeeze, squeeze

cdef enum:
    LANES = 8  # particles that are copied together, and whose distances are taken together
    STRETCH = 16  # cells along x after which the rows found so far are put into their places


def search(const double[:, ::1] packed, const unsigned char[::1] active, const int[::1] start,
           const int[::1] count, const int[::1] reach, const int[:, ::1] beside, double radius,
           double width, int[::1] indptr, int[::1] indices, int[::1] nearby,
           double[:, ::1] block, int[::1] begin, int[::1] found):
    """Rows of the neighbours of the active particles, each ascending.

    packed : (3, n + LANES) positions in the order of the cells, and spare room
    active : (n,) 1 for particles that need a row
    start : (cells + 1,) first particle of each cell
    count, reach : (3,) cells of the grid, and how many cells away neighbours may be
    beside : (count[1], .) for each cell across the tank, the cells with neighbours, ascending; -1
        after the last
    indptr : (n + 1,) out, indices : out
    nearby : scratch, the candidates
    block : (3, .) scratch, the coordinates of the candidates
    begin : (n,) scratch
    found : scratch as long as `indices`, the rows in the order in which they are found

    Returns the number of entries written; -1 when `indices` is too short, -2 when `block` is.
    """
    cdef int x, y, z, end = 0, plane = count[1] * count[2]
    cdef Py_ssize_t first = 0, last, i, used, total = 0, capacity = indices.shape[0]
    prepare_squeeze()
    with nogil:
        while end < count[0]:
            x, end = end, min(end + STRETCH, count[0])
            last = start[end * plane]
            used = 0
            for y in range(count[1]):
                for z in range(count[2]):
                    if used >= 0:
                        used = walk(packed, active, start, count, reach, beside, radius, width,
                                    x, end, y, z, indptr, nearby, block, begin, found, used)
            if used < 0 or total + used > capacity:
                total = min(used, -1)
                break
            for i in range(first, last):
                used = indptr[i]
                indptr[i] = <int>total
                if used > 0:
                    memcpy(&indices[total], &found[begin[i]], used * sizeof(int))
                    total += used
            first = last
            indptr[first] = <int>total
    return total


cdef Py_ssize_t walk(const double[:, ::1] packed, const unsigned char[::1] active,
                     const int[::1] start, const int[::1] count, const int[::1] reach,
                     const int[:, ::1] beside, double radius, double width, int x, int end, int y,
                     int z, int[::1] length, int[::1] nearby, double[:, ::1] block,
                     int[::1] begin, int[::1] found, Py_ssize_t used) noexcept nogil:
    """Rows of the particles in the cells from x to end along a line; returns the entries used.

    length, begin : (n,) out, where each row lies in `found`
    """
    cdef int[2 * STRETCH] layer  # where each layer of candidates begins, from x - reach on
    cdef int cx, c, low, high, next = 0, lowest = max(x - reach[0], 0)
    cdef Py_ssize_t i, m, filled = 0, own
    cdef Py_ssize_t room = nearby.shape[0] - LANES, capacity = found.shape[0]
    cdef bint wanted
    for cx in range(x, end):
        c = (cx * count[1] + y) * count[2] + z
        wanted = False
        for i in range(start[c], start[c + 1]):
            begin[i] = length[i] = 0
            wanted |= active[i]
        if not wanted:
            continue
        low, high = max(cx - reach[0], 0), min(cx + reach[0] + 1, count[0])
        next = max(next, low)
        while next < high:
            layer[next - lowest] = <int>filled
            filled = add_layer(packed, start, count, reach, beside, next, y, z, nearby, block,
                               filled, room)
            if filled > room:
                return -2
            next += 1
        m = layer[low - lowest]
        own = layer[cx - lowest] + ahead(start, count, reach, beside, cx, y, z)
        for i in range(start[c], start[c + 1]):
            if not active[i]:
                own += 1
                continue
            if used + filled - m + LANES > capacity:
                return -1
            begin[i] = <int>used
            used = pick(block, nearby, m, filled, own, packed[0, i], packed[1, i], packed[2, i],
                        radius * radius, width, found, used)
            own += 1
            length[i] = <int>used - begin[i]
    return used


cdef Py_ssize_t add_layer(const double[:, ::1] packed, const int[::1] start,
                          const int[::1] count, const int[::1] reach, const int[:, ::1] beside,
                          int x, int y, int z, int[::1] nearby, double[:, ::1] block,
                          Py_ssize_t filled, Py_ssize_t room) noexcept nogil:
    """Append the particles in the cells around (y, z) at x; returns how many there are now."""
    cdef int low = max(z - reach[2], 0), high = min(z + reach[2] + 1, count[2]), base
    cdef Py_ssize_t s, m, k, end
    for s in range(beside.shape[1]):
        if beside[y, s] < 0:
            break
        base = (x * count[1] + beside[y, s]) * count[2]
        m, end = start[base + low], start[base + high]
        while m < end:
            if filled > room:
                return filled
            memcpy(&block[0, filled], &packed[0, m], LANES * sizeof(double))
            memcpy(&block[1, filled], &packed[1, m], LANES * sizeof(double))
            memcpy(&block[2, filled], &packed[2, m], LANES * sizeof(double))
            for k in range(LANES):
                nearby[filled + k] = <int>(m + k)
            filled += min(end - m, LANES)
            m += LANES
    return filled


cdef inline Py_ssize_t ahead(const int[::1] start, const int[::1] count, const int[::1] reach,
                             const int[:, ::1] beside, int x, int y, int z) noexcept nogil:
    """How many particles of a layer come before those of the cell in the middle of the layer."""
    cdef int low = max(z - reach[2], 0), high = min(z + reach[2] + 1, count[2]), base
    cdef Py_ssize_t s, before = 0
    for s in range(beside.shape[1]):
        base = (x * count[1] + beside[y, s]) * count[2]
        if beside[y, s] == y:
            return before + start[base + z] - start[base + low]
        before += start[base + high] - start[base + low]
    return before


cdef inline Py_ssize_t pick(const double[:, ::1] block, const int[::1] nearby, Py_ssize_t first,
                            Py_ssize_t end, Py_ssize_t own, double x, double y, double z,
                            double limit, double width, int[::1] found,
                            Py_ssize_t used) noexcept nogil:
    """Append the candidates whose squared distance from a place is below the limit, without `own`;
    returns the entries used.

    Distances are always taken LANES at a time, so that a pair has the same distance from either
    side, to the last bit.
    """
    cdef Py_ssize_t m = first
    cdef int near
    while m < end:
        near = near_eight(&block[0, m], &block[1, m], &block[2, m], x, y, z, limit, width)
        if m + LANES > end:
            near &= (1 << (end - m)) - 1
        if m <= own < m + LANES:
            near &= ~(1 << (own - m))
        used += squeeze(&found[used], &nearby[m], near)
        m += LANES
    return used
