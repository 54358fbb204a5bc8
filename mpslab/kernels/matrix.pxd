# Symmetric matrices of 3 x 3, in three columns of four numbers.


cdef inline bint inverted(const double* moment, double factor, bint flat, double least_determinant,
                          double* out) noexcept nogil:
    """Invert factor times a matrix; the identity, and False, where it is too close to singular.

    A flat one (2-D) has factor yy = 1 whatever is in it.  The fourth numbers of `out` are 0.
    """
    cdef double xx = factor * moment[0], xy = factor * moment[1], xz = factor * moment[2]
    cdef double yy = 1.0 if flat else factor * moment[5], yz = factor * moment[6]
    cdef double zz = factor * moment[10]
    cdef double det = (xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz)
                       + xz * (xy * yz - yy * xz))
    cdef bint regular = not det < least_determinant
    if not regular:
        xx = yy = zz = det = 1.0
        xy = xz = yz = 0.0
    out[0] = (yy * zz - yz * yz) / det
    out[5] = (xx * zz - xz * xz) / det
    out[10] = (xx * yy - xy * xy) / det
    out[1] = out[4] = (xz * yz - xy * zz) / det
    out[2] = out[8] = (xy * yz - xz * yy) / det
    out[6] = out[9] = (xy * xz - xx * yz) / det
    out[3] = out[7] = out[11] = 0.0
    return regular
