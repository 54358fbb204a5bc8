"""Goda's force on an upright wall: its limits, the sum of its pressures, and Takahashi's peak."""

import numpy as np
import pytest

from mpslab.analysis.goda import Wall, load

DENSITY, GRAVITY = 1000.0, 9.81
PLAIN = Wall(depth=0.1, foot=0.1, over_berm=0.1, crest=0.02)
BERM = Wall(depth=10.0, foot=6.0, over_berm=4.0, crest=3.0, berm=12.0, slope=0.01)


@pytest.mark.parametrize("wall", [PLAIN, BERM])
def test_force_and_moment_are_those_of_the_pressure(wall):
    """Straight from the foot to still water, and from there to where it ends or the wall does."""
    height = 0.4 * wall.over_berm
    found = load(wall, height, 6.0 * wall.depth)
    z = np.linspace(-wall.foot, wall.crest, 200_001)
    knots = [-wall.foot, 0.0, found.reach]
    pressure = np.interp(z, knots, [found.p3, found.p1, 0.0])
    assert np.interp(wall.crest, knots, [found.p3, found.p1, 0.0]) == pytest.approx(found.p4)
    assert found.force == pytest.approx(np.trapezoid(pressure, z), rel=1e-6)
    lever = pressure * (z + wall.foot)
    assert found.moment == pytest.approx(np.trapezoid(lever, z), rel=1e-6)


def test_pressure_of_small_waves_is_that_of_goda_s_coefficients():
    """Long waves: alpha_1 = 1.1, alpha_3 = 1; in deep water 0.6, and little at the foot."""
    weight = DENSITY * GRAVITY * 0.001
    long = load(PLAIN, 0.001, 100.0)
    assert long.p1 == pytest.approx(1.1 * weight, rel=1e-3)
    assert long.p3 == pytest.approx(long.p1, rel=1e-4)
    short = load(PLAIN, 0.001, 0.05)
    assert short.p1 == pytest.approx(0.6 * weight, rel=1e-3)
    assert short.p3 < 1e-4 * short.p1


def test_a_wall_that_is_higher_than_the_wave_has_the_whole_of_it():
    high = Wall(depth=0.1, foot=0.1, over_berm=0.1, crest=0.5)
    found = load(high, 0.02, 0.4)
    assert found.reach == pytest.approx(0.03)
    assert found.p4 == 0.0
    low = load(PLAIN, 0.02, 0.4)
    assert low.p4 == pytest.approx(low.p1 / 3.0)
    assert low.force < found.force


def test_impulsive_pressure_peaks_over_a_high_berm_of_an_eighth_of_a_wavelength():
    """Takahashi's coefficient is H/d, at most 2, at B/L = 0.12 and (h - d)/h = 0.6."""
    worst = Wall(depth=10.0, foot=5.0, over_berm=4.0, crest=5.0, berm=12.0)
    found = load(worst, 6.0, 100.0)
    assert found.impulsive == pytest.approx(1.5)
    assert found.breaking
    assert load(worst, 12.0, 100.0).impulsive == pytest.approx(2.0)
    for other in (Wall(10.0, 5.0, 4.0, 5.0, 30.0), Wall(10.0, 8.0, 8.0, 5.0, 12.0)):
        assert load(other, 6.0, 100.0).impulsive < 1.5
    assert load(Wall(10.0, 5.0, 4.0, 5.0), 6.0, 100.0).impulsive == 0.0
