"""Run-up, overtopping and forces as the report of a sea gives them, from tables that were drawn."""

import json

import numpy as np
import pytest
from seas import sea, write_run

from mpslab import sea as command
from mpslab.analysis import shore
from mpslab.analysis.windows import Window

PERIOD, STEP, LEVEL = 0.8, 0.01, 0.08
LAST = 16.0
TIME = np.arange(0.0, LAST, STEP)
WINDOW = Window(4.0, 12.0, "")
X = np.array([0.95, 1.01, 1.07, 1.16])
CASE = {
    "tank.length": 1.62, "tank.bed": [[0.0, 0.0], [1.26, 0.0], [1.527, 0.089], [1.62, 0.089]],
    "wavemaker.type": "second_order", "wavemaker.height": 0.03, "wavemaker.period": PERIOD,
    "overtopping": [{"name": "crest", "x": 1.557, "drain": True}], "runup": [{"name": "edge"}],
    "particles.spacing": 0.004,
}  # fmt: skip
PARTICLE = 0.004**2


def flow(peaks, volumes, width=0.05):
    """Cumulative volume of pulses at times [s], (n,)."""
    steps = sum(v * np.exp(-0.5 * ((TIME - t) / width) ** 2) for t, v in
                zip(peaks, volumes, strict=True))  # fmt: skip
    total = np.cumsum(steps) * STEP / (width * np.sqrt(2.0 * np.pi))
    return np.floor(total / PARTICLE) * PARTICLE


def passing(onwards, layer=0.02, name="crest"):
    kind = [(f, float) for f in ("time", *(f"{name} {w}" for w in
                                           ("onwards", "back", "layer", "speed")))]  # fmt: skip
    table = np.zeros(len(TIME), kind)
    table["time"], table[f"{name} onwards"] = TIME, onwards
    table[f"{name} layer"], table[f"{name} speed"] = layer, 0.5
    return table


def seen(onwards, **changes):
    given = {"freeboard": 0.009, "waves": 10.0, "period": PERIOD, "particle": PARTICLE,
             "width": 1.0, "spacing": 0.004, **changes}  # fmt: skip
    return shore.overtopped("crest", passing(onwards), WINDOW, **given)


def test_events_and_discharge_come_back():
    peaks = [2.0, 4.6, 5.4, 7.0, 11.0, 13.0]
    volumes = np.array([9.0, 1.0, 2.0, 4.0, 3.0, 9.0]) * 1e-3
    found = seen(flow(peaks, volumes))
    np.testing.assert_allclose(found.events["time"], peaks[1:5], atol=0.05)
    np.testing.assert_allclose(found.events["volume"], volumes[1:5], atol=2.0 * PARTICLE)
    assert found.discharge == pytest.approx(volumes[1:5].sum() / 8.0, rel=0.01)
    assert found.largest == pytest.approx(4e-3, abs=2.0 * PARTICLE)
    assert found.share == pytest.approx(0.4)
    assert found.layer == pytest.approx(5.0)
    assert found.resolved
    assert found.quantum == pytest.approx(PARTICLE / 8.0)


def test_drops_between_waves_are_no_events():
    onwards = flow([5.0, 5.8], [2e-3, 2e-3])
    for moment in (6.6, 7.5, 9.0, 10.1):
        onwards[moment <= TIME] += PARTICLE
    found = seen(onwards)
    assert len(found.events) == 2
    assert found.discharge == pytest.approx((4e-3 + 4 * PARTICLE) / 8.0, abs=2 * PARTICLE / 8.0)


def test_what_comes_back_is_taken_off_and_the_width_divides():
    table = passing(flow([6.0], [4e-3]))
    table["crest back"] = flow([9.0], [1e-3])
    found = shore.overtopped("crest", table, WINDOW, 0.0, 10.0, PERIOD, PARTICLE, 0.5, 0.004)
    assert found.volume == pytest.approx(6e-3, rel=0.02)


def test_a_dry_crest_has_no_events():
    found = seen(np.zeros(len(TIME)))
    assert len(found.events) == found.discharge == found.largest == 0.0
    assert not found.resolved


def test_run_ups_of_an_irregular_sea_are_ranked_among_the_incident_waves():
    heights = np.random.default_rng(1).permutation(np.arange(1.0, 201.0)) * 1e-3
    time = np.arange(0.0, 200.0, 0.02)
    level = heights[time.astype(int)] * np.maximum(np.sin(2.0 * np.pi * time), -0.4)
    window = Window(0.0, 200.0, "")
    found = shore.runup("edge", time, level, window, 0.004, 200.0, 1.0, regular=False)
    high = np.sort(found.peaks["level"])
    assert len(high) > 150
    assert found.r2 == pytest.approx(high[-4])
    assert not found.fitted
    assert found.highest == high[-1]
    few = shore.runup("edge", time, level, Window(0.0, 40.0, ""), 0.004, 40.0, 1.0, regular=False)
    assert few.fitted
    assert 0.1 < few.r2 < 0.4


def test_force_of_still_water_is_taken_off():
    table = np.zeros(len(TIME), [("time", float), ("wall fx", float)])
    wave = np.where(TIME > 3.0, 20.0 * np.sin(2.0 * np.pi * TIME / PERIOD), 0.0)
    table["time"], table["wall fx"] = TIME, 49.0 + wave
    found = shore.pushed("wall", table, 2.0, WINDOW, 50.0, 0.5, None)
    assert found.still == pytest.approx(98.0)
    assert found.mean == pytest.approx(40.0, rel=0.01)
    assert found.largest == pytest.approx(40.0, rel=0.01)
    assert found.least == pytest.approx(-40.0, rel=0.01)
    assert len(found.peaks) == 10
    early = shore.pushed("wall", table, 0.1, WINDOW, 50.0, 0.5, None)
    assert early.still == pytest.approx(100.0), "too few rows: that of theory"


def write_tables(folder, period=PERIOD):
    """What stands beside the gauges in the folder of a run: run-up and overtopping."""
    rise = 0.02 * np.sin(2.0 * np.pi * TIME / period)
    edge = np.column_stack([TIME, LEVEL + rise, 1.5 + 3.0 * rise])
    peaks = np.arange(0.5, LAST, period)
    onwards = flow(peaks, np.full(len(peaks), 1e-3))
    crest = np.column_stack([TIME, onwards, 0.0 * TIME, 0.01 + 0.0 * TIME, 0.5 + 0.0 * TIME])
    heads = {
        "runup": "time [s],edge level [m],edge x [m]",
        "overtopping": "time [s],crest onwards [m3/m],crest back [m3/m],crest layer [m],"
                       "crest speed [m/s]",
    }  # fmt: skip
    for name, rows in (("runup", edge), ("overtopping", crest)):
        lines = [",".join(map(repr, map(float, row))) for row in rows]
        (folder / f"{name}.csv").write_text("\n".join([heads[name], *lines]) + "\n")


def regular(folder):
    k, w = 2.0 * np.pi / 0.65, 2.0 * np.pi / PERIOD
    level = 0.015 * np.cos(w * TIME[:, np.newaxis] - k * X)
    level += 0.003 * np.cos(w * TIME[:, np.newaxis] + k * (X - 3.0))
    run = write_run(folder, TIME, level, X, LEVEL, CASE)
    write_tables(folder)
    return run


def test_the_report_holds_discharge_against_eurotop(tmp_path, capsys):
    run = regular(tmp_path / "run")
    assert command.main([str(run)]) == 0
    out = capsys.readouterr().out
    assert "overtopping 'crest', 9 mm above still water: q = " in out
    assert "100 % of the waves" in out
    assert "Hunt's law" in out
    assert "unresolved, the layer is 2.5 spacings thick" in out
    assert "taken as an irregular sea of the same energy" in out
    files = {path.name for path in (run / "sea").iterdir()}
    assert {"runups.csv", "overtopping.csv", "runup.png", "overtopping.png", "page.html"} <= files
    assert "walls.csv" not in files
    found = json.loads((run / "sea" / "sea.json").read_text())
    (row,) = found["expected"]
    assert row["name"] == "q"
    assert row["measured"] == pytest.approx(1e-3 / PERIOD, rel=0.03)
    assert found["overtopping"][0]["freeboard [m]"] == pytest.approx(0.009)
    assert found["runup"][0]["mean [m]"] == pytest.approx(0.02, rel=0.01)
    assert found["shore window"]["start [s]"] > found["window"]["start [s]"]
    whole = (found["shore window"]["end [s]"] - found["shore window"]["start [s]"]) / PERIOD
    assert whole == pytest.approx(round(whole))
    page = (run / "sea" / "page.html").read_text()
    assert "Run-up, overtopping and walls" in page


def test_an_irregular_sea_has_both_its_run_up_and_its_discharge_expected(tmp_path):
    irregular = {"wavemaker.type": "irregular"}
    level = sea(X, len(TIME), STEP, 0.02, PERIOD, LEVEL, 0.3, 1.5, seed=2)
    run = write_run(tmp_path / "run", TIME, level, X, LEVEL, CASE | irregular)
    write_tables(run)
    found = command.look(run)
    assert [row["name"] for row in found.expected] == ["R2%", "q"]
    assert np.isfinite(found.expected["measured"]).all()
    assert found.coast.runups[0].fitted
    assert any("R2% wants 500 or more" in note for note in found.notes)


def test_a_caisson_is_held_against_goda(tmp_path, capsys):
    changes = {
        "tank.length": 0.99, "tank.height": 0.3, "runup": [], "tank.bed": [],
        "obstacle": [{"name": "caisson", "from": [0.9, 0.0, 0.0], "to": [0.99, 0.0, 0.1]}],
        "overtopping": [{"name": "crest", "x": 0.94, "drain": True}],
        "force": [{"name": "wall", "on": "caisson"}],
    }  # fmt: skip
    x = np.array([0.55, 0.6, 0.68])
    k, w = 2.0 * np.pi / 0.65, 2.0 * np.pi / PERIOD
    level = 0.01 * np.cos(w * TIME[:, np.newaxis] - k * x)
    level += 0.0095 * np.cos(w * TIME[:, np.newaxis] + k * (x - 1.8))
    run = write_run(tmp_path / "run", TIME, level, x, LEVEL, CASE | changes)
    write_tables(run)
    (run / "runup.csv").unlink()
    force = 0.5 * 9810.0 * LEVEL**2 + np.where(TIME > 1.5, 15.0 * np.sin(w * TIME), 0.0)
    rows = [f"{t!r},{f!r}" for t, f in zip(TIME.tolist(), force.tolist(), strict=True)]
    (run / "forces.csv").write_text("\n".join(["time [s],wall fx [N/m]", *rows]) + "\n")
    found = command.look(run)
    (wall,) = found.coast.pushed
    assert wall.mean == pytest.approx(15.0, rel=0.02)
    assert wall.still == pytest.approx(0.5 * 9810.0 * LEVEL**2, rel=1e-6)
    height = found.reflection.incident_height
    assert 0.5 * 9810.0 * height * LEVEL < wall.expected.force < 2.0 * 9810.0 * height * LEVEL
    assert wall.expected.reach == pytest.approx(1.5 * height)
    (row,) = found.expected
    assert row["name"] == "q"
    assert row["relation"] in ("7.1", "7.5", "7.7")
    assert command.main([str(run)]) == 0
    assert "force 'wall': 15" in capsys.readouterr().out
    assert (run / "sea" / "walls.png").exists()
