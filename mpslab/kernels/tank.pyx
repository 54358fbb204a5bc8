"""The inside of the tank."""
from mpslab.kernels.pair cimport FLUID


def outside(const double[:, ::1] position, const signed char[::1] role, const double[::1] low,
            const double[::1] high, const double[:, ::1] bed, int[::1] rows):
    """rows = the water particles outside of a box, or below the bed.

    low, high : (3,) corners of the box [m]
    bed : (k, 2) x and z [m] of its points, two at least; it is level before the first, and goes
        straight on after the last

    Returns how many there are.
    """
    cdef Py_ssize_t i, k = 0
    cdef int found = 0
    cdef double x, y, z, along
    with nogil:
        for i in range(position.shape[0]):
            if role[i] != FLUID:
                continue
            x, y, z = position[i, 0], position[i, 1], position[i, 2]
            while k > 0 and x < bed[k, 0]:
                k -= 1
            while k < bed.shape[0] - 2 and x > bed[k + 1, 0]:
                k += 1
            along = max(x - bed[k, 0], 0.0)
            rows[found] = <int>i
            found += (x < low[0] or x > high[0] or y < low[1] or y > high[1] or z > high[2]
                      or (z - bed[k, 1]) * (bed[k + 1, 0] - bed[k, 0])
                      < along * (bed[k + 1, 1] - bed[k, 1]))
    return found
