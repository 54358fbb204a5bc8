"""Waves before and behind a box afloat, and its heave, sway and roll, against the experiment."""

from pathlib import Path

import numpy as np

from validation.comparison import Comparison, rms
from validation.data import read_curves

DATA = Path(__file__).parent / "data" / "hadzic2005_box_wavepacket.csv"
# What was measured, by its name in the data: criterion, title, unit, factor from SI units.
CURVES = {
    "eta_x1.16_m": ("before", "Level before the box", "mm", 1e3),
    "eta_x2.66_m": ("behind", "Level behind the box", "mm", 1e3),
    "heave_m": ("heave", "Heave", "mm", 1e3),
    "surge_m": ("surge", "Surge", "mm", 1e3),
    "roll_deg": ("roll", "Roll, the side of the waves down", "deg", 1.0),
}


def compare(runs):
    """The finest run is measured, all are drawn."""
    result = Comparison()
    measured, rows = read_curves(DATA), []
    runs = sorted(runs.values(), key=lambda run: -run.spacing)
    for curve, (name, title, unit, factor) in CURVES.items():
        at, right = measured[curve]
        figure = result.figure(title, "time [s]", f"{title.split(',')[0].lower()} [{unit}]")
        figure.points("experiment", at, factor * right)
        for run in runs:
            time, seen = _seen(run)[name]
            figure.line(run.label, time, factor * seen)
            row = result.hold(f"{title}, {run.label} [{unit}], [s]", time, factor * seen, at,
                              factor * right)  # fmt: skip
            seen = np.interp(at, time, seen)
            rows.append([title, run.label, row["rms error"] / rms(factor * right),
                         np.ptp(seen) / np.ptp(right)])  # fmt: skip
        result.measure(f"{name}_range", rows[-1][3])
        result.measure(f"{name}_error", rows[-1][2])
    columns = ["curve", "run", "rms error over the rms", "range from low to high over measured"]
    result.table("Against the experiment", columns, rows)
    return result


def _seen(run):
    """Time [s] and value [m, deg] of each curve of a run, from where box and level are at rest."""
    bodies, gauges = run.table("bodies"), run.gauges
    time = bodies["time"]
    return {
        "before": (gauges["time"], gauges["before"] - run.depth),
        "behind": (gauges["time"], gauges["behind"] - run.depth),
        "heave": (time, bodies["box z"] - bodies["box z"][0]),
        "surge": (time, bodies["box x"] - bodies["box x"][0]),
        "roll": (time, -bodies["box roll"]),
    }
