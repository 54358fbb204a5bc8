"""Met, open or missed: the criteria of a case against what its draws measured, and the misses that
are known.
"""

import tomllib
from pathlib import Path

import numpy as np

from validation.suite import FOLDER

KNOWN = FOLDER / "known_misses.toml"
MET, OPEN, MISSED = "met", "open", "missed"
SURE = 2.0  # standard errors


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


def judge(case, suite, draws, known):
    """The metrics of a case as its JSON file holds them.

    Parameters
    ----------
    case : validation.suite.ValidationCase
    suite : str
    draws : list of dict of str to float
        What each draw measured, by the name of the criterion.
    known : dict
        From `known_misses`.

    Returns
    -------
    list of dict
    """
    return [
        _metric(case, suite, criterion, [draw[criterion.id] for draw in draws], known)
        for criterion in case.criteria_of(suite)
    ]


def check(case, suite, measured):
    """Raise ValueError if something was measured that has no criterion, or the other way round."""
    criteria = {criterion.id for criterion in case.criteria_of(suite)}
    if set(measured) != criteria:
        raise ValueError(f"measured {sorted(measured)}, but criteria.toml has {sorted(criteria)}")


def estimate(criterion, values):
    """What the values of the draws come to: a value and its standard error.

    Of a chaotic criterion the mean. Its error is from the scatter that the criterion states and
    not from that of a few draws, which is uncertain, and which a draw gone wild would excuse
    itself by. Of another criterion the worst draw, without an error.
    """
    if not criterion.scatter:
        broken = [value for value in values if not np.isfinite(value)]
        return (broken or [min(values, key=criterion.margin)])[0], 0.0
    return np.mean(values), criterion.scatter / np.sqrt(len(values))


def verdict(criterion, value, error):
    """Met, missed, or open: within two standard errors of an edge of the band."""
    if not np.isfinite(value):
        return MISSED
    if abs(criterion.margin(value)) < SURE * error:
        return OPEN
    return MET if criterion.met(value) else MISSED


def _metric(case, suite, criterion, values, known):
    drawn = values if len(set(values)) > 1 else values[:1]  # the same bits: not drawn again
    value, error = estimate(criterion, drawn)
    return {
        "id": criterion.id,
        "title": criterion.title,
        "unit": criterion.unit,
        "low": criterion.low,
        "high": criterion.high,
        "value": float(value) if np.isfinite(value) else None,
        "error": float(error),
        "draws": [float(one) if np.isfinite(one) else None for one in drawn],
        "verdict": verdict(criterion, value, error),
        "reason": criterion.reason,
        "scatter": criterion.scatter,
        "scatter_from": criterion.scatter_from,
        "known": cause_of(known, case.name, criterion.id, suite),
        "listed": value_of(known, case.name, criterion.id, suite),
    }


def with_verdict(results, word):
    """(case, metric) of all that have a verdict."""
    return [(r["case"], m) for r in results for m in r["metrics"] if m["verdict"] == word]


def unexpected(results):
    """Lines that say where the results differ from the list of known misses; none if nowhere.

    What is open surprises nobody, listed or not. A known miss does that has become worse by more
    than both values, the listed and the new one, are certain to: two standard errors each.
    """
    every = ((f"{r['case']}.{m['id']}", m) for r in results for m in r["metrics"])
    lines = [(name, _surprise(metric)) for name, metric in every]
    return [f"{name} is {line}" for name, line in lines if line]


def _surprise(metric):
    """Where a metric differs from the list of known misses, in words; None where it does not."""
    value, known = told(metric), metric["known"] is not None
    if metric["verdict"] == MET and known:
        return f"met ({value}): take it off the known misses"
    if metric["verdict"] != MISSED:
        return None
    if not known:
        return f"missed ({value}) and not among the known misses"
    allowed = _beyond(metric, metric["listed"]) + 2.0 * SURE * metric["error"]
    if metric["value"] is None or _beyond(metric, metric["value"]) > allowed:
        return f"missed by more ({value}) than the known misses say ({metric['listed']})"
    return None


def told(metric):
    """The value of a metric and its standard error, in words."""
    if metric["value"] is None:
        return "no value"
    error = f" +- {metric['error']:.2g}" if metric["error"] else ""
    return f"{metric['value']:.5g}{error}"


def _beyond(metric, value):
    """How far a value lies outside the band."""
    low = value if metric["low"] is None else metric["low"]
    high = value if metric["high"] is None else metric["high"]
    return max(low - value, value - high, 0.0)
