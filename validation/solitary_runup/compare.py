"""Run-up and profiles of solitary waves against Synolakis (1987)."""

from pathlib import Path

import numpy as np

from mpslab.core import gauges
from mpslab.theory import waves
from validation.comparison import Comparison
from validation.data import foremost

DATA = Path(__file__).parent / "data"
TIMES = (15, 20, 25, 30)  # of the measured profiles, in sqrt(d/g)
COT = 19.85  # of the measured beach
SMOOTH_SHARE = (0.80, 1.04)  # of the law, that the waves below 0.03 ran up: 0.92 +- 0.12
TOP = 0.9  # of the crest, from where the parabola is fitted
COMPANY = 1  # others within two spacings: the tip of a row has one or two, spray has none
OTHERS = (1, 2, 3)  # of those, that a table gives the run-up for

GAP = (
    "A gap: no run of a wave that does not break on 1:19.85. The one with measured profiles, H/d = "
    "0.0185, would be 0.55 particles high at 2 mm; four particles take about 200 spacings over the "
    "depth, two about 100. The law is held against a wave on 1:5 instead, in the full suite."
)
BETWEEN = (
    "The frames are 0.05 s, or 0.64 sqrt(d/g), apart; profiles are interpolated between the two "
    "next to the wanted time. A wave of 0.30 d that goes 0.73 d between them is cut by 0.01 d at "
    "its crest by that; a vertical front becomes a slope as long."
)


def compare(runs):
    """Run-up of all runs, profiles of the finest with H/d = 0.30."""
    result = Comparison()
    rows = {name: _row(name, run) for name, run in runs.items()}
    finest = {wave: _finest(runs, wave) for wave in ("0.30", "0.10", "steep")}
    for wave, metric in (("0.30", "runup_30"), ("0.10", "runup_10"), ("steep", "runup_steep")):
        if finest[wave]:
            result.measure(metric, rows[finest[wave]][-1])
    incident = [rows[name][2] for name in finest.values() if name]
    result.measure("incident", max(incident, key=lambda ratio: abs(np.log(ratio))))
    columns = ["run", "H/d asked for", "at X1, ratio", "R/d", "law", "ratio"]
    result.table("Run-up", columns, list(rows.values()))
    columns = ["run", *(f"R/d, {k} others within two spacings" for k in OTHERS)]
    result.table("What counts as water in the run-up", columns, [
        [name, *(_runup(run, k) / run.depth for k in OTHERS)] for name, run in runs.items()
    ])  # fmt: skip
    for wave, title in (("0.30", "H/d = 0.30 on 1:19.85"), ("steep", "H/d = 0.10 on 1:5")):
        _converge(result, title, [(run.spacing, rows[name][-1]) for name, run in runs.items()
                                  if name.startswith(wave)])  # fmt: skip
    data = np.loadtxt(DATA / "synolakis1987_bp4_runup.csv", delimiter=",", skiprows=1)
    _draw_breaking(result, data, [r for n, r in rows.items() if not n.startswith("steep")])
    _draw_smooth(result, data, {n: (r, rows[n]) for n, r in runs.items() if n.startswith("steep")})
    _compare_profiles(result, runs[finest["0.30"]])
    result.note(GAP)
    return result


def _row(name, run):
    """Line of the table of run-ups."""
    asked, runup = run.case.wavemaker.height / run.depth, _runup(run) / run.depth
    law = _law(asked, _cot(run))
    return [name, asked, _crest(run)[1] / run.depth / asked, runup, law, runup / law]


def _finest(runs, wave):
    """Name of the finest run of a wave; None if there is none."""
    names = [name for name in runs if name.startswith(wave)]
    return min(names, key=lambda name: runs[name].spacing, default=None)


def _converge(result, title, found):
    """Order of the run-up, from pairs of spacing and ratio to the law."""
    if len(found) > 1:
        spacing, ratio = np.array(found).T
        result.converge(f"Run-up over the law, less one, {title}", spacing, ratio - 1.0)


def _law(height, cot):
    """Run-up over depth of a wave that breaks and of one that does not, Synolakis (1987)."""
    if height > 0.8183 * cot ** (-10 / 9):
        return _breaking(height)
    return 2.831 * np.sqrt(cot) * height**1.25


def _breaking(height):
    return 1.109 * height**0.582


def _crest(run):
    """When the crest passes X1 [s], and its height there [m], by a parabola through its top.

    Looked for from when the wave has come to half its height until it could be back from the toe.
    """
    gauge, height = run.case.gauge[0], run.case.wavemaker.height
    time, level = run.gauge(gauge.name)
    speed = waves.solitary_celerity(height, run.depth, run.gravity)
    came = time[np.argmax(level - run.depth > 0.5 * height)]
    part = (time >= came) & (time <= came + 2.0 * (_toe(run) - gauge.x) / speed)
    time, level = time[part], level[part] - run.depth
    top = level > TOP * level.max()
    middle = time[top].mean()
    a, b, c = np.polyfit(time[top] - middle, level[top], 2)
    return middle - 0.5 * b / a, c - 0.25 * b**2 / a


def _toe(run):
    """x of the toe of the beach [m]."""
    return run.case.tank.bed[1][0]


def _cot(run):
    """Length of the beach over its height."""
    _, (toe, low), (end, high) = run.case.tank.bed
    return (end - toe) / (high - low)


def _shoreline(run):
    """x of the still shoreline [m]."""
    return _toe(run) + _cot(run) * run.depth


def _runup(run, others=COMPANY):
    """Highest place above still water that water with others around it holds in two frames running
    [m]; a lone particle that slides ahead may meet another in one.
    """
    shore = _shoreline(run)
    places = (position[position[:, 0] > shore - 0.05] for _, position, _ in run.water())
    x = np.array([foremost(place, run.spacing, others) for place in places])
    return (np.minimum(x[1:], x[:-1]).max() - shore) / _cot(run)


def _draw_breaking(result, data, rows):
    """Law and measurements of waves that break, (n, 2) H/d and R/d, and the runs."""
    high = data[:, 0] > 0.05
    figure = result.figure("Run-up of breaking waves", "H / d", "R / d")
    figure.points("Synolakis 1987", data[high, 0], data[high, 1])
    heights = np.linspace(0.05, 0.6, 50)
    figure.dashed("1.109 (H/d)^0.582", heights, _breaking(heights))
    for name, height, ratio, runup, *_ in rows:
        figure.points(f"standard, {name}", [height * ratio], [runup])


def _draw_smooth(result, data, runs):
    """Law and measurements of waves that do not break, whatever the slope, and the runs."""
    low = data[:, 0] < 0.03
    title = "Run-up of waves that do not break"
    figure = result.figure(title, "H / d", "R / (d sqrt(cot beta))")
    heights = np.linspace(0.0, 0.11, 100)
    law = 2.831 * heights**1.25
    low_share, high_share = SMOOTH_SHARE
    figure.band("measured on 1:19.85", heights, low_share * law, high_share * law)
    figure.dashed("2.831 (H/d)^(5/4)", heights, law)
    figure.points("Synolakis 1987", data[low, 0], data[low, 1] / np.sqrt(COT))
    for name, (run, (_, height, ratio, runup, *_)) in runs.items():
        figure.points(f"standard, {name}", [height * ratio], [runup / np.sqrt(_cot(run))])


def _compare_profiles(result, run):
    data = np.loadtxt(DATA / "synolakis1987_bp4_profiles.csv", delimiter=",", skiprows=1)
    data = data[data[:, 0] == 0.3]
    came, _ = _crest(run)
    unit, errors = np.sqrt(run.depth / run.gravity), []
    for time in TIMES:
        x, eta = data[data[:, 1] == time][:, 2:].T
        order = np.argsort(x)
        x, eta = x[order], eta[order]
        seen = _profile(run, came + time * unit, _shoreline(run) - x * run.depth) / run.depth
        figure = result.figure(
            f"Profile at t = {time} sqrt(d/g)", "distance from the shoreline / d", "elevation / d"
        )
        figure.line(f"standard, d0 = {1e3 * run.spacing:.3g} mm", x, seen)
        figure.points("Synolakis 1987", x, eta)
        errors.append(result.hold(f"profile at t = {time} sqrt(d/g) [d], [d]", x, seen, x, eta))
    result.measure("profiles_30", np.mean([error["rms error"] for error in errors]))
    result.note(BETWEEN)


def _profile(run, moment, places):
    """Elevation at places [m] at a time, between those of the frames before and after it [m]."""
    times = run.frames.times
    after = np.searchsorted(times, moment)
    bed = (places - _shoreline(run)) / _cot(run) + run.depth
    earlier, later = (
        _levels(run, frame, places, bed) for frame in run.frames[after - 1 : after + 1]
    )
    share = (moment - times[after - 1]) / (times[after] - times[after - 1])
    return earlier + share * (later - earlier) - run.depth


def _levels(run, frame, places, bed):
    """Level at each place [m], the bed where it is dry."""
    position = frame["position"].astype(float)
    levels = [gauges.surface_elevation(position, frame["kind"], run.spacing, x) for x in places]
    levels = np.array(levels)
    return np.where(np.isfinite(levels), levels, np.maximum(bed, 0.0))
