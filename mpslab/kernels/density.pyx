"""Particle number density and its first moment."""
from libc.math cimport sqrt

from mpslab.kernels.pair cimport distance, weight, wrap


def number_density(const double[:, ::1] position, const int[::1] indptr, const int[::1] indices,
                   stencil, double[::1] out):
    """n_i = sum_j w(|r_ij|) over all neighbours (Koshizuka & Oka 1996), (n,)."""
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double x, y, z, total
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            x, y, z = position[i, 0], position[i, 1], position[i, 2]
            total = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                total += weight(distance(position[j, 0] - x,
                                         wrap(position[j, 1] - y, width),
                                         position[j, 2] - z, floor), radius)
            out[i] = total


def imbalance(const double[:, ::1] position, const int[::1] indptr, const int[::1] indices,
              stencil, const int[::1] rows, int[::1] count, double[::1] out):
    """|sum_j w r_ij| / sum_j w of the particles `rows`: how lopsided the neighbours are [m].

    count : out, neighbours inside the radius of the stencil (the list may reach further)
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, w, mx, my, mz, total
    cdef Py_ssize_t m, i, k, j
    cdef int near
    with nogil:
        for m in range(rows.shape[0]):
            i = rows[m]
            mx = my = mz = total = 0.0
            near = 0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                w = weight(distance(dx, dy, dz, floor), radius)
                mx += w * dx
                my += w * dy
                mz += w * dz
                total += w
                near += w > 0.0
            count[m] = near
            out[m] = sqrt(mx * mx + my * my + mz * mz) / (total if total > 0.0 else 1.0)
