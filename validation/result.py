"""The result of a case: a JSON file that the report is drawn from, and pictures beside it."""

import json
import traceback
from datetime import UTC, datetime

import matplotlib
import numpy as np

from mpslab import measures
from mpslab.analysis.pictures import STYLE
from mpslab.core.files import replacing
from mpslab.output.provenance import environment
from validation.comparison import Comparison, Figure
from validation.judge import check, judge
from validation.run import Run

PICTURE_DPI = 100
LEDGER = (
    "Ledger (in 2-D of a slice 1 m wide). Walls do no work: what is dissipated is lost by the "
    "scheme, to the viscosity of water and, where a case has them, to friction and eddies"
)
LEDGER_COLUMNS = [
    "run", "work of the piston [J]", "kinetic energy gained [J]", "potential energy gained [J]",
    "dissipated [J]", "momentum along x, start [N s]", "end [N s]",
    "volume against its first tenth [%]", "particles lost",
]  # fmt: skip


def compare(case, suite, outcomes, runs):
    """What a case finds in its runs.

    Parameters
    ----------
    case : validation.suite.ValidationCase
    suite : str
    outcomes : list of validation.work.Outcome
    runs : list of validation.run.Run
        One for each outcome.

    Returns
    -------
    Comparison
        Of the first draw, with the values of all. With no values, and a note that says why, where
        a run failed that has to end well, or where the comparison itself did.
    """
    failed = [o for o in outcomes if o.outcome != "finished" and not o.task.plan.may_fail]
    why = [f"Run {o.task.plan.name} {o.outcome}: {o.reason}" for o in failed]
    if not failed:
        try:
            every = [case.compare(draw) for draw in draws_of(outcomes, runs)]
            for one in every:
                check(case, suite, one.measured)
            every[0].draws = [one.measured for one in every]
            return every[0]
        except Exception:
            traceback.print_exc()
            why = [f"The comparison failed: {traceback.format_exc().splitlines()[-1]}"]
    nothing = {criterion.id: np.nan for criterion in case.criteria_of(suite)}
    return Comparison(measured=nothing, draws=[nothing], notes=why)


def draws_of(outcomes, runs):
    """Runs by name, a dict for each draw; a run that was not drawn again stands in all of them.

    A run without a step is left out: it may fail.
    """
    pairs = [(o.task.plan, run) for o, run in zip(outcomes, runs, strict=True)]
    count = 1 + max((plan.draw for plan, _ in pairs), default=0)
    draws = [{plan.first: run for plan, run in pairs if plan.draw in (0, k)} for k in range(count)]
    return [{name: run for name, run in draw.items() if len(run.steps)} for draw in draws]


def make(case, suite, outcomes, known):
    """The JSON object of a case (see ``validation/README.md``), and the pictures that go with it.

    Returns
    -------
    dict, dict of str to matplotlib Figure
        The object, and by the names in it its pictures.
    """
    runs = [Run(outcome.task.folder) for outcome in outcomes]
    found = compare(case, suite, outcomes, runs)
    pictures = {}
    figures = [_figure(case, figure, pictures) for figure in found.figures]
    told = [_run(*pair) for pair in zip(outcomes, runs, strict=True)]
    result = {
        "case": case.name,
        "title": case.title,
        "question": case.question,
        "order": case.order,
        "suite": suite,
        "readme": case.readme,
        "runs": told,
        "metrics": judge(case, suite, found.draws, known),
        "figures": figures,
        "tables": [*found.all_tables, *ledger(outcomes, runs)],
        "convergence": found.convergence,
        "notes": found.notes,
        "provenance": {
            **_origin(runs),
            "date": datetime.now(UTC).isoformat(timespec="seconds"),
            "seconds": sum(run["seconds"] for run in told),
        },
    }
    return result, pictures


def _figure(case, figure, pictures):
    """A figure as the JSON file holds it; a picture goes into `pictures`."""
    if isinstance(figure, Figure):
        return vars(figure)
    name = f"{case.name}-{len(pictures) + 1}.png"
    pictures[name] = figure["picture"]
    return {**figure, "picture": name}


def _origin(runs):
    """Versions, machine and commit that the runs were made with, of the last of them; those of
    now where a case has no runs.
    """
    made = [run.record for run in runs if run.record]
    keys = ("versions", "machine", "commit")
    return {key: made[-1][key] for key in keys} if made else environment()


def ledger(outcomes, runs):
    """Table of what became of water, energy and momentum; none where there are no runs."""
    rows = []
    for outcome, run in zip(outcomes, runs, strict=True):
        steps = run.steps
        if len(steps):
            books, volume = measures.ledger(steps), steps["volume"]
            settled = volume[: len(volume) // 10 + 1].mean()
            change = 100.0 * (volume[-1] / settled - 1.0)
            rows.append([outcome.task.plan.name, *books.values(), *run.momentum(), change,
                         steps["lost"][-1]])  # fmt: skip
    return [{"title": LEDGER, "columns": LEDGER_COLUMNS, "rows": rows}] if rows else []


def _run(outcome, run):
    plan, record = outcome.task.plan, run.record
    return {
        "name": plan.name,
        "case": plan.resolved.name,
        "changes": plan.changes,
        "particles": sum(record.get("particles", {}).values()),
        "steps": len(run.steps),
        "seconds": record.get("wall_time [s]", 0.0),
        "outcome": outcome.outcome,
        "reason": outcome.reason,
    }


def write(out, result, pictures):
    """Write the JSON file of a case, and its pictures beside it."""
    for name, picture in pictures.items():
        with matplotlib.rc_context(STYLE):
            picture.savefig(out / name, dpi=PICTURE_DPI)
    with replacing(out / f"{result['case']}.json") as draft:
        draft.write_text(json.dumps(result, indent=1), encoding="utf-8")
