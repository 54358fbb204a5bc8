"""Conservative corrected pressure gradient (reverse kernel gradient correction)."""
from mpslab.kernels.pair cimport FLUID, distance, has_pressure, weight, wrap

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False
NEEDS_CORRECTION = True


def gradient(const double[:, ::1] position, const double[::1] pressure,
             const signed char[::1] kind, const int[::1] indptr, const int[::1] indices,
             stencil, const double[:, ::1] c, double[:, ::1] out):
    """<grad p>_i = (Ds/n0) sum_j (p_i C_j + p_j C_i) r_ij w / r^2 (Zhang, Adams & Hu 2024).

    C is the correction matrix (`mpslab.correction`); walls take that of the water particle.
    The pair force is equal and opposite, but not central: linear momentum is conserved, angular
    momentum nearly.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef double dx, dy, dz, r, w, pi, pj, gx, gy, gz
    cdef Py_ssize_t i, k, j, m
    with nogil:
        for i in range(indptr.shape[0] - 1):
            gx = gy = gz = 0.0
            pi = pressure[i]
            for k in range(indptr[i], indptr[i + 1] if kind[i] == FLUID else indptr[i]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = weight(r, radius) / (r * r)
                w = w if has_pressure(kind[j]) else 0.0
                pj = pressure[j]
                m = j if kind[j] == FLUID else i
                gx += w * ((pi * c[m, 0] + pj * c[i, 0]) * dx + (pi * c[m, 3] + pj * c[i, 3]) * dy
                           + (pi * c[m, 4] + pj * c[i, 4]) * dz)
                gy += w * ((pi * c[m, 3] + pj * c[i, 3]) * dx + (pi * c[m, 1] + pj * c[i, 1]) * dy
                           + (pi * c[m, 5] + pj * c[i, 5]) * dz)
                gz += w * ((pi * c[m, 4] + pj * c[i, 4]) * dx + (pi * c[m, 5] + pj * c[i, 5]) * dy
                           + (pi * c[m, 2] + pj * c[i, 2]) * dz)
            out[i, 0] = factor * gx
            out[i, 1] = factor * gy
            out[i, 2] = factor * gz
