"""Pressure gradient of CMPS with one power of the distance less, a softer pair force."""

from dataclasses import replace

from mpslab.models.gradients._pairs import by_pairs, least

CONSERVES_MOMENTUM = True
EXACT_FOR_LINEAR = False


def gradient(near, out):
    """<grad p>_i = (Ds/m0) sum_j ((p_i + p_j) - (p^_i + p^_j)) r_ij w / r.

    Equation (4) of the paper with r in place of r^2, and m0 = sum w r over the full lattice in
    place of n0 = sum w: so the dimension is that of a gradient, and the sum of p_i + p_j is exact
    on the lattice.  The printed text that we have shows r, but its factor goes with r^2
    (docs/cmps.md).
    """
    sums, pressure = as_pairs(near)
    sums(near.of(replace(near.particles, pressure=pressure)), out)


def as_pairs(near):
    """The sum with p_i + p_j in the bracket, and p - p^ [Pa]."""
    return symmetric, near.particles.pressure - least(near)


def symmetric(near, out):
    """(Ds/m0) sum_j (p_i + p_j) r_ij w / r."""
    m0 = near.stencil.first
    by_pairs(near, near.particles.pressure, out, near.stencil.dim / m0, soft=True)
