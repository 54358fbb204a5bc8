"""Rates of compression, for the right-hand sides of the pressure equation.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
velocity : (n, 3) [m/s]
"""
from mpslab.kernels.lanes cimport ended, four, lane, load, minus, nothing, plus, store
from mpslab.kernels.matrix cimport inverted
from mpslab.kernels.pair cimport FLUID, along, plus_turned, pull, turned


def divergence(const int[::1] row, const int[::1] other, const float[:, ::1] offset, stencil,
               const double[:, ::1] velocity, double[::1] out):
    """<div u>_i = (Ds/n0) sum_j u_ij . r_ij w / r^2 over all neighbours [1/s]."""
    cdef double factor = stencil.dim / stencil.n0
    cdef double total
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(out.shape[0]):
            total = 0.0
            for k in range(row[i], row[i + 1]):
                total += offset[k, 3] * along(&velocity[other[k], 0], &velocity[i, 0],
                                              &offset[k, 0])
            out[i] = factor * total


def density_rate(const int[::1] row, const int[::1] other, const float[:, ::1] offset,
                 const float[::1] inverse, stencil, const double[:, ::1] velocity,
                 double[::1] out):
    """(Dn/Dt)_i = -sum_j (r_e/r^3) r_ij . u_ij over all neighbours (Khayyer & Gotoh 2009) [1/s]."""
    cdef double radius = stencil.radius
    cdef double near, total
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(out.shape[0]):
            total = 0.0
            for k in range(row[i], row[i + 1]):
                near = inverse[k] if radius * inverse[k] > 1.0 else 0.0
                total += near * near * near * along(&velocity[other[k], 0], &velocity[i, 0],
                                                    &offset[k, 0])
            out[i] = -radius * total


def corrected(const int[::1] row, const int[::1] solid, const int[::1] other,
              const float[:, ::1] offset, const double[:, ::1] velocity,
              const double[:, :, ::1] second, const double[:, :, ::1] c, stencil,
              double least_determinant, double[:, ::1] out):
    """S_i = sum_j D_j r_ij w/r^2 and sum_j u_ij . B_i r_ij w/r^2: (n, 4) out [1/m, 1/(m s)].

    D_j is C_j of a water particle; of a solid it is C_i.  B_i is the inverse of the second moment:
    the second sum is n0/Ds div u, exact for linear velocities.

    velocity : (n, 4) [m/s], the fourth number 0
    second : (n, 3, 4), see mpslab.kernels.measure
    c : (n, 3, 4) correction matrices
    least_determinant : below it B_i = I
    """
    cdef double factor = stencil.dim / stencil.n0
    cdef bint flat = stencil.dim == 2
    cdef double[12] b
    cdef four here, u, g, lean, of_solids, x, y, z
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(out.shape[0]):
            here = load(&velocity[i, 0])
            lean = of_solids = x = y = z = nothing()
            for k in range(row[i], row[i + 1]):
                j, g = other[k], pull(&offset[k, 0])
                u = minus(load(&velocity[j, 0]), here)
                x, y, z = plus(x, lane(u, 0), g), plus(y, lane(u, 1), g), plus(z, lane(u, 2), g)
                if k < solid[i]:
                    lean = plus_turned(lean, &c[j, 0, 0], g)
                else:
                    of_solids = plus(of_solids, 1.0, g)
            lean = plus_turned(lean, &c[i, 0, 0], of_solids)
            inverted(&second[i, 0, 0], factor, flat, least_determinant, b)
            store(&out[i, 0], ended(lean, lane(turned(b, x), 0) + lane(turned(b, y), 1)
                                    + lane(turned(b, z), 2)))


def adjoint(const int[::1] row, const int[::1] solid, const int[::1] other,
            const float[:, ::1] offset, const double[:, ::1] velocity,
            double[:, :, ::1] c, double[:, ::1] out):
    """S_i = sum_j D_j r_ij w/r^2 and sum_j u_ij . D_j r_ij w/r^2: (n, 4) out [1/m, 1/(m s)].

    D_j is C_j of a water particle; of a solid it is C_i.  The sum over water is one product: of
    the three columns (C_j, C_j u_j) with r_ij w/r^2.

    c : (n, 3, 4) correction matrices; the fourth numbers become C_j u_j
    """
    cdef double u, v, w, div
    cdef four total, g
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(out.shape[0]):
            u, v, w = velocity[i, 0], velocity[i, 1], velocity[i, 2]
            for a in range(3):
                c[i, a, 3] = c[i, a, 0] * u + c[i, a, 1] * v + c[i, a, 2] * w
        for i in range(out.shape[0]):
            total = nothing()
            for k in range(row[i], solid[i]):
                total = plus_turned(total, &c[other[k], 0, 0], pull(&offset[k, 0]))
            div = lane(total, 3)
            for k in range(solid[i], row[i + 1]):
                j = other[k]
                g = turned(&c[i, 0, 0], pull(&offset[k, 0]))
                total = plus(total, 1.0, g)
                div += (velocity[j, 0] * lane(g, 0) + velocity[j, 1] * lane(g, 1)
                        + velocity[j, 2] * lane(g, 2))
            for a in range(3):
                out[i, a] = lane(total, a)
                div -= velocity[i, a] * lane(total, a)
            out[i, 3] = div


def largest_together(const int[::1] row, const int[::1] solid, const int[::1] other,
                     const signed char[::1] role, const double[::1] rate, Py_ssize_t begin,
                     Py_ssize_t end):
    """Largest over water of the lesser of its rate and the mean rate of it and the water beside it.

    0 if that is negative.
    """
    cdef double best = 0.0, total
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(begin, end):
            if role[i] != FLUID or rate[i] <= best:
                continue
            total = rate[i]
            for k in range(row[i], solid[i]):
                total += rate[other[k]]
            total = min(rate[i], total / (1 + solid[i] - row[i]))
            best = max(best, total)
    return best
