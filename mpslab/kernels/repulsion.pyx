"""Displacements that keep particles apart: shifting, dynamic stabilisation, collision."""
import numpy as np

from libc.math cimport sqrt

from mpslab.kernels.pair cimport FLUID, distance, has_pressure, weight, wrap

from mpslab.kernels import shares


def shifting(const double[:, ::1] position, const signed char[::1] role,
             const unsigned char[::1] surface, const int[::1] indptr, const int[::1] indices,
             stencil, const double[:, ::1] c, double factor, double longest,
             double[:, ::1] out):
    """dr_i = -factor sum_j (C_i + C_j)/2 r_ij w/r^2, at most `longest` [m].

    Zero for free-surface particles and for those that have one as a neighbour.

    c : (n, 6) matrices C of the fluid particles; solids take that of their neighbour
    factor : [m2]
    """
    cdef double radius = stencil.radius, width = stencil.width, floor = stencil.floor
    cdef const double[::1] water = shares.of_water(role), free = np.asarray(surface, float)
    cdef double dx, dy, dz, r, w, a, b, xx, yy, zz, xy, xz, yz, sx, sy, sz, near_surface, length
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            out[i, 0] = out[i, 1] = out[i, 2] = 0.0
            if role[i] != FLUID or surface[i]:
                continue
            sx = sy = sz = 0.0
            near_surface = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                w = 0.5 * weight(r, radius) / (r * r)
                near_surface += free[j] * (r < radius)
                a = water[j]
                b = 2.0 - a
                xx = a * c[j, 0] + b * c[i, 0]
                yy = a * c[j, 1] + b * c[i, 1]
                zz = a * c[j, 2] + b * c[i, 2]
                xy = a * c[j, 3] + b * c[i, 3]
                xz = a * c[j, 4] + b * c[i, 4]
                yz = a * c[j, 5] + b * c[i, 5]
                sx += w * (xx * dx + xy * dy + xz * dz)
                sy += w * (xy * dx + yy * dy + yz * dz)
                sz += w * (xz * dx + yz * dy + zz * dz)
            if near_surface > 0.0:
                continue
            length = factor * sqrt(sx * sx + sy * sy + sz * sz)
            w = -factor * (longest / length if length > longest else 1.0)
            out[i, 0] = w * sx
            out[i, 1] = w * sy
            out[i, 2] = w * sz


def overlap(const double[:, ::1] position, const double[:, ::1] before,
            const double[:, ::1] velocity, const signed char[::1] role, const int[::1] indptr,
            const int[::1] indices, stencil, double closest, double dt, double[:, ::1] move,
            double[:, ::1] change):
    """Displacement that takes pairs closer than `closest` apart (after Tsuruta et al. 2013) [m],
    and the change of velocity that goes with it [m/s].

    dr_i = -s (sqrt(closest^2 - r_perp^2) - r_par) e, along the direction e that the pair had
    before the pressure moved it; s = 1/2 between fluid particles, 1 against a wall.  The velocity
    changes by dr_i/dt, but by no more than takes the pair's approach away: parting those that
    something else has pushed together must not make energy.
    """
    cdef double width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, ex, ey, ez, r, rr, par, along, push, approach, share
    cdef double sx, sy, sz, ux, uy, uz
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            move[i, 0] = move[i, 1] = move[i, 2] = 0.0
            change[i, 0] = change[i, 1] = change[i, 2] = 0.0
            if role[i] != FLUID:
                continue
            sx = sy = sz = ux = uy = uz = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                rr = dx * dx + dy * dy + dz * dz
                if rr >= closest * closest or not has_pressure(role[j]):
                    continue
                ex = before[j, 0] - before[i, 0]
                ey = wrap(before[j, 1] - before[i, 1], width)
                ez = before[j, 2] - before[i, 2]
                r = distance(ex, ey, ez, floor)
                ex /= r
                ey /= r
                ez /= r
                par = dx * ex + dy * ey + dz * ez
                along = closest * closest - (rr - par * par)
                push = sqrt(along if along > 0.0 else 0.0) - par
                if push <= 0.0:
                    continue
                approach = ((velocity[i, 0] - velocity[j, 0]) * ex
                            + (velocity[i, 1] - velocity[j, 1]) * ey
                            + (velocity[i, 2] - velocity[j, 2]) * ez)
                approach = min(max(approach, 0.0), push / dt)
                share = 0.5 if role[j] == FLUID else 1.0
                sx -= share * push * ex
                sy -= share * push * ey
                sz -= share * push * ez
                ux -= share * approach * ex
                uy -= share * approach * ey
                uz -= share * approach * ez
            move[i, 0] = sx
            move[i, 1] = sy
            move[i, 2] = sz
            change[i, 0] = ux
            change[i, 1] = uy
            change[i, 2] = uz


def collision(const double[:, ::1] position, const double[:, ::1] velocity,
              const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
              stencil, double closest, double restitution, double[:, ::1] out):
    """Change of velocity where approaching pairs are closer than `closest` [m/s].

    du_i = -(1 + restitution) s (u_i - u_j).e e, with s = 1/2 between equal particles and 1
    against a wall (Shibata, Murotani & Koshizuka 2014).
    """
    cdef double width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, r, approach, sx, sy, sz
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            out[i, 0] = out[i, 1] = out[i, 2] = 0.0
            if role[i] != FLUID:
                continue
            sx = sy = sz = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                if r >= closest:
                    continue
                approach = ((velocity[i, 0] - velocity[j, 0]) * dx
                            + (velocity[i, 1] - velocity[j, 1]) * dy
                            + (velocity[i, 2] - velocity[j, 2]) * dz) / r
                if approach <= 0.0:
                    continue
                approach *= (1.0 + restitution) * (0.5 if role[j] == FLUID else 1.0) / r
                sx -= approach * dx
                sy -= approach * dy
                sz -= approach * dz
            out[i, 0] = sx
            out[i, 1] = sy
            out[i, 2] = sz
