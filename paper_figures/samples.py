"""What a time step costs with each of the paper's methods: some steps of each, in turn.

With the paper's solvers a run takes hours, and no machine that is shared stays as fast as it was
for hours. So each method does the same few steps, from states that one run has left, and one
method follows the other.
"""

import shutil
from dataclasses import dataclass

import numpy as np

from mpslab import load_case
from mpslab.core.particles import FLUID
from mpslab.output import checkpoint
from mpslab.output.tables import read_table
from paper_figures import runs
from paper_figures.keep import STEPS, keep_record, write_table

TABLE = "samples.csv"
TOPS = "tops.npz"
HEADER = ("from [s]", *STEPS)
COLUMN = 2.0  # [spacings] width of the columns whose tops are the surface


@dataclass(frozen=True)
class Method:
    """A solver and a way to cut the tank.

    Attributes
    ----------
    name, title : str
    ranks : int
    changes : dict of str to value
        Keys in which it differs from the run whose states it goes on from.
    """

    name: str
    title: str
    ranks: int
    changes: dict


def read_methods():
    """The methods of ``runs.toml``, by their names."""
    return {
        name: Method(name, given["title"], given["ranks"], given["set"])
        for name, given in runs.read_table()["method"].items()
    }


def take(methods, plan, out, results):
    """Let methods do their steps from each state, in turn, and keep what is asked of them.

    Parameters
    ----------
    methods : list of Method
        Those that have no results.
    plan : dict
        ``at``, the times of the states [s], and ``steps``, how many steps at least.
    out : Path
        Folder of the runs.
    results : Path
        Each method gets a folder there: ``run.json``, ``samples.csv`` and ``tops.npz``.

    Raises
    ------
    Failed
        If the run has not left one of the states.
    """
    for state in (runs.state_of(out / runs.SAMPLED, time) for time in plan["at"]):
        if not state.exists():
            raise runs.Failed(
                f"{state}: missing; remove {results / runs.SAMPLED}, and the run that leaves this "
                "state is made again"
            )
    rows, tops = {m.name: [] for m in methods}, {m.name: {} for m in methods}
    for time in plan["at"]:
        state = runs.state_of(out / runs.SAMPLED, time)
        for method in methods:
            folder = out / f"{method.name} at {time:.2f}"
            print(f"\nFrom {time} s: {method.name}, {method.title}", flush=True)
            began = _sample(method, state, folder, plan["steps"])
            rows[method.name] += _rows(time, began, folder)
            tops[method.name][f"{time:.2f}"] = _tops(folder)
    for method in methods:
        target = results / method.name
        target.mkdir(parents=True, exist_ok=True)
        first = out / f"{method.name} at {plan['at'][0]:.2f}"
        spacing = load_case(first / "case.toml").particles.spacing
        keep_record(first, target, **{"ranks": method.ranks, "spacing [m]": spacing})
        np.savez_compressed(target / TOPS, **tops[method.name])
        write_table(target / TABLE, HEADER, rows[method.name])


def _sample(method, state, folder, steps):
    """Some steps from a state, in a folder of their own; returns the time of the state [s]."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(state, folder)
    began = checkpoint.read_state(folder / "checkpoint.h5")["time"]
    until = began + (steps - 0.5) * load_case(folder / "case.toml").time.maximum
    changes = [f"--set={key}={value}" for key, value in method.changes.items()]
    runs.tank(method.ranks, "--resume", str(folder), "--until", str(until), *changes)
    return began


def _rows(time, began, folder):
    """The steps since a state, rows of texts."""
    steps = read_table(folder / "steps.csv")
    new = steps["time [s]"] > began
    columns = [map(form.format, steps[name][new]) for name, form in STEPS.items()]
    return [(f"{time:.2f}", *row) for row in zip(*columns, strict=True)]


def _tops(folder):
    """Height of the water in columns along the tank [m], (n,); NaN where there is none."""
    particles, _ = checkpoint.read(folder / "checkpoint.h5")
    case = load_case(folder / "case.toml")
    wide = COLUMN * case.particles.spacing
    wet = particles["position"][particles["role"] == FLUID]
    top = np.full(round(case.tank.length / wide) + 1, np.nan)
    column = np.clip(np.floor(wet[:, 0] / wide).astype(int), 0, len(top) - 1)
    np.fmax.at(top, column, wet[:, 2])
    return top
