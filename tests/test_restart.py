"""Going on with a run: the same case, changed only in what may change, and openly."""

import json
import shutil

import h5py
import numpy as np
import pytest
from tanks import csv_rows

from mpslab import CaseError, Simulation, load_case, tank
from mpslab.cases import inputs
from mpslab.output import checkpoint, restart

# The piston goes back behind its place of rest only after the first end.
RECORD = "0,0\n0.1,0.004\n0.2,0.008\n0.35,-0.009\n"
END, LATER = 0.2, 0.4
CASE = {
    "tank.length": 0.16,
    "tank.depth": 0.04,
    "tank.width": 0.0,
    "particles.spacing": 0.004,
    "wavemaker.type": "file",
    "scheme.settling": 0,
    "time.end": END,
    "output.interval": 0.05,
    "output.checkpoint": 0.1,
    "gauge": [{"name": "g", "x": 0.08}],
    "probe": [{"name": "p", "x": 0.16, "z": 0.01}],
}


def make_case(folder, changes=None):
    (folder / "record.csv").write_text(RECORD)
    file = {"wavemaker.file": str(folder / "record.csv")}
    return load_case("hydrostatic", {**CASE, **file, **(changes or {})})


@pytest.fixture(scope="module")
def begun(tmp_path_factory):
    """A run that has reached its end."""
    folder = tmp_path_factory.mktemp("begun")
    Simulation(make_case(folder), folder / "run").run()
    return folder / "run"


@pytest.fixture
def run(begun, tmp_path):
    """A copy of it, elsewhere and without the file that it began with."""
    return shutil.copytree(begun, tmp_path / "moved")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run that had the later end from the start."""
    folder = tmp_path_factory.mktemp("whole")
    Simulation(make_case(folder, {"time.end": LATER}), folder / "run").run()
    return folder / "run"


def edit(run, old, new):
    """Change the text of case.toml as an editor does."""
    text = (run / "case.toml").read_text()
    assert old in text
    (run / "case.toml").write_text(text.replace(old, new))


def contents(folder):
    return {p.name: p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def assert_refused(run, *words, changes=None):
    before = contents(run)
    with pytest.raises(ValueError) as caught:
        Simulation.resume(run, changes)
    assert "\n" not in str(caught.value)
    for word in words:
        assert word in str(caught.value)
    assert contents(run) == before


def assert_same_results(one, other):
    for name in checkpoint.FIELDS:
        a, b = (checkpoint.read(f / "checkpoint.h5")[0][name] for f in (one, other))
        assert a.tobytes() == b.tobytes(), name
    for name in ("gauges.csv", "probes.csv", "lost.csv", "case.toml"):
        assert (one / name).read_text() == (other / name).read_text(), name
    assert csv_rows(one / "steps.csv") == csv_rows(other / "steps.csv")
    with h5py.File(one / "particles.vtkhdf") as a, h5py.File(other / "particles.vtkhdf") as b:
        for name in ("Steps/Values", "Points", "PointData/pressure"):
            assert np.array_equal(a[f"VTKHDF/{name}"], b[f"VTKHDF/{name}"]), name


def test_extended_run_gives_the_bits_of_one_that_had_that_end(run, whole):
    extended = Simulation.resume(run, {"time.end": LATER}).run()
    assert extended.time > LATER
    assert_same_results(run, whole)


def test_run_extended_by_hand_gives_the_same_bits(run, whole):
    edit(run, f"end = {END}", f"end = {LATER}")
    Simulation.resume(run).run()
    assert_same_results(run, whole)


def test_run_extended_from_the_command_line_gives_the_same_bits(run, whole):
    line = ["--resume", str(run), "--set", f"time.end={LATER}", "--no-pictures"]
    assert tank.main([*line, "--until", "0.3"]) == 0
    assert tank.main(["--resume", str(run), "--no-pictures"]) == 0
    assert_same_results(run, whole)


def test_change_is_kept_in_the_case_and_told_in_the_record(run):
    reached = checkpoint.read_state(run / "checkpoint.h5")
    Simulation.resume(run, {"time.end": LATER, "title": "longer"}).run(until=0.22)
    case = load_case(run / "case.toml")
    assert (case.time.end, case.title) == (LATER, "longer")
    (entry,) = json.loads((run / "run.json").read_text())["resumes"]
    assert (entry["step"], entry["time [s]"]) == (reached["step"], reached["time"])
    assert entry["date"]
    assert entry["changes"]["time.end"] == [END, LATER]
    assert set(entry["changes"]) == {"time.end", "title"}
    Simulation.resume(run).run(until=0.24)
    assert [e["changes"] != {} for e in json.loads((run / "run.json").read_text())["resumes"]] == [
        True, False,
    ]  # fmt: skip


FREE = {
    "name": "other",
    "title": "other",
    "time.end": LATER,
    "scheme.solver": "scg",
    "scheme.tolerance": 1e-6,
    "scheme.max_iterations": 500,
    "parallel.balance": "static",
    "parallel.rebalance_every": 7,
    "output.interval": 0.01,
    "output.checkpoint": 0.02,
    "output.gauge_interval": 0.01,
    "output.pictures": [0.1],
}


def test_all_that_may_change_does(run):
    resumed = Simulation.resume(run, FREE)
    case = resumed.case
    assert (case.name, case.scheme.tolerance, case.output.interval) == ("other", 1e-6, 0.01)
    resumed.run(until=0.22)
    assert restart.differences(load_case(run / "case.toml"), case) == {}


FIXED = {
    "tank.depth": (0.04, 0.036),
    "tank.width": (0.0, 0.04),
    "tank.bed": ("[[0.0, 0.0], [0.16, 0.0]]", "[[0.0, 0.0], [0.16, 0.01]]"),
    "fluid.density": (1000.0, 1025.0),
    "fluid.gravity": (9.81, 9.8),
    "wavemaker.start": (0.0, 0.1),
    "particles.spacing": (0.004, 0.005),
    "particles.seed": (0, 1),
    "scheme.gradient": ("corrected", "cmps"),
    "scheme.wall_slip": ("true", "false"),
    "time.maximum": (None, 0.001),
    "initial.mode": (1, 2),
    "gauge.0.x": (0.08, 0.1),
    "probe.0.name": ("p", "q"),
    "output.fields": ("velocity", '["velocity"]'),
}


@pytest.mark.parametrize("key", FIXED)
def test_all_else_is_refused_with_key_and_both_values(run, key):
    old, new = FIXED[key]
    changes = dict([tank.cases.parse_set(f"{key}={new}")])
    words = [f"{key} = ", "must stay", "may change", "time.end"]
    assert_refused(run, *words, str(new).strip('[]"'), str(old or ""), changes=changes)


def test_instruments_can_neither_come_nor_go(run):
    more = [*CASE["gauge"], {"name": "h", "x": 0.1}]
    assert_refused(run, "gauge.1.name = 'h'", "absent", "gauges.csv", changes={"gauge": more})
    assert_refused(run, "probe.0.name is absent", "stay 'p'", "probes.csv", changes={"probe": []})


@pytest.mark.parametrize(
    "old, new, key",
    [
        ("jitter = 0.001", "jitter = 0.002", "particles.jitter = 0.002"),
        ("depth = 0.04", "depth = 0.05", "tank.depth = 0.05"),
        ('name = "g"', 'name = "h"', "gauge.0.name"),
    ],
)
def test_edit_by_hand_is_refused_as_well(run, old, new, key):
    edit(run, old, new)
    assert_refused(run, key, "must stay")


@pytest.mark.parametrize("end", [0.1, END])
def test_end_before_the_time_reached_is_refused(run, end):
    if end != END:
        assert_refused(run, f"time.end = {end:g} s", "must be > 0.20", changes={"time.end": end})
    else:
        assert Simulation.resume(run, {"time.end": end}).run().outcome == "finished"


def test_checkpoint_that_does_not_know_its_case_is_refused(run):
    with h5py.File(run / "checkpoint.h5", "r+") as file:
        del file["state/case"]
    assert_refused(run, "earlier mpslab", "does not hold the case")


def told(capsys, *arguments):
    status = tank.main([str(a) for a in arguments])
    shown = capsys.readouterr()
    return status, shown.out + shown.err


def test_until_before_the_time_reached_is_refused(capsys, tmp_path):
    run = tmp_path / "run"
    Simulation(make_case(tmp_path), run).run(until=0.05)
    before = contents(run)
    for until in ("0.02", "0.05", "9"):
        status, text = told(capsys, "--resume", run, "--until", until)
        assert status == 2
        assert f"--until = {until} s: must be > 0.05" in text
        assert "<= time.end = 0.2 s" in text
    assert contents(run) == before


def test_run_that_has_reached_its_end_says_how_to_take_it_further(capsys, run):
    status, text = told(capsys, "--resume", run, "--no-pictures")
    assert status == 0
    assert "has reached its end, time.end = 0.2 s; --set time.end=SECONDS" in text
    assert "Done" not in text
    status, text = told(capsys, "--resume", run, "--until", "0.1")
    assert status == 2
    assert "--set time.end=SECONDS" in text


# Input files


def test_input_file_is_kept_and_the_folder_runs_anywhere(run, whole, tmp_path, monkeypatch):
    """The file it began with is not there; the copy is, and case.toml names it by itself."""
    monkeypatch.chdir(tmp_path)
    assert 'file = "wavemaker.csv" ' in (run / "case.toml").read_text()
    assert (run / "wavemaker.csv").read_text() == RECORD
    (entry,) = json.loads((run / "run.json").read_text())["inputs"]
    assert entry["key"] == "wavemaker.file"
    assert entry["origin"].endswith("record.csv")
    Simulation(load_case(run / "case.toml", {"time.end": LATER}), tmp_path / "again").run()
    assert_same_results(tmp_path / "again", whole)


def test_input_file_that_changes_after_the_start_moves_no_piston(tmp_path):
    case = make_case(tmp_path)
    started = Simulation(case, tmp_path / "run")
    (tmp_path / "record.csv").write_text("0,0\n1,0.1\n")
    started.run(until=0.05)
    resumed = Simulation.resume(tmp_path / "run")
    assert resumed.case.wavemaker.file == str(tmp_path / "run/wavemaker.csv")
    times = np.linspace(0.0, 0.2, 21)
    for t in times:
        assert resumed._flow.solids.face(t) == started._flow.solids.face(t)


def test_changed_copy_is_refused_with_both_checksums(run):
    began = json.loads((run / "run.json").read_text())["inputs"][0]["sha256"]
    (run / "wavemaker.csv").write_text("0,0\n1,0.1\n")
    now = inputs.of(load_case(run / "case.toml"))[0].sha256
    assert_refused(run, "wavemaker.csv", "wavemaker.file", "has changed", began[:12], now[:12])


def test_missing_copy_is_refused(run):
    (run / "wavemaker.csv").unlink()
    assert_refused(run, "wavemaker.csv", "record.csv", "is missing", "sha256")


def test_another_input_file_is_refused(run, tmp_path):
    (tmp_path / "other.csv").write_text(RECORD)
    changes = {"wavemaker.file": str(tmp_path / "other.csv")}
    assert_refused(run, "wavemaker.file = ", "other.csv", "must stay", changes=changes)


def test_run_in_memory_keeps_nothing(tmp_path):
    case = make_case(tmp_path)
    run = Simulation(case)
    run.advance()
    assert run.case == case
    assert [p.name for p in tmp_path.iterdir()] == ["record.csv"]


def test_piston_that_would_run_into_an_obstacle_later_is_refused(tmp_path):
    (tmp_path / "far.csv").write_text("0,0\n0.2,0.002\n0.4,0.05\n")
    box = {"from": [0.06, 0.0, 0.0], "to": [0.1, 0.0, 0.02]}
    changes = {"wavemaker.file": str(tmp_path / "far.csv"), "obstacle": [box]}
    Simulation(make_case(tmp_path, changes), tmp_path / "run").run(until=0.01)
    assert_refused(tmp_path / "run", "obstacle.0.from", changes={"time.end": LATER})


def test_case_error_of_a_change_is_that_of_the_key(run):
    with pytest.raises(CaseError, match="unknown key"):
        Simulation.resume(run, {"time.ent": 3.0})


@pytest.mark.parametrize("name", ["irregular", "focused", "bichromatic", "stream_function"])
def test_sea_goes_on_as_if_it_had_had_the_later_end(tmp_path, name):
    sea = {
        "wavemaker.type": name, "wavemaker.height": 0.004, "wavemaker.period": 0.5,
        "wavemaker.second_period": 0.4, "wavemaker.place": 0.1, "wavemaker.file": "",
        "particles.spacing": 0.008, "time.end": 0.06, "output.checkpoint": 0.03,
    }  # fmt: skip
    if name != "stream_function":
        sea["wavemaker.order"] = 2
    Simulation(make_case(tmp_path, {**sea, "time.end": 0.12}), tmp_path / "whole").run()
    Simulation(make_case(tmp_path, sea), tmp_path / "run").run()
    Simulation.resume(tmp_path / "run", {"time.end": 0.12}).run()
    assert_same_results(tmp_path / "run", tmp_path / "whole")
