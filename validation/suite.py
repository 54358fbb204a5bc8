"""The cases on the disk: a folder each, with case.toml, criteria.toml and compare.py."""

import importlib
import math
import tomllib
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from mpslab.cases import load_case
from mpslab.cases import names as built_in
from mpslab.core.keys import did_you_mean

FOLDER = Path(__file__).parent
SUITES = ("quick", "full")


@dataclass(frozen=True)
class PlannedRun:
    """A simulation that a case needs.

    Attributes
    ----------
    name : str
    case : str
        A built-in case, or the path of a TOML file.
    changes : dict
        Keys and values that replace those of the case.
    suites : tuple of str
    may_fail : bool
        Whether the case can be compared although this run failed.
    draw : int
        0, or the seed by which alone it differs from the run that it is another draw of.
    """

    name: str
    case: str
    changes: dict
    suites: tuple
    may_fail: bool = False
    draw: int = 0

    @property
    def first(self):
        """Name of the run that this is a draw of, its own where it is the first."""
        return self.name.removesuffix(f"-seed-{self.draw}") if self.draw else self.name

    def drawn_again(self, seed):
        """The same run with another seed, named after it."""
        changes = {**self.changes, "particles.seed": seed}
        return replace(self, name=f"{self.name}-seed-{seed}", changes=changes, draw=seed)

    @cached_property
    def resolved(self):
        """The `mpslab.core.parameters.Case`, with nothing left open."""
        return load_case(self.case, self.changes)

    @property
    def weight(self):
        """Particles of water times steps, roughly; to say how much of the work is done."""
        case = self.resolved
        spacing, tank = case.particles.spacing, case.tank
        columns = tank.length / spacing * max(tank.width / spacing, 1.0)
        return columns * tank.depth / spacing * case.time.end / case.time.maximum


@dataclass(frozen=True)
class Criterion:
    """A metric and the band it must lie in; None is no bound.

    Attributes
    ----------
    scatter : float
        Standard deviation of the metric from draw to draw, where it is chaotic: another seed, or
        the last bit on another machine, is another draw. 0: it must lie in the band in each.
    scatter_from : str
        The draws that the scatter was taken from.
    """

    id: str
    title: str
    reason: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    scatter: float = 0.0
    scatter_from: str = ""
    suites: tuple = SUITES

    def margin(self, value):
        """How far inside the band a value lies, negative where it is outside."""
        above = math.inf if self.low is None else value - self.low
        below = math.inf if self.high is None else self.high - value
        return min(above, below)

    def met(self, value):
        """Whether a value lies in the band; one that is not a number does not."""
        return value == value and self.margin(value) >= 0.0


@dataclass(frozen=True)
class ValidationCase:
    """A case of the suite.

    Attributes
    ----------
    name, title, question, readme : str
    order : int
        Its place in the report.
    runs : tuple of PlannedRun
    criteria : tuple of Criterion
    """

    name: str
    title: str
    question: str
    order: int
    readme: str
    runs: tuple = field(repr=False)
    criteria: tuple = field(repr=False)

    def runs_of(self, suite):
        """The runs of a suite, a list."""
        return [run for run in self.runs if suite in run.suites]

    def criteria_of(self, suite):
        """The criteria of a suite, a list."""
        return [criterion for criterion in self.criteria if suite in criterion.suites]

    def in_suite(self, suite):
        """Whether the suite has anything to look at here."""
        return bool(self.criteria_of(suite))

    @property
    def compare(self):
        """The function `compare` of the case, from the runs of a draw by name to a `Comparison`."""
        return importlib.import_module(f"validation.{self.name}.compare").compare


def load(name):
    """A case of the suite by the name of its folder.

    Raises
    ------
    ValueError
        If there is no such case, or a file of it does not fit.
    """
    if name not in names():
        raise ValueError(
            f"case = {name!r}: must be one of {', '.join(names())}{did_you_mean(name, names())}"
        )
    folder = FOLDER / name
    about = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
    criteria = tomllib.loads((folder / "criteria.toml").read_text(encoding="utf-8"))
    return ValidationCase(
        name=name,
        title=about["title"],
        question=about["question"],
        order=about["order"],
        readme=(folder / "README.md").read_text(encoding="utf-8"),
        runs=tuple(plan for run in about.get("run", ()) for plan in _planned(folder, run)),
        criteria=tuple(_criterion(*item) for item in criteria.items()),
    )


def names():
    """Names of all cases, in the order of the alphabet."""
    return tuple(sorted(path.parent.name for path in FOLDER.glob("*/case.toml")))


def load_all():
    """All cases in the order of the report."""
    return sorted(map(load, names()), key=lambda case: case.order)


def _planned(folder, run):
    """A run and its other draws, a list."""
    case = run["case"]
    path = case if case in built_in() else str(folder / case)
    suites = tuple(run.get("suites", SUITES))
    first = PlannedRun(run["name"], path, run.get("set", {}), suites, run.get("may_fail", False))
    return [first, *map(first.drawn_again, range(1, run.get("seeds", 1)))]


def _criterion(name, keys):
    return Criterion(name, **{**keys, "suites": tuple(keys.get("suites", SUITES))})
