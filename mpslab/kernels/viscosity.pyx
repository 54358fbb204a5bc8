"""Viscous acceleration."""
import numpy as np
from libc.math cimport sqrt

from mpslab.kernels.pair cimport FLUID, distance, weight, wrap

from mpslab.kernels import shares


def viscous_acceleration(const double[:, ::1] position, const double[:, ::1] velocity,
                         const signed char[::1] role, const int[::1] indptr,
                         const int[::1] indices, stencil, double viscosity, bint slip,
                         double[:, ::1] out):
    """nu <lap u>_i = nu (2 Ds/(lambda0 n0)) sum_j (u_j - u_i) w of the fluid particles [m/s2].

    Equation (1) of the paper, with the Laplacian of Koshizuka & Oka (1996).  With `slip` the
    walls are left out of the sum: a wall without friction.
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = viscosity * 2.0 * stencil.dim / (stencil.lambda0 * stencil.n0)
    cdef const double[::1] share = shares.of_water(role) if slip else np.ones(role.shape[0])
    cdef double x, y, z, w, ax, ay, az
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            if role[i] != FLUID:
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


def strain_rate(const double[:, ::1] position, const double[:, ::1] velocity,
                const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
                stencil, const double[:, ::1] c, bint slip, double[::1] out):
    """|S| = sqrt(2 S:S) of the water, S the symmetric part of (Ds/n0) sum_j u_ij (x) C_i r_ij w/r^2.

    In [1/s]; 0 for solids.  Exact for linear velocities where the neighbours are complete.  With
    `slip` the walls are left out, as in `viscous_acceleration`, and next to one |S| is about half.

    c : (n, 6) correction matrices over all neighbours; see mpslab.kernels.moments
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef const double[::1] share = shares.of_water(role) if slip else np.ones(role.shape[0])
    cdef double dx, dy, dz, r, w, x, y, z, ux, uy, uz, xx, yy, zz, xy, xz, yz
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            xx = yy = zz = xy = xz = yz = 0.0
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = share[j] * weight(r, radius) / (r * r)
                x = w * (c[i, 0] * dx + c[i, 3] * dy + c[i, 4] * dz)
                y = w * (c[i, 3] * dx + c[i, 1] * dy + c[i, 5] * dz)
                z = w * (c[i, 4] * dx + c[i, 5] * dy + c[i, 2] * dz)
                ux = velocity[j, 0] - velocity[i, 0]
                uy = velocity[j, 1] - velocity[i, 1]
                uz = velocity[j, 2] - velocity[i, 2]
                xx += ux * x
                yy += uy * y
                zz += uz * z
                xy += ux * y + uy * x
                xz += ux * z + uz * x
                yz += uy * z + uz * y
            out[i] = factor * sqrt(2.0 * (xx * xx + yy * yy + zz * zz)
                                   + xy * xy + xz * xz + yz * yz)


def eddy_acceleration(const double[:, ::1] position, const double[:, ::1] velocity,
                      const signed char[::1] role, const int[::1] indptr,
                      const int[::1] indices, stencil, const double[::1] eddy, bint slip,
                      double[:, ::1] out):
    """Add (2 Ds/(lambda0 n0)) sum_j (e_i + e_j)/2 (u_j - u_i) w of the fluid particles [m/s2].

    eddy : (n,) viscosity e of each particle; solids take that of their neighbour [m2/s]
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / (stencil.lambda0 * stencil.n0)
    cdef const double[::1] water = shares.of_water(role)
    cdef const double[::1] share = water if slip else np.ones(role.shape[0])
    cdef double x, y, z, w, e, ax, ay, az
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            x, y, z, e = position[i, 0], position[i, 1], position[i, 2], eddy[i]
            ax = ay = az = 0.0
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                j = indices[k]
                w = share[j] * weight(distance(position[j, 0] - x,
                                               wrap(position[j, 1] - y, width),
                                               position[j, 2] - z, floor), radius)
                w = w * (2.0 * e + water[j] * (eddy[j] - e))
                ax += (velocity[j, 0] - velocity[i, 0]) * w
                ay += (velocity[j, 1] - velocity[i, 1]) * w
                az += (velocity[j, 2] - velocity[i, 2]) * w
            out[i, 0] += factor * ax
            out[i, 1] += factor * ay
            out[i, 2] += factor * az
