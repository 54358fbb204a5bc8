"""The push of a wall of particles without its hollows.

A wall of particles is a washboard: along it their forces hold the water in its hollows.  Its
normal is that of sum_j w r_ij/r^2 in the mean over walls that lie a quarter of a spacing aside,
where one has particles the other has hollows.
"""
from libc.math cimport fabs, fmax, sqrt

cdef inline double pulled(double x, double y, double z, const double* aside, double radius,
                          double* total) noexcept nogil:
    """Add w r/r^2 of a pair that lies somewhat aside to a sum; returns w/r^2."""
    x, y, z = x + aside[0], y + aside[1], z + aside[2]
    cdef double square = fmax(x * x + y * y + z * z, 1e-6 * radius * radius)
    cdef double g = (radius / sqrt(square) - 1.0) / square
    if not g > 0.0:
        return 0.0
    total[0] += g * x
    total[1] += g * y
    total[2] += g * z
    return g


cdef inline double dot(const double* a, const double* b) noexcept nogil:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


cdef inline int places(const double* push, double quarter, int dim, double* out) noexcept nogil:
    """Where the moved walls lie: 4 vectors across a push, in x-z 2; returns how many.

    One direction is the part across the push of the axis that is least along it, so that beside
    walls that stand along an axis both are along the rows of particles.
    """
    cdef double[3] normal, first, second
    cdef double length = sqrt(dot(push, push)), one, other
    cdef int a, n, least = 1
    for a in range(3):
        normal[a] = push[a] / length
    for a in range(0, 3, 2):
        if fabs(normal[a]) < fabs(normal[least]):
            least = a
    for a in range(3):
        second[a] = (a == least) - normal[least] * normal[a]
    length = sqrt(dot(second, second))
    for a in range(3):
        second[a] /= length
    for a in range(3):
        first[a] = (normal[(a + 1) % 3] * second[(a + 2) % 3]
                    - normal[(a + 2) % 3] * second[(a + 1) % 3])
    for n in range(4 if dim == 3 else 2):
        one = quarter if n % 2 else -quarter
        other = (quarter if n > 1 else -quarter) if dim == 3 else 0.0
        for a in range(3):
            out[3 * n + a] = one * first[a] + other * second[a]
    return 4 if dim == 3 else 2


cdef inline void turn(const double* smooth, double* push) noexcept nogil:
    """Leave of a push its part along another vector; all of it, if that is none."""
    cdef double square = dot(smooth, smooth), part
    cdef int a
    if square == 0.0:
        return
    part = dot(smooth, push) / square
    for a in range(3):
        push[a] = part * smooth[a]
