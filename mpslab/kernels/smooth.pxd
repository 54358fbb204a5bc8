"""The push of a wall of particles without its hollows.

A wall of particles is a washboard: along it their forces hold the water in its hollows.  Its
normal is that of sum_j w r_ij/r^2 in the mean over walls that lie a quarter of a spacing aside,
where one has particles the other has hollows.
"""
#
# The four moved walls are worked on together, in the lanes of the machine; in x-z there are two of
# them, each taken twice.
from libc.math cimport fabs, sqrt

from mpslab.kernels.lanes cimport (
    added, at_least, four, lane, load, minus, nothing, plus, product, quotient, root, same, store,
    times,
)


cdef inline void places(four push, double quarter, int dim, four* out) noexcept nogil:
    """Where the moved walls lie: x, y and z of four places across a push.

    One direction is the part across the push of the axis that is least along it, so that beside
    walls that stand along an axis both are along the rows of particles.
    """
    cdef double[3] normal, first, second
    cdef double[4] one, other
    cdef double length = sqrt(square(push))
    cdef int a, n, least = 1
    for a in range(3):
        normal[a] = lane(push, a) / length
    for a in range(0, 3, 2):
        if fabs(normal[a]) < fabs(normal[least]):
            least = a
    for a in range(3):
        second[a] = (a == least) - normal[least] * normal[a]
    length = sqrt(second[0] * second[0] + second[1] * second[1] + second[2] * second[2])
    for a in range(3):
        second[a] /= length
    for a in range(3):
        first[a] = (normal[(a + 1) % 3] * second[(a + 2) % 3]
                    - normal[(a + 2) % 3] * second[(a + 1) % 3])
    for n in range(4):
        one[n] = quarter if n % 2 else -quarter
        other[n] = 0.0 if dim == 2 else quarter if n > 1 else -quarter
    for a in range(3):
        out[a] = plus(times(first[a], load(one)), second[a], load(other))


cdef inline void pulled(four r, const four* aside, double radius, four* total) noexcept nogil:
    """Add w r/r^2 of a pair to a sum, as if it lay at each of four places aside."""
    cdef four x = plus(aside[0], lane(r, 0), same(1.0))
    cdef four y = plus(aside[1], lane(r, 1), same(1.0))
    cdef four z = plus(aside[2], lane(r, 2), same(1.0))
    cdef four rr = plus(product(x, x), 1.0, plus(product(y, y), 1.0, product(z, z)))
    rr = at_least(1e-6 * radius * radius, rr)
    cdef four w = at_least(0.0, minus(quotient(same(radius), root(rr)), same(1.0)))
    w = quotient(w, rr)
    total[0] = plus(total[0], 1.0, product(w, x))
    total[1] = plus(total[1], 1.0, product(w, y))
    total[2] = plus(total[2], 1.0, product(w, z))


cdef inline four evened(const four* total, four push) noexcept nogil:
    """The part of a push that is along the mean over the moved walls; all of it, if that is none.

    total : what `pulled` has added up
    """
    cdef double[4] mean
    cdef four normal
    mean[0], mean[1], mean[2], mean[3] = added(total[0]), added(total[1]), added(total[2]), 0.0
    normal = load(mean)
    if square(normal) == 0.0:
        return push
    return times(dot(normal, push) / square(normal), normal)


cdef inline double dot(four a, four b) noexcept nogil:
    """Of the first three numbers."""
    return lane(a, 0) * lane(b, 0) + lane(a, 1) * lane(b, 1) + lane(a, 2) * lane(b, 2)


cdef inline double square(four v) noexcept nogil:
    return dot(v, v)
