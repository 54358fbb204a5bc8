"""The run folder: nothing overwritten, and a resumed run's tables are those of a whole one."""

import csv
import json
import math
import subprocess

import numpy as np
import pytest
from tanks import add_step, open_tables

from mpslab.core import columns
from mpslab.output import provenance, run_folder, tables
from mpslab.output.run_folder import CsvTable, RunFolder

STEPS_HEADER = (
    "step,time [s],dt [s],dt_limit,iterations,residual,seconds,max_speed [m/s],"
    "kinetic_energy [J],potential_energy [J],volume [m3],piston_force [N],piston_work [J],lost"
)

PHASE_CELLS = [
    f"{phase}{part} [s/step]"
    for phase in ("ghosts", "neighbours", "operators", "assembly", "solve", "record", "rest")
    for part in ("", " communication", " waiting")
]


def step_row(step):
    """A row of steps.csv with awkward numbers."""
    return {
        "step": step,
        "time": step / 3,
        "dt": np.float64(1e-4) / 3,
        "dt_limit": "courant",
        "iterations": 40 + step,
        "residual": np.float64(1e-7) / 7,
        "seconds": 0.25,
        "max_speed": math.pi,
        "kinetic_energy": 1 / 7,
        "potential_energy": -2.5,
        "volume": np.float64(0.1) * 3,
        "piston_force": 12.5,
        "piston_work": -1 / 3,
        "lost": 0,
    }


def write_steps(folder, steps):
    for step in steps:
        time = step / 3
        add_step(folder, **step_row(step))
        folder.add_phases(step, time, {("solve", "work"): 0.1 * step, ("rest", "waiting"): 0.5})
        folder.add_rows("gauges", [(time, np.float64(time / 7), math.nan)])
        folder.add_rows("probes", [(time, 1000.0 / 3, 0.1, 0.0, time)])
        folder.add_rows("lost", [(step, time, step, time, time, time, "left, upwards")])


def rows(path):
    with path.open(newline="") as file:
        return list(csv.reader(file))


@pytest.fixture
def folder(tmp_path):
    folder = RunFolder.create(tmp_path / "run")
    open_tables(folder, ["g1", "g2"], ["p1"])
    return folder


def test_headers_are_the_promised_ones(folder):
    folder.close()
    headers = {path.stem: path.read_text() for path in folder.path.glob("*.csv")}
    assert headers == {
        "steps": STEPS_HEADER + "\n",
        "phases": "step,time [s]," + ",".join(PHASE_CELLS) + "\n",
        "gauges": "time [s],g1 [m],g2 [m]\n",
        "probes": "time [s],p1 pressure [Pa],p1 u [m/s],p1 v [m/s],p1 w [m/s]\n",
        "lost": "step,time [s],gid,x [m],y [m],z [m],reason\n",
    }


def test_numbers_come_back_with_the_same_bits(folder):
    write_steps(folder, [1])
    folder.close()
    header, row = rows(folder.path / "steps.csv")
    expected = step_row(1)
    for key, name in columns.STEP_COLUMNS.items():
        entry = row[header.index(name)]
        assert entry == expected[key] if key == "dt_limit" else float(entry) == expected[key]
    assert rows(folder.path / "gauges.csv")[1] == [repr(1 / 3), repr(1 / 3 / 7), "nan"]
    assert rows(folder.path / "lost.csv")[1][-1] == "left, upwards"


def test_a_phase_counts_its_work_its_communication_and_its_waiting(folder):
    spent = {("solve", "work"): 0.25, ("solve", "communication"): 0.5, ("rest", "waiting"): 1.0}
    folder.add_phases(20, 0.5, spent)
    folder.close()
    row = dict(zip(*rows(folder.path / "phases.csv"), strict=True))
    assert (row.pop("step"), row.pop("time [s]")) == ("20", "0.5")
    assert {name: float(cell) for name, cell in row.items() if float(cell)} == {
        "solve [s/step]": 0.75,
        "solve communication [s/step]": 0.5,
        "rest [s/step]": 1.0,
        "rest waiting [s/step]": 1.0,
    }


def test_resumed_tables_are_those_of_an_uninterrupted_run(folder, tmp_path):
    write_steps(folder, range(1, 11))
    folder.close()
    broken = RunFolder.create(tmp_path / "broken")
    open_tables(broken, ["g1", "g2"], ["p1"])
    write_steps(broken, range(1, 8))
    broken.close()
    for path in broken.path.glob("*.csv"):  # a kill amid the row of step 12, or of 1.2 s
        path.write_text(path.read_text() + "1")
    resumed = RunFolder(broken.path)
    open_tables(resumed, ["g1", "g2"], ["p1"], step=5, time=5 / 3)
    write_steps(resumed, range(6, 11))
    resumed.close()
    for name in ("steps", "phases", "gauges", "probes", "lost"):
        whole, pieces = ((f.path / f"{name}.csv").read_bytes() for f in (folder, resumed))
        assert pieces == whole


def test_a_reader_leaves_out_a_row_that_has_no_end_wherever_it_is_cut(folder):
    write_steps(folder, range(1, 4))
    folder.close()
    for name in ("steps", "gauges", "probes", "lost"):
        path = folder.path / f"{name}.csv"
        whole, text = tables.read_table(path), path.read_text()
        ends = [k + 1 for k, letter in enumerate(text) if letter == "\n"]
        for cut in range(len(text)):
            path.write_text(text[:cut])
            count = max(sum(end <= cut for end in ends) - 1, 0)
            found = tables.read_table(path)
            assert set(found) == (set(whole) if count else set())
            for column, entries in found.items():
                np.testing.assert_array_equal(entries, whole[column][:count])


def test_resumed_table_with_other_columns_is_refused(tmp_path):
    CsvTable(tmp_path / "gauges.csv", ["time [s]", "g1 [m]"]).close()
    with pytest.raises(ValueError, match="g2"):
        CsvTable(tmp_path / "gauges.csv", ["time [s]", "g2 [m]"], last=1.0)
    assert rows(tmp_path / "gauges.csv") == [["time [s]", "g1 [m]"]]


def test_row_of_wrong_length_is_refused(tmp_path):
    table = CsvTable(tmp_path / "t.csv", ["a", "b"])
    with pytest.raises(ValueError, match="3 entries for 2 columns"):
        table.append([1, 2, 3])


def test_rows_are_on_disk_after_a_second_or_a_flush(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(tables, "monotonic", lambda: clock[0])
    table = CsvTable(tmp_path / "t.csv", ["a"])
    table.append([1])
    assert rows(table.path) == [["a"]]
    clock[0] = 1.0
    table.append([2])
    assert rows(table.path) == [["a"], ["1"], ["2"]]
    table.append([3])
    assert len(rows(table.path)) == 3
    table.flush()
    assert len(rows(table.path)) == 4


def bad_file(tmp_path):
    path = tmp_path / "file"
    path.write_text("mine")
    return path, "is a file"


def bad_non_empty(tmp_path):
    path = tmp_path / "full"
    path.mkdir()
    (path / "steps.csv").write_text("mine")
    return path, "is not empty"


def bad_unwritable(tmp_path):
    path = tmp_path / "file"
    path.write_text("mine")
    return path / "run", "cannot be written"


@pytest.mark.parametrize("make", [bad_file, bad_non_empty, bad_unwritable])
def test_unfit_folder_is_refused_and_left_as_it_was(tmp_path, make):
    path, said = make(tmp_path)
    before = {p: p.is_file() and p.read_bytes() for p in tmp_path.rglob("*")}
    with pytest.raises(ValueError, match=said) as caught:
        RunFolder.create(path)
    message = str(caught.value)
    assert message.startswith(f"--out: '{path}'")
    assert "allowed" in message
    assert "\n" not in message
    assert {p: p.is_file() and p.read_bytes() for p in tmp_path.rglob("*")} == before


def test_empty_folder_is_taken(tmp_path):
    RunFolder.create(tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("missing", ["case.toml", "checkpoint.h5"])
def test_folder_without_a_run_cannot_be_resumed(tmp_path, missing):
    for name in {"case.toml", "checkpoint.h5"} - {missing}:
        (tmp_path / name).touch()
    with pytest.raises(ValueError, match=f"holds no {missing}") as caught:
        RunFolder.reopen(tmp_path)
    assert str(tmp_path) in str(caught.value)


def test_record_of_the_run(folder):
    folder.write_run("running", {"fluid": np.int64(10)}, {"solve": 1.23456})
    assert json.loads(folder.run.read_text())["ended"] is None
    folder.write_run("stopped", {"fluid": 9}, {}, "not a number at step 3")
    record = json.loads(folder.run.read_text())
    assert record["versions"]["numpy"] == np.__version__
    assert record["machine"]["cores"] >= 1
    assert record["machine"]["cpu"]
    assert record["particles"] == {"fluid": 9}
    assert (record["outcome"], record["reason"]) == ("stopped", "not a number at step 3")
    assert record["started"] <= record["ended"]
    assert record["resumed"] == 0


def test_versions_and_commit_are_asked_for_by_who_writes_the_record_only(tmp_path, monkeypatch):
    """Other ranks know the folder as well, and must start no git."""
    asked = []
    monkeypatch.setattr(run_folder, "environment", lambda: asked.append(1) or {})
    folder = RunFolder.create(tmp_path / "run")
    RunFolder(tmp_path / "run")
    assert asked == []
    folder.write_run("running", {}, {})
    assert asked == [1]


def test_record_of_a_resumed_run_adds_up(folder):
    folder.write_case('name = "x"\n')
    folder.checkpoint.touch()
    folder.write_run("interrupted", {}, {})
    earlier = json.loads(folder.run.read_text()) | {"wall_time [s]": 1000.0}
    folder.run.write_text(json.dumps(earlier | {"started": "2020-01-01T00:00:00+00:00"}))
    folder.close()
    RunFolder.reopen(folder.path).write_run("finished", {}, {})
    record = json.loads(folder.run.read_text())
    assert record["started"].startswith("2020")
    assert record["wall_time [s]"] >= 1000.0
    assert record["resumed"] == 1


def test_damaged_record_does_not_hinder_a_resume(folder):
    folder.write_case("")
    folder.checkpoint.touch()
    folder.run.write_text("{")
    folder.close()
    RunFolder.reopen(folder.path).write_run("finished", {}, {})
    assert json.loads(folder.run.read_text())["resumed"] == 1


def git(folder, *arguments):
    subprocess.run(
        ["git", "-c", "user.name=n", "-c", "user.email=e@x", "-C", folder, *arguments],
        check=True,
        capture_output=True,
    )


def test_commit_is_that_of_the_package_and_of_no_other_project(tmp_path):
    package = tmp_path / "lib"
    package.mkdir()
    (package / "a.py").write_text("1")
    assert provenance._commit(package) is None
    git(tmp_path, "init")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-m", "m")
    assert provenance._commit(package) is None
    commit = provenance._commit(tmp_path)
    assert len(commit) == 40
    (package / "a.py").write_text("2")
    assert provenance._commit(tmp_path) == commit + "-dirty"
