"""Conservative corrected pressure gradient (reverse kernel gradient correction)."""
from mpslab.kernels.pair cimport FLUID, distance, weight, wrap

from mpslab.kernels import shares

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False
NEEDS_CORRECTION = True


def gradient(const double[:, ::1] position, const double[::1] pressure,
             const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
             stencil, const double[:, ::1] c, double[:, ::1] out):
    """<grad p>_i = (Ds/n0) sum_j (p_i C_j + p_j C_i) r_ij w / r^2 (Zhang, Adams & Hu 2024).

    C is the correction matrix (`mpslab.correction`); walls take that of the water particle.
    The pair force is equal and opposite, but not central: linear momentum is conserved, angular
    momentum nearly.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef const double[::1] water = shares.of_water(role), loaded = shares.of_loaded(role)
    cdef double dx, dy, dz, r, w, pi, a, b, xx, yy, zz, xy, xz, yz, gx, gy, gz
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            gx = gy = gz = 0.0
            pi = pressure[i]
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = loaded[j] * weight(r, radius) / (r * r)
                a = pi * water[j]
                b = pi - a + pressure[j]
                xx = a * c[j, 0] + b * c[i, 0]
                yy = a * c[j, 1] + b * c[i, 1]
                zz = a * c[j, 2] + b * c[i, 2]
                xy = a * c[j, 3] + b * c[i, 3]
                xz = a * c[j, 4] + b * c[i, 4]
                yz = a * c[j, 5] + b * c[i, 5]
                gx += w * (xx * dx + xy * dy + xz * dz)
                gy += w * (xy * dx + yy * dy + yz * dz)
                gz += w * (xz * dx + yz * dy + zz * dz)
            out[i, 0] = factor * gx
            out[i, 1] = factor * gy
            out[i, 2] = factor * gz
