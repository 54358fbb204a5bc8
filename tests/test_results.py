"""A run is read from its folder as it is in memory, also one that goes on or was cut off."""

import json
import os
import shutil

import numpy as np
import pytest
from tanks import make_case, open_tables

import mpslab
from mpslab import sea, tank
from mpslab.analysis.pictures import draw_run
from mpslab.analysis.results import Frames, Run
from mpslab.core.particles import make_particles
from mpslab.output import journal, vtkhdf
from mpslab.output.run_folder import RunFolder
from mpslab.run.preflight import preflight
from mpslab.run.preflight_text import sections
from mpslab.simulation import Simulation

DRIVEN = {
    "wavemaker.type": "linear", "wavemaker.height": 0.006, "wavemaker.period": 0.4,
    "time.end": 0.05, "output.interval": 0.01, "output.checkpoint": 0.02,
    "gauge": [{"name": "toe", "x": 0.02}, {"name": "reason", "x": 0.03}],
    "probe": [{"name": "wall 1", "x": 0.03, "z": 0.01}],
    "parallel.rebalance_every": 5,
}  # fmt: skip
SERIES = ("steps", "gauges", "probes")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A finished run: the simulation, and its folder."""
    folder = tmp_path_factory.mktemp("made") / "run"
    return Simulation(make_case(DRIVEN), folder).run(), folder


@pytest.fixture
def copy(made, tmp_path):
    """A copy of its folder, to be spoiled."""
    return shutil.copytree(made[1], tmp_path / "copy")


def one_line(caught):
    return str(caught.value).count("\n") == 0 and len(str(caught.value)) > 0


# What is read


def test_series_are_those_of_the_simulation(made):
    simulation, folder = made
    run = mpslab.open_run(folder)
    for name in SERIES:
        read, known = getattr(run, name), getattr(simulation, name)
        assert read.dtype == known.dtype
        np.testing.assert_array_equal(read, known)
        with pytest.raises(ValueError, match="read-only"):
            read["time"][0] = 1.0
    assert {"time", "toe", "reason"} == set(run.gauges.dtype.names)
    assert np.isfinite(run.probes["wall 1 pressure"]).all()


def test_case_and_record_are_those_of_the_simulation(made):
    simulation, folder = made
    run = mpslab.open_run(str(folder))
    assert run.case == simulation.case
    assert run.tables["gauge"][0]["name"] == run.case.gauge[0].name == "toe"
    assert (run.outcome, run.reason) == ("finished", None)
    assert run.record["particles"]["fluid"] == np.count_nonzero(simulation.particles.fluid)


def test_tables_of_the_ranks_and_of_the_lost_have_names_without_units(made, tmp_path):
    run = mpslab.open_run(made[1])
    assert len(run.phases) == len(run.steps) // 5
    assert (run.phases["solve"] > run.phases["solve waiting"]).all()
    assert (len(run.decomposition), len(run.lost)) == (0, 0)
    folder = RunFolder.create(tmp_path / "ranks")
    open_tables(folder)
    lost = [(7, 1.0, 0.0, 2.0), (8, 3.0, 0.0, 4.0)]
    folder.add_rows("lost", [(3, 0.1, *one, "left, upwards") for one in lost])
    folder.open_decomposition(None, 2)
    entry = {"imbalance_before": 1.5, "imbalance_after": 1.1, "migrated": 4, "ghosts": 11}
    for step, ranks in ((20, 2), (40, 3)):
        lists = {name: [step + rank for rank in range(ranks)]
                 for name in ("particles", "seconds", "waiting")}  # fmt: skip
        folder.add_decomposition(step=step, time=0.1 * step, **lists, **entry)
    folder.close()
    run = Run(tmp_path / "ranks")
    assert run.lost["gid"].tolist() == [7, 8] and run.lost["z"].tolist() == [2.0, 4.0]
    assert set(run.lost["reason"]) == {"left, upwards"}
    np.testing.assert_array_equal(run.decomposition["particles"], [[20, 21, np.nan], [40, 41, 42]])
    assert run.decomposition["imbalance_after"].tolist() == [1.1, 1.1]


def test_frames_are_read_by_number_by_slice_and_by_time(made):
    simulation, folder = made
    frames = mpslab.open_run(folder).frames
    assert len(frames) == len(frames.times) == 6
    assert [frame.time for frame in frames] == frames.times.tolist()
    last = frames[-1]
    assert last.time == frames[5].time == frames.at(9.0).time == frames[np.int64(5)].time
    assert frames.at(0.0211).time == min(frames.times, key=lambda time: abs(time - 0.0211))
    part = frames[1::2]
    assert part.times.tolist() == frames.times[1::2].tolist()
    assert [frame.time for frame in part] == part.times.tolist()
    assert part[-1].time == frames[5].time and part.at(0.0).time == frames[1].time
    shape = (len(last.kind), 3)
    assert last.position.shape == last.velocity.shape == shape and last.pressure.shape == shape[:1]
    assert set(last) == {"position", *simulation.case.output.fields, "kind", "body"}
    assert last.fluid.sum() == np.count_nonzero(simulation.particles.fluid)
    water = last.position[last.fluid]
    assert (water[:, 2] > 0.0).all() and water[:, 2].max() < 0.03


def test_a_frame_that_there_is_not_is_refused(made):
    frames = mpslab.open_run(made[1]).frames
    for number in (6, -7):
        with pytest.raises(IndexError, match=f"frame {number}: must be from -6 to 5"):
            frames[number]
    with pytest.raises(TypeError):
        frames[0.5]


def test_a_field_that_the_frames_do_not_hold_is_named(tmp_path):
    path = tmp_path / "p.vtkhdf"
    vtkhdf.ParticleSeries(path, []).append(0.0, make_particles(np.zeros((3, 3)), np.zeros(3)))
    frame = Frames(path)[0]
    assert frame.fluid.all()
    for name in ("velocity", "pressure"):
        with pytest.raises(ValueError, match=f"hold no {name}, only position, body, kind; output"):
            getattr(frame, name)


# What is no run, or lacks something


def test_a_folder_that_is_no_run_is_refused_in_one_line(tmp_path):
    (tmp_path / "case.toml").write_text("tank = \n")
    for folder in (tmp_path, tmp_path / "none", tmp_path / "case.toml"):
        with pytest.raises(ValueError, match=r"cannot be read as a case .*; allowed: ") as caught:
            mpslab.open_run(folder)
        assert one_line(caught)


def test_a_run_without_frames_is_empty_and_says_so_when_one_is_asked_for(copy):
    (copy / "particles.vtkhdf").unlink()
    for name in (*SERIES, "phases", "decomposition", "lost"):
        (copy / f"{name}.csv").unlink(missing_ok=True)
    (copy / "run.json").unlink()
    run = mpslab.open_run(copy)
    assert not run.frames and list(run.frames) == [] and len(run.frames.times) == 0
    for ask in (lambda: run.frames[0], lambda: run.frames.at(0.0), run.frames.required):
        with pytest.raises(ValueError, match=r"holds no particles\.vtkhdf with a frame") as caught:
            ask()
        assert one_line(caught)
    assert (run.outcome, run.reason, run.preflight) == (None, None, {})
    assert run.gauges.dtype.names == ("time", "toe", "reason")
    assert run.probes.dtype.names[1:3] == ("wall 1 pressure", "wall 1 u")
    for name in (*SERIES, "phases", "decomposition", "lost"):
        series = getattr(run, name)
        assert len(series) == 0 and len(series["time"]) == 0


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 0.999])
def test_frames_that_are_damaged_are_refused_in_one_line(copy, share):
    path = copy / "particles.vtkhdf"
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    with pytest.raises(ValueError, match=r"particles\.vtkhdf") as caught:
        list(mpslab.open_run(copy).frames)
    assert one_line(caught)


def test_tables_and_records_that_are_damaged_are_refused_in_one_line(copy):
    (copy / "run.json").write_text('{"outcome": ')
    (copy / "steps.csv").write_text("step,time [s]\n1,0.1\n2\n")
    (copy / "gauges.csv").write_text("time [s],toe [m]\n0.0,high\n")
    run = mpslab.open_run(copy)
    for name, file in (("outcome", "run.json"), ("steps", "steps.csv"), ("gauges", "gauges.csv")):
        with pytest.raises(ValueError, match=f"{file}': cannot be read") as caught:
            getattr(run, name)
        assert one_line(caught)


@pytest.mark.parametrize(
    ("spoil", "why"),
    [
        (lambda content: b"\xff\xfe" + content, "codec can't decode byte"),
        (lambda content: content.decode().encode("utf-16"), "codec can't decode byte"),
        (lambda content: content + b"1" * 200_000 + b"\n", "field larger than"),
        (lambda content: content.replace(b"toe", b"other"), "case.toml differ: other, toe"),
        (lambda content: content.replace(b"time", b"tome"), "one of them be time or step"),
        (lambda content: content.replace(b"toe", b"time"), "headings must differ"),
    ],
)
def test_gauges_that_are_damaged_are_named_by_all_that_read_them(copy, spoil, why, capsys):
    path = copy / "gauges.csv"
    path.write_bytes(spoil(path.read_bytes()))
    for read in (lambda: mpslab.open_run(copy).gauges, lambda: draw_run(copy)):
        with pytest.raises(ValueError, match=r"gauges\.csv': cannot be read as a table") as caught:
            read()
        assert one_line(caught) and why in str(caught.value)
    assert sea.main([str(copy)]) == 2
    assert "gauges.csv': cannot be read as a table" in capsys.readouterr().err


# What goes on, or was cut off


@pytest.mark.parametrize("name", [*SERIES, "phases"])
def test_a_table_is_read_up_to_its_last_whole_row_wherever_it_is_cut(copy, name):
    whole, path = getattr(Run(copy), name), copy / f"{name}.csv"
    content = path.read_bytes()
    ends = [k + 1 for k, letter in enumerate(content) if letter == ord("\n")]
    for cut in range(ends[-3], len(content) + 1):
        path.write_bytes(content[:cut])
        count = sum(end <= cut for end in ends) - 1
        assert len(whole) - 2 <= count <= len(whole)
        np.testing.assert_array_equal(getattr(Run(copy), name), whole[:count])
    for cut in range(ends[0] + 1):
        path.write_bytes(content[:cut])
        assert len(getattr(Run(copy), name)) == 0
        assert getattr(Run(copy), name).dtype.names == whole.dtype.names


def test_frames_are_whole_wherever_a_kill_comes_amid_the_writing_of_one(tmp_path, monkeypatch):
    path = tmp_path / "p.vtkhdf"
    particles = make_particles(np.random.default_rng(0).random((40, 3)), np.zeros(40))
    series = vtkhdf.ParticleSeries(path, ["velocity"])
    for time in (0.0, 0.1):
        series.append(time, particles)
    before = path.read_bytes()
    monkeypatch.setattr(journal, "recover", lambda path: None)
    particles.position[:] += 1.0
    series.append(0.2, particles)
    held = journal.journal_of(path).read_bytes()
    _, pieces = journal._read_journal(journal.journal_of(path))
    # Before the journal has its name, the frame is not there.
    journal.journal_of(path).rename(tmp_path / "p.vtkhdf.journal.0123abcd.tmp")
    assert Frames(path).times.tolist() == [0.0, 0.1]
    journal.journal_of(path).write_bytes(held)
    for done in range(len(pieces) + 1):
        half = bytearray(before)
        for offset, piece in pieces[:done]:
            half[offset : offset + len(piece)] = piece
        path.write_bytes(half)
        assert Frames(path).times.tolist() == [0.0, 0.1, 0.2]
        for frame, moved in zip(Frames(path), (-1.0, -1.0, 0.0), strict=True):
            assert np.array_equal(frame.position, (particles.position + moved).astype("f4"))


def test_a_run_is_read_while_it_goes_on(tmp_path):
    simulation, seen = Simulation(make_case(DRIVEN), tmp_path / "run"), []

    def look(simulation):
        run = mpslab.open_run(tmp_path / "run")
        assert run.outcome == "running" and run.preflight["steps"] > 0
        for name in SERIES:
            read = getattr(run, name)
            np.testing.assert_array_equal(read, getattr(simulation, name)[: len(read)])
        assert run.frames[-1].time <= simulation.time
        seen.append((len(run.steps), len(run.frames)))

    simulation.run(progress=look)
    assert seen == sorted(seen)
    assert seen[-1][1] == 6 and len({steps for steps, _ in seen}) > 1


def test_what_was_asked_for_stays_until_the_run_is_opened_anew(copy):
    earlier = mpslab.open_run(copy)
    steps, times = earlier.steps, earlier.frames.times
    Simulation.resume(copy, {"time.end": 0.08}).run()
    later = mpslab.open_run(copy)
    assert earlier.steps is steps and earlier.frames.times is times
    assert len(later.steps) > len(steps) and len(later.frames) > len(times)
    np.testing.assert_array_equal(later.steps[: len(steps)]["kinetic_energy"],
                                  steps["kinetic_energy"])  # fmt: skip


def test_a_frame_that_a_resume_has_dropped_is_refused_in_one_line(copy):
    frames = mpslab.open_run(copy).frames
    assert len(frames) == 6
    vtkhdf.truncate(copy / "particles.vtkhdf", 0.02)
    assert frames[0].time == 0.0
    with pytest.raises(ValueError, match="is there no more") as caught:
        frames[-1]
    assert one_line(caught)


def test_a_run_that_was_killed_is_read_as_far_as_it_came(tmp_path):
    child = os.fork()
    if child == 0:

        def kill(simulation):
            if simulation.time > 0.035:
                os._exit(9)

        Simulation(make_case(DRIVEN), tmp_path / "run").run(progress=kill)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 9
    run = mpslab.open_run(tmp_path / "run")
    assert run.outcome == "running"
    assert len(run.frames) == 4 and run.frames[-1].fluid.any()
    # Rows are on the disk up to the checkpoint at 0.02 s, or to the last second.
    assert 0.02 < run.steps["time"][-1] <= 0.04
    assert len(run.gauges) > 1


# The preflight in run.json


def test_the_preflight_is_that_of_check_whatever_starts_the_run(made, tmp_path):
    run = mpslab.open_run(made[1])
    assert run.preflight == preflight(run.case).findings
    assert sections(run.preflight) == preflight(make_case(DRIVEN)).sections
    changes = {"time.end": 0.002, "scheme.settling": 0}
    settings = [f"--set={key}={value}" for key, value in changes.items()]
    out = tmp_path / "run"
    assert tank.main(["hydrostatic", "--out", str(out), "--no-pictures", *settings]) == 0
    case = mpslab.load_case("hydrostatic", changes)
    assert mpslab.open_run(out).preflight == preflight(case).findings


def test_a_run_that_goes_on_keeps_its_preflight_but_for_what_has_changed(copy):
    before = mpslab.open_run(copy).preflight
    Simulation.resume(copy).run()
    assert mpslab.open_run(copy).preflight == before
    Simulation.resume(copy, {"time.end": 0.06}).run()
    after = mpslab.open_run(copy).preflight
    assert after["end [s]"] == 0.06 and after["steps"] > before["steps"]
    assert after["particles"] == before["particles"]


def test_a_run_that_check_refuses_says_so(tmp_path):
    case = make_case({"time.end": 0.001, "output.interval": 1e-13})
    with pytest.raises(ValueError, match="interval") as caught:
        preflight(case)
    Simulation(case, tmp_path / "run").run()
    record = json.loads((tmp_path / "run" / "run.json").read_text())
    assert record["preflight"] == {"refused": str(caught.value)}


def test_resume_names_a_table_that_is_damaged(copy):
    path = copy / "gauges.csv"
    path.write_bytes(b"\xff" + path.read_bytes())
    with pytest.raises(ValueError, match=r"gauges\.csv': cannot be read as a table") as caught:
        Simulation.resume(copy, {"time.end": 0.06})
    assert one_line(caught)
