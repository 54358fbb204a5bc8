"""Pressure gradient of CMPS with one power of the distance less, a softer pair force."""
from dataclasses import replace

from mpslab.models.gradients.cmps import above_least

from mpslab.kernels.lanes cimport four, lane, nothing, plus
from mpslab.kernels.pair cimport FLUID, pull

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(near, double[:, ::1] out):
    """<grad p>_i = (Ds/m0) sum_j ((p_i + p_j) - (p^_i + p^_j)) r_ij w / r.

    Equation (4) of the paper with r in place of r^2, and m0 = sum w r over the full lattice in
    place of n0 = sum w: so the dimension is that of a gradient, and the sum of p_i + p_j is exact
    on the lattice.  The printed text that we have shows r, but its factor goes with r^2
    (docs/cmps.md).
    """
    by_pairs, pressure = as_pairs(near)
    by_pairs(near.of(replace(near.particles, pressure=pressure)), out)


def as_pairs(near):
    """The sum with p_i + p_j in the bracket, and p - p^ [Pa]."""
    return symmetric, above_least(near)


def symmetric(near, double[:, ::1] out):
    """(Ds/m0) sum_j (p_i + p_j) r_ij w / r."""
    cdef const int[::1] row = near.row, other = near.other
    cdef const float[:, ::1] offset = near.offset
    cdef const float[::1] inverse = near.inverse
    cdef const double[::1] pressure = near.particles.pressure
    cdef const signed char[::1] role = near.particles.role
    cdef const unsigned char[::1] loaded = near.loaded
    cdef double factor = near.stencil.dim / near.stencil.first
    cdef four total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(role.shape[0]):
            total = nothing()
            for k in range(row[i], row[i + 1] if role[i] == FLUID else row[i]):
                j = other[k]
                if loaded[j]:
                    total = plus(total, (pressure[i] + pressure[j]) / inverse[k],
                                 pull(&offset[k, 0]))
            for a in range(3):
                out[i, a] = factor * lane(total, a)
