"""A jet is told from spray, and a slope is measured, on surfaces that were drawn."""

import numpy as np
import pytest

from mpslab.analysis.overturning import find_crest, find_front

D0 = 0.002


def block(nx, nz, x0=0, z0=0):
    x, z = np.meshgrid(x0 + np.arange(nx) + 0.5, z0 + np.arange(nz) + 0.5, indexing="ij")
    return D0 * np.stack([x.ravel(), z.ravel()])


def crest_of(*pieces):
    x, z = np.concatenate(pieces, axis=1)
    order = np.random.default_rng(0).permutation(len(x))
    return find_crest(x[order], z[order], np.ones_like(x), D0)


def test_flat_water_has_neither_jet_nor_slope():
    crest = crest_of(block(100, 20))
    assert crest.jet == 0
    assert crest.steepness == 0.0
    assert not crest.overturns


def test_slope_is_measured_where_it_is():
    x, z = block(100, 40)
    below = z < 20 * D0 + 0.4 * np.clip(x - 60 * D0, 0, 20 * D0)
    crest = find_crest(x[below], z[below], np.ones(below.sum()), D0)
    assert crest.steepness == pytest.approx(0.4, abs=0.15)
    assert 58 * D0 < crest.x < 82 * D0


def test_of_two_slopes_the_faster_counts():
    x, z = block(100, 40)
    below = z < 20 * D0 + 8 * D0 * np.exp(-(((x / D0 - 30) / 8) ** 2))
    below |= z < 20 * D0 + 8 * D0 * np.exp(-(((x / D0 - 70) / 8) ** 2))
    for left_speed, place in ((2.0, 30), (0.5, 70)):
        speed = np.where(x < 50 * D0, left_speed, 1.0)
        crest = find_crest(x[below], z[below], speed[below], D0)
        assert crest.x == pytest.approx(place * D0, abs=12 * D0)
        assert crest.speed == max(left_speed, 1.0)


def test_jet_over_air_is_found():
    jet = block(10, 3, x0=50, z0=25)
    crest = crest_of(block(100, 20), jet)
    assert crest.jet == 30
    assert crest.overturns
    assert (crest.x, crest.z) == pytest.approx(jet.mean(axis=1), abs=D0)


def test_jet_that_has_touched_down_is_none():
    assert crest_of(block(100, 20), block(10, 3, x0=50, z0=20)).jet == 0


def test_spray_is_no_jet():
    rng = np.random.default_rng(1)
    drops = np.stack([rng.uniform(0, 100, 20), rng.uniform(24, 60, 20)]) * D0
    assert not crest_of(block(100, 20), drops).overturns


def test_disordered_water_has_no_jet():
    x, z = block(100, 20)
    rng = np.random.default_rng(2)
    jitter = rng.uniform(-0.2, 0.2, (2, len(x))) * D0
    assert find_crest(x + jitter[0], z + jitter[1], np.ones_like(x), D0).jet == 0


def test_single_particle():
    assert find_crest(np.array([0.3]), np.array([0.1]), np.array([1.0]), D0).steepness == 0.0


def front_of(*pieces, along=lambda x, z: z):
    """The front of pieces of water whose velocity grows upwards."""
    x, z = np.concatenate(pieces, axis=1)
    order = np.random.default_rng(0).permutation(len(x))
    return find_front(x[order], z[order], along(x, z)[order], D0)


HIGH_WATER = block(40, 30), block(60, 15, x0=40)


def test_a_front_that_stands_upright_over_water_is_found():
    front = front_of(*HIGH_WATER)
    assert not front.overturns
    assert (front.x, front.z) == pytest.approx((40 * D0, 30 * D0), abs=2 * D0)
    mirrored = front_of(*HIGH_WATER, along=lambda x, z: -z)
    assert mirrored is None, "it would run backwards"


def test_a_front_with_a_jet_overturns():
    front = front_of(*HIGH_WATER, block(8, 3, x0=40, z0=27))
    assert front.overturns
    assert front.x == pytest.approx(44 * D0, abs=2 * D0)


def test_a_column_that_collapses_is_no_breaker():
    assert front_of(*HIGH_WATER, along=lambda x, z: x) is None


def test_water_over_a_dry_bed_is_no_breaker():
    assert front_of(block(40, 30)) is None


def test_the_sheet_of_a_run_up_on_a_wall_is_no_breaker():
    flat, sheet = block(100, 10), block(4, 40, x0=96, z0=10)
    assert front_of(flat, sheet, along=lambda x, z: -z) is None
    hole = ~((sheet[1] > 20 * D0) & (sheet[1] < 24 * D0) & (sheet[0] < 98 * D0))
    assert front_of(flat, sheet[:, hole], along=lambda x, z: -z) is None


def test_spray_is_no_breaker():
    rng = np.random.default_rng(1)
    drops = np.stack([rng.uniform(0, 100, 20), rng.uniform(24, 60, 20)]) * D0
    assert front_of(block(100, 20), drops) is None
    assert front_of(block(100, 20), block(10, 3, x0=50, z0=30)) is None, "a drop in the air"


def test_flat_water_and_none_have_no_front():
    assert front_of(block(100, 20)) is None
    assert find_front(*np.empty((3, 0)), D0) is None
