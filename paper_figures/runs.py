"""The runs behind the figures: which there are, and how they are made."""

import json
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from mpslab import load_case
from mpslab.core.keys import CaseError

CASE = "plunging_breaker"
TABLE = Path(__file__).parent / "runs.toml"
SIZES = ("full", "quick")


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
    water : bool
        Whether the water near the wave is kept.
    """

    name: str
    title: str
    ranks: int
    changes: dict
    water: bool

    @property
    def case(self):
        """The resolved case."""
        return load_case(CASE, self.changes)


def read_runs(size):
    """The runs of a size, "full" or "quick", by their names."""
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    return {
        name: Run(
            name,
            given["title"],
            given["ranks"],
            table["all"] | table["size"][size] | given["set"] | given.get(size, {}),
            given.get("water", True),
        )
        for name, given in table["run"].items()
    }


def is_done(run, folder):
    """Whether the folder holds this run, at its end.

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


def make(run, folder):
    """Make a run, or go on with one that was interrupted; its progress is printed.

    Raises
    ------
    Failed
        If it stops before its end, or the folder holds another run.
    """
    if is_done(run, folder):
        return
    line = [sys.executable, "-m", "mpslab.tank", "--no-pictures"]
    line += ["--ranks", str(run.ranks)] if run.ranks > 1 else []
    if (folder / "checkpoint.h5").exists():
        line += ["--resume", str(folder)]
    else:
        line += [CASE, "--out", str(folder)]
        line += [f"--set={key}={_toml(value)}" for key, value in run.changes.items()]
    if subprocess.run(line, check=False).returncode:
        raise Failed(f"{folder}: '{run.name}' has stopped; the same command goes on with it")


def _toml(value):
    return f"[{', '.join(map(_toml, value))}]" if isinstance(value, list) else repr(value)
