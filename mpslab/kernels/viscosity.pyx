"""Viscous acceleration: the divergence of the stress 2 nu D, pair by pair.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
velocity : (n, 4) [m/s], the fourth number 0
"""
from libc.math cimport sqrt

from mpslab.kernels.lanes cimport four, lane, load, minus, nothing, plus, widened
from mpslab.kernels.pair cimport FLUID, along, pull, turned, weight


cdef inline four stretched(four total, double factor, double inverse, const double* there,
                           const double* here, const float* offset) noexcept nogil:
    """total + factor ((u_j - u_i) . e) e, e = r_ij/r: what a pair that is stretched gives."""
    factor *= along(there, here, offset) * inverse * inverse
    return plus(total, factor, widened(offset))


def mirror(const int[::1] row, const int[::1] solid, const int[::1] other,
           const float[::1] inverse, const signed char[::1] role, stencil,
           const double[:, ::1] velocity, double[::1] total, double[:, ::1] out):
    """2 u_w less the mean of the water near it, sum_f w u_f / sum_f w, for each solid w [m/s].

    With it the velocity at the face of a wall is that of the wall (Adami, Hu & Adams 2012).  Water
    keeps its velocity, and so do solids without any near.

    total : (n,) out, sum_f w of each solid
    """
    cdef double radius = stencil.radius
    cdef double w
    cdef Py_ssize_t i, j, k, a
    with nogil:
        for i in range(solid.shape[0]):
            total[i] = 0.0
            for a in range(4):
                out[i, a] = velocity[i, a] if role[i] == FLUID else 0.0
        for i in range(solid.shape[0]):
            for k in range(solid[i], row[i + 1] if role[i] == FLUID else solid[i]):
                j, w = other[k], weight(inverse[k], radius)
                total[j] += w
                for a in range(3):
                    out[j, a] += w * velocity[i, a]
        for i in range(solid.shape[0]):
            if role[i] != FLUID:
                for a in range(3):
                    out[i, a] = (2.0 * velocity[i, a] - out[i, a] / total[i] if total[i] > 0.0
                                 else velocity[i, a])


def acceleration(const int[::1] row, const int[::1] solid, const int[::1] other,
                 const float[:, ::1] offset, const float[::1] inverse,
                 const signed char[::1] role, stencil, const double[:, ::1] velocity,
                 const double[::1] viscosity, bint slip, double[:, ::1] out):
    """(2 Ds (Ds + 2)/(lambda0 n0)) sum_j (nu_i + nu_j)/2 w ((u_j - u_i) . e) e of the water [m/s2].

    e = r_ij/r.  With solids j, which may be smooth and have no r_ij along their face, the term is
    that of the Laplacian, nu_i w (u_j - u_i) 2/(Ds + 2).  With `slip` the walls are left out of the
    sum: they have no friction.

    viscosity : (n,) nu of each particle [m2/s]
    """
    cdef double radius = stencil.radius, moment = stencil.lambda0 * stencil.n0
    cdef double factor = stencil.dim * (stencil.dim + 2) / moment
    cdef double drag = 2.0 / (stencil.dim + 2)
    cdef four here, total
    cdef Py_ssize_t i, j, k, a
    with nogil:
        for i in range(solid.shape[0]):
            if role[i] != FLUID:
                continue
            here, total = load(&velocity[i, 0]), nothing()
            for k in range(row[i], solid[i]):
                j = other[k]
                total = stretched(total, (viscosity[i] + viscosity[j]) * weight(inverse[k], radius),
                                  inverse[k], &velocity[j, 0], &velocity[i, 0], &offset[k, 0])
            for k in range(solid[i], solid[i] if slip else row[i + 1]):
                total = plus(total, drag * viscosity[i] * weight(inverse[k], radius),
                             minus(load(&velocity[other[k], 0]), here))
            for a in range(3):
                out[i, a] = factor * lane(total, a)


def drag(const int[::1] row, const int[::1] solid, const int[::1] other,
         const float[::1] inverse, const signed char[::1] role, stencil,
         const double[:, ::1] velocity, const double[::1] grip, double[:, ::1] out):
    """sum_j grip_j w (u_j - u_i) over the solids beside each particle of water [m/s2].

    grip : (n,) of solids [1/s]
    """
    cdef double radius = stencil.radius
    cdef four here, total
    cdef Py_ssize_t i, k, a
    with nogil:
        for i in range(solid.shape[0]):
            if role[i] != FLUID or solid[i] == row[i + 1]:
                continue
            here, total = load(&velocity[i, 0]), nothing()
            for k in range(solid[i], row[i + 1]):
                total = plus(total, grip[other[k]] * weight(inverse[k], radius),
                             minus(load(&velocity[other[k], 0]), here))
            for a in range(3):
                out[i, a] = lane(total, a)


def strain_rate(const int[::1] row, const int[::1] solid, const int[::1] other,
                const float[:, ::1] offset, const signed char[::1] role, stencil,
                const double[:, ::1] velocity, const double[:, :, ::1] c, bint slip,
                double[::1] out):
    """|S| = sqrt(2 S:S) of the water [1/s]; 0 for solids.

    S is the symmetric part of (Ds/n0) sum_j u_ij (x) C_i r_ij w/r^2, exact for linear velocities
    where the neighbours are complete.  With `slip` the walls are left out, as in `acceleration`;
    next to a wall |S| is then about half of what it should be.

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
