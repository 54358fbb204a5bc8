"""A folder has one run at a time: the second is refused at once, and nothing is touched."""

import csv
import errno
import gc
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from ranks import SMALL, TIMEOUT, environment, tank
from tanks import make_case

from mpslab import cases, measures
from mpslab import tank as command_line
from mpslab.output import lock
from mpslab.output.lock import FolderLock, InUse
from mpslab.output.run_folder import RunFolder
from mpslab.simulation import Simulation

QUICK = {"output.checkpoint": 0.002, "output.interval": 0.002, "time.end": 0.01}
SLOW = {**QUICK, "time.end": 30.0}


def in_child(act, then=None):
    """A forked process that does something and then waits to be killed, and what it found.

    If the act gives nothing it does not wait, but does what comes then.
    """
    reader, writer = os.pipe()
    number = os.fork()
    if number == 0:
        try:
            kept = act()
            os.write(writer, b"done")
            while kept:
                time.sleep(1.0)
            if then:
                then()
        except ValueError as error:
            os.write(writer, str(error).encode())
        finally:
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb", buffering=0) as pipe:
        return number, pipe.read(1000).decode()


def end(number):
    os.kill(number, signal.SIGKILL)
    os.waitpid(number, 0)


def test_a_held_folder_is_refused_to_all_and_the_holder_is_named(tmp_path):
    held = FolderLock(tmp_path)
    said = rf"in use by process {os.getpid()} on .+ since 20\d\d-.+"
    with pytest.raises(InUse, match=said):
        FolderLock(tmp_path)
    number, found = in_child(lambda: FolderLock(tmp_path))
    os.waitpid(number, 0)
    assert f"process {os.getpid()} " in found
    held.release()
    held.release()
    assert list(tmp_path.iterdir()) == []
    FolderLock(tmp_path)


def test_a_lock_that_is_forgotten_is_released(tmp_path):
    held = FolderLock(tmp_path)
    del held
    gc.collect()
    FolderLock(tmp_path)


def test_a_kill_frees_the_folder(tmp_path):
    number, found = in_child(lambda: FolderLock(tmp_path))
    assert found == "done"
    with pytest.raises(InUse, match=f"process {number} "):
        FolderLock(tmp_path)
    end(number)
    assert [p.name for p in tmp_path.iterdir()] == [lock.NAME]
    held = FolderLock(tmp_path)
    assert f"process {os.getpid()} " in (tmp_path / lock.NAME).read_text()
    held.release()


def test_a_fork_does_not_end_the_lock_of_its_parent(tmp_path):
    held = FolderLock(tmp_path)
    number, _ = in_child(held.release)
    os.waitpid(number, 0)
    with pytest.raises(InUse):
        FolderLock(tmp_path)


def test_a_lock_in_a_folder_made_anew_is_not_removed_by_the_earlier_holder(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    earlier = FolderLock(folder)
    (folder / lock.NAME).unlink()
    later = FolderLock(folder)
    earlier.release()
    with pytest.raises(InUse):
        FolderLock(folder)
    later.release()


def test_a_file_system_without_locks_is_said_and_no_hindrance(tmp_path, monkeypatch):
    def unknown(*arguments):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(lock.fcntl, "flock", unknown)
    with pytest.warns(UserWarning, match=r"not held against other runs, .+ \(No locks available\)"):
        held = FolderLock(tmp_path)
    held.release()
    assert list(tmp_path.iterdir()) == []


def test_many_processes_that_take_turns_never_meet(tmp_path):
    (tmp_path / "count").write_text("0")
    folder = tmp_path / "run"
    folder.mkdir()

    def count():
        done = 0
        while done < 20:
            try:
                held = FolderLock(folder)
            except InUse:
                continue
            number = int((tmp_path / "count").read_text())
            (tmp_path / "count").write_text(str(number + 1))
            held.release()
            done += 1

    children = [in_child(lambda: None, count) for _ in range(4)]
    for child, _ in children:
        os.waitpid(child, 0)
    assert (tmp_path / "count").read_text() == "80"


def contents(folder):
    return {path: (path.stat().st_mtime_ns, path.read_bytes())
            for path in sorted(folder.rglob("*")) if path.is_file()}  # fmt: skip


def test_a_second_run_in_a_folder_is_refused_and_touches_nothing(tmp_path, capsys):
    folder, case = tmp_path / "run", tmp_path / "case.toml"
    case.write_text(cases.dumps(make_case(QUICK)))
    first = Simulation(make_case(QUICK), folder)
    before = contents(tmp_path)
    for arguments, option in (([str(case), "--out", str(folder)], "--out"),
                              (["--resume", str(folder)], "--resume")):  # fmt: skip
        assert command_line.main(arguments) == 2
        out, error = capsys.readouterr()
        assert out == "" and error.count("\n") == 1
        assert error.startswith(f"mpslab: {option}: '{folder}' is in use by process {os.getpid()} ")
        assert "since 20" in error and "wait for that run, or stop it; allowed:" in error
    assert contents(tmp_path) == before
    first.run()
    assert lock.NAME not in os.listdir(folder)
    assert command_line.main(["--resume", str(folder), "--no-pictures"]) == 0


def test_a_script_may_go_on_with_a_folder_once_the_run_there_has_ended(tmp_path):
    first = Simulation(make_case(QUICK), tmp_path / "run").run(until=0.004)
    first.run(until=0.006)
    second = Simulation.resume(tmp_path / "run").run()
    assert second.outcome == "finished"
    before = contents(tmp_path)
    for go_on in (first.run, first.advance):
        with pytest.raises(ValueError, match="another run has gone on with it meanwhile"):
            go_on()
    assert contents(tmp_path) == before


def test_a_damaged_checkpoint_leaves_the_folder_free(tmp_path):
    Simulation(make_case(QUICK), tmp_path / "run").run()
    (tmp_path / "run/checkpoint.h5").write_bytes(b"damaged")
    with pytest.raises(ValueError, match="damaged") as first:
        Simulation.resume(tmp_path / "run")
    with pytest.raises(ValueError, match="checkpoint"):
        Simulation.resume(tmp_path / "run")
    assert first.value is not None


@pytest.mark.parametrize("out", ["new", "deep/er/new", "empty", None])
def test_a_folder_is_taken_before_the_water_is_laid_out_and_given_up_if_that_fails(
    tmp_path, monkeypatch, capsys, out
):
    seen = []

    def fail(*arguments):
        folder = tmp_path / (out or "runs/test")
        with pytest.raises(ValueError, match="in use"):
            RunFolder.create(folder)
        seen.append(folder)
        raise ValueError("particles.spacing = 1: does not fit")

    (tmp_path / "empty").mkdir()
    (tmp_path / "test.toml").write_text(cases.dumps(make_case(QUICK)))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mpslab.run.start.make_flow", fail)
    assert command_line.main(["test.toml", *(["--out", out] if out else [])]) == 2
    assert capsys.readouterr().err == "mpslab: particles.spacing = 1: does not fit\n"
    assert len(seen) == 1
    assert sorted(p.name for p in tmp_path.rglob("*")) == ["empty", "test.toml"]


def test_a_folder_that_a_kill_left_before_the_first_file_is_taken(tmp_path):
    number, _ = in_child(lambda: RunFolder.create(tmp_path / "run"))
    end(number)
    assert RunFolder.create(tmp_path / "run").path.is_dir()


def test_drafts_that_a_kill_left_are_removed_by_the_next_run(tmp_path):
    Simulation(make_case(QUICK), tmp_path / "run").run(until=0.004)
    (tmp_path / "run/checkpoint.h5.0123abcd.tmp").write_bytes(b"half")
    (tmp_path / "run/my.tmp").write_bytes(b"mine")
    Simulation.resume(tmp_path / "run").run()
    names = os.listdir(tmp_path / "run")
    assert "my.tmp" in names and "checkpoint.h5.0123abcd.tmp" not in names


def start(folder, *arguments):
    line = [sys.executable, "-m", "mpslab.tank", *arguments]
    return subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            cwd=folder, env=environment())  # fmt: skip


def statuses(processes):
    told = [process.communicate(timeout=TIMEOUT) for process in processes]
    return [process.returncode for process in processes], told


def steps_of(folder):
    with (folder / "steps.csv").open() as file:
        return [int(row["step"]) for row in csv.DictReader(file)]


def test_runs_that_start_together_have_folders_of_their_own(tmp_path):
    (tmp_path / "test.toml").write_text(cases.dumps(make_case(QUICK)))
    codes, told = statuses([start(tmp_path, "test.toml", "--no-pictures") for _ in range(2)])
    assert codes == [0, 0], told
    folders = sorted(p.name for p in (tmp_path / "runs").iterdir())
    assert folders == ["test", "test-2"]
    steps = [steps_of(tmp_path / "runs" / name) for name in folders]
    assert steps[0] == steps[1] == list(range(1, len(steps[0]) + 1))


@pytest.mark.parametrize("way", ["--out", "--resume"])
def test_of_two_that_start_together_in_one_folder_one_runs(tmp_path, way):
    (tmp_path / "test.toml").write_text(cases.dumps(make_case(QUICK)))
    arguments = ["test.toml", "--out", "run", "--no-pictures"]
    if way == "--resume":
        Simulation(make_case(QUICK), tmp_path / "run").run(until=0.002)
        arguments = ["--resume", "run", "--no-pictures"]
    codes, told = statuses([start(tmp_path, *arguments) for _ in range(2)])
    if way == "--out":
        assert sorted(codes) == [0, 2], told
        refused = told[codes.index(2)][1]
        assert refused.count("\n") == 1 and ("in use by" in refused or "not empty" in refused)
    else:  # the second may come when the first has ended, and finds nothing left to do
        assert sorted(codes) in ([0, 2], [0, 0]), told
    steps = steps_of(tmp_path / "run")
    assert steps == list(range(1, len(steps) + 1))
    assert json.loads((tmp_path / "run/run.json").read_text())["outcome"] == "finished"


def test_measures_and_pictures_of_a_running_run_do_not_disturb_it(tmp_path):
    folder = tmp_path / "run"
    looked = []

    def look(run):
        if run.step % 5 == 0:
            assert measures.main([str(folder)]) == 0
            looked.append(len((folder / "measures.csv").read_text().splitlines()))

    run = Simulation(make_case(QUICK), folder).run(progress=look)
    assert run.outcome == "finished" and looked[-1] > looked[0] > 1
    undisturbed = Simulation(make_case(QUICK)).run()
    assert np.array_equal(run.particles.position, undisturbed.particles.position)


def test_with_many_ranks_the_first_alone_holds_the_folder_and_all_are_refused(tmp_path):
    folder = tmp_path / "run"
    held = Simulation(make_case(SLOW), folder)
    for arguments in (["--resume", str(folder)], [*SMALL, "--out", str(folder)]):
        process = tank(*arguments, "--ranks", "2")
        text, _ = process.communicate(timeout=TIMEOUT)
        assert process.returncode == 2, text
        assert text.count("mpslab: ") == 1
        assert f"is in use by process {os.getpid()} " in text
    held.advance()
