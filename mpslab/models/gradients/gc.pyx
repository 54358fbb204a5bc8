"""Corrected pressure gradient, exact for linear fields (GC)."""
from mpslab.kernels.lanes cimport four, lane, nothing, plus
from mpslab.kernels.pair cimport FLUID, pull, turned

from mpslab.kernels.moments import without_fillers

CONSERVES_MOMENTUM = False
EXACT_FOR_LINEAR = True
LEAST_DETERMINANT = 0.05


def gradient(near, double[:, ::1] out):
    """<grad p>_i = C_i (Ds/n0) sum_j (p_j - p_i) r_ij w / r^2 (Khayyer & Gotoh 2011).

    C_i is the inverse moment matrix over the same neighbours.  Forces are not equal and
    opposite, and nothing in them keeps particles apart: a stabiliser has to.
    """
    cdef const int[::1] row = near.row, other = near.other
    cdef const float[:, ::1] offset = near.offset
    cdef const double[::1] pressure = near.particles.pressure
    cdef const signed char[::1] role = near.particles.role
    cdef const unsigned char[::1] loaded = near.loaded
    cdef double factor = near.stencil.dim / near.stencil.n0
    cdef const double[:, :, ::1] c = _matrices(near)
    cdef four total
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(role.shape[0]):
            total = nothing()
            for k in range(row[i], row[i + 1] if role[i] == FLUID else row[i]):
                j = other[k]
                if loaded[j]:
                    total = plus(total, pressure[j] - pressure[i], pull(&offset[k, 0]))
            total = turned(&c[i, 0, 0], total)
            for a in range(3):
                out[i, a] = factor * lane(total, a)


def _matrices(near):
    """C of the neighbours that act with a pressure, (n, 3, 4)."""
    second = near.second.copy()
    without_fillers(near.row, near.solid, near.other, near.offset, near.loaded, second)
    return near.inverted(LEAST_DETERMINANT, second)
