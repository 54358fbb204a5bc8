"""Runs on several ranks from the command line: the same files, and no end without a word."""

import csv
import json
import os
import re
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from ranks import ROOT, SMALL, TIMEOUT, environment, tank

from mpslab import open_run
from mpslab.core.stopwatch import PHASES
from mpslab.output import checkpoint
from mpslab.parallel import communicator, launch

FILES = ("checkpoint.h5", "gauges.csv", "probes.csv", "lost.csv")
END = ["--until", "0.0235", "--no-pictures"]


def finished(*arguments):
    """Output of a command line that ends well."""
    process = tank(*arguments)
    text, _ = process.communicate(timeout=TIMEOUT)
    assert process.returncode == 0, text
    return text


def table(folder, name="steps", without=("seconds",)):
    with (folder / f"{name}.csv").open() as file:
        return [{k: v for k, v in row.items() if k not in without} for row in csv.DictReader(file)]


def series(folder):
    """What the particle series holds; frames that a resumed run drops leave gaps in the file."""
    found = {}
    with h5py.File(folder / "particles.vtkhdf") as file:
        file.visititems(lambda name, item: found.update(
            {name: item[:].tobytes()} if isinstance(item, h5py.Dataset) else {}))  # fmt: skip
    return found


def assert_same_results(one, other):
    assert series(one) == series(other)
    for name in FILES:
        assert (one / name).read_bytes() == (other / name).read_bytes(), name
    assert table(one) == table(other)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Results of the small tank on one rank."""
    folder = tmp_path_factory.mktemp("alone") / "run"
    finished(*SMALL, *END, "--out", str(folder))
    return folder


@pytest.fixture(scope="module")
def together(tmp_path_factory):
    """Results of it on two ranks, and what the run said."""
    folder = tmp_path_factory.mktemp("together") / "run"
    return folder, finished(*SMALL, *END, "--out", str(folder), "--ranks", "2")


def test_ranks_that_share_cores_nap_soon():
    cores = len(communicator.cores())
    alone = communicator.looks_before_nap(1, cores)
    assert communicator.looks_before_nap(cores, cores) == alone
    assert communicator.looks_before_nap(cores + 1, cores) < alone / 100


@pytest.mark.parametrize("share, bind", [(1, []), (2, []), (2, ["-bind-to", "core"])])
def test_two_ranks_nap_soon_only_where_both_have_one_core(share, bind):
    """However many the machine has, and where each is bound to a core of its own."""
    several = sorted(communicator.cores())[:share]
    if len(several) < share:
        pytest.skip("needs two cores")
    mpiexec, *line = launch.command(2, str(ROOT / "tests" / "ranks.py"), "looks")
    line = ["taskset", "-c", ",".join(map(str, several)), mpiexec, *bind, *line]
    done = subprocess.run(line, env=environment(), cwd=ROOT, timeout=TIMEOUT, capture_output=True)
    assert json.loads(done.stdout) == [communicator.looks_before_nap(2, share)] * 2


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks_leave_the_same_files_as_one(alone, together, tmp_path, ranks):
    found, text = together
    if ranks == 4:
        found = tmp_path / "run"
        text = finished(*SMALL, *END, "--out", str(found), "--ranks", "4")
    assert text.count("Done:") == 1
    assert f"on {ranks} ranks" in text
    assert_same_results(alone, found)
    frames = [(folder / "particles.vtkhdf").read_bytes() for folder in (alone, found)]
    assert frames[0] == frames[1]
    foretold = [open_run(folder).preflight for folder in (alone, found)]
    assert foretold[0] == foretold[1] and foretold[0]["steps"] > 0


def test_mpiexec_starts_the_same_run(alone, tmp_path):
    line = launch.command(3, "-m", "mpslab.tank", *SMALL, *END, "--out", str(tmp_path / "run"),
                          "--set", "parallel.balance=static")  # fmt: skip
    done = subprocess.run(line, env=environment(), cwd=ROOT, timeout=TIMEOUT, capture_output=True)
    assert done.returncode == 0, done.stderr
    last = [checkpoint.read(f / "checkpoint.h5")[0] for f in (alone, tmp_path / "run")]
    for name, array in last[0].items():
        assert array.tobytes() == last[1][name].tobytes(), name


def test_a_checkpoint_goes_on_with_any_number_of_ranks(alone, tmp_path):
    folder = str(tmp_path / "run")
    finished(*SMALL, "--until", "0.004", "--out", folder, "--ranks", "3")
    finished("--resume", folder, "--until", "0.009", "--ranks", "2", "--no-pictures")
    finished("--resume", folder, *END)
    assert table(tmp_path / "run") == table(alone)
    steps = [[row["step"] for row in table(f, "phases")] for f in (tmp_path / "run", alone)]
    assert steps[0] == steps[1]
    last = [checkpoint.read(f / "checkpoint.h5")[0] for f in (alone, tmp_path / "run")]
    for name, array in last[0].items():
        assert array.tobytes() == last[1][name].tobytes(), name


def test_rebalancing_is_written_down(together):
    folder, _ = together
    run = open_run(folder)
    shares = run.decomposition["particles"]
    assert shares.shape == (len(run.phases), 2)
    assert (shares.sum(axis=1) == sum(run.record["particles"].values())).all()
    rows = table(folder, "decomposition")
    assert [int(row["step"]) for row in rows] == list(range(5, int(rows[-1]["step"]) + 1, 5))
    total = len(checkpoint.read(folder / "checkpoint.h5")[0]["gid"])
    for row in rows:
        assert sum(map(int, row["particles of each rank"].split())) == total
        assert len(row["work of each rank [s]"].split()) == 2
        assert 1.0 <= float(row["imbalance after"]) <= float(row["imbalance before"]) < 1.2
        assert int(row["ghosts"]) > 0


@pytest.mark.parametrize("ranks", [1, 2])
def test_where_the_time_went_is_written_down(alone, together, ranks):
    folder = alone if ranks == 1 else together[0]
    rows, steps = table(folder, "phases"), len(table(folder))
    assert [int(row["step"]) for row in rows] == list(range(5, steps + 1, 5))
    waiting = whole = 0.0
    for row in rows:
        for phase in PHASES:
            seconds, talking, idle = (
                float(row[f"{phase}{part} [s/step]"]) for part in ("", " communication", " waiting")
            )
            assert 0.0 <= talking + idle <= seconds + 2e-7
            waiting, whole = waiting + idle, whole + seconds
    assert 0.0 < whole < 60.0
    assert waiting > 0.001 * whole if ranks == 2 else waiting < 0.05 * whole


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["--ranks", "-1"], "--ranks -1: must be a whole number >= 1"),
        (["--ranks", "2", "--set", "scheme.solver=iccg"], 'scheme.solver = "iccg": runs on one'),
        (["--ranks", "3", "--set", "parallel.balance=centroid"], "ranks = 3: must be a power of"),
        (["--ranks", "3", "--set", "particles.spacing=0.04", "--set", "tank.depth=0.2",
          "--set", "tank.length=0.2", "--set", "tank.bed=[]", "--set", "wavemaker.height=0.08",
          "--set", "gauge=[]", "--set", "probe=[]"],
         "ranks = 3: must be from 1 to 2, the number of slabs"),
    ],
)  # fmt: skip
def test_what_cannot_be_shared_out_is_refused_in_one_line(tmp_path, arguments, message):
    process = tank(*SMALL, "--out", str(tmp_path / "run"), *arguments)
    text, _ = process.communicate(timeout=TIMEOUT)
    assert process.returncode == 2, text
    assert [line for line in text.splitlines() if message in line and "mpslab: " in line], text
    assert text.count("mpslab: ") == 1
    assert not (tmp_path / "run").exists()


def run_until_checkpoint(folder, ranks=2):
    """A run that has left a checkpoint, and the numbers of its ranks' processes."""
    process = tank(*SMALL, "--out", str(folder), "--ranks", str(ranks))
    first, *then = (process.stdout.readline() for _ in range(3))
    assert "killed, go on with" in then[0]  # said now: a rank that is killed says nothing
    assert then[1] == f"  python -m mpslab.tank --resume {folder}\n"
    numbers = [int(number) for number in re.findall(r"\d+: (\d+)", first)]
    assert len(numbers) == ranks
    end = time.monotonic() + 60.0
    while last_step(folder) == 0 and time.monotonic() < end:
        time.sleep(0.05)
    return process, numbers


def last_step(folder):
    """Step of the last checkpoint, 0 if there is none."""
    path = folder / "checkpoint.h5"
    return checkpoint.read(path)[1]["step"] if path.exists() else 0


def running(number):
    try:
        with open(f"/proc/{number}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def assert_goes_on(folder, alone):
    """The last checkpoint is good: the run goes on from it, to the same end as one that did not
    stop.
    """
    assert last_step(folder) > 0
    finished("--resume", str(folder), *END)
    assert_same_results(alone, folder)


@pytest.mark.parametrize("victim", [0, 1])
def test_a_killed_rank_ends_all_within_10_seconds_and_is_named(alone, tmp_path, victim):
    folder = tmp_path / "run"
    process, numbers = run_until_checkpoint(folder)
    os.kill(numbers[victim], signal.SIGKILL)
    text, _ = process.communicate(timeout=10.0)
    assert process.returncode not in (0, None)
    assert f"PID {numbers[victim]} " in text
    assert "Killed (signal 9)" in text
    assert not any(map(running, numbers))
    assert_goes_on(folder, alone)


def test_a_killed_launcher_takes_the_ranks_with_it(alone, tmp_path):
    folder = tmp_path / "run"
    process, numbers = run_until_checkpoint(folder)
    process.kill()
    process.communicate(timeout=10.0)
    end = time.monotonic() + 10.0
    while any(map(running, numbers)) and time.monotonic() < end:
        time.sleep(0.1)
    assert not any(map(running, numbers))
    assert_goes_on(folder, alone)


def test_ctrl_c_ends_all_ranks_after_the_same_step(alone, tmp_path):
    folder = tmp_path / "run"
    process, _ = run_until_checkpoint(folder, ranks=3)
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=20.0)
    assert "Stopped at t =" in text
    assert_goes_on(folder, alone)


@pytest.mark.parametrize("how, said, steps", [("ctrl-c", "Stopped at t =", [10]),
                                              ("kill", "signal 9", range(6, 10))])  # fmt: skip
def test_a_run_that_is_struck_amid_a_cut_loses_only_what_its_checkpoint_lacks(
    alone, tmp_path, how, said, steps
):
    folder = tmp_path / "run"
    done = spoil(how, folder, "struck")
    assert done.returncode != 0
    assert said in done.stdout + done.stderr
    assert checkpoint.read(folder / "checkpoint.h5")[1]["step"] in steps
    finished("--resume", str(folder), *END, "--ranks", "2")
    assert_same_results(alone, folder)
    for name in ("phases", "decomposition"):
        assert [row["step"] for row in table(folder, name)] == ["5", "10", "15", "20", "25"]


def spoil(how, folder, program="spoiled"):
    line = launch.command(2, str(ROOT / "tests" / "ranks.py"), program, f'"{how}"', f'"{folder}"')
    return subprocess.run(line, env=environment(), cwd=ROOT, timeout=TIMEOUT, capture_output=True,
                          text=True)  # fmt: skip


@pytest.mark.parametrize("how, error", [("index", "IndexError"), ("value", "ValueError")])
def test_a_rank_that_raises_ends_all_and_says_which_and_why(alone, tmp_path, how, error):
    done = spoil(how, tmp_path / "run")
    assert done.returncode != 0
    assert "rank 1 of 2 failed" in done.stderr
    assert f"{error}: a fault in the code" in done.stderr
    assert_goes_on(tmp_path / "run", alone)


def test_a_fault_in_the_input_that_one_rank_alone_finds_ends_all(tmp_path):
    line = launch.command(2, str(ROOT / "tests" / "ranks.py"), "refused", f'"{tmp_path / "run"}"')
    done = subprocess.run(line, env=environment(), cwd=ROOT, timeout=30.0, capture_output=True,
                          text=True)  # fmt: skip
    assert done.returncode not in (0, 2)
    assert "rank 1 of 2 failed" in done.stderr
    assert "ValueError: only here" in done.stderr


@pytest.mark.parametrize("what", ["append", "write"])
def test_a_full_disk_ends_all_ranks_and_the_run_goes_on_when_there_is_room(alone, tmp_path, what):
    folder = tmp_path / "run"
    done = spoil(what, folder, "full")
    assert done.returncode == 3
    assert done.stderr.count("cannot be written (File too large) after step") == 1
    assert_goes_on(folder, alone)


def test_not_a_number_on_one_rank_is_a_failure_of_the_run(alone, tmp_path):
    folder = tmp_path / "run"
    done = spoil("nan", folder)
    assert done.returncode == 3
    said = r"run stopped: not a number in 1 particles, step \d+, .* on rank 1\n"
    assert len(re.findall(said, done.stderr)) == 1
    arrays, _ = checkpoint.read(folder / "failed.h5")
    assert np.isnan(arrays["velocity"]).any(axis=1).sum() == 1
    assert_goes_on(folder, alone)


COLUMN = ["dam_break", "--set", "tank.width=0", "--set", "particles.spacing=0.02",
          "--set", "parallel.rebalance_every=5", "--set", "scheme.settling=20"]  # fmt: skip


def test_cuts_follow_the_water_and_ranks_without_water_do_no_harm(tmp_path):
    for name, more in (
        ("alone", ["--no-pictures"]),
        ("optimal", ["--ranks", "3"]),
        ("static", ["--ranks", "4", "--set", "parallel.balance=static", "--no-pictures"]),
    ):
        finished(*COLUMN, "--until", "0.12", "--out", str(tmp_path / name), *more)
    assert (tmp_path / "optimal/pictures/tank.png").exists()
    rows = table(tmp_path / "optimal", "decomposition")
    assert any(float(r["imbalance after"]) < float(r["imbalance before"]) for r in rows)
    assert any(int(row["migrated"]) for row in rows)
    assert float(table(tmp_path / "static", "decomposition")[0]["imbalance after"]) > 2.0
    last = [checkpoint.read(tmp_path / name / "checkpoint.h5")[0]
            for name in ("alone", "optimal", "static")]  # fmt: skip
    for name, array in last[0].items():
        assert array.tobytes() == last[1][name].tobytes() == last[2][name].tobytes(), name
