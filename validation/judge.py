"""Met or missed: the criteria of a case against what it measured, and the misses that are known."""

import tomllib
from pathlib import Path

import numpy as np

from validation.suite import FOLDER

KNOWN = FOLDER / "known_misses.toml"


def known_misses(path=KNOWN):
    """The list of known misses: by case and criterion, a table with suites, value and cause.

    The value is that of all its suites, or a table of one for each.
    """
    return tomllib.loads(Path(path).read_text(encoding="utf-8"))


def cause_of(known, case, criterion, suite):
    """Why a criterion is known to be missed in a suite; None if it is not."""
    entry = known.get(case, {}).get(criterion)
    return entry["cause"] if entry and suite in entry["suites"] else None


def value_of(known, case, criterion, suite):
    """What is listed as measured in a suite; None if nothing is."""
    value = known.get(case, {}).get(criterion, {}).get("value")
    return value.get(suite) if isinstance(value, dict) else value


def judge(case, suite, measured, known):
    """The metrics of a case as its JSON file holds them.

    Parameters
    ----------
    case : validation.suite.ValidationCase
    suite : str
    measured : dict of str to float
        By the name of the criterion.
    known : dict
        From `known_misses`.

    Returns
    -------
    list of dict
    """
    return [_metric(case, suite, c, measured[c.id], known) for c in case.criteria_of(suite)]


def check(case, suite, measured):
    """Raise ValueError if something was measured that has no criterion, or the other way round."""
    criteria = {criterion.id for criterion in case.criteria_of(suite)}
    if set(measured) != criteria:
        raise ValueError(f"measured {sorted(measured)}, but criteria.toml has {sorted(criteria)}")


def _metric(case, suite, criterion, value, known):
    return {
        "id": criterion.id,
        "title": criterion.title,
        "unit": criterion.unit,
        "low": criterion.low,
        "high": criterion.high,
        "value": value if np.isfinite(value) else None,
        "passed": bool(criterion.met(value)),
        "close": bool(criterion.at_an_edge(value)),
        "reason": criterion.reason,
        "noise": criterion.noise,
        "known": cause_of(known, case.name, criterion.id, suite),
        "listed": value_of(known, case.name, criterion.id, suite),
    }


def misses(results):
    """(case, metric) of all that was missed."""
    return [(r["case"], m) for r in results for m in r["metrics"] if not m["passed"]]


def unexpected(results):
    """Lines that say where the results differ from the list of known misses; none if nowhere.

    A value within the noise of an edge of its band surprises nobody on either side; a known miss
    that is farther off than was listed, by more than the noise, does.
    """
    every = ((f"{r['case']}.{m['id']}", m) for r in results for m in r["metrics"])
    lines = [(name, _surprise(metric)) for name, metric in every]
    return [f"{name} is {line}" for name, line in lines if line]


def _surprise(metric):
    """Where a metric differs from the list of known misses, in words; None where it does not."""
    value, known = metric["value"], metric["known"] is not None
    if metric["passed"]:
        heals = known and not metric["close"]
        return f"met ({value}): take it off the known misses" if heals else None
    if not known:
        return None if metric["close"] else f"missed ({value}) and not among the known misses"
    allowed = _beyond(metric, metric["listed"]) + metric["noise"]
    if value is None or _beyond(metric, value) > allowed:
        return f"missed by more ({value}) than the known misses say ({metric['listed']})"
    return None


def _beyond(metric, value):
    """How far a value lies outside the band."""
    low = value if metric["low"] is None else metric["low"]
    high = value if metric["high"] is None else metric["high"]
    return max(low - value, value - high, 0.0)
