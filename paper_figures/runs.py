"""The runs behind the figures: which there are, and how they are made."""

import json
import shutil
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from mpslab import load_case
from mpslab.core.keys import CaseError
from mpslab.parallel.communicator import cores

CASE = "plunging_breaker"
TABLE = Path(__file__).parent / "runs.toml"
SIZES = ("full", "quick")
SAMPLED = "cmps"  # the run that leaves states for `paper_figures.samples`
# What a state is gone on with from; the frames of the run are not needed.
STATE = ("case.toml", "run.json", "checkpoint.h5", "*.csv")


class Failed(Exception):
    """A run has not come to its end; the message says which, where it lies and what to do."""


@dataclass(frozen=True)
class Run:
    """One run of the tank.

    Attributes
    ----------
    name, title : str
    ranks : int
    changes : dict of str to value
        The keys in which its case differs from plunging_breaker.
    late : float [s]
        By how much its wave breaks later than the paper's; the figures show it as much later.
    stops : tuple of float [s]
        Times at which its state is left in a folder, for `paper_figures.samples`.
    """

    name: str
    title: str
    ranks: int
    changes: dict
    late: float = 0.0
    stops: tuple = ()

    @property
    def case(self):
        """The resolved case."""
        return load_case(CASE, self.changes)


def read_runs(size):
    """The runs of a size, "full" or "quick", by their names."""
    table = read_table()
    return {
        name: Run(
            name,
            given["title"],
            given["ranks"],
            table["all"] | table["size"][size] | given["set"] | given.get(size, {}),
            given.get("late", {}).get(size, 0.0),
            tuple(table["samples"][size]["at"]) if name == SAMPLED else (),
        )
        for name, given in table["run"].items()
    }


def read_table():
    """``runs.toml`` as it stands."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))


def state_of(folder, time):
    """Folder of the state that a run has left at one of its stops [s]."""
    return folder.with_name(f"{folder.name} at {time:.2f}")


def is_done(run, folder):
    """Whether the folder holds this run, at its end, and all its states.

    Raises Failed if it holds another one.
    """
    if not (folder / "case.toml").exists():
        return False
    try:
        same = load_case(folder / "case.toml") == run.case
    except CaseError:
        same = False
    if not same:
        raise Failed(f"{folder}: holds another run than '{run.name}' of runs.toml; move it away")
    record = folder / "run.json"
    return record.exists() and json.loads(record.read_text("utf-8"))["outcome"] == "finished"


def batches(rows):
    """Lists of the runs that are made at the same time.

    Those on one rank that follow each other, as many as there are cores; each of the others alone.
    """
    for alone, group in groupby(rows, lambda run: run.ranks > 1):
        together, most = list(group), 1 if alone else len(cores())
        for k in range(0, len(together), most):
            yield together[k : k + most]


def make_all(rows, out):
    """Make runs side by side, each in the folder of its name, as `make` does.

    The first one prints its progress; the others write theirs to ``NAME.log``. After Ctrl-C, all
    come to their checkpoint before this returns.
    """
    out.mkdir(parents=True, exist_ok=True)
    logs = [None, *(out / f"{run.name}.log" for run in rows[1:])]
    with ThreadPoolExecutor(len(rows)) as pool:
        going = [pool.submit(make, run, out / run.name, log)
                 for run, log in zip(rows, logs, strict=True)]  # fmt: skip
        for one in going:
            one.result()


def make(run, folder, log=None):
    """Make a run, or go on with one that was interrupted.

    Parameters
    ----------
    run : Run
    folder : Path
    log : Path, optional
        Where its progress is written to; left out, it is printed.

    Raises
    ------
    Failed
        If it stops before its end, or the folder holds another run.
    """
    if is_done(run, folder):
        return
    for time in run.stops:
        state = state_of(folder, time)
        if not state.exists():
            _go_on(run, folder, log, "--until", str(time))
            _leave(folder, state)
    _go_on(run, folder, log)


def _go_on(run, folder, log, *until):
    if (folder / "checkpoint.h5").exists():
        what = ["--resume", str(folder)]
    else:
        what = [CASE, "--out", str(folder)]
        what += [f"--set={key}={_toml(value)}" for key, value in run.changes.items()]
    with log.open("a", encoding="utf-8") if log else nullcontext() as file:
        tank(run.ranks, *what, *until, output=file)


def tank(ranks, *arguments, output=None):
    """Call ``python -m mpslab.tank`` on so many ranks; Failed if it ends before its time.

    output : open file, optional
        Takes what it prints.
    """
    line = [sys.executable, "-m", "mpslab.tank", "--no-pictures"]
    line += ["--ranks", str(ranks)] if ranks > 1 else []
    if subprocess.run([*line, *arguments], stdout=output, check=False).returncode:
        raise Failed(f"'{' '.join(arguments)}' has stopped; the same command goes on with it")


def _leave(folder, state):
    """Copy the state of a run; the folder has its name when it is whole."""
    draft = state.with_name(state.name + ".part")
    shutil.rmtree(draft, ignore_errors=True)
    draft.mkdir()
    for pattern in STATE:
        for file in folder.glob(pattern):
            shutil.copy(file, draft)
    draft.rename(state)


def _toml(value):
    return f"[{', '.join(map(_toml, value))}]" if isinstance(value, list) else repr(value)
