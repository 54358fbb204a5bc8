"""Least pressure around a particle."""


def least_pressure(const int[::1] row, const int[::1] other, const float[:, ::1] offset,
                   const double[::1] pressure, const unsigned char[::1] loaded,
                   double[::1] out):
    """p^_i = min of p over the particle itself and its neighbours (equation 3 of the paper) [Pa].

    The layers behind the walls carry no pressure and do not count.
    """
    cdef double least
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(out.shape[0]):
            least = pressure[i]
            for k in range(row[i], row[i + 1]):
                j = other[k]
                if loaded[j] and pressure[j] < least and offset[k, 3] > 0.0:
                    least = pressure[j]
            out[i] = least
