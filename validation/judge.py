"""Met or missed: the criteria of a case against what it measured, and the misses that are known."""

import tomllib
from pathlib import Path

import numpy as np

from validation.suite import FOLDER

KNOWN = FOLDER / "known_misses.toml"


def known_misses(path=KNOWN):
    """The list of known misses: by case and criterion, a table with suites, value and cause."""
    return tomllib.loads(Path(path).read_text(encoding="utf-8"))


def cause_of(known, case, criterion, suite):
    """Why a criterion is known to be missed in a suite; None if it is not."""
    entry = known.get(case, {}).get(criterion)
    return entry["cause"] if entry and suite in entry["suites"] else None


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

    Raises
    ------
    ValueError
        If something was measured that has no criterion, or a criterion was not measured.
    """
    criteria = {criterion.id: criterion for criterion in case.criteria_of(suite)}
    if set(measured) != set(criteria):
        raise ValueError(
            f"{case.name}: measured {sorted(measured)}, but criteria.toml has {sorted(criteria)}"
        )
    return [_metric(case, suite, c, measured[c.id], known) for c in criteria.values()]


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
        "known": cause_of(known, case.name, criterion.id, suite),
    }


def misses(results):
    """(case, metric) of all that was missed."""
    return [(r["case"], m) for r in results for m in r["metrics"] if not m["passed"]]


def unexpected(results):
    """Lines that say where the results differ from the list of known misses; none if nowhere.

    A value within the noise of an edge of its band surprises nobody on either side.
    """
    lines = []
    for result in results:
        for metric in result["metrics"]:
            if metric["close"]:
                continue
            name = f"{result['case']}.{metric['id']}"
            if not metric["passed"] and metric["known"] is None:
                lines.append(f"{name} is missed ({metric['value']}) and not among the known misses")
            if metric["passed"] and metric["known"] is not None:
                lines.append(f"{name} is met ({metric['value']}): take it off the known misses")
    return lines
