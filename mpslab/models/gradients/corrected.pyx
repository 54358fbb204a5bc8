"""Conservative corrected pressure gradient (reverse kernel gradient correction)."""
from mpslab.kernels.lanes cimport four, lane, nothing, plus
from mpslab.kernels.pair cimport FLUID, pull, turned

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False
HAS_RESIDUE = True


def gradient(near, double[:, ::1] out):
    """<grad p>_i = (Ds/n0) sum_j (p_i C_j + p_j C_i) r_ij w / r^2 (Zhang, Adams & Hu 2024).

    C is the correction matrix; a wall takes that of the water particle.  The pair forces are equal
    and opposite, but not central: linear momentum is conserved, angular momentum nearly.

    It is computed as p_i S_i + C_i sum_j p_j r_ij w/r^2, where S_i = sum_j C_j r_ij w/r^2
    (`near.lean`) does not depend on the pressure.
    """
    cdef const int[::1] row = near.row, solid = near.solid, other = near.other
    cdef const float[:, ::1] offset = near.offset
    cdef const double[:, :, ::1] c = near.correction
    cdef const double[:, ::1] lean = near.lean
    cdef const double[::1] pressure = near.particles.pressure
    cdef const signed char[::1] role = near.particles.role
    cdef const unsigned char[::1] loaded = near.loaded
    cdef double factor = near.stencil.dim / near.stencil.n0
    cdef four total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(solid.shape[0]):
            out[i, 0] = out[i, 1] = out[i, 2] = 0.0
            if role[i] != FLUID:
                continue
            total = nothing()
            for k in range(row[i], solid[i]):
                total = plus(total, pressure[other[k]], pull(&offset[k, 0]))
            for k in range(solid[i], row[i + 1]):
                j = other[k]
                # A solid without a pressure is in S_i, with C_i: this takes it out.
                total = plus(total, pressure[j] if loaded[j] else -pressure[i],
                             pull(&offset[k, 0]))
            total = turned(&c[i, 0, 0], total)
            for a in range(3):
                out[i, a] = factor * (pressure[i] * lean[i, a] + lane(total, a))
