"""Run-up of solitary waves on a vertical wall."""

import csv
from pathlib import Path

import numpy as np

from mpslab.theory import waves
from validation import potential_tank
from validation.comparison import Comparison

DATA = Path(__file__).parent / "data" / "chan_street1970_solitary_wall_runup.csv"
CONVERGE = ("0.3-coarse", "0.3", "0.3-fine")
BESIDE = ("0.3-coarse", "0.3-paper")  # for the order, and for the recipe: not judged
REACH = 2.0  # to either side of the crest, in units of 1/k: there sech^2 is 0.07


def compare(runs):
    """Run-up against experiment and theory."""
    result = Comparison()
    rows = {name: _row(name, run) for name, run in runs.items()}
    judged = [row[-1] for name, row in rows.items() if name not in BESIDE]
    result.measure("runup", max(judged, key=lambda ratio: abs(np.log(ratio))))
    columns = ["run", "H/d asked for", "H/d measured", "R/d", "in potential flow", "theory",
               "over theory"]  # fmt: skip
    result.table("Run-up", columns, list(rows.values()))
    _converge(result, {name: (runs[name].spacing, rows[name][-1]) for name in runs})
    _draw_runup(result, rows)
    level = result.figure("Level at the wall", "time [s]", "elevation / d")
    for name, run in runs.items():
        time, eta = run.gauge("wall")
        level.line(_label(name), time, eta / run.depth - 1.0)
    _compare_incident(result, {n: run for n, run in runs.items() if n != "0.3-paper"})
    return result


def _row(name, run):
    """Line of the table of run-ups."""
    asked, height = run.case.wavemaker.height / run.depth, _incident(run)[1] / run.depth
    runup = _runup(run) / run.depth
    ideal = _in_potential_flow(run)
    return [name, asked, height, runup, ideal, _theory(height), runup / _theory(height)]


def _label(name):
    return name if name == "0.3-paper" else f"standard, {name}"


def _converge(result, found):
    """Order of the run-up of 0.3, from pairs of spacing and ratio to the theory by run."""
    spacing, ratio = np.array([found[name] for name in CONVERGE if name in found]).T
    if len(spacing) > 1:
        result.converge("Run-up of H/d = 0.3 over the theory, less one", spacing, ratio - 1.0)
        result.note("The waves of the experiment scatter by 7 % about the theory: an order means "
                    "something only where the run-up is further off than that.")  # fmt: skip


def _draw_runup(result, rows):
    """Experiment, theory and runs, by the height of the wave."""
    figure = result.figure("Run-up on a vertical wall", "H / d", "R / d")
    heights = np.linspace(0.05, 0.65, 50)
    for kind in ("experiment", "SUMMAC computation"):
        with DATA.open() as file:
            data = [row for row in csv.DictReader(file) if row["kind"] == kind]
        columns = ([float(row[c]) for row in data] for c in ("H/d [-]", "R/d [-]"))
        figure.points(f"Chan & Street 1970, {kind.split()[-1]}", *columns)
    figure.dashed("Su & Mirie 1980", heights, _theory(heights))
    for name, _, height, runup, *_ in rows.values():
        figure.points(_label(name), [height], [runup])


def _compare_incident(result, runs):
    """The wave as it comes in against sech^2 of its height and its own clock."""
    for name, run in runs.items():
        (crest, height), (time, level) = _incident(run), run.gauge("incident")
        x = waves.solitary_celerity(height, run.depth, run.gravity) * (time - crest)
        near = np.abs(x) < REACH / waves.solitary_wave_number(height, run.depth)
        theory = waves.solitary_elevation(x[near], height, run.depth) / run.depth
        label = f"{name}: the wave as it comes in against sech^2 of its height [d], [d]"
        x = x[near] / run.depth
        result.hold(label, x, level[near] / run.depth - 1.0, x, theory)


def _theory(e):
    """Run-up over depth, third order (Su & Mirie 1980)."""
    return 2.0 * e + 0.5 * e**2 + 0.75 * e**3


def _incident(run):
    """When the crest passes the gauge [s], and its height as it comes in, before it comes back from
    the wall [m].
    """
    time, level = run.gauge("incident")
    speed = waves.solitary_celerity(run.case.wavemaker.height, run.depth, run.gravity)
    way = run.case.tank.length - run.case.gauge[0].x
    at_wall = time[np.argmax(run.gauge("wall")[1])]
    top = np.argmax(np.where(time < at_wall - 0.3 * way / speed, level, -np.inf))
    return time[top], level[top] - run.depth


def _in_potential_flow(run):
    """Run-up over depth of the wave that the same piston makes in potential flow."""
    (wall,) = (gauge for gauge in run.case.gauge if gauge.name == "wall")
    period = potential_tank.solitary_period(run.case.wavemaker.height, run.depth, run.gravity)
    return potential_tank.levels(run.case, [wall.x], period)[1].max() / run.depth


def _runup(run):
    """Highest level at the wall over still water [m]."""
    return np.nanmax(run.gauge("wall")[1]) - run.depth
