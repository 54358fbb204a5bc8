"""Detection of free-surface particles."""

import numpy as np

from mpslab.kernels import density

LOPSIDED = 0.2  # spacings
FEW = 4


def mark_surface(particles, neighbors, stencil, threshold):
    """Set ``particles.surface``, where p = 0 holds; number density must be up to date.

    A particle is at the surface where n < threshold n0, unless its neighbours surround it
    evenly: more than four of them, and |sum w r_ij|/n < 0.2 d0 (Shibata et al.; NPCD 2016).
    """
    few = particles.number_density < threshold * stencil.n0
    few &= particles.carries_pressure
    rows = np.flatnonzero(few).astype(np.int32)
    count, lopsided = np.empty(len(rows), np.int32), np.empty(len(rows))
    density.imbalance(
        particles.position, neighbors.indptr, neighbors.indices, stencil, rows, count, lopsided
    )
    inside = (count > FEW) & (lopsided < LOPSIDED * stencil.spacing)
    few[rows[inside]] = False
    particles.surface[:] = few
