"""How far the water's velocities are from even: from linear in space, as far as neighbours tell.

L u_i = sum_j a_ij (u_j - u_i) over the water beside a particle of water, with
a_ij = (w - (w/r^2) r_ij . b_i)/n0.  The vector b_i makes it zero of any linear velocity, at the
surface too: (sum_j r_ij (x) r_ij w/r^2) b_i = sum_j w r_ij.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
found : (n, 2, 4), L u [m/s] and b [1/m] of the water, 0 of solids; the fourth numbers are 0
"""
from mpslab.kernels.lanes cimport (
    ended, four, lane, load, minus, nothing, plus, store, times, widened,
)
from mpslab.kernels.matrix cimport inverted
from mpslab.kernels.pair cimport FLUID, dot, turned, weight

# Determinant of the second moment, 1 in a full neighbourhood, 0.04 at a corner of water in 3-D;
# with less (a film, spray) b is 0.
cdef double LEAST_DETERMINANT = 0.008


def unevenness(const int[::1] row, const int[::1] solid, const int[::1] other,
               const float[:, ::1] offset, const float[::1] inverse, const signed char[::1] role,
               stencil, const double[:, ::1] velocity, double[:, :, ::1] found):
    """L u and b of velocities (n, 4) [m/s] whose fourth number is 0."""
    cdef double radius = stencil.radius, share = 1.0 / stencil.n0, w
    cdef int dim = stencil.dim
    cdef double[12] moment
    cdef four here, u, r, b, gr, lean, sums, xx, yy, zz, x, y, z
    cdef Py_ssize_t i, k
    with nogil:
        for i in range(solid.shape[0]):
            store(&found[i, 0, 0], nothing())
            store(&found[i, 1, 0], nothing())
            if role[i] != FLUID:
                continue
            here = load(&velocity[i, 0])
            lean = sums = xx = yy = zz = x = y = z = nothing()
            for k in range(row[i], solid[i]):
                u, r = minus(load(&velocity[other[k], 0]), here), widened(&offset[k, 0])
                w = share * weight(inverse[k], radius)
                gr = times(share * lane(r, 3), r)
                sums, lean = plus(sums, w, u), plus(lean, w, r)
                xx, yy = plus(xx, lane(r, 0), gr), plus(yy, lane(r, 1), gr)
                zz = plus(zz, lane(r, 2), gr)
                x, y, z = plus(x, lane(gr, 0), u), plus(y, lane(gr, 1), u), plus(z, lane(gr, 2), u)
            store(moment, xx)
            store(moment + 4, yy)
            store(moment + 8, zz)
            if inverted(moment, dim, dim == 2, LEAST_DETERMINANT, moment):
                b = times(dim, turned(moment, lean))
                store(&found[i, 1, 0], ended(b, 0.0))
                sums = plus(plus(plus(sums, -lane(b, 0), x), -lane(b, 1), y), -lane(b, 2), z)
            store(&found[i, 0, 0], sums)


def transposed(const int[::1] row, const int[::1] solid, const int[::1] other,
               const float[:, ::1] offset, const float[::1] inverse, const signed char[::1] role,
               stencil, const double[:, :, ::1] found, double[:, ::1] out):
    """-L^T q_i = -sum_j (a_ji q_j - a_ij q_i) of q = L u of the water, (n, 3) out; 0 of solids.

    What one of a pair gains the other loses.
    """
    cdef double radius = stencil.radius, share = 1.0 / stencil.n0, w, mine, yours
    cdef four here, total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(solid.shape[0]):
            total = nothing()
            if role[i] == FLUID:
                here = load(&found[i, 0, 0])
                for k in range(row[i], solid[i]):
                    j, w = other[k], weight(inverse[k], radius)
                    mine = share * (w - offset[k, 3] * dot(&found[i, 1, 0], &offset[k, 0]))
                    yours = share * (w + offset[k, 3] * dot(&found[j, 1, 0], &offset[k, 0]))
                    total = plus(plus(total, mine, here), -yours, load(&found[j, 0, 0]))
            for a in range(3):
                out[i, a] = lane(total, a)
