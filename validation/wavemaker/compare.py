"""The waves that the piston makes against the theories it follows."""

import numpy as np

from mpslab import waves
from validation.comparison import Comparison
from validation.wave_analysis import harmonics

PERIODS = 2  # that harmonics are taken over
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
REACH = 2.0  # to either side of the crest, in units of 1/k: there sech^2 is 0.07


def compare(runs):
    """Regular waves by depth, and the solitary wave."""
    result = Comparison()
    _compare_regular(result, {n: run for n, run in runs.items() if n.startswith("kh")})
    _compare_solitary(result, {n: run for n, run in runs.items() if n.startswith("solitary")})
    return result


def _compare_regular(result, runs):
    figure = result.figure("Regular waves one wavelength from the piston", "t / T", "level / H")
    rows = []
    for name, run in runs.items():
        maker, (gauge,) = run.case["wavemaker"], run.case["gauge"]
        time, level = run.gauge(gauge["name"])
        period, height = maker["period"], maker["height"]
        speed = waves.group_celerity(period, run.depth, run.gravity)
        came = maker["start"] + SETTLE * period + gauge["x"] / speed
        found = harmonics(time, level - run.depth, period, came, PERIODS)
        figure.line(name.replace("-", " = "), time / period, (level - run.depth) / height)
        rows.append([name, 1e3 * height, 2e3 * abs(found[1]), 2.0 * abs(found[1]) / height])
    worst = max((row[-1] for row in rows), key=lambda ratio: abs(np.log(ratio)))
    result.measure("biesel", worst)
    columns = ["run", "asked for [mm]", "twice the first harmonic [mm]", "ratio"]
    result.table("Biesel's transfer function", columns, rows)


def _compare_solitary(result, runs):
    finest = list(runs)[-1]
    figure = result.figure(
        "Solitary wave, 20 depths from the piston", "c (t - t_crest) / d", "level / H"
    )
    rows = []
    for name, run in runs.items():
        height, depth = run.case["wavemaker"]["height"], run.depth
        crests = {g["name"]: _crest(*run.gauge(g["name"]), depth) for g in run.case["gauge"]}
        celerity = waves.solitary_celerity(height, depth, run.gravity)
        speed = 10.0 * depth / (crests["20d"][0] - crests["10d"][0])
        moment, top = crests["20d"]
        time, level = run.gauge("20d")
        x = celerity * (time - moment)
        near = np.abs(x) < REACH / waves.solitary_wave_number(height, depth)
        own = waves.solitary_elevation(x, top, depth)
        shape = np.sqrt(np.mean((level[near] - depth - own[near]) ** 2)) / top
        label = f"standard, d0 = d / {depth / run.spacing:.0f}"
        figure.line(label, x[near] / depth, (level[near] - depth) / height)
        rows.append([label, *(crest[1] / height for crest in crests.values()), speed / celerity,
                     100.0 * shape])  # fmt: skip
        if name == finest:
            theory = waves.solitary_elevation(x[near], height, depth) / height
            figure.dashed("sech^2", x[near] / depth, theory)
            result.measure("solitary_height", top / height)
            result.measure("solitary_speed", speed / celerity)
            result.measure("solitary_shape", 100.0 * shape)
    columns = ["run", *(f"height at {g}" for g in crests), "speed ratio", "shape [% of H]"]
    result.table("Solitary wave over theory", columns, rows)


def _crest(time, level, depth):
    """When the crest passes a gauge [s], and its height over still water [m], by a parabola."""
    level = np.where(np.isfinite(level), level - depth, 0.0)
    top = np.argmax(level)
    near = level > 0.9 * level[top]
    near &= np.abs(time - time[top]) < 0.1
    a, b, c = np.polyfit(time[near] - time[top], level[near], 2)
    return time[top] - 0.5 * b / a, c - 0.25 * b**2 / a
