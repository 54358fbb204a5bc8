"""Corrected pressure gradient, exact for linear fields (GC)."""

from mpslab.kernels.gradient import turn
from mpslab.kernels.moments import without_fillers
from mpslab.models.gradients._pairs import by_pairs

CONSERVES_MOMENTUM = False
EXACT_FOR_LINEAR = True
LEAST_DETERMINANT = 0.05


def gradient(near, out):
    """<grad p>_i = C_i (Ds/n0) sum_j (p_j - p_i) r_ij w / r^2 (Khayyer & Gotoh 2011).

    C_i is the inverse moment matrix over the same neighbours.  Forces are not equal and opposite,
    and nothing in them keeps particles apart: a stabiliser has to.
    """
    by_pairs(near, -near.particles.pressure, out, factor=1.0)
    turn(_matrices(near), near.stencil.dim / near.stencil.n0, out)


def _matrices(near):
    """C of the neighbours that act with a pressure, (n, 3, 4)."""
    second = near.second.copy()
    without_fillers(near.row, near.solid, near.other, near.offset, near.loaded, second)
    return near.inverted(LEAST_DETERMINANT, second)
