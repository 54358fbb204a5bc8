"""Rates of compression, for the right-hand sides of the pressure equation."""
from mpslab.kernels.pair cimport distance, weight, wrap

from mpslab.kernels import shares


def divergence(const double[:, ::1] position, const double[:, ::1] velocity,
               const int[::1] indptr, const int[::1] indices, stencil, double[::1] out):
    """<div u>_i = (Ds/n0) sum_j u_ij . r_ij w / r^2 over all neighbours [1/s]."""
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef double dx, dy, dz, r, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                total += ((velocity[j, 0] - velocity[i, 0]) * dx
                          + (velocity[j, 1] - velocity[i, 1]) * dy
                          + (velocity[j, 2] - velocity[i, 2]) * dz) * weight(r, radius) / (r * r)
            out[i] = factor * total


def density_rate(const double[:, ::1] position, const double[:, ::1] velocity,
                 const int[::1] indptr, const int[::1] indices, stencil, double[::1] out):
    """(Dn/Dt)_i = -sum_j (r_e/r^3) r_ij . u_ij over all neighbours (Khayyer & Gotoh 2009) [1/s]."""
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, r, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                total += ((velocity[j, 0] - velocity[i, 0]) * dx
                          + (velocity[j, 1] - velocity[i, 1]) * dy
                          + (velocity[j, 2] - velocity[i, 2]) * dz
                          ) * (1.0 if r < radius else 0.0) / (r * r * r)
            out[i] = -radius * total


def corrected_divergence(const double[:, ::1] position, const double[:, ::1] velocity,
                         const int[::1] indptr, const int[::1] indices, stencil,
                         const double[:, ::1] c, double[::1] out):
    """<div u>_i = (Ds/n0) sum_j u_ij . C_i r_ij w / r^2, exact for linear velocities [1/s].

    c : (n, 6) correction matrices over the same neighbours; see mpslab.kernels.moments
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef double dx, dy, dz, r, ux, uy, uz, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                ux = velocity[j, 0] - velocity[i, 0]
                uy = velocity[j, 1] - velocity[i, 1]
                uz = velocity[j, 2] - velocity[i, 2]
                r = distance(dx, dy, dz, floor)
                total += (ux * (c[i, 0] * dx + c[i, 3] * dy + c[i, 4] * dz)
                          + uy * (c[i, 3] * dx + c[i, 1] * dy + c[i, 5] * dz)
                          + uz * (c[i, 4] * dx + c[i, 5] * dy + c[i, 2] * dz)
                          ) * weight(r, radius) / (r * r)
            out[i] = factor * total


def adjoint_divergence(const double[:, ::1] position, const double[:, ::1] velocity,
                       const signed char[::1] role, const int[::1] indptr,
                       const int[::1] indices, stencil, const double[:, ::1] c,
                       double[::1] out):
    """<div u>_i = (Ds/n0) sum_j u_ij . C_j r_ij w / r^2: adjoint of the conservative gradient [1/s].

    sum_i p_i <div u>_i = -sum_i u_i . <grad p>_i with (Ds/n0) sum_j (p_i C_j + p_j C_i) r_ij w/r^2,
    where all particles are fluid.

    c : (n, 6) matrices C of the fluid particles; solids take that of their neighbour
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double factor = stencil.dim / stencil.n0
    cdef const double[::1] water = shares.of_water(role)
    cdef double dx, dy, dz, r, ux, uy, uz, a, b, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                a = water[j]
                b = 1.0 - a
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                ux = velocity[j, 0] - velocity[i, 0]
                uy = velocity[j, 1] - velocity[i, 1]
                uz = velocity[j, 2] - velocity[i, 2]
                r = distance(dx, dy, dz, floor)
                total += ((a * c[j, 0] + b * c[i, 0]) * ux * dx
                          + (a * c[j, 1] + b * c[i, 1]) * uy * dy
                          + (a * c[j, 2] + b * c[i, 2]) * uz * dz
                          + (a * c[j, 3] + b * c[i, 3]) * (ux * dy + uy * dx)
                          + (a * c[j, 4] + b * c[i, 4]) * (ux * dz + uz * dx)
                          + (a * c[j, 5] + b * c[i, 5]) * (uy * dz + uz * dy)
                          ) * weight(r, radius) / (r * r)
            out[i] = factor * total
