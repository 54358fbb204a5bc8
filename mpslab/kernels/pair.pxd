# Geometry of a pair of particles, inlined into every kernel.
from libc.math cimport sqrt

# Roles of particles, as in mpslab/particles.py.
cdef enum:
    FLUID = 0
    FACE = 1
    FILLER = 2


cdef inline bint has_pressure(signed char role) noexcept nogil:
    """Water and the faces of solids carry a pressure; the layers behind the faces do not."""
    return role != FILLER


cdef inline double wrap(double dy, double width) noexcept nogil:
    """Nearest image of a distance across the tank; width = 0 means no periodicity."""
    cdef double half = 0.5 * width
    return dy - width * ((dy > half) - (dy < -half))


cdef inline double weight(double r, double radius) noexcept nogil:
    """w(r) = r_e/r - 1 inside the effective radius, 0 outside (Koshizuka & Oka 1996)."""
    cdef double w = radius / r - 1.0
    return w if w > 0.0 else 0.0


cdef inline double distance(double dx, double dy, double dz, double floor) noexcept nogil:
    """|r_ij|, kept above a floor so that coincident particles do not divide by zero."""
    cdef double r = sqrt(dx * dx + dy * dy + dz * dz)
    return r if r > floor else floor
