"""Mixed source: the divergence of the velocity and a share of the density deviation."""

import numpy as np

from mpslab.kernels import divergence


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = -<div u*>_i/dt + s (n_i - n0)/(n0 dt) (Tanaka & Masunaga 2010) [1/s2]."""
    out = np.empty(len(velocity))
    divergence.divergence(near.row, near.other, near.offset, near.stencil, velocity, out)
    return (rate * (number_density / near.stencil.n0 - 1.0) - out) / dt
