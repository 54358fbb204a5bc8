"""Correction matrix of the gradient: the inverse of the neighbours' second moment."""
import numpy as np

from mpslab.kernels.pair cimport distance, weight, wrap

from mpslab.kernels import shares


def correction_matrix(const double[:, ::1] position, const signed char[::1] role,
                      const int[::1] indptr, const int[::1] indices, stencil, bint dummies,
                      double least_determinant, double[:, ::1] out):
    """C_i = [(Ds/n0) sum_j w r_ij (x) r_ij / r^2]^-1 (Khayyer & Gotoh 2011) [-].

    dummies : whether the layers behind the walls count in the sum
    least_determinant : below it the matrix is too close to singular and C_i = I
    out : (n, 6), the components xx, yy, zz, xy, xz, yz
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef const double[::1] share = np.ones(role.shape[0]) if dummies else shares.of_loaded(role)
    cdef bint flat = stencil.dim == 2
    cdef double dx, dy, dz, r, w, xx, yy, zz, xy, xz, yz, det
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            xx = yy = zz = xy = xz = yz = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = factor * share[j] * weight(r, radius) / (r * r)
                xx += w * dx * dx
                yy += w * dy * dy
                zz += w * dz * dz
                xy += w * dx * dy
                xz += w * dx * dz
                yz += w * dy * dz
            if flat:
                yy = 1.0
            det = (xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz)
                   + xz * (xy * yz - yy * xz))
            if det < least_determinant:
                out[i, 0] = out[i, 1] = out[i, 2] = 1.0
                out[i, 3] = out[i, 4] = out[i, 5] = 0.0
                continue
            out[i, 0] = (yy * zz - yz * yz) / det
            out[i, 1] = (xx * zz - xz * xz) / det
            out[i, 2] = (xx * yy - xy * xy) / det
            out[i, 3] = (xz * yz - xy * zz) / det
            out[i, 4] = (xy * yz - xz * yy) / det
            out[i, 5] = (xy * xz - xx * yz) / det
