"""Pressure gradient of the Corrected MPS method (CMPS)."""

from dataclasses import replace

from mpslab.models.gradients import symmetric
from mpslab.models.gradients._pairs import least

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(near, out):
    """<grad p>_i = (Ds/n0) sum_j ((p_i + p_j) - (p^_i + p^_j)) r_ij w / r^2.

    Equation (4) of the paper, with the square that its print lacks: the pair force is equal and
    opposite.  It is that of `symmetric` with p - p^ in place of p.  In a linear pressure on a
    regular lattice the bracket is the same for every j and the sum vanishes: still water is held
    only by a curved pressure, several times hydrostatic.
    """
    by_pairs, pressure = as_pairs(near)
    by_pairs(near.of(replace(near.particles, pressure=pressure)), out)


def as_pairs(near):
    """The gradient `symmetric`, and p - p^ [Pa]."""
    return symmetric.gradient, near.particles.pressure - least(near)
