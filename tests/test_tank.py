"""The command line: exit status, one-line errors, a stop and a restart from outside."""

import json
import os
import signal
import subprocess
import sys
import time
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from mpslab import cases, tank
from mpslab.output import checkpoint

QUICK = ["hydrostatic", "--set", "particles.spacing=0.004", "--set", "scheme.settling=0"]


def command(*arguments, **options):
    return subprocess.Popen(
        [sys.executable, "-m", "mpslab.tank", *map(str, arguments)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options,
    )  # fmt: skip


def one_line_error(capsys, *arguments):
    status = tank.main([str(a) for a in arguments])
    shown = capsys.readouterr()
    assert status == 2
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    return shown.err


def test_list_and_show_cover_every_case(capsys):
    assert tank.main(["--list"]) == 0
    listed = capsys.readouterr().out
    for name in cases.names():
        assert name in listed
        assert tank.main(["--show", name]) == 0
        assert f'name = "{name}"' in capsys.readouterr().out


def test_check_tells_what_will_happen_and_writes_nothing(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert tank.main(["plunging_breaker", "--check"]) == 0
    text = capsys.readouterr().out
    for word in ("particles", "memory", "time step", "run time", "kh", "0.54", "Ursell", "101",
                 "surf similarity", "plunging", "out of range", "spacings"):  # fmt: skip
        assert word in text, word
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", cases.names())
def test_check_works_for_every_case(capsys, name):
    assert tank.main([name, "--check"]) == 0
    assert "expected steps" in capsys.readouterr().out


def test_run_writes_all_files_and_says_where_the_pictures_are(capsys, tmp_path):
    out = tmp_path / "run"
    assert tank.main([*QUICK, "--until", "0.02", "--out", str(out)]) == 0
    assert str(out / "pictures") in capsys.readouterr().out
    for name in ("case.toml", "run.json", "steps.csv", "gauges.csv", "probes.csv",
                 "particles.vtkhdf", "checkpoint.h5", "pictures/tank.png"):  # fmt: skip
        assert (out / name).stat().st_size > 0, name
    record = json.loads((out / "run.json").read_text())
    assert record["outcome"] == "finished"
    assert record["phases [s]"]["solve"] > 0


def test_default_folder_takes_the_next_free_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for _ in range(2):
        assert tank.main([*QUICK, "--until", "0.002", "--no-pictures"]) == 0
    assert sorted(p.name for p in (tmp_path / "runs").iterdir()) == ["hydrostatic", "hydrostatic-2"]


BAD = {
    "unknown case": (["tsunami"], ["tsunami", "plunging_breaker"]),
    "unknown key": (["--set", "tank.depht=1"], ["tank.depht", "tank.depth"]),
    "unknown model": (["--set", "scheme.gradient=cpms"], ["cpms", "cmps"]),
    "not key=value": (["--set", "tank.depth"], ["tank.depth"]),
    "wrong type": (["--set", "tank.depth=deep"], ["tank.depth", "deep", "number"]),
    "negative length": (["--set", "tank.length=-1"], ["tank.length", "-1", "> 0"]),
    "breaks at the maker": (["--set", "wavemaker.height=0.05"], ["wavemaker.height", "0.05"]),
    "second order out of range": (["--set", "wavemaker.type=second_order"], ["26.3"]),
    "until after the end": (["--until", "9"], ["--until", "9", "1.25"]),
    "until not a number": (["--until", "soon"], ["--until", "soon"]),
    "unknown option": (["--speed", "9"], ["--speed"]),
    "resume nothing": (["--resume", "nowhere"], ["nowhere", "case.toml"]),
    "resume with a case": (["hydrostatic", "--resume", "nowhere"], ["--resume", "CASE"]),
    "missing motion file": (
        ["--set", "wavemaker.type=file", "--set", "wavemaker.file=none.csv"],
        ["wavemaker.file", "none.csv"],
    ),
}


@pytest.mark.parametrize("arguments, words", BAD.values(), ids=BAD)
def test_bad_input_is_one_line_with_status_2_and_writes_nothing(
    capsys, tmp_path, monkeypatch, arguments, words
):
    monkeypatch.chdir(tmp_path)
    error = one_line_error(capsys, *arguments)
    for word in words:
        assert word in error
    assert list(tmp_path.iterdir()) == []


def test_folder_that_is_not_empty_is_left_alone(capsys, tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    assert "--out" in one_line_error(capsys, *QUICK, "--out", tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["notes.txt"]


def test_run_that_goes_wrong_ends_with_status_3_and_a_reason(capsys, tmp_path):
    arguments = [*QUICK, "--set", "scheme.max_iterations=2", "--out", str(tmp_path / "run")]
    assert tank.main(arguments) == 3
    error = capsys.readouterr().err
    assert "did not converge" in error and "step 1" in error and "failed.h5" in error


def test_results_that_cannot_be_written_end_the_run_with_status_3(capsys, tmp_path, monkeypatch):
    def full(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint, "write", full)
    out = tmp_path / "run"
    assert tank.main([*QUICK, "--until", "0.02", "--out", str(out)]) == 3
    error = capsys.readouterr().err
    assert f"{out}: cannot be written (No space left on device) before the first step" in error


def wait_for_step(folder, process, seconds=60.0):
    """Wait until there is a checkpoint of a later step than the start."""
    end = time.monotonic() + seconds
    path = folder / "checkpoint.h5"
    while not path.exists() or checkpoint.read(path)[1]["step"] == 0:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.02)


def go_on(folder):
    """Status of a resume that goes 0.05 s further."""
    until = checkpoint.read(folder / "checkpoint.h5")[1]["time"] + 0.05
    return tank.main(["--resume", str(folder), "--until", str(until), "--no-pictures"])


def test_interrupt_ends_cleanly_and_the_run_can_go_on(tmp_path):
    out = tmp_path / "run"
    process = command(*QUICK, "--out", out, "--set", "output.checkpoint=0.01", "--no-pictures")
    wait_for_step(out, process)
    process.send_signal(signal.SIGINT)
    text, error = process.communicate(timeout=60)
    assert process.returncode == 130, error
    assert f"--resume {out}" in text
    assert json.loads((out / "run.json").read_text())["outcome"] == "interrupted"
    time_reached = json.loads((out / "run.json").read_text())["particles"]
    assert time_reached["fluid"] > 0
    assert go_on(out) == 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_stop_before_the_first_step_is_no_error_of_the_disk(capsys, monkeypatch, number):
    """A library that is called meanwhile may make an error of its own of it."""

    def prepared(*_):
        try:
            os.kill(os.getpid(), number)
            time.sleep(1.0)
        except KeyboardInterrupt:
            raise OSError(5, "cannot read") from None

    before = signal.getsignal(number)
    monkeypatch.setattr(tank, "_prepared", prepared)
    assert tank.main([]) == 130
    assert capsys.readouterr().err == "mpslab: stopped\n"
    assert signal.getsignal(number) is before


def test_stop_that_is_lost_before_the_first_step_ends_the_run_at_it(tmp_path, monkeypatch):
    made = tank._prepared

    def prepared(*arguments):
        simulation = made(*arguments)
        try:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1.0)
        except KeyboardInterrupt:
            return simulation

    monkeypatch.setattr(tank, "_prepared", prepared)
    out = tmp_path / "run"
    assert tank.main([*QUICK, "--out", str(out), "--no-pictures"]) == 130
    assert json.loads((out / "run.json").read_text())["outcome"] == "interrupted"
    assert checkpoint.read(out / "checkpoint.h5")[1]["step"] <= 1


def test_killed_run_goes_on_from_its_last_checkpoint(tmp_path):
    out = tmp_path / "run"
    process = command(*QUICK, "--out", out, "--set", "output.checkpoint=0.01", "--no-pictures")
    wait_for_step(out, process)
    time.sleep(0.1)
    os.kill(process.pid, signal.SIGKILL)
    process.communicate(timeout=60)
    assert go_on(out) == 0
    assert json.loads((out / "run.json").read_text())["resumed"] == 1


def test_the_command_mpslab_is_the_tank_and_hands_on_its_status(capsys):
    pyproject = Path(__file__).parents[1] / "pyproject.toml"
    script = tomllib.loads(pyproject.read_text(encoding="utf-8"))["project"]["scripts"]["mpslab"]
    main = EntryPoint("mpslab", script, "console_scripts").load()
    assert main is tank.main
    assert main(["--list"]) == 0
    assert main(["no_such_case"]) == 2
