"""Pressure gradient of the Corrected MPS method (CMPS)."""
from dataclasses import replace

import numpy as np

from mpslab.models.gradients import symmetric
from mpslab.kernels.minimum import least_pressure

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(near, double[:, ::1] out):
    """<grad p>_i = (Ds/n0) sum_j ((p_i + p_j) - (p^_i + p^_j)) r_ij w / r^2.

    Equation (4) of the paper, with the square that its print lacks: the pair force is equal and
    opposite.  It is that of `symmetric` with p - p^ in place of p.  In a linear pressure on a
    regular lattice the bracket is the same for every j and the sum vanishes: still water is held
    only by a curved pressure, several times hydrostatic.
    """
    by_pairs, pressure = as_pairs(near)
    by_pairs(near.of(replace(near.particles, pressure=pressure)), out)


def as_pairs(near):
    """That of `symmetric`, and p - p^ [Pa]."""
    return symmetric.gradient, above_least(near)


def above_least(near):
    """p - p^ of all particles, (n,) float64 [Pa]."""
    pressure = near.particles.pressure
    least = np.empty_like(pressure)
    least_pressure(near.row, near.other, near.offset, pressure, near.loaded, least)
    return pressure - least
