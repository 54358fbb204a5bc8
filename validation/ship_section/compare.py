"""Free heave and roll of a ship section, against measured periods and linear theory."""

import numpy as np

from validation.comparison import Comparison
from validation.floating import radiation
from validation.swing import first_swing

HEAVE, ROLL = 1.17, 1.26  # s, natural periods of the experiment
BREADTH, DRAFT, BILGE = 0.40, 0.20, 0.0512  # m
MASS, CENTER = 78.87, 0.106  # kg/m, and the height of the centre of mass over the keel [m]
EXTREME = 0.02  # s before and after an extreme, over which a parabola is fitted
PANELS = 30  # on half of the section


def compare(runs):
    """The finest run of each motion is measured, all are drawn."""
    result = Comparison()
    _compare_heave(result, _sorted(runs, "heave"))
    _compare_roll(result, _sorted(runs, "roll"))
    return result


def _sorted(runs, motion):
    found = [run for name, run in runs.items() if name.startswith(motion)]
    return sorted(found, key=lambda run: -run.spacing)


def _compare_heave(result, runs):
    figure = result.figure("Free heave", "time [s]", "height / first height")
    rows = []
    for run in runs:
        bodies, rest = run.table("bodies"), run.depth - DRAFT + CENTER
        time, height = bodies["time"], bodies["section z"] - rest
        height = height / height[0]
        theory = radiation.heave(outline(), run.depth, run.gravity, MASS, run.density, time)
        seen, right = (first_swing(time, place, EXTREME) for place in (height, theory))
        rows.append([run.label, seen.crest_at, seen.crest_at / right.crest_at,
                     seen.trough / right.trough, seen.crest / right.crest])  # fmt: skip
        figure.line(run.label, time, height)
    figure.dashed("linear theory", time, theory)
    result.measure("heave_measured", seen.crest_at / HEAVE)
    result.measure("heave_period", rows[-1][2])
    result.measure("heave_trough", rows[-1][3])
    result.measure("heave_crest", rows[-1][4])
    columns = ["run", "first crest [s]", "over that of theory", "first trough over that of theory",
               "first crest over that of theory"]  # fmt: skip
    result.table("Free heave", columns, rows)
    result.note(f"Linear theory: first crest after {right.crest_at:.3f} s, {HEAVE:g} s measured.")


def outline():
    """The wetted right half of the section, from the keel up, by panels."""
    turn = np.linspace(0.0, 0.5 * np.pi, 6)
    x = np.array([0.0, *(0.5 * BREADTH - BILGE * (1.0 - np.sin(turn))), 0.5 * BREADTH])
    z = np.array([0.0, *(BILGE * (1.0 - np.cos(turn))), DRAFT])
    along = np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(z))))
    ends = np.unique(np.append(np.linspace(0.0, along[-1], PANELS + 1), along))
    points = np.interp(ends, along, x), np.interp(ends, along, z) - DRAFT
    return tuple(zip(*(p.tolist() for p in points), strict=True))


def _compare_roll(result, runs):
    figure, rows = result.figure("Free roll", "time [s]", "roll [deg]"), []
    for run in runs:
        bodies, (given,) = run.table("bodies"), run.case.solid
        time, roll = bodies["time"], bodies["section roll"] + heel(given.points)
        turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(roll))) != 0)
        period = 2.0 * np.diff(time[turns]).mean()
        decrement = np.log(roll[0] / np.abs(roll[turns[-1]])) / len(turns)
        rows.append([run.label, period, period / ROLL, decrement])
        figure.line(run.label, time, roll)
    result.measure("roll_measured", rows[-1][2])
    columns = ["run", "period [s]", "over the measured one", "decrement of half a period"]
    result.table("Free roll", columns, rows)


def heel(points):
    """Angle [deg] of the deck of the section as it is laid out, positive where it lifts its end."""
    (a, b), (c, d) = sorted(sorted(points, key=lambda point: point[1])[-2:])
    return np.degrees(np.arctan2(d - b, c - a))
