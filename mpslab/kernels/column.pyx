"""The column of water over a place, which a gauge reads."""
from libc.math cimport fabs, rint

from mpslab.kernels.pair cimport wrap


cdef inline double spline(double t) noexcept nogil:
    """Quadratic B-spline, t in spacings: a bell of half width 1.5 and of area one."""
    t = fabs(t)
    if t < 0.5:
        return 0.75 - t * t
    return 0.5 * (1.5 - t) * (1.5 - t) if t < 1.5 else 0.0


def around(const double[:, ::1] position, double spacing, double x, double y, double width,
           int[::1] near, double[::1] weight):
    """Rows of the particles less than 1.5 spacings from a vertical line, along x and along y, and
    their weights: splines of both distances, or of that along x if all have the same y.

    near, weight : (n,) out, filled from the beginning

    Returns how many there are.
    """
    cdef Py_ssize_t i, k, count = 0, kept = 0
    cdef double dy, w
    cdef bint flat = True
    with nogil:
        for i in range(position.shape[0]):
            if fabs(position[i, 0] - x) < 1.5 * spacing:
                near[count] = <int>i
                count += 1
                flat = flat and position[i, 1] == position[near[0], 1]
        for k in range(count):
            i = near[k]
            w = spline((position[i, 0] - x) / spacing)
            if not flat:
                dy = position[i, 1] - y
                if width > 0.0:
                    dy -= width * rint(dy / width)
                w *= spline(dy / spacing)
            if w > 0.0:
                near[kept] = <int>i
                weight[kept] = w
                kept += 1
    return kept


def spread(const double[::1] height, const double[::1] weight, const unsigned char[::1] wet,
           int points, double[::1] fluid, double[::1] solid):
    """Add the weighted splines of particles to the points of a vertical line.

    height : (n,) above the first point [spacings]
    wet : (n,) whether a particle is fluid
    points : how many there are to a spacing
    fluid, solid : (m,) sums, changed in place
    """
    cdef Py_ssize_t i, k, nearest, reach = 2 * points
    cdef double value
    with nogil:
        for i in range(height.shape[0]):
            nearest = <Py_ssize_t>rint(height[i] * points)
            for k in range(max(nearest - reach, 0), min(nearest + reach + 1, fluid.shape[0])):
                value = weight[i] * spline(<double>k / points - height[i])
                if wet[i]:
                    fluid[k] += value
                else:
                    solid[k] += value


def top(const double[::1] fluid, const double[::1] solid, int gap, double least_room):
    """The highest place where water fills half of the room that the solids leave, in the lowest
    connected part of a column.

    Between points, the excess of water over that half is linear; at the last point it is negative.

    fluid, solid : (m,) shares at the points
    gap : the connected part ends where so many points or more follow each other at which water and
        solids together fill less than half; from solid to solid it goes on, for solids of any shape
        are hollow inside
    least_room : share of room that counts as left where the solids leave less

    Returns the point below that place, and the share of the way from there to the next point;
    -1 and not-a-number if there is no such place.
    """
    cdef Py_ssize_t k, last = -1, wet = -1
    cdef double excess, above, part = float("nan")
    cdef bint hollow
    with nogil:
        for k in range(fluid.shape[0]):
            if fluid[k] + solid[k] < 0.5:
                continue
            hollow = last >= 0 and solid[last] > fluid[last] and solid[k] > fluid[k]
            if last >= 0 and k - last > gap and not hollow:
                break
            last = k
            if fluid[k] >= 0.5 * max(1.0 - solid[k], least_room):
                wet = k
        if wet >= 0:
            excess = fluid[wet] - 0.5 * max(1.0 - solid[wet], least_room)
            above = fluid[wet + 1] - 0.5 * max(1.0 - solid[wet + 1], least_room)
            part = excess / (excess - above)
    return wet, part


def beside(const double[:, ::1] position, const double[:, ::1] points, const double[::1] reach,
           double width, int[::1] rows):
    """rows = the particles that are less than a reach from one of the points along every axis.

    points : (k, 3), reach : (3,) [m]; width : period along y, 0 for none

    Returns how many there are.
    """
    cdef Py_ssize_t i, k
    cdef int found = 0
    cdef bint inside
    with nogil:
        for i in range(position.shape[0]):
            inside = False
            for k in range(points.shape[0]):
                if fabs(position[i, 0] - points[k, 0]) < reach[0]:
                    inside |= (fabs(wrap(position[i, 1] - points[k, 1], width)) < reach[1]
                               and fabs(position[i, 2] - points[k, 2]) < reach[2])
            rows[found] = <int>i
            found += inside
    return found
