"""Viscous acceleration.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
velocity : (n, 4) [m/s], the fourth number 0
"""
from libc.math cimport sqrt

from mpslab.kernels.lanes cimport four, lane, load, minus, nothing, plus
from mpslab.kernels.pair cimport FLUID, pull, turned, weight


def viscous_acceleration(const int[::1] row, const int[::1] solid, const int[::1] other,
                         const float[::1] inverse, const signed char[::1] role, stencil,
                         const double[:, ::1] velocity, double viscosity, bint slip,
                         double[:, ::1] out):
    """nu <lap u>_i = nu (2 Ds/(lambda0 n0)) sum_j (u_j - u_i) w of the fluid particles [m/s2].

    Equation (1) of the paper, with the Laplacian of Koshizuka & Oka (1996).  With `slip` the
    walls are left out of the sum: they have no friction.
    """
    cdef double radius = stencil.radius
    cdef double factor = viscosity * 2.0 * stencil.dim / (stencil.lambda0 * stencil.n0)
    cdef four here, total
    cdef Py_ssize_t i, k, a
    with nogil:
        for i in range(solid.shape[0]):
            if role[i] != FLUID:
                continue
            here, total = load(&velocity[i, 0]), nothing()
            for k in range(row[i], solid[i] if slip else row[i + 1]):
                total = plus(total, weight(inverse[k], radius),
                             minus(load(&velocity[other[k], 0]), here))
            for a in range(3):
                out[i, a] = factor * lane(total, a)


def strain_rate(const int[::1] row, const int[::1] solid, const int[::1] other,
                const float[:, ::1] offset, const signed char[::1] role, stencil,
                const double[:, ::1] velocity, const double[:, :, ::1] c, bint slip,
                double[::1] out):
    """|S| = sqrt(2 S:S) of the water [1/s]; 0 for solids.

    S is the symmetric part of (Ds/n0) sum_j u_ij (x) C_i r_ij w/r^2, exact for linear velocities
    where the neighbours are complete.  With `slip` the walls are left out, as in
    `viscous_acceleration`; next to a wall |S| is then about half of what it should be.

    c : (n, 3, 4) correction matrices over all neighbours; see mpslab.kernels.moments
    """
    cdef double factor = stencil.dim / stencil.n0
    cdef double xx, yy, zz, xy, xz, yz
    cdef four g, u, x, y, z
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(solid.shape[0]):
            out[i] = 0.0
            if role[i] != FLUID:
                continue
            x = y = z = nothing()
            for k in range(row[i], solid[i] if slip else row[i + 1]):
                g = pull(&offset[k, 0])
                u = minus(load(&velocity[other[k], 0]), load(&velocity[i, 0]))
                x, y, z = plus(x, lane(u, 0), g), plus(y, lane(u, 1), g), plus(z, lane(u, 2), g)
            x, y, z = turned(&c[i, 0, 0], x), turned(&c[i, 0, 0], y), turned(&c[i, 0, 0], z)
            xx, yy, zz = lane(x, 0), lane(y, 1), lane(z, 2)
            xy, xz, yz = lane(x, 1) + lane(y, 0), lane(x, 2) + lane(z, 0), lane(y, 2) + lane(z, 1)
            out[i] = factor * sqrt(2.0 * (xx * xx + yy * yy + zz * zz)
                                   + xy * xy + xz * xz + yz * yz)


def eddy_acceleration(const int[::1] row, const int[::1] solid, const int[::1] other,
                      const float[::1] inverse, const signed char[::1] role, stencil,
                      const double[:, ::1] velocity, const double[::1] eddy, bint slip,
                      double[:, ::1] out):
    """Add (2 Ds/(lambda0 n0)) sum_j (e_i + e_j)/2 (u_j - u_i) w of the fluid particles [m/s2].

    eddy : (n,) viscosity e of each particle [m2/s]; a solid takes that of the water particle
    """
    cdef double radius = stencil.radius
    cdef double factor = stencil.dim / (stencil.lambda0 * stencil.n0)
    cdef four here, total
    cdef Py_ssize_t i, k, a
    with nogil:
        for i in range(solid.shape[0]):
            if role[i] != FLUID:
                continue
            here, total = load(&velocity[i, 0]), nothing()
            for k in range(row[i], solid[i]):
                total = plus(total, weight(inverse[k], radius) * (eddy[i] + eddy[other[k]]),
                             minus(load(&velocity[other[k], 0]), here))
            for k in range(solid[i], solid[i] if slip else row[i + 1]):
                total = plus(total, weight(inverse[k], radius) * 2.0 * eddy[i],
                             minus(load(&velocity[other[k], 0]), here))
            for a in range(3):
                out[i, a] += factor * lane(total, a)
