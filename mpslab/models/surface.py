"""The free surface: which particles it is made of, and how p = 0 holds there."""

from functools import cache

import numpy as np

from mpslab.core.stencil import lattice_offsets
from mpslab.kernels import density

# How lopsided the neighbours are in the second layer [spacings]. With larger radii they are more
# so, and by as much more in the surface too, so that the limits below move along.
SECOND_LAYER = 0.02
LOPSIDED = 0.2  # spacings
FEW = 4
# Grade 0 to 1 of "graded": over this range of lopsidedness [spacings], or of n/n0 in spray.
GRADE_LOPSIDED = (0.15, 0.35)
GRADE_SPRAY = (0.85, 0.70)


def mark_surface(near, threshold, unknown):
    """Option ``scheme.surface = "marked"``: set ``particles.surface``, where p = 0 holds.

    Only particles whose pressure is an unknown, a mask (n,) bool, can be marked: the others have no
    neighbours in the list.

    A particle is at the surface where n < threshold n0, unless its neighbours surround it
    evenly: more than four of them, and |sum w r_ij|/n < 0.2 d0 (Shibata et al.; NPCD 2016).
    """
    few = near.number_density < threshold * near.stencil.n0
    few &= unknown
    rows = np.flatnonzero(few).astype(np.int32)
    count = np.empty(len(rows), np.int32)
    density.count(near.row, near.offset, rows, count)
    inside = (count > FEW) & (_lopsided(near, rows) < LOPSIDED)
    few[rows[inside]] = False
    near.particles.surface[:] = few


def grade_surface(near):
    """Option ``scheme.surface = "graded"``: how much of the surface each particle is, (n,) float64.

    0 inside, 1 at the surface or in spray, and in between smooth: so a particle on its way to the
    surface does not switch from one condition to the other.  Sets ``particles.surface`` as well.
    """
    rows = _near_surface(near)
    share = near.number_density[rows] / near.stencil.n0
    side = _between(_lopsided(near, rows), *GRADE_LOPSIDED)
    t = np.maximum(side, _between(share, *GRADE_SPRAY))
    graded = np.zeros(len(near.particles))
    graded[rows] = t * t * (3.0 - 2.0 * t)
    near.particles.surface[:] = graded > 0.5
    return graded


def surface_pull(particles, graded, stencil, laplacian_stencil, pair_terms, density_):
    """What the space above the surface adds to the diagonal of the pressure equation, (n,).

    The neighbours that a surface particle lacks stand for its mirror image above the surface, at
    the pressure -p_i: p = 0 holds half a spacing above the centre, where the water ends.  With
    the points themselves at p = 0 (half this pull; Tsuruta et al. 2015) the correction overshoots
    in 3-D, and the pressure of still water alternates by 6 % from step to step.

    The number density, of the first stencil, tells which share of the neighbours is missing; the
    pull of all neighbours together is that of the Laplacian's stencil.
    """
    missing = np.maximum(1.0 - particles.number_density / stencil.n0, 0.0)
    return 2.0 * graded * missing * _lattice_sum(laplacian_stencil, pair_terms) / density_


def filled_density(number_density, graded, stencil):
    """Number density as if the neighbours missing at the surface were there, (n,)."""
    return number_density + graded * np.maximum(stencil.relaxed - number_density, 0.0)


def _between(value, zero, one):
    return np.clip((value - zero) / (one - zero), 0.0, 1.0)


@cache
def _lattice_sum(stencil, pair_terms):
    """Sum of the Laplacian's pair weight over the full lattice [1/m2]."""
    reach = int(np.ceil(stencil.radius / stencil.spacing)) + 1
    r = np.linalg.norm(lattice_offsets(stencil.dim, reach), axis=1) * stencil.spacing
    one, inverse, cubic = pair_terms
    return float(np.sum((one + inverse / r + cubic / r**3)[r < stencil.radius]))


def _near_surface(near):
    """Rows of the water that may have a grade above 0; inside, which is nearly all, none has."""
    rows = np.empty(len(near.particles), np.int32)
    side = (GRADE_LOPSIDED[0] + _more_lopsided(near.stencil)) * near.stencil.spacing
    share = GRADE_SPRAY[0] * near.stencil.n0
    return rows[: density.thin_or_lopsided(near.particles.role, near.first, share, side, rows)]


def _lopsided(near, rows):
    """|sum_j w r_ij| / sum_j w of rows: how lopsided the neighbours are [spacings], (m,).

    If the second layer has more of it than at a radius of 2.1, the difference is taken off.
    """
    stencil, sums = near.stencil, near.first.take(rows, 0)
    length = np.sqrt(np.einsum("ij,ij->i", sums[:, :3], sums[:, :3]))
    total = np.where(sums[:, 3] > 0.0, sums[:, 3], 1.0)
    return length / total / stencil.spacing - _more_lopsided(stencil)


def _more_lopsided(stencil):
    return max(stencil.lopsided / stencil.spacing - SECOND_LAYER, 0.0)
