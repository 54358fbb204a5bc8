"""Relations of EurOtop 2018, against another program, limits and each other.

deltares-coastal-structures-toolbox 1.1.0 (best fit, and design: one standard deviation off) gave
the numbers; it is not needed here.
"""

import numpy as np
import pytest

from mpslab.analysis import eurotop

HEIGHT, PERIOD = 0.1, 1.4


def one_deviation(monkeypatch):
    monkeypatch.setattr(eurotop, "BAND", 1.0)


@pytest.mark.parametrize(
    ("cot", "mean", "design"), [(3.0, 0.2895373, None), (8.0, 0.1140950, 0.1210098)]
)
def test_runup_is_that_of_another_program(monkeypatch, cot, mean, design):
    one_deviation(monkeypatch)
    found = eurotop.runup(HEIGHT, PERIOD, 1.0 / cot)
    assert found.mean == pytest.approx(mean, rel=1e-6)
    if design:
        assert found.high == pytest.approx(design, rel=1e-6)


@pytest.mark.parametrize(
    ("cot", "freeboard", "mean", "design"),
    [(3.0, 0.1, 1.4089294e-3, 1.8621561e-3), (3.0, 0.2, 1.2773181e-4, 2.1217200e-4),
     (8.0, 0.1, 1.2506336e-5, 2.4735552e-5), (8.0, 0.2, 2.3212406e-9, 1.0403247e-8)],
)  # fmt: skip
def test_overtopping_of_a_slope_is_that_of_another_program(
    monkeypatch, cot, freeboard, mean, design
):
    one_deviation(monkeypatch)
    found = eurotop.overtopping_of_slope(HEIGHT, PERIOD, 1.0 / cot, freeboard)
    assert found.mean == pytest.approx(mean, rel=1e-6)
    assert found.high == pytest.approx(design, rel=1e-6)


def test_band_holds_the_mean_and_is_a_factor_of_two_to_seven_in_discharge():
    for cot, freeboard in ((3.0, 0.1), (3.0, 0.2)):
        found = eurotop.overtopping_of_slope(HEIGHT, PERIOD, 1.0 / cot, freeboard)
        assert found.low < found.mean < found.high
        assert 2.0 < found.high / found.low < 7.0


def test_steep_slope_has_a_largest_run_up():
    """xi large: 4 Hm0; gentle: 1.65 xi Hm0, without the sign that the limit has there."""
    assert eurotop.runup(0.001, 20.0, 0.5).mean == pytest.approx(0.004, rel=0.05)
    xi = eurotop.surf_similarity(1.0 / 100.0, HEIGHT, PERIOD)
    assert eurotop.runup(HEIGHT, PERIOD, 1.0 / 100.0).mean == pytest.approx(1.65 * xi * HEIGHT)


def test_relations_of_a_wall_meet_where_one_takes_over():
    """At Rc = 1.35 Hm0, and the same at both ends of zero freeboard."""
    below, above = (
        eurotop.overtopping_of_wall(HEIGHT, PERIOD, 0.15, 1.35 * HEIGHT * part).mean
        for part in (0.9999, 1.0001)
    )
    assert below == pytest.approx(above, rel=0.01)
    deep = eurotop.overtopping_of_wall(HEIGHT, PERIOD, 1.0, 0.0, foreshore=False)
    assert deep.mean == pytest.approx(0.047 * np.sqrt(9.81 * HEIGHT**3))
    assert (deep.relation, deep.doubts) == ("7.1", ())
    near = eurotop.overtopping_of_wall(HEIGHT, PERIOD, 0.3, 0.1)
    assert near.relation == "7.5"
    assert near.mean == pytest.approx(0.05 * np.sqrt(9.81 * HEIGHT**3) * np.exp(-2.78))
    breaking = eurotop.overtopping_of_wall(HEIGHT, PERIOD, 0.15, 0.1)
    assert breaking.relation == "7.7"
    assert breaking.mean > eurotop.overtopping_of_wall(HEIGHT, PERIOD, 0.3, 0.1).mean


def test_numbers_outside_of_the_tests_are_told():
    assert eurotop.runup(HEIGHT, PERIOD, 1.0 / 3.0).doubts == ()
    assert "slope 1:20" in eurotop.runup(HEIGHT, PERIOD, 0.05).doubts[0]
    steep = eurotop.runup(HEIGHT, 0.8, 1.0 / 3.0).doubts
    assert any("Hm0 / L = 0.1" in doubt for doubt in steep)
    shallow = eurotop.overtopping_of_wall(HEIGHT, PERIOD, 0.2, 0.1, foreshore=False)
    assert "depth / Hm0 = 2" in shallow.doubts[0]
    with pytest.raises(ValueError, match=r"freeboard = -0\.1 m: must be 0 or more"):
        eurotop.overtopping_of_slope(HEIGHT, PERIOD, 0.3, -0.1)


def test_oblique_waves_overtop_less_up_to_80_degrees():
    assert eurotop.obliqueness(0.0) == 1.0
    assert eurotop.obliqueness(-45.0) == pytest.approx(0.8515)
    assert eurotop.obliqueness(85.0) == eurotop.obliqueness(80.0)


def test_table_sets_measured_beside_expected():
    entries = [eurotop.runup(HEIGHT, PERIOD, 1.0 / 3.0),
               eurotop.overtopping_of_slope(HEIGHT, PERIOD, 1.0 / 3.0, 0.1)]  # fmt: skip
    rows = eurotop.table(entries, {"R2%": 0.3})
    assert list(rows["name"]) == ["R2%", "q"]
    assert list(rows["inside"]) == [True, False]
    assert np.isnan(rows["measured"][1])
    assert list(rows["unit"]) == ["m", "m2/s"]
