"""The cases on the disk: a folder each, with case.toml, criteria.toml and compare.py."""

import importlib
import tomllib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from mpslab.cases import load_case
from mpslab.cases import names as built_in
from mpslab.keys import did_you_mean

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
    """

    name: str
    case: str
    changes: dict
    suites: tuple
    may_fail: bool = False

    @cached_property
    def resolved(self):
        """The `mpslab.parameters.Case`, with nothing left open."""
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

    A value nearer to an edge of the band than `noise` may fall on either side of it with another
    seed, or on another machine.
    """

    id: str
    title: str
    reason: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    noise: float = 0.0
    suites: tuple = SUITES

    def at_an_edge(self, value):
        """Whether a value is within the noise of an edge of the band."""
        edges = [edge for edge in (self.low, self.high) if edge is not None]
        return any(abs(value - edge) < self.noise for edge in edges)

    def met(self, value):
        """Whether a value lies in the band; one that is not a number does not."""
        above = self.low is None or value >= self.low
        below = self.high is None or value <= self.high
        return value == value and above and below


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
        """The function `compare` of the case, from runs by name to a `Comparison`."""
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
        runs=tuple(_planned(folder, run) for run in about.get("run", ())),
        criteria=tuple(_criterion(*item) for item in criteria.items()),
    )


def names():
    """Names of all cases, in the order of the alphabet."""
    return tuple(sorted(path.parent.name for path in FOLDER.glob("*/case.toml")))


def load_all():
    """All cases in the order of the report."""
    return sorted(map(load, names()), key=lambda case: case.order)


def _planned(folder, run):
    case = run["case"]
    path = case if case in built_in() else str(folder / case)
    suites = tuple(run.get("suites", SUITES))
    return PlannedRun(run["name"], path, run.get("set", {}), suites, run.get("may_fail", False))


def _criterion(name, keys):
    return Criterion(name, **{**keys, "suites": tuple(keys.get("suites", SUITES))})
