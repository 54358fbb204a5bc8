"""Correction matrix of the gradient: the inverse of the second moment of the neighbours."""


def invert(const double[:, :, ::1] second, stencil, double least_determinant,
           double[:, :, ::1] out):
    """C_i = [(Ds/n0) sum_j w r_ij (x) r_ij / r^2]^-1 (Khayyer & Gotoh 2011) [-].

    second : (n, 3, 4), see mpslab.kernels.measure
    least_determinant : below it the matrix is too close to singular and C_i = I
    out : (n, 3, 4), the columns of C_i; the fourth number of each is 0
    """
    cdef double factor = stencil.dim / stencil.n0
    cdef bint flat = stencil.dim == 2
    cdef double xx, yy, zz, xy, xz, yz, det
    cdef Py_ssize_t i
    with nogil:
        for i in range(second.shape[0]):
            xx, xy, xz = factor * second[i, 0, 0], factor * second[i, 0, 1], factor * second[i, 0, 2]
            yy, yz, zz = factor * second[i, 1, 1], factor * second[i, 1, 2], factor * second[i, 2, 2]
            if flat:
                yy = 1.0
            det = (xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz)
                   + xz * (xy * yz - yy * xz))
            if det < least_determinant:
                xx = yy = zz = det = 1.0
                xy = xz = yz = 0.0
            out[i, 0, 0] = (yy * zz - yz * yz) / det
            out[i, 1, 1] = (xx * zz - xz * xz) / det
            out[i, 2, 2] = (xx * yy - xy * xy) / det
            out[i, 0, 1] = out[i, 1, 0] = (xz * yz - xy * zz) / det
            out[i, 0, 2] = out[i, 2, 0] = (xy * yz - xz * yy) / det
            out[i, 1, 2] = out[i, 2, 1] = (xy * xz - xx * yz) / det
            out[i, 0, 3] = out[i, 1, 3] = out[i, 2, 3] = 0.0


def without_fillers(const int[::1] row, const int[::1] solid, const int[::1] other,
                    const float[:, ::1] offset, const unsigned char[::1] loaded,
                    double[:, :, ::1] second):
    """Subtract neighbours that carry no pressure from the second moments, in place."""
    cdef Py_ssize_t i, k, a, b
    with nogil:
        for i in range(solid.shape[0]):
            for k in range(solid[i], row[i + 1]):
                if loaded[other[k]]:
                    continue
                for a in range(3):
                    for b in range(3):
                        second[i, a, b] -= offset[k, 3] * offset[k, a] * <double>offset[k, b]
