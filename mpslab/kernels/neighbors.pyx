"""Neighbour search over linked cells.

The search visits the particles cell by cell and writes, for each particle, its *active*
neighbours in the order in which it meets them.  Reading those lists back particle by particle
and handing each entry to its partner gives the rows of the active particles, sorted, without a
sort: the relation is symmetric.
"""
from mpslab.kernels.pair cimport wrap


cdef inline int column(int c, int shift, int count, bint periodic) noexcept nogil:
    """Cell index beside c, -1 where there is none."""
    cdef int beside = c + shift
    if periodic:
        return beside + count if beside < 0 else (beside - count if beside >= count else beside)
    return -1 if beside < 0 or beside >= count else beside


def search(const double[:, ::1] packed, const int[::1] member, const unsigned char[::1] active,
           const int[::1] start, const int[::1] count, double radius, double width,
           int[::1] first, int[::1] found, int[::1] nearby, double[:, ::1] block):
    """List the active neighbours of every particle.

    packed : (3, n) positions in cell order
    member : (n,) particle at each place of the cell order
    active : (n,) 1 for particles that need a row, in cell order
    first : (n + 1,) out: first entry of each place in `found`
    found : out: particle numbers
    nearby : scratch, the candidates of one cell; block : (4, .) scratch, their coordinates and
        squared distances, copied together so that the distances are computed in vector lanes

    Returns the number of entries written, or -1 when `found` is too short.
    """
    cdef Py_ssize_t place, m, candidates
    cdef int cx, cy, sx, sy, kx, ky, cz, lo, hi, base, c, written = 0
    cdef int side = 0 if count[1] == 1 else 1
    cdef int capacity = <int>found.shape[0]
    cdef bint periodic = width > 0.0
    cdef double x, y, z, dx, dy, dz, limit = radius * radius
    cdef bint overflow = False
    with nogil:
        for cx in range(count[0]):
            for cy in range(count[1]):
                for cz in range(count[2]):
                    c = (cx * count[1] + cy) * count[2] + cz
                    if start[c] == start[c + 1]:
                        continue
                    candidates = 0
                    for sx in range(-1, 2):
                        kx = column(cx, sx, count[0], False)
                        if kx < 0:
                            continue
                        for sy in range(-side, side + 1):
                            ky = column(cy, sy, count[1], periodic)
                            if ky < 0:
                                continue
                            base = (kx * count[1] + ky) * count[2]
                            lo = start[base + (cz - 1 if cz > 0 else 0)]
                            hi = start[base + (cz + 2 if cz + 2 < count[2] else count[2])]
                            for m in range(lo, hi):
                                nearby[candidates] = <int>m
                                candidates += active[m]
                    for m in range(candidates):
                        block[0, m] = packed[0, nearby[m]]
                        block[1, m] = packed[1, nearby[m]]
                        block[2, m] = packed[2, nearby[m]]
                    for place in range(start[c], start[c + 1]):
                        first[place] = written
                        if written + candidates > capacity:
                            overflow = True
                            break
                        x, y, z = packed[0, place], packed[1, place], packed[2, place]
                        for m in range(candidates):
                            dx = block[0, m] - x
                            dy = wrap(block[1, m] - y, width)
                            dz = block[2, m] - z
                            block[3, m] = dx * dx + dy * dy + dz * dz
                        for m in range(candidates):
                            found[written] = member[nearby[m]]
                            written += (block[3, m] < limit) & (nearby[m] != place)
                    if overflow:
                        break
                if overflow:
                    break
            if overflow:
                break
        first[member.shape[0]] = written
    return -1 if overflow else written


def transpose(const int[::1] order, const int[::1] place_of, const int[::1] first,
              const int[::1] found, int[::1] indptr, int[::1] indices):
    """Rows of the active particles, each in the order in which `order` lists the particles.

    place_of : (n,) place of each particle in the cell order
    indptr : (n + 1,) out, indices : (m,) out
    """
    cdef Py_ssize_t k, i, e
    cdef int here, total = 0
    cdef Py_ssize_t n = indptr.shape[0] - 1
    with nogil:
        indptr[:] = 0
        for e in range(indices.shape[0]):
            indptr[found[e]] += 1
        for i in range(n):
            here = indptr[i]
            indptr[i] = total
            total += here
        indptr[n] = total
        for k in range(order.shape[0]):
            i = order[k]
            for e in range(first[place_of[i]], first[place_of[i] + 1]):
                indices[indptr[found[e]]] = <int>i
                indptr[found[e]] += 1
        for i in range(n, 0, -1):
            indptr[i] = indptr[i - 1]
        indptr[0] = 0
