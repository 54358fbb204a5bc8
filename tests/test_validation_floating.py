"""Theory that bodies in the water are held against."""

from types import SimpleNamespace

import numpy as np
import pytest

from validation import potential_flow
from validation.cylinder_in_waves import theory as pile
from validation.data import read_columns
from validation.floating import compare, radiation
from validation.section_in_waves import compare as section_in_waves
from validation.ship_section.compare import BREADTH, MASS, outline
from validation.sphere_drop import theory as sphere
from validation.swing import first_swing


@pytest.mark.parametrize(("shape", "share"), [("cylinder", 1.0), ("sphere", 0.5)])
def test_added_mass_is_that_of_unbounded_water_where_nothing_is_near(shape, share):
    def added(side):
        tank = SimpleNamespace(length=side, width=side, depth=side)
        body = SimpleNamespace(shape=shape, radius=0.06, center=[0.5 * side] * 3)
        return compare.added(SimpleNamespace(solid=[body], tank=tank))

    assert added(6.0) == pytest.approx(share, rel=0.01)
    assert share * 1.01 < added(0.36) < share * 1.3


def test_radiation_of_a_half_immersed_cylinder_is_that_of_deep_water():
    """Multipoles after Ursell (1949): w^2 a/g, added mass and damping over w rho pi a^2/2."""
    radius, depth, gravity = 0.05, 0.6, 9.81
    w, added, damping = radiation.coefficients(radiation.cylinder(radius), depth, gravity)
    found = [np.interp([0.5, 1.0, 2.0, 4.0], w**2 * radius / gravity, part)
             for part in (added, damping)]  # fmt: skip
    found = np.array(found) / (0.5 * np.pi * radius**2)
    np.testing.assert_allclose(found[0], [0.645, 0.605, 0.727, 0.864], rtol=0.01)
    np.testing.assert_allclose(found[1], [0.812, 0.396, 0.121, 0.021], atol=0.012)


def test_heave_of_a_cylinder_in_deep_water_is_that_of_maskell_and_ursell():
    radius, gravity = 0.05, 9.81
    times = np.array([0.5, 1.0, 2.0, 3.0, 5.0, 7.0]) * np.sqrt(radius / gravity)
    mass = 500.0 * np.pi * radius**2
    found = radiation.heave(radiation.cylinder(radius), 0.6, gravity, mass, 1000.0, times)
    exact = [0.9215, 0.7037, 0.0404, -0.5115, -0.3245, 0.2970]
    np.testing.assert_allclose(found, exact, atol=0.025)


def test_radiation_of_the_ship_section_has_the_measured_added_mass():
    w, added, _ = radiation.coefficients(outline(), 1.0, 9.81)
    assert 1000.0 * np.interp(2.0 * np.pi / 1.17, w, added) / MASS == pytest.approx(0.70, abs=0.04)


def test_added_mass_of_a_hemisphere_follows_from_its_damping():
    """Relation of Kramers and Kronig, for each wave of Hulme's table but the longest."""
    times = np.linspace(0.0, 200.0, 40_001)
    memory = sphere.memory(times)
    table = np.array([sphere.K, sphere.ADDED, sphere.DAMPING]).T
    for share, added, damping in table[3:]:
        w = np.sqrt(share)
        waves = np.trapezoid(memory * np.exp(1j * w * times), times)
        assert sphere.AT_ONCE - waves.imag / w == pytest.approx(added, abs=0.003)
        assert waves.real / w == pytest.approx(damping, abs=0.002)


def test_sphere_that_is_let_go_heaves_with_the_period_of_its_mass_and_added_mass():
    times = np.linspace(0.0, 1.0, 1001)
    low = sphere.heave(0.001, 0.15, 9.81, 7.069, 1000.0, times)
    crest = times[400 + np.argmax(low[400:])]
    w = 2.0 * np.pi / crest
    added = np.interp(w * w * 0.15 / 9.81, sphere.K, sphere.ADDED)
    assert w * w * 0.15 / 9.81 == pytest.approx(1.5 / (1.0 + added), rel=0.03)
    high = sphere.heave(0.14, 0.15, 9.81, 7.069, 1000.0, times)
    assert times[400 + np.argmax(high[400:])] > 1.05 * crest  # a lifted sphere has less buoyancy


def test_force_on_a_pile_is_that_of_maccamy_and_fuchs():
    k = 2.2230  # 1.5 s in 0.5 m of water
    size, lead = pile.force(k, 0.125, 0.5)
    assert 1000.0 * 9.81 * 0.025 * size == pytest.approx(19.98, rel=2e-3)
    thin, ahead = pile.force(k, 1e-3, 0.5)
    assert thin == pytest.approx(2.0 * np.pi * 1e-6 * np.tanh(0.5 * k), rel=1e-3)  # C_M = 2
    assert (ahead, lead) == (pytest.approx(0.5 * np.pi, abs=1e-3), pytest.approx(1.510, abs=1e-3))


def test_side_walls_far_away_leave_the_force_on_a_pile_as_it_is():
    k = 2.2230
    alone = pile.force(k, 0.02, 0.5)[0]
    assert pile.force(k, 0.02, 0.5, 2.0)[0] == pytest.approx(alone, rel=0.02)


def test_standing_wave_presses_on_a_wall_as_linear_theory_says_and_in_the_mean_as_its_radiation():
    """Mean: twice S_xx = E (2 n - 1/2) of a wave of half the height (Longuet-Higgins & Stewart)."""
    k, depth, gravity = 15.0, 0.1, 9.81
    w = np.sqrt(gravity * k * np.tanh(k * depth))
    n = 0.5 * (1.0 + 2.0 * k * depth / np.sinh(2.0 * k * depth))
    for amplitude, share in ((1e-4, 1e-3), (5e-3, 0.02)):
        _, force = potential_flow.wall_force(amplitude, np.pi / k, depth, gravity, w, 2)
        linear = amplitude * np.tanh(k * depth) / k
        assert force.max() == pytest.approx(linear, rel=share)
        assert force.min() == pytest.approx(-linear, rel=share)
    assert force.mean() == pytest.approx(0.25 * amplitude**2 * (2.0 * n - 0.5), rel=0.03)


def test_long_waves_lift_a_held_section_with_their_own_height():
    """rho g B a, less what the pressure of a wave falls with depth; it has to come from below."""
    seen = [radiation.wave_force(outline(), 1.0, 9.81, period, "heave")
            for period in (1.27, 2.0, 3.0, 5.0)]  # fmt: skip
    assert np.all(np.diff(seen) > 0.0)
    assert 0.94 < seen[-1] < 0.97


@pytest.mark.parametrize("mode", ["sway", "heave"])
@pytest.mark.parametrize("period", [1.0722, 0.89709])
def test_haskinds_force_on_the_ship_section_is_near_the_measured_one(period, mode):
    table = read_columns(section_in_waves.MEASURED)
    row = table["T_s"].tolist().index(period)
    unit = 1000.0 * 9.81 * BREADTH * section_in_waves.MODEL * table["a_inc_m"][row]
    found = radiation.wave_force(outline(), 1.0, 9.81, period, mode)
    assert found == pytest.approx(table[f"F{mode}_amp_N"][row] / unit, rel=0.03)


def test_a_swing_has_its_first_trough_and_crest_between_the_rows():
    time = np.arange(0.0, 3.0, 0.013)
    swing = first_swing(time, 0.5 + 0.2 * np.exp(-0.4 * time) * np.cos(2.0 * np.pi * time), 0.03)
    late = np.arctan2(0.4, 2.0 * np.pi) / (2.0 * np.pi)  # by which the extremes come early
    low, high = 0.2 * np.cos(2.0 * np.pi * late) * np.exp(-0.4 * np.array([0.5 - late, 1.0 - late]))
    assert swing.trough == pytest.approx(0.5 - low, abs=1e-4)
    assert swing.crest == pytest.approx(0.5 + high, abs=1e-4)
    assert swing.crest_at == pytest.approx(1.0 - late, abs=1e-3)


def test_a_body_that_has_not_come_up_has_no_crest():
    time = np.linspace(0.0, 1.0, 101)
    swing = first_swing(time, -time, 0.03)
    assert np.isnan(swing.crest) and np.isnan(swing.crest_at)
