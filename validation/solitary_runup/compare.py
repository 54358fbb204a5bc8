"""Run-up and profiles of solitary waves against Synolakis (1987)."""

from pathlib import Path

import numpy as np

from mpslab import gauges
from validation.comparison import Comparison
from validation.data import foremost

DATA = Path(__file__).parent / "data"
TIMES = (15, 20, 25, 30)  # of the measured profiles, in sqrt(d/g)
COMPANY = 1  # others within two spacings: the tip of a row has one or two, spray has none


def compare(runs):
    """Run-up of all runs, profiles of the finest with H/d = 0.30."""
    result = Comparison()
    high = {name: run for name, run in runs.items() if name.startswith("0.30")}
    finest = list(high.values())[-1]
    rows = []
    for name, run in runs.items():
        asked, depth = run.case["wavemaker"]["height"] / run.depth, run.depth
        _, height = _crest(run)
        runup = _runup(run) / depth
        law = _law(asked, _cot(run))
        rows.append([name, asked, height / depth / asked, runup, law, runup / law])
    by_name = {row[0]: row for row in rows}
    result.measure("runup_30", by_name[list(high)[-1]][-1])
    result.measure("incident_30", by_name[list(high)[-1]][2])
    for name, metric in (("0.10-2mm", "runup_10"), ("steep-2mm", "runup_steep")):
        if name in runs:
            result.measure(metric, by_name[name][-1])
    columns = ["run", "H/d asked for", "at X1, ratio", "R/d", "law", "ratio"]
    result.table("Run-up", columns, rows)
    _draw_law(result, [row for row in rows if not row[0].startswith("steep")])
    _compare_profiles(result, finest)
    return result


def _law(height, cot):
    """Run-up over depth of a wave that breaks and of one that does not, Synolakis (1987)."""
    if height > 0.8183 * cot ** (-10 / 9):
        return _breaking(height)
    return 2.831 * np.sqrt(cot) * height**1.25


def _breaking(height):
    return 1.109 * height**0.582


def _crest(run):
    """When the crest passes X1 [s], and its height there [m]."""
    time, level = run.gauge("X1")
    top = np.argmax(level)
    return time[top], level[top] - run.depth


def _cot(run):
    """Length of the beach over its height."""
    _, (toe, low), (end, high) = run.case["tank"]["bed"]
    return (end - toe) / (high - low)


def _shoreline(run):
    """x of the still shoreline [m]."""
    _, (toe, _), _ = run.case["tank"]["bed"]
    return toe + _cot(run) * run.depth


def _runup(run):
    """Highest place above still water that water with others around it reached [m]."""
    shore = _shoreline(run)
    x = max(foremost(p[p[:, 0] > shore - 0.05], run.spacing, COMPANY) for _, p, _ in run.water())
    return (x - shore) / _cot(run)


def _draw_law(result, rows):
    data = np.loadtxt(DATA / "synolakis1987_bp4_runup.csv", delimiter=",", skiprows=1)
    breaking = data[:, 0] > 0.05
    figure = result.figure("Run-up of breaking waves", "H / d", "R / d")
    figure.points("Synolakis 1987", data[breaking, 0], data[breaking, 1])
    heights = np.linspace(0.05, 0.6, 50)
    figure.dashed("1.109 (H/d)^0.582", heights, _breaking(heights))
    for name, height, ratio, runup, *_ in rows:
        figure.points(f"standard, {name}", [height * ratio], [runup])


def _compare_profiles(result, run):
    data = np.loadtxt(DATA / "synolakis1987_bp4_profiles.csv", delimiter=",", skiprows=1)
    data = data[data[:, 0] == 0.3]
    came, _ = _crest(run)
    unit, errors, rows = np.sqrt(run.depth / run.gravity), [], []
    for time in TIMES:
        moment, frame = run.frame_at(came + time * unit)
        x, eta = data[data[:, 1] == time][:, 2:].T
        place = _shoreline(run) - x * run.depth
        bed = (place - _shoreline(run)) / _cot(run) + run.depth
        seen = (_levels(run, frame, place, bed) - run.depth) / run.depth
        error = np.sqrt(np.mean((seen - eta) ** 2))
        errors.append(error)
        rows.append([time, (moment - came) / unit, error, np.mean(seen - eta)])
        title = f"Profile at t = {time} sqrt(d/g)"
        figure = result.figure(title, "distance from the shoreline / d", "elevation / d")
        order = np.argsort(x)
        figure.line(f"standard, d0 = {1e3 * run.spacing:.3g} mm", x[order], seen[order])
        figure.points("Synolakis 1987", x, eta)
    result.measure("profiles_30", np.mean(errors))
    result.table("Profiles", ["t/sqrt(d/g)", "of the frame", "rmse / d", "bias / d"], rows)


def _levels(run, frame, places, bed):
    """Level at each place [m], the bed where it is dry."""
    position = frame["position"].astype(float)
    levels = [gauges.surface_elevation(position, frame["kind"], run.spacing, x) for x in places]
    levels = np.array(levels)
    return np.where(np.isfinite(levels), levels, np.maximum(bed, 0.0))
