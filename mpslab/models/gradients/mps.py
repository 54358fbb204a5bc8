"""Pressure gradient of the original MPS method."""

from mpslab.models.gradients._pairs import by_pairs, least

CONSERVES_MOMENTUM = False
EXACT_FOR_LINEAR = False


def gradient(near, out):
    """<grad p>_i = (Ds/n0) sum_j (p_j - p^_i) r_ij w / r^2 (equations 2 and 3 of the paper)."""
    by_pairs(near, -least(near), out)
