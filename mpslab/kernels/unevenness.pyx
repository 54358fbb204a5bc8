"""How far the water's velocities are from even: from linear in space, as far as neighbours tell.

L u_i = sum_j a_ij (u_j - u_i) over the water beside a particle of water, with
a_ij = (w - (w/r^2) r_ij . b_i)/n0.  The vector b_i makes it zero of any linear velocity, at the
surface too: (sum_j r_ij (x) r_ij w/r^2) b_i = sum_j w r_ij.

row, solid, other, offset, inverse : pairs, see mpslab.kernels.measure
found : (n, 2, 4), L u [m/s] and b [1/m] of the water, 0 of solids; the fourth numbers are 0
"""
from mpslab.kernels.lanes cimport four, lane, load, minus, nothing, plus, store, times, widened
from mpslab.kernels.pair cimport FLUID, dot, weight

# Determinant of the second moment, 1 in a full neighbourhood, 0.04 at a corner of water in 3-D;
# with less (a film, spray) b is 0.
cdef double LEAST_DETERMINANT = 0.008


def unevenness(const int[::1] row, const int[::1] solid, const int[::1] other,
               const float[:, ::1] offset, const float[::1] inverse, const signed char[::1] role,
               stencil, const double[:, ::1] velocity, double[:, :, ::1] found):
    """L u and b of velocities (n, 4) [m/s] whose fourth number is 0."""
    cdef double radius = stencil.radius, share = 1.0 / stencil.n0, w
    cdef int dim = stencil.dim
    cdef double[4] slope
    cdef four here, u, r, gr, lean, sums, xx, yy, zz, x, y, z
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
            if solve(xx, yy, zz, lean, dim, slope):
                store(&found[i, 1, 0], load(slope))
                sums = plus(plus(plus(sums, -slope[0], x), -slope[1], y), -slope[2], z)
            store(&found[i, 0, 0], sums)


cdef inline bint solve(four x, four y, four z, four right, int dim, double* out) noexcept nogil:
    """Solve a symmetric matrix, in three columns, for a vector; whether it can be."""
    cdef double xx = lane(x, 0), xy = lane(x, 1), xz = lane(x, 2)
    cdef double yy = lane(y, 1) if dim == 3 else 1.0 / dim, yz = lane(y, 2), zz = lane(z, 2)
    cdef double a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - yy * xz
    cdef double d = xx * zz - xz * xz, e = xy * xz - xx * yz, f = xx * yy - xy * xy
    cdef double det = xx * a + xy * b + xz * c, u, v, w
    if det * dim * dim * dim < LEAST_DETERMINANT:
        return False
    u, v, w = lane(right, 0) / det, lane(right, 1) / det, lane(right, 2) / det
    out[0], out[1], out[2] = a * u + b * v + c * w, b * u + d * v + e * w, c * u + e * v + f * w
    out[3] = 0.0
    return True


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
