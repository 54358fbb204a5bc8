"""What gradients that are sums over pairs share.

A pair counts where the neighbour acts with a pressure.
"""

import numpy as np

from mpslab.kernels import gradient as kernels
from mpslab.kernels.minimum import least_pressure


def by_pairs(near, own, out, factor=None, soft=False):
    """factor sum_j (p_j + own_i) r_ij w / r^2 of the fluid particles, to out; zero elsewhere.

    Parameters
    ----------
    near : Neighbourhood
    own : (n,) float64 [Pa]
        What particle i adds to the pressure of each of its neighbours.
    out : (n, 3) float64 [Pa/m]
    factor : float, optional
        Ds/n0 unless given.
    soft : bool
        w / r in place of w / r^2.
    """
    particles, stencil = near.particles, near.stencil
    factor = stencil.dim / stencil.n0 if factor is None else factor
    kernels.by_pairs(
        near.row, near.other, near.offset, near.inverse, particles.pressure, own, particles.role,
        near.loaded, factor, soft, out,
    )  # fmt: skip


def least(near):
    """p^_i, the least pressure of a particle and its neighbours (equation 3), (n,) float64 [Pa]."""
    pressure = near.particles.pressure
    found = np.empty_like(pressure)
    least_pressure(near.row, near.other, near.offset, pressure, near.loaded, found)
    return found
