"""Run-up of solitary waves on a vertical wall."""

import csv
from pathlib import Path

import numpy as np

from mpslab.waves import solitary_celerity
from validation.comparison import Comparison

DATA = Path(__file__).parent / "data" / "chan_street1970_solitary_wall_runup.csv"


def compare(runs):
    """Run-up against experiment and theory."""
    result = Comparison()
    figure = result.figure("Run-up on a vertical wall", "H / d", "R / d")
    heights = np.linspace(0.05, 0.65, 50)
    for kind in ("experiment", "SUMMAC computation"):
        with DATA.open() as file:
            rows = [row for row in csv.DictReader(file) if row["kind"] == kind]
        columns = ([float(row[c]) for row in rows] for c in ("H/d [-]", "R/d [-]"))
        figure.points(f"Chan & Street 1970, {kind.split()[-1]}", *columns)
    figure.dashed("Su & Mirie 1980", heights, _theory(heights))
    rows = []
    for name, run in runs.items():
        height, runup = _incident(run) / run.depth, _runup(run) / run.depth
        figure.points(f"standard, {name}", [height], [runup])
        asked = run.case["wavemaker"]["height"] / run.depth
        rows.append([name, asked, height, runup, _theory(height), runup / _theory(height)])
    result.measure("runup", max((row[-1] for row in rows), key=lambda ratio: abs(np.log(ratio))))
    columns = ["run", "H/d asked for", "H/d measured", "R/d", "theory", "ratio"]
    result.table("Run-up", columns, rows)
    level = result.figure("Level at the wall", "time [s]", "elevation / d")
    for name, run in runs.items():
        time, eta = run.gauge("wall")
        level.line(f"standard, {name}", time, eta / run.depth - 1.0)
    return result


def _theory(e):
    """Run-up over depth, third order (Su & Mirie 1980)."""
    return 2.0 * e + 0.5 * e**2 + 0.75 * e**3


def _incident(run):
    """Height of the wave as it comes in, before it comes back from the wall [m]."""
    time, level = run.gauge("incident")
    speed = solitary_celerity(run.case["wavemaker"]["height"], run.depth, run.gravity)
    way = run.case["tank"]["length"] - run.case["gauge"][0]["x"]
    at_wall = time[np.argmax(run.gauge("wall")[1])]
    return level[time < at_wall - 0.3 * way / speed].max() - run.depth


def _runup(run):
    """Highest level at the wall over still water [m]."""
    return np.nanmax(run.gauge("wall")[1]) - run.depth
