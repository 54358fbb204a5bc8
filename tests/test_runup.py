"""Run-up: the thickness of water on a slope, its tip, and what a run reads."""

import numpy as np
import pytest
from tanks import make_case

from mpslab import Simulation
from mpslab.core import bed as beds
from mpslab.core import runup
from mpslab.core.keys import CaseError

D0 = 0.002
BED = ((0.0, 0.0), (0.02, 0.0), (0.08, 0.03), (0.1, 0.03))
SLOPE = {
    "tank.length": 0.1, "tank.depth": 0.02, "tank.bed": [list(p) for p in BED],
    "runup": [{"name": "edge"}, {"name": "film", "thickness": D0}],
}  # fmt: skip
LEAN = np.sqrt(1.25)


def layer(thick, start, end, jitter=0.0):
    """Water on the slope of BED, so many spacings thick at right angles to it, (n, 3) [m]."""
    along = np.arange(start, end, D0 / LEAN)
    rows = (np.arange(thick) + 0.5) * D0
    x, above = (a.ravel() for a in np.meshgrid(along, rows))
    random = np.random.default_rng(3)
    position = np.zeros((len(x), 3))
    position[:, 0] = x + jitter * D0 * random.uniform(-1.0, 1.0, len(x))
    position[:, 2] = beds.elevation(BED, position[:, 0]) + above * LEAN
    return position


def tip(position, least=2.0 * D0):
    x = runup.stations(0.02, 0.1, D0)
    return runup.tip(BED, x, runup.thickness(position, BED, x, D0, least), least)


@pytest.mark.parametrize("jitter", [0.0, 0.2])
@pytest.mark.parametrize("thick", [1, 2, 3])
def test_thickness_is_that_of_the_layers(thick, jitter):
    x = runup.stations(0.02, 0.1, D0)
    found = runup.thickness(layer(thick, 0.02, 0.07, jitter), BED, x, D0, 3.0 * D0)
    inner = (x > 0.03) & (x < 0.06)
    assert found[inner].mean() == pytest.approx(thick * D0, rel=0.01)
    np.testing.assert_allclose(found[inner], thick * D0, rtol=0.35 if jitter else 0.08)
    assert found[x > 0.075].max() == 0.0


def test_the_tip_is_where_the_layer_ends():
    """Where the layer of 3 falls to 2 spacings, close to its end."""
    level, place = tip(layer(3, 0.02, 0.06))
    assert place == pytest.approx(0.06, abs=0.75 * D0)
    assert level == pytest.approx(beds.elevation(BED, place) + 2.0 * D0 * LEAN)


def test_a_thin_tongue_does_not_count():
    position = np.vstack([layer(4, 0.01, 0.05), layer(2, 0.05, 0.075)])
    assert tip(position, 3.0 * D0)[1] == pytest.approx(0.05, abs=D0)
    assert tip(position, 1.5 * D0)[1] == pytest.approx(0.075, abs=D0)


def test_water_that_does_not_hang_together_with_the_sea_does_not_count():
    position = np.vstack([layer(3, 0.02, 0.04), layer(3, 0.05, 0.06)])
    assert tip(position)[1] == pytest.approx(0.04, abs=D0)


def test_a_jet_over_the_dry_slope_does_not_count():
    jet = layer(3, 0.04, 0.07) + np.array([0.0, 0.0, 4.0 * D0])
    assert tip(np.vstack([layer(3, 0.02, 0.04), jet]))[1] == pytest.approx(0.04, abs=D0)


def test_a_dry_foot_has_no_tip():
    assert np.isnan(tip(layer(3, 0.05, 0.06))).all()


def test_water_over_the_crest_reads_its_end():
    full = np.vstack([layer(3, 0.02, 0.1)])
    level, place = tip(full)
    assert place == pytest.approx(0.1, abs=D0)
    assert level == pytest.approx(0.03 + 2.0 * D0, abs=0.2 * D0)


@pytest.mark.parametrize(
    ("bed", "level", "found"),
    [(BED, 0.02, (0.02, 0.1)), (BED, 0.04, None), (((0.0, 0.0), (1.0, 0.0)), 0.1, None),
     (((0, 0.3), (1, 0.0), (2, 0.4), (3, 0.1)), 0.2, None),
     (((0, 0.1), (1, 0.0), (2, 0.1), (3, 0.4), (4, 0.1)), 0.2, (1.0, 3.0))],
)  # fmt: skip
def test_the_slope_that_a_level_meets(bed, level, found):
    assert beds.shore(bed, level) == found


@pytest.mark.parametrize("width", [0.0, 0.012])
def test_still_water_reads_its_level_whatever_the_thickness(width):
    changes = {**SLOPE, "tank.width": width, "tank.periodic": width > 0.0, "scheme.settling": 20}
    table = Simulation(make_case(changes)).table("runup")
    assert table.dtype.names == ("time", "edge level", "edge x", "film level", "film x")
    for name, thick in (("edge", 2.0 * D0), ("film", D0)):
        assert table[f"{name} level"][0] == pytest.approx(0.02, abs=0.4 * D0)
        ground = beds.elevation(BED, table[f"{name} x"][0])
        assert table[f"{name} level"][0] == pytest.approx(ground + thick * LEAN)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"tank.depth": 0.035}, "tank.bed = "),
        ({"runup": [{"name": "a"}, {"name": "a"}]}, "runup.1.name = 'a'"),
        ({"runup": [{"name": "a", "thickness": 0.001}]}, "runup.0.thickness = 0.001: must"),
        ({"tank.width": 0.012, "runup": [{"name": "a", "y": 0.02}]}, "runup.0.y = 0.02"),
    ],
)
def test_a_run_up_that_cannot_be_read_is_refused(changes, words):
    with pytest.raises(CaseError, match=words.replace(".", r"\.")) as caught:
        make_case({**SLOPE, **changes})
    assert "\n" not in str(caught.value)
