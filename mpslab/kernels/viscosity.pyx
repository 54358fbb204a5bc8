"""Viscous acceleration."""
import numpy as np

from mpslab.kernels.pair cimport FLUID, distance, weight, wrap

from mpslab.kernels import shares


def viscous_acceleration(const double[:, ::1] position, const double[:, ::1] velocity,
                         const signed char[::1] kind, const int[::1] indptr,
                         const int[::1] indices, stencil, double viscosity, bint slip,
                         double[:, ::1] out):
    """nu <lap u>_i = nu (2 Ds/(lambda0 n0)) sum_j (u_j - u_i) w of the fluid particles [m/s2].

    Equation (1) of the paper, with the Laplacian of Koshizuka & Oka (1996).  With `slip` the
    walls are left out of the sum: a wall without friction.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = viscosity * 2.0 * stencil.dim / (stencil.lambda0 * stencil.n0)
    cdef const double[::1] share = shares.of_water(kind) if slip else np.ones(kind.shape[0])
    cdef double x, y, z, w, ax, ay, az
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            if kind[i] != FLUID:
                continue
            x, y, z = position[i, 0], position[i, 1], position[i, 2]
            ax = ay = az = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                w = share[j] * weight(distance(position[j, 0] - x,
                                               wrap(position[j, 1] - y, width),
                                               position[j, 2] - z, floor), radius)
                ax += (velocity[j, 0] - velocity[i, 0]) * w
                ay += (velocity[j, 1] - velocity[i, 1]) * w
                az += (velocity[j, 2] - velocity[i, 2]) * w
            out[i, 0] = factor * ax
            out[i, 1] = factor * ay
            out[i, 2] = factor * az
