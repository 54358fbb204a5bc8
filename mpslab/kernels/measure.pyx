"""The geometry of all pairs of a neighbour list, kept for whatever a step sums over them."""
from libc.math cimport sqrtf

from mpslab.kernels.lanes cimport (
    ended, four, lane, load, minus, nearest, nothing, plus, store, store_rounded, times, widened,
)
from mpslab.kernels.pair cimport FLUID, LANES, weight
from mpslab.kernels.smooth cimport evened, places, pulled, square

# Rows of so many pairs are taken through all three parts at a time, and stay in the cache.
cdef enum:
    PAIRS = 1024


def measure(const double[:, ::1] position, const signed char[::1] role, const int[::1] row,
            int[::1] other, stencil, bint smooth, int[::1] solid, int[::1] behind,
            float[:, ::1] offset, float[:, ::1] straight, float[::1] inverse,
            double[:, ::1] first, double[:, :, ::1] second):
    """Geometry of each pair and its sums over the neighbours of each particle.

    position : (n, 4) [m], the fourth number 0
    row, other : of the neighbour list; in each row of `other` water is put before solids
    smooth : whether water sees solids slid along their face, see `slide`
    straight : (m + LANES, 4) out where smooth, r_ij as it is from water to solids
    solid : (n,) out, first solid neighbour in each row of `other`
    behind : scratch, as long as the longest row
    offset : (m + LANES, 4) out, r_ij [m] and w/r^2 [1/m2]; the rounded difference of two doubles,
        so that r_ji is -r_ij
    inverse : (m + LANES,) out, 1/r [1/m]
    first : (n, 4) out, sum_j w r_ij [m] and the number density sum_j w
    second : (n, 3, 4) out, for each axis a: sum_j (r_ij)_a w/r^2 (r_ij, 1)
    """
    cdef double width = stencil.width, spacing = stencil.spacing
    cdef int dim = stencil.dim
    cdef float radius = stencil.radius, floor = stencil.floor
    cdef Py_ssize_t i, begin = 0, end = 0, n = role.shape[0]
    with nogil:
        while begin < n:
            while end < n and (end == begin or row[end + 1] - row[begin] <= PAIRS):
                end += 1
            for i in range(begin, end):
                solid[i] = part(i, role, row, other, behind)
                lay_out(i, position, row, other, width, offset, inverse)
            invert(row[begin], row[end], floor, inverse)
            for i in range(begin, end):
                if smooth and role[i] == FLUID and solid[i] < row[i + 1]:
                    slide(solid[i], row[i + 1], radius, spacing, dim, inverse, offset, straight)
                add_up(i, row, radius, offset, inverse, first, second)
            begin = end


def weigh(const int[::1] row, stencil, const float[:, ::1] measured, const float[::1] inverse,
          float[:, ::1] offset, double[:, ::1] first, double[:, :, ::1] second):
    """As `measure`, for pairs that were measured with another stencil."""
    cdef float radius = stencil.radius
    cdef Py_ssize_t i, k, a
    with nogil:
        for i in range(row.shape[0] - 1):
            for k in range(row[i], row[i + 1]):
                for a in range(3):
                    offset[k, a] = measured[k, a]
                offset[k, 3] = 1
            add_up(i, row, radius, offset, inverse, first, second)


cdef inline int part(Py_ssize_t i, const signed char[::1] role, const int[::1] row,
                     int[::1] other, int[::1] behind) noexcept nogil:
    """Put water first, then solids, each in the order of the list; returns where solids begin.

    Most rows have no solids, and are not written to: writing costs more than reading.
    """
    cdef int k, front = row[i], back = 0
    for k in range(row[i], row[i + 1]):
        if role[other[k]] != FLUID:
            behind[back] = other[k]
            back += 1
        else:
            if back:
                other[front] = other[k]
            front += 1
    for k in range(back):
        other[front + k] = behind[k]
    return front


cdef inline void lay_out(Py_ssize_t i, const double[:, ::1] position, const int[::1] row,
                         const int[::1] other, double width, float[:, ::1] offset,
                         float[::1] inverse) noexcept nogil:
    """r_ij of a row, with 1 as its fourth number; and r^2, in the place where 1/r will be."""
    cdef Py_ssize_t k
    cdef four r, here = ended(load(&position[i, 0]), -1.0)
    for k in range(row[i], row[i + 1]):
        r = nearest(minus(load(&position[other[k], 0]), here), width)
        store_rounded(&offset[k, 0], r)
        inverse[k] = <float>(lane(r, 0) * lane(r, 0) + lane(r, 1) * lane(r, 1)
                             + lane(r, 2) * lane(r, 2))


cdef inline void invert(Py_ssize_t begin, Py_ssize_t end, float floor,
                        float[::1] inverse) noexcept nogil:
    """1/r in place of r^2.

    LANES at a time; what this writes past the end is overwritten when the next rows are laid out.
    """
    cdef float square, one = 1, least = floor * floor
    cdef Py_ssize_t block, lane_
    cdef float* value
    for block in range((end - begin + LANES - 1) // LANES):
        value = &inverse[begin + block * LANES]
        for lane_ in range(LANES):
            square = value[lane_] if value[lane_] > least else least
            value[lane_] = one / sqrtf(square)


cdef inline void slide(Py_ssize_t begin, Py_ssize_t end, double radius, double spacing, int dim,
                       const float[::1] inverse, float[:, ::1] offset,
                       float[:, ::1] straight) noexcept nogil:
    """Slide the solids of a row until sum_j w r_ij/r^2 points along their normal.

    See mpslab.kernels.smooth; r_ij as it was goes to `straight`.
    """
    cdef Py_ssize_t k
    cdef double g, pulls = 0
    cdef four r, push = nothing()
    cdef four[3] aside, total
    for k in range(begin, end):
        r = widened(&offset[k, 0])
        store_rounded(&straight[k, 0], r)
        g = weight(inverse[k], radius) * inverse[k] * inverse[k]
        push = plus(push, g, r)
        pulls += g
    if square(push) == 0.0:
        return
    places(push, 0.25 * spacing, dim, aside)
    total[0] = total[1] = total[2] = nothing()
    for k in range(begin, end):
        pulled(widened(&offset[k, 0]), aside, radius, total)
    push = ended(times(1.0 / pulls, minus(evened(total, push), push)), 0.0)
    for k in range(begin, end):
        store_rounded(&offset[k, 0], plus(widened(&offset[k, 0]), 1.0, push))


cdef inline void add_up(Py_ssize_t i, const int[::1] row, float radius, float[:, ::1] offset,
                        const float[::1] inverse, double[:, ::1] first,
                        double[:, :, ::1] second) noexcept nogil:
    """First and second moment of a row; w/r^2 becomes the fourth number, after r_ij.

    w = r_e/r - 1 inside the radius (Koshizuka & Oka 1996).
    """
    cdef Py_ssize_t k
    cdef float w, g, none = 0, one = 1
    cdef four r, gr, sums = nothing(), x = nothing(), y = nothing(), z = nothing()
    for k in range(row[i], row[i + 1]):
        r = widened(&offset[k, 0])
        w = radius * inverse[k] - one
        w = w if w > none else none
        g = w * inverse[k] * inverse[k]
        offset[k, 3] = g
        gr = times(g, r)
        sums = plus(sums, w, r)
        x = plus(x, lane(gr, 0), r)
        y = plus(y, lane(gr, 1), r)
        z = plus(z, lane(gr, 2), r)
    store(&first[i, 0], sums)
    store(&second[i, 0, 0], x)
    store(&second[i, 1, 0], y)
    store(&second[i, 2, 0], z)
