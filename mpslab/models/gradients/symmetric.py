"""Symmetric pressure gradient: the sum of the two pressures."""

from mpslab.models.gradients._pairs import by_pairs

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(near, out):
    """<grad p>_i = (Ds/n0) sum_j (p_i + p_j) r_ij w / r^2: equal and opposite pair forces."""
    by_pairs(near, near.particles.pressure, out)
