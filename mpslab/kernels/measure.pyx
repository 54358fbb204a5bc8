"""The geometry of all pairs of a neighbour list, kept for whatever a step sums over them."""
from libc.math cimport sqrtf

from mpslab.kernels.lanes cimport (
    ended, four, lane, load, minus, nearest, nothing, plus, store, store_rounded, times, widened,
)
from mpslab.kernels.pair cimport FLUID, LANES, weight

# Rows of so many pairs are taken through all three parts at a time, and stay in the cache.
cdef enum:
    PAIRS = 1024


def measure(const double[:, ::1] position, const signed char[::1] role, const int[::1] row,
            const int[::1] indices, stencil, int[::1] solid, int[::1] other, int[::1] behind,
            float[:, ::1] offset, float[::1] inverse, double[:, ::1] first,
            double[:, :, ::1] second):
    """Geometry of each pair and its sums over the neighbours of each particle.

    position : (n, 4) [m], the fourth number 0
    row, indices : of the neighbour list
    solid : (n,) out, first solid neighbour in each row of `other`
    other : (m,) out, the neighbours, in each row water before solids
    behind : scratch, as long as the longest row
    offset : (m + LANES, 4) out, r_ij [m] and w/r^2 [1/m2]; the rounded difference of two doubles,
        so that r_ji is -r_ij
    inverse : (m + LANES,) out, 1/r [1/m]
    first : (n, 4) out, sum_j w r_ij [m] and the number density sum_j w
    second : (n, 3, 4) out, for each axis a: sum_j (r_ij)_a w/r^2 (r_ij, 1)
    """
    cdef double radius = stencil.radius, width = stencil.width
    cdef float floor = stencil.floor
    cdef Py_ssize_t i, begin = 0, end = 0, n = role.shape[0]
    with nogil:
        while begin < n:
            while end < n and (end == begin or row[end + 1] - row[begin] <= PAIRS):
                end += 1
            for i in range(begin, end):
                solid[i] = part(i, role, row, indices, other, behind)
                lay_out(i, position, row, other, width, offset)
            weigh(row[begin], row[end], <float>radius, floor, offset, inverse)
            for i in range(begin, end):
                add_up(i, row, radius, offset, inverse, first, second)
            begin = end


cdef inline int part(Py_ssize_t i, const signed char[::1] role, const int[::1] row,
                     const int[::1] indices, int[::1] other, int[::1] behind) noexcept nogil:
    """Water first, then solids, each in the order of the list; returns where the solids begin."""
    cdef int k, j, is_solid, front = row[i], back = 0
    for k in range(row[i], row[i + 1]):
        j = indices[k]
        is_solid = role[j] != FLUID
        other[front] = j
        behind[back] = j
        front += 1 - is_solid
        back += is_solid
    for k in range(back):
        other[front + k] = behind[k]
    return front


cdef inline void lay_out(Py_ssize_t i, const double[:, ::1] position, const int[::1] row,
                         const int[::1] other, double width, float[:, ::1] offset) noexcept nogil:
    """r_ij of a row."""
    cdef Py_ssize_t k
    cdef four here = load(&position[i, 0])
    for k in range(row[i], row[i + 1]):
        store_rounded(&offset[k, 0],
                      nearest(minus(load(&position[other[k], 0]), here), width))


cdef inline void weigh(Py_ssize_t begin, Py_ssize_t end, float radius, float floor,
                       float[:, ::1] offset, float[::1] inverse) noexcept nogil:
    """1/r and w/r^2 of pairs, w = r_e/r - 1 inside the radius (Koshizuka & Oka 1996).

    LANES at a time: what the last ones write behind the end, their own turn puts right.
    """
    cdef float[LANES] pull, near
    cdef float square, inv, w, zero = 0, one = 1, least = floor * floor
    cdef float* r
    cdef Py_ssize_t block, k, lane_
    for block in range((end - begin + LANES - 1) // LANES):
        k = begin + block * LANES
        r = &offset[k, 0]
        for lane_ in range(LANES):
            square = (r[4 * lane_] * r[4 * lane_] + r[4 * lane_ + 1] * r[4 * lane_ + 1]
                      + r[4 * lane_ + 2] * r[4 * lane_ + 2] + r[4 * lane_ + 3] * r[4 * lane_ + 3])
            square = square if square > least else least
            inv = one / sqrtf(square)
            w = radius * inv - one
            w = w if w > zero else zero
            near[lane_] = inv
            pull[lane_] = w * inv * inv
        for lane_ in range(LANES):
            inverse[k + lane_] = near[lane_]
            r[4 * lane_ + 3] = pull[lane_]


cdef inline void add_up(Py_ssize_t i, const int[::1] row, double radius,
                        const float[:, ::1] offset, const float[::1] inverse,
                        double[:, ::1] first, double[:, :, ::1] second) noexcept nogil:
    """First and second moment of a row."""
    cdef Py_ssize_t k
    cdef double g
    cdef four r, sums = nothing(), x = nothing(), y = nothing(), z = nothing()
    for k in range(row[i], row[i + 1]):
        r = widened(&offset[k, 0])
        g = lane(r, 3)
        r = ended(r, 1.0)
        sums = plus(sums, weight(inverse[k], radius), r)
        x = plus(x, g * lane(r, 0), r)
        y = plus(y, g * lane(r, 1), r)
        z = plus(z, g * lane(r, 2), r)
    store(&first[i, 0], sums)
    store(&second[i, 0, 0], x)
    store(&second[i, 1, 0], y)
    store(&second[i, 2, 0], z)
