"""However a run ends, by an error of the caller, Ctrl-C or a full disk, its record says so."""

import errno
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from ranks import TIMEOUT, alone, environment, start
from tanks import make_case

import mpslab
from mpslab import simulation, tank, terminal
from mpslab.cases import dumps
from mpslab.output import checkpoint
from mpslab.run import record
from mpslab.simulation import Simulation

QUICK = {
    "output.checkpoint": 0.004, "output.interval": 0.002, "time.end": 0.01,
    "gauge": [{"name": "middle", "x": 0.02}], "probe": [{"name": "deep", "x": 0.02, "z": 0.005}],
}  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "run"


def told(folder):
    found = json.loads((folder / "run.json").read_text())
    assert found["ended"] is not None
    return found["outcome"], found["reason"]


@pytest.mark.parametrize(
    "until", [np.nan, np.inf, -np.inf, -1.0, "0.1", True, None, [0.1], np.float32("nan"), 0.001]
)
def test_a_time_to_stop_at_that_is_none_is_refused_with_its_range(folder, until):
    run = Simulation(make_case(QUICK), folder).run(until=0.002)
    step = run.step
    if until is None:
        assert run.run(until).time >= 0.01
        return
    with pytest.raises(ValueError, match="until") as caught:
        run.run(until=until)
    assert f"until = {until!r}: must be a number of seconds >= {run.time}" in str(caught.value)
    assert run.step == step and told(folder)[0] == "finished"


@pytest.mark.parametrize("number", [int, float, np.float64, np.float32])
def test_the_present_time_and_any_kind_of_number_are_times_to_stop_at(number):
    run = Simulation(make_case(QUICK))
    assert run.run(until=number(0)).step == 0
    assert run.run(until=run.time).step == 0
    assert run.run(until=number(1) * 0.002).time >= 0.002


def test_until_before_the_time_reached_is_refused_at_the_command_line(folder, capsys):
    Simulation(make_case(QUICK), folder).run(until=0.005)
    before = {p: p.read_bytes() for p in folder.iterdir() if p.is_file()}
    assert tank.main(["--resume", str(folder), "--until", "0.003"]) == 2
    error = capsys.readouterr().err
    assert "--until = 0.003 s: must be > 0.005" in error and "time.end = 0.01 s" in error
    assert {p: p.read_bytes() for p in folder.iterdir() if p.is_file()} == before


@pytest.mark.parametrize("error, outcome, said", [
    (KeyError("mine"), "failed", "KeyError 'mine'"),
    (KeyboardInterrupt(), "interrupted", "KeyboardInterrupt"),
    (SystemExit(4), "interrupted", "SystemExit 4"),
])  # fmt: skip
def test_what_progress_raises_ends_the_run_with_a_checkpoint_of_that_step(
    folder, error, outcome, said
):
    def stumble(run):
        if run.step == 3:
            raise error

    run = Simulation(make_case(QUICK), folder)
    with pytest.raises(type(error)) as caught:
        run.run(progress=stumble)
    assert caught.value is error
    assert told(folder) == (run.outcome, run.reason) == (outcome, said)
    assert not (folder / "failed.h5").exists()
    resumed = Simulation.resume(folder)
    assert resumed.step == 3
    resumed.run()
    assert told(folder) == ("finished", None)
    whole = Simulation(make_case(QUICK)).run()
    assert np.array_equal(resumed.particles.position, whole.particles.position)


@pytest.mark.parametrize("error, outcome", [(IndexError("fault"), "failed"),
                                            (KeyboardInterrupt(), "interrupted")])  # fmt: skip
def test_what_comes_amid_a_step_ends_the_run_and_leaves_the_last_checkpoint(
    folder, monkeypatch, error, outcome
):
    case, advance = make_case({**QUICK, "output.checkpoint": 0.001}), simulation.advance
    run = Simulation(case, folder)

    def stumble(flow, dt):
        if flow.time > 0.005:
            flow.particles.velocity += 1.0
            raise error
        return advance(flow, dt)

    with monkeypatch.context() as patch:
        patch.setattr(simulation, "advance", stumble)
        with pytest.raises(type(error)):
            run.run()
    assert told(folder)[0] == outcome
    assert type(error).__name__ in told(folder)[1]
    resumed = Simulation.resume(folder)
    assert 0.003 < resumed.time < 0.006
    whole = Simulation(case).run()
    assert np.array_equal(resumed.run().particles.position, whole.particles.position)


def full(*arguments):
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_failed_state_that_cannot_be_written_does_not_hide_the_reason(
    tmp_path, folder, monkeypatch, capsys
):
    write = checkpoint.write
    monkeypatch.setattr(record.checkpoint, "write",
                        lambda path, *what: full() if path.name == "failed.h5"
                        else write(path, *what))  # fmt: skip
    case = make_case({**QUICK, "scheme.max_iterations": 2})
    with pytest.raises(mpslab.RunFailed, match="did not converge") as caught:
        Simulation(case, folder).run()
    assert caught.value.__notes__ == [
        "The state could not be written to failed.h5 (No space left on device)"
    ]
    assert told(folder) == ("failed", str(caught.value))
    (tmp_path / "case.toml").write_text(dumps(case))
    assert tank.main([str(tmp_path / "case.toml"), "--out", str(tmp_path / "other")]) == 3
    error = capsys.readouterr().err
    assert "run stopped: pressure did not converge" in error
    assert f"{caught.value.__notes__[0]}; the last good one is in " in error
    assert told(tmp_path / "other")[0] == "failed"


def test_a_disk_without_room_for_anything_does_not_hide_the_reason(folder, monkeypatch):
    run = Simulation(make_case({**QUICK, "scheme.max_iterations": 2}), folder)
    run._record.write_run("running")
    for name in ("write_run", "flush"):
        monkeypatch.setattr(type(run.folder), name, full)
    monkeypatch.setattr(run._record, "write_run", lambda *what: None if what[0] == "running"
                        else full())  # fmt: skip
    with pytest.raises(mpslab.RunFailed, match="did not converge"):
        run.run()


def test_a_last_checkpoint_that_cannot_be_written_is_said_in_the_record(folder, monkeypatch):
    run = Simulation(make_case({**QUICK, "output.checkpoint": 1.0}), folder)
    monkeypatch.setattr(record.checkpoint, "write", full)
    with pytest.raises(OSError, match="No space left"):
        run.run()
    assert told(folder) == ("failed", "OSError [Errno 28] No space left on device")


def test_series_cost_nothing_to_look_at_and_stay_as_they_were():
    run = Simulation(make_case(QUICK))
    seen = []
    run.run(progress=lambda run: seen.append((run.steps, run.gauges, run.probes)))
    assert [len(steps) for steps, _, _ in seen] == list(range(1, run.step + 1))
    for name, k in (("steps", 0), ("gauges", 1), ("probes", 2)):
        whole = getattr(run, name)
        assert np.shares_memory(whole, getattr(run, name))
        for looked in seen:
            assert looked[k].tolist() == whole[: len(looked[k])].tolist()
    with pytest.raises(ValueError, match="read-only"):
        run.steps["time"][0] = 1.0
    assert set(run.steps["dt_limit"]) <= {"courant", "growth", "start", "maximum", "viscous"}


def test_series_are_the_same_on_all_ranks():
    changes = {**QUICK, "tank.length": 0.16, "scheme.solver": "scg"}
    (one,), (first, second) = alone("series", changes), start("series", 2, changes)
    assert first == second
    for name in ("gauges", "probes"):
        assert len(one[name]) > 1
        assert first[name] == one[name]
    assert len(first["steps"]) == len(one["steps"])


def command(*arguments, stdout, stderr=subprocess.PIPE):
    line = [sys.executable, "-m", *arguments]
    return subprocess.Popen(line, stdout=stdout, stderr=stderr, env=environment(), text=True)


@pytest.mark.parametrize("both", [False, True])
def test_a_run_whose_output_nobody_reads_goes_on_and_ends_well(tmp_path, folder, both):
    few = {**QUICK, "gauge": [], "probe": [], "output.pictures": [0.01]}
    (tmp_path / "case.toml").write_text(dumps(make_case(few)))
    reader, writer = os.pipe()
    os.close(reader)
    process = command("mpslab.tank", str(tmp_path / "case.toml"), "--out", str(folder),
                      stdout=writer, stderr=writer if both else subprocess.PIPE)  # fmt: skip
    os.close(writer)
    _, error = process.communicate(timeout=TIMEOUT)
    assert process.returncode == 0 and not error
    assert told(folder) == ("finished", None)
    assert (folder / "pictures/tank.png").exists()


def test_a_list_that_nobody_reads_ends_well():
    reader, writer = os.pipe()
    os.close(reader)
    process = command("mpslab.tank", "--list", stdout=writer)
    os.close(writer)
    assert process.communicate(timeout=TIMEOUT)[1] == ""
    assert process.returncode == 0


def test_output_to_a_disk_that_is_full_is_no_error():
    with open("/dev/full", "w") as sink, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdout", sink)
        with terminal.unbroken():
            print("lost", flush=True)
            print("lost as well")
        assert sys.stdout is sink
