"""How many neighbours a particle has, and which particles are near the surface."""
from mpslab.kernels.pair cimport FLUID


def count(const int[::1] row, const float[:, ::1] offset, const int[::1] rows, int[::1] out):
    """How many neighbours the particles `rows` have within the radius; the list may reach on."""
    cdef Py_ssize_t m, k
    cdef int near
    with nogil:
        for m in range(rows.shape[0]):
            near = 0
            for k in range(row[rows[m]], row[rows[m] + 1]):
                near += offset[k, 3] > 0.0
            out[m] = near


def beside(const int[::1] row, const int[::1] other, const float[:, ::1] offset,
           const unsigned char[::1] mark, unsigned char[::1] out):
    """Whether a particle, or one of its neighbours within the radius, is marked.

    Marked particles have rows in the list.
    """
    cdef Py_ssize_t i, k
    with nogil:
        out[:] = mark
        for i in range(mark.shape[0]):
            if mark[i]:
                for k in range(row[i], row[i + 1]):
                    if offset[k, 3] > 0.0:
                        out[other[k]] = 1


def thin_or_lopsided(const signed char[::1] role, const double[:, ::1] first, double share,
                     double side, int[::1] rows):
    """rows = the water with n < share, or with |sum w r_ij| > side n [m], or nearly so.

    first : (n, 4), see mpslab.kernels.measure

    Returns how many there are.
    """
    cdef double x, y, z, least = share * (1.0 + 1e-9), most = side * (1.0 - 1e-9)
    cdef Py_ssize_t i
    cdef int found = 0
    with nogil:
        for i in range(role.shape[0]):
            x, y, z = first[i, 0], first[i, 1], first[i, 2]
            rows[found] = <int>i
            found += role[i] == FLUID and not (
                first[i, 3] > least and x * x + y * y + z * z < (most * first[i, 3]) ** 2
            )
    return found
