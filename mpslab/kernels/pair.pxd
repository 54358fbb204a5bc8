# The pieces that sums over pairs of particles are made of, inlined into every kernel.
#
# What a pair i, j is, `mpslab.kernels.measure` has kept: offset[k] = (r_ij, g) with g = w/r^2, and
# inverse[k] = 1/r.
from libc.math cimport sqrt

from mpslab.kernels.lanes cimport four, lane, load, plus, times, widened

# Roles of particles, as in mpslab/core/particles.py.
cdef enum:
    FLUID = 0
    FACE = 1
    FILLER = 2

# Pairs that are worked on together, in the lanes of the machine, always as many: what a pair gets
# must not depend on its place in the list.
cdef enum:
    LANES = 16


cdef inline bint has_pressure(signed char role) noexcept nogil:
    """Water and the faces of solids carry a pressure; the layers behind the faces do not."""
    return role != FILLER


cdef inline double wrap(double dy, double width) noexcept nogil:
    """Nearest image of a distance across the tank; width = 0 means no periodicity."""
    cdef double half = 0.5 * width
    return dy - width * ((dy > half) - (dy < -half))


cdef inline double distance(double dx, double dy, double dz, double floor) noexcept nogil:
    """|r_ij|, kept above a floor so that coincident particles do not divide by zero."""
    cdef double r = sqrt(dx * dx + dy * dy + dz * dz)
    return r if r > floor else floor


cdef inline double weight(double inverse, double radius) noexcept nogil:
    """w(r) = r_e/r - 1 inside the effective radius, 0 outside (Koshizuka & Oka 1996)."""
    cdef double w = radius * inverse - 1.0
    return w if w > 0.0 else 0.0


cdef inline double coefficient(double inverse, double radius, double one, double first,
                               double third) noexcept nogil:
    """L(r) = one + first/r + third/r^3 of the Laplacian inside the radius, 0 outside."""
    cdef double value = one + inverse * (first + third * inverse * inverse)
    return value if radius * inverse > 1.0 else 0.0


cdef inline four pull(const float* offset) noexcept nogil:
    """r_ij w/r^2: that of j on i is opposite to the last bit.  The fourth number means nothing."""
    cdef four r = widened(offset)
    return times(lane(r, 3), r)


cdef inline four turned(const double* columns, four v) noexcept nogil:
    """C v, of a matrix in three columns of four numbers."""
    return plus(plus(times(lane(v, 0), load(columns)), lane(v, 1), load(columns + 4)),
                lane(v, 2), load(columns + 8))


cdef inline four plus_turned(four total, const double* columns, four v) noexcept nogil:
    """total + C v."""
    total = plus(total, lane(v, 0), load(columns))
    total = plus(total, lane(v, 1), load(columns + 4))
    return plus(total, lane(v, 2), load(columns + 8))


cdef inline double dot(const double* v, const float* r) noexcept nogil:
    return v[0] * r[0] + v[1] * r[1] + v[2] * r[2]


cdef inline double along(const double* u, const double* v, const float* r) noexcept nogil:
    """(u - v) . r"""
    return (u[0] - v[0]) * r[0] + (u[1] - v[1]) * r[1] + (u[2] - v[2]) * r[2]
