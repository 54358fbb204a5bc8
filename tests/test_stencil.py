"""Lattice constants of the weight function."""

import numpy as np
import pytest

from mpslab.core.stencil import lattice_offsets, make_stencil

# dim, effective radius [d0], neighbours, n0, lambda0 [d0^2]; summed by independent scripts.
LATTICE = [
    (2, 2.1, 12, 6.5397, 1.3884),
    (2, 2.4, 20, 9.7747, 1.7708),
    (2, 3.1, 28, 18.9764, 2.4485),
    (2, 4.0, 44, 35.6092, 3.7071),
    (3, 1.8, 26, 8.3874, 1.4651),
    (3, 2.1, 32, 14.4186, 1.7017),
    (3, 2.4, 56, 22.8093, 2.1036),
    (3, 2.5, 80, 26.5879, 2.3018),
    (3, 3.1, 122, 54.3212, 3.2434),
    (3, 3.6, 178, 88.4466, 4.2776),
    (3, 4.0, 250, 123.9916, 5.2120),
]


@pytest.mark.parametrize(("dim", "radius", "neighbours", "n0", "lambda0"), LATTICE)
def test_lattice_constants_to_four_digits(dim, radius, neighbours, n0, lambda0):
    stencil = make_stencil(dim, 1.0, radius)
    assert stencil.n0 == pytest.approx(n0, abs=5.1e-5)
    assert stencil.lambda0 == pytest.approx(lambda0, abs=5.1e-5)


@pytest.mark.parametrize(("dim", "radius", "neighbours", "n0", "lambda0"), LATTICE)
def test_number_of_lattice_neighbours(dim, radius, neighbours, n0, lambda0):
    r = np.linalg.norm(lattice_offsets(dim, 6), axis=1)
    assert np.count_nonzero(r < radius) == neighbours


@pytest.mark.parametrize(("dim", "radius"), [(2, 2.1), (3, 2.1), (3, 3.1)])
def test_restoring_is_the_growth_of_the_lopsidedness_with_a_displacement(dim, radius):
    """Against the sum itself, for a particle moved a little along x."""
    small, places = 1e-7, lattice_offsets(dim, 6)

    def lopsided(move):
        offset = places - [move, 0.0, 0.0]
        r = np.linalg.norm(offset, axis=1)
        return np.sum(np.maximum(radius / r - 1.0, 0.0) / r**2 * offset[:, 0])

    growth = (lopsided(small) - lopsided(-small)) / (2.0 * small)
    assert make_stencil(dim, 1.0, radius).restoring == pytest.approx(growth, rel=1e-6)
    assert make_stencil(dim, 0.5, radius).restoring == pytest.approx(4.0 * growth, rel=1e-6)


def test_spacing_scales_lengths_and_leaves_the_number_density():
    unit, small = make_stencil(3, 1.0, 2.1), make_stencil(3, 0.002, 2.1)
    assert small.n0 == unit.n0
    assert small.radius == pytest.approx(2.1 * 0.002, rel=1e-15)
    assert small.lambda0 == pytest.approx(unit.lambda0 * 0.002**2, rel=1e-15)


def test_lattice_reaches_beyond_four_spacings():
    """A lattice cut at 4 d0 would give the n0 of a smaller radius without a word."""
    r = np.linalg.norm(lattice_offsets(2, 12), axis=1)
    expected = np.maximum(6.0 / r - 1.0, 0.0).sum()
    assert make_stencil(2, 1.0, 6.0).n0 == pytest.approx(expected, rel=1e-14)
