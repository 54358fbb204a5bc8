"""How far the water's velocities are from even: from linear in space, as far as neighbours tell.

L u_i = sum_j a_ij (u_j - u_i) over the water beside a particle of water, with
a_ij = (w - (w/r^2) r_ij . b_i)/n0.  The vector b_i makes it zero of any linear velocity, at the
surface too: (sum_j r_ij (x) r_ij w/r^2) b_i = sum_j w r_ij.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
found : (n, 2, 4), of water L u [m/s] and sum_j a_ij, b [1/m] and 0; 0 of solids
"""
from mpslab.kernels.lanes cimport (
    added, ended, four, lane, load, minus, nothing, plus, product, store, times, widened,
)
from mpslab.kernels.matrix cimport inverted
from mpslab.kernels.pair cimport FLUID, turned, weight

# Determinant of the second moment, 1 in a full neighbourhood, 0.04 at a corner of water in 3-D;
# with less (a film, spray) b is 0.
cdef double LEAST_DETERMINANT = 0.008


def unevenness(const int[::1] row, const int[::1] solid, const int[::1] other,
               const float[:, ::1] offset, const float[::1] inverse, const signed char[::1] role,
               stencil, const double[:, ::1] first, const double[:, :, ::1] second,
               const double[:, ::1] velocity, double[:, :, ::1] found):
    """L u, sum_j a_ij and b of velocities (n, 4) [m/s] whose fourth number is 0.

    first, second : sums over all neighbours, see mpslab.kernels.measure
    """
    cdef double radius = stencil.radius, share = 1.0 / stencil.n0, one, all_
    cdef int dim = stencil.dim
    cdef double[4] lean
    cdef double[12] moment
    cdef four here, b, sums
    cdef Py_ssize_t i, k, a
    with nogil:
        for i in range(solid.shape[0]):
            store(&found[i, 0, 0], nothing())
            store(&found[i, 1, 0], nothing())
            if role[i] != FLUID:
                continue
            if solid[i] == row[i + 1]:
                store(lean, load(&first[i, 0]))
                for a in range(3):
                    store(moment + 4 * a, times(share, load(&second[i, a, 0])))
            else:
                of_water(row[i], solid[i], offset, inverse, radius, share, lean, moment)
            b = nothing()
            if inverted(moment, dim, dim == 2, LEAST_DETERMINANT, moment):
                b = ended(times(dim * share, turned(moment, load(lean))), 0.0)
            here, sums, all_ = load(&velocity[i, 0]), nothing(), 0.0
            for k in range(row[i], solid[i]):
                one = coupling(weight(inverse[k], radius), -1.0, b, &offset[k, 0])
                sums = plus(sums, one, minus(load(&velocity[other[k], 0]), here))
                all_ += one
            store(&found[i, 0, 0], ended(times(share, sums), share * all_))
            store(&found[i, 1, 0], b)


cdef inline void of_water(Py_ssize_t begin, Py_ssize_t end, const float[:, ::1] offset,
                          const float[::1] inverse, double radius, double share, double* lean,
                          double* moment) noexcept nogil:
    """sum_j w r_ij and, times a share, the second moment of a part of a row."""
    cdef four r, gr, sums = nothing(), x = nothing(), y = nothing(), z = nothing()
    cdef Py_ssize_t k
    for k in range(begin, end):
        r = widened(&offset[k, 0])
        gr = times(share * lane(r, 3), r)
        sums = plus(sums, weight(inverse[k], radius), r)
        x, y, z = plus(x, lane(r, 0), gr), plus(y, lane(r, 1), gr), plus(z, lane(r, 2), gr)
    store(lean, sums)
    store(moment, x)
    store(moment + 4, y)
    store(moment + 8, z)


cdef inline double coupling(double w, double sign, four b, const float* offset) noexcept nogil:
    """n0 a_ij (sign -1) or n0 a_ji (1): w + sign (w/r^2) r_ij . b, b with 0 as fourth number."""
    cdef four r = widened(offset)
    return w + sign * lane(r, 3) * added(product(b, r))


def transposed(const int[::1] row, const int[::1] solid, const int[::1] other,
               const float[:, ::1] offset, const float[::1] inverse, const signed char[::1] role,
               stencil, const double[:, :, ::1] found, double[:, ::1] out):
    """-L^T q_i = -sum_j (a_ji q_j - a_ij q_i) of q = L u of the water, (n, 3) out; 0 of solids.

    What one of a pair gains the other loses.
    """
    cdef double radius = stencil.radius, share = 1.0 / stencil.n0, yours
    cdef four total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(solid.shape[0]):
            total = nothing()
            if role[i] == FLUID:
                total = times(found[i, 0, 3], load(&found[i, 0, 0]))
                for k in range(row[i], solid[i]):
                    j = other[k]
                    yours = coupling(weight(inverse[k], radius), 1.0, load(&found[j, 1, 0]),
                                     &offset[k, 0])
                    total = plus(total, -share * yours, load(&found[j, 0, 0]))
            for a in range(3):
                out[i, a] = lane(total, a)
