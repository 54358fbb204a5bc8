"""Hyperviscosity: what velocities differ in from particle to particle dies out."""

import numpy as np

from mpslab.core.neighbourhood import padded
from mpslab.kernels import unevenness as kernels


def change(near, velocity, share, refresh):
    """-s L^T L u of the water, (n, 3) [m/s]; L as in mpslab.kernels.unevenness.

    A difference of fourth order, as it takes from a flow what its grid does not resolve (Jameson,
    Schmidt & Turkel 1981). A wave of number k loses at most 0.12 s (k d0)^4 in it, what alternates
    from particle to particle about s. As L is zero of linear velocities, at the surface too,
    momentum and angular momentum are kept. Solids have no part in it.

    Parameters
    ----------
    near : Neighbourhood
    velocity : (n, 3) float64 [m/s]
    share : float
        s, at most 1/2.
    refresh : callable
        Brings the ghosts' rows of arrays up to date.
    """
    mine = near.row, near.solid, near.other, near.offset, near.inverse, near.particles.role
    velocity = padded(velocity)
    refresh(velocity)
    found, out = np.empty((len(velocity), 2, 4)), np.empty((len(velocity), 3))
    kernels.unevenness(*mine, near.stencil, near.first, near.second, velocity, found)
    refresh(found)
    kernels.transposed(*mine, near.stencil, found, out)
    return share * out
