"""Overtopping: particles are counted as they pass a plane, and drained if that is asked for."""

import numpy as np
import pytest
from ranks import start
from tanks import csv_rows, make_case

from mpslab import Simulation, load_case
from mpslab.core.keys import CaseError
from mpslab.run.preflight import preflight

D0 = 0.002
# A column of water that falls over a step, and back from the far wall where nothing is drained.
FALL = {
    "tank.length": 0.08, "tank.depth": 0.02, "tank.height": 0.06, "time.end": 0.16,
    "tank.bed": [[0.0, 0.0], [0.03, 0.0], [0.04, 0.006], [0.08, 0.006]],
    "water": [{"from": [0.0, 0.0, 0.0], "to": [0.02, 0.0, 0.036]}], "output.gauge_interval": 0.01,
}  # fmt: skip
PLANES = [{"name": "edge", "x": 0.045}, {"name": "far", "x": 0.066}]
DRAINED = [PLANES[0], {**PLANES[1], "drain": True}]


def run_of(planes, **changes):
    run = Simulation(make_case({**FALL, "overtopping": planes, **changes}))
    run.at = int(np.count_nonzero(run.particles.fluid))
    return run.run()


def beyond(run, x):
    return int(np.count_nonzero(run.particles.fluid & (run.particles.position[:, 0] > x)))


def counted(run, name):
    """Particles that have passed, onwards and back, by the last row."""
    row = run.table("overtopping")[-1]
    size = D0**run.case.dim
    return [row[f"{name} {way}"] / size for way in ("onwards", "back")]


def test_what_has_passed_less_what_came_back_is_what_is_beyond():
    """Of water that runs against the end wall, and back."""
    stream = {"time.end": 0.15, "initial.type": "stream", "initial.speed": 0.2}
    planes = [{"name": "a", "x": 0.019}, {"name": "b", "x": 0.031}]
    run = Simulation(make_case({**stream, "overtopping": planes}))
    before = [beyond(run, plane["x"]) for plane in planes]
    run.run()
    for plane, first in zip(planes, before, strict=True):
        onwards, back = counted(run, plane["name"])
        assert min(onwards, back) > 4.0
        assert onwards - back == pytest.approx(beyond(run, plane["x"]) - first, abs=1e-6)


@pytest.mark.parametrize("width", [0.0, 0.012])
def test_what_a_plane_drains_is_what_is_missing_in_front_of_it(width):
    water = [{"from": [0.0, 0.0, 0.0], "to": [0.02, width, 0.036]}]
    changes = {"tank.width": width, "tank.periodic": width > 0.0, "water": water,
               "time.end": 0.12 if width else 0.16, "output.gauge_interval": 0.0}  # fmt: skip
    run = run_of(DRAINED, **changes)
    onwards, back = counted(run, "far")
    assert onwards > 10
    assert back == 0.0
    assert beyond(run, 0.066) == 0
    assert onwards == pytest.approx(run.at - np.count_nonzero(run.particles.fluid), abs=1e-6)
    passed, returned = counted(run, "edge")
    assert passed - returned == pytest.approx(onwards + beyond(run, 0.045), abs=1e-6)


def test_drained_water_is_in_the_ledger_and_is_not_lost():
    run = run_of(DRAINED, **{"output.gauge_interval": 0.0})
    lost = run.table("lost")
    assert set(lost["reason"]) == {"drained by far"}
    assert (lost["x"] > 0.066).all()
    assert len(lost) == round(counted(run, "far")[0])
    assert run.lost == 0
    assert (run.steps["lost"] == 0).all()
    assert run.outcome == "finished"


def test_rows_come_at_the_interval_of_the_gauges_and_count_all_steps():
    coarse, fine = run_of(PLANES), run_of(PLANES, **{"output.gauge_interval": 0.0})
    rows, steps = coarse.table("overtopping"), fine.table("overtopping")
    assert len(rows) == 17
    assert len(steps) == len(fine.steps) + 1
    at = np.searchsorted(steps["time"], rows["time"])
    for name in ("edge onwards", "edge back", "far onwards"):
        np.testing.assert_array_equal(rows[name], steps[name][at])


def test_layer_and_speed_are_those_of_a_stream():
    stream = {"tank.bed": [[0.0, 0.0], [0.08, 0.0]], "initial.type": "stream", "initial.speed": 0.2,
              "water": [{"from": [0.0, 0.0, 0.0], "to": [0.06, 0.0, 0.02]}]}  # fmt: skip
    run = Simulation(make_case({**FALL, **stream, "overtopping": [{"name": "in", "x": 0.03}]}))
    (row,) = run.table("overtopping")
    assert row["in layer"] == pytest.approx(0.02, rel=0.01)
    assert row["in speed"] == pytest.approx(0.2)


def test_counts_are_the_same_on_several_ranks():
    planes = [{"name": "edge", "x": 0.0205}, {"name": "far", "x": 0.022, "drain": True}]
    changes = {**FALL, "tank.length": 0.16, "overtopping": planes, "parallel.rebalance_every": 7,
               "tank.bed": [[0.0, 0.0], [0.01, 0.0], [0.16, 0.03]],
               "runup": [{"name": "edge"}], "time.end": 0.024, "time.start": 8e-4,
               "output.gauge_interval": 0.0}  # fmt: skip
    one = Simulation(make_case(changes)).run()
    (first, second) = start("shore_series", 2, changes)
    assert repr(first) == repr(second), "NaN is as good as NaN"
    mine = {name: one.table(name).tolist() for name in ("overtopping", "runup")}
    assert repr(first) == repr({name: [list(row) for row in rows] for name, rows in mine.items()})
    assert one.table("overtopping")["far onwards"][-1] > 0.0


def test_a_run_that_goes_on_counts_on(tmp_path):
    changes = {**FALL, "overtopping": DRAINED, "output.checkpoint": 0.05}
    whole = Simulation(make_case(changes), tmp_path / "whole").run()
    Simulation(make_case(changes), tmp_path / "part").run(until=0.13)
    resumed = Simulation.resume(tmp_path / "part").run()
    for name in ("overtopping", "lost", "steps"):
        one, other = (csv_rows(tmp_path / folder / f"{name}.csv") for folder in ("whole", "part"))
        assert one == other
    assert np.array_equal(whole.particles.position, resumed.particles.position)


def test_a_layer_that_will_be_too_thin_is_told_before_the_run():
    thin = preflight(load_case("overtopping", {"particles.spacing": 0.004})).warnings
    assert any("layer on the crest would be about 2.4 spacings" in warning for warning in thin)
    assert preflight(load_case("overtopping", {"particles.spacing": 0.002})).warnings == []


@pytest.mark.parametrize(
    ("planes", "changes", "words"),
    [
        ([{"name": "a", "x": 0.09}], {}, "overtopping.0.x = 0.09: must be from 0.004 to 0.078 m"),
        ([{"name": "a", "x": 0.001}], {}, "overtopping.0.x = 0.001"),
        ([{"name": "a", "x": 0.01, "drain": True}], {}, "behind all water of the start"),
        ([{"name": "a", "x": 0.05, "drain": True}], {"water": []}, "behind all water of the start"),
        (PLANES[:1] * 2, {}, "overtopping.1.name = 'edge'"),
    ],
)
def test_a_plane_that_nothing_can_pass_is_refused(planes, changes, words):
    with pytest.raises(CaseError) as caught:
        make_case({**FALL, **changes, "overtopping": planes})
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
