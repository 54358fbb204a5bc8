"""The kept results of the runs, as the figures read them."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mpslab import open_run
from mpslab.output.tables import read_table
from paper_figures.keep import LEVELS, MILLIMETRE, SPEED
from paper_figures.samples import TABLE, TOPS


@dataclass(frozen=True)
class Water:
    """Water particles of a frame.

    Attributes
    ----------
    time : float [s]
    position : (n, 3) float64 [m]
    u : (n,) float64 [m/s]
        Velocity along x.
    """

    time: float
    position: np.ndarray
    u: np.ndarray


class Kept:
    """The kept results of one run.

    Parameters
    ----------
    folder : Path
        As `paper_figures.keep.keep` has written it.
    title : str
        What the run is called in the figures.
    """

    def __init__(self, folder, title):
        self.folder, self.title = Path(folder), title

    @cached_property
    def _run(self):
        return open_run(self.folder)

    @property
    def case(self):
        """The resolved case, a dict of tables."""
        return self._run.tables

    @property
    def spacing(self):
        """Particle spacing [m]."""
        return self.case["particles"]["spacing"]

    @property
    def late(self):
        """By how much its wave breaks later than the paper's [s]."""
        return self.record["late"]

    def moved(self, along):
        """What a picture shows of the tank (2,) [m], moved as far as a late wave breaks farther."""
        return along[0] + SPEED * self.late, along[1] + SPEED * self.late

    @property
    def width(self):
        """Width of the tank [m]."""
        return self.case["tank"]["width"]

    @property
    def record(self):
        """How the run was made: ranks, machine, commit, particles; a dict."""
        return self._run.record

    @cached_property
    def steps(self):
        """Columns step, time [s], iterations and seconds, (steps,) each."""
        return read_table(self.folder / "steps.csv")

    @cached_property
    def series(self):
        """Columns of `paper_figures.measures.measure`, a row for each frame."""
        return read_table(self.folder / "series.csv")

    @cached_property
    def _arrays(self):
        with np.load(self.folder / "water.npz") as file:
            return dict(file)

    def near(self, time):
        """The water where the waves break at one of `paper_figures.keep.TIMES`, or later."""
        return self._water("near", time)

    def tank(self, time):
        """The middle slice of the whole tank at one of `paper_figures.keep.CUTS`."""
        return self._water("tank", time)

    def cuts(self, time, method):
        """Where a method cuts the tank, and what the ranks get.

        Returns
        -------
        borders : (ranks + 1,) float64 [m]
        share, work : (ranks,) float64 [-]
            Of all particles, and of the work.
        """
        return [self._arrays[f"{what} {time:.2f} {method}"] for what in ("cuts", "share", "work")]

    def _water(self, what, time):
        name = f"{what} {time:.2f}"
        low, high = self._arrays[f"{name} box"]
        position = low + self._arrays[f"{name} position"].T / LEVELS * (high - low)
        time = float(self._arrays[f"{name} time"])
        return Water(time, position, self._arrays[f"{name} u"] * MILLIMETRE)


class Sampled:
    """What a method did from each of the states of a run, as `paper_figures.samples` has kept it.

    Parameters
    ----------
    folder : Path
    title : str
        What the method is called in the figures.
    """

    def __init__(self, folder, title):
        self.folder, self.title = Path(folder), title

    @cached_property
    def record(self):
        """How it was made: ranks, machine, commit, particles; a dict."""
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    @cached_property
    def steps(self):
        """Columns from [s] (the state), step, time [s], iterations and seconds, (steps,) each."""
        return read_table(self.folder / TABLE)

    @cached_property
    def states(self):
        """Times of the states [s], (k,)."""
        return np.unique(self.steps["from [s]"])

    def middle(self, column):
        """Median of a column from each of the states on, (k,).

        Other work on the machine strikes single steps.
        """
        each = [self.steps[column][self.steps["from [s]"] == state] for state in self.states]
        return np.array([np.median(one) for one in each])

    def over(self, column, steps):
        """A column for steps (n,), between the medians from the states; as at the next beyond."""
        return np.interp(steps, self.middle("step"), self.middle(column))

    @cached_property
    def tops(self):
        """Height of the water in columns along the tank after the steps from each state, (k, n)."""
        with np.load(self.folder / TOPS) as file:
            return np.array([file[f"{state:.2f}"] for state in self.states])


def read(folder, runs, methods):
    """The kept results of the runs and methods that have any, by their names."""
    found = {
        name: Kept(folder / name, run.title)
        for name, run in runs.items()
        if (folder / name / "water.npz").exists()
    }
    return found | {
        name: Sampled(folder / name, method.title)
        for name, method in methods.items()
        if (folder / name / TABLE).exists()
    }
