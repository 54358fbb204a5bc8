"""First harmonic along a flat tank."""

import numpy as np

from mpslab.waves import group_celerity, wavelength
from validation.comparison import Comparison
from validation.wave_analysis import decay, harmonics

PERIODS = 2  # that harmonics are taken over at least
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
LENGTHS = {"height-5": 2.0, "height-10": 5.0, "height-20": 5.0}  # over which the loss is told


def compare(runs):
    """Decay of the first harmonic, from one wavelength off the piston on."""
    result = Comparison()
    figure = result.figure("First harmonic along the tank", "x / L", "first harmonic / (H / 2)")
    rows = []
    for name, run in runs.items():
        particles, over = name.removeprefix("height-"), LENGTHS[name]
        length, x, first, second, periods = _along(run)
        used = np.isfinite(first) & (x < (1.05 + over) * length)
        rate, start, error = decay(x[used], first[used])
        lost = 100.0 * (1.0 - np.exp(-rate * over * length))
        half = 0.5 * run.case["wavemaker"]["height"]
        result.measure(f"lost_{particles}", lost)
        result.measure(f"generated_{particles}", first[0] / half)
        figure.points(f"{particles} particles over the height", x / length, first / half)
        label = (
            f"fit: {lost:.2g} % over {over:g} L, standard error {100 * error * over * length:.1g} %"
        )
        figure.line(label, x[used] / length, start * np.exp(-rate * x[used]) / half)
        rows += [
            [name, a / length, 1e3 * b, 1e3 * c, n]
            for a, b, c, n in zip(x, first, second, periods, strict=True)
        ]
    figure.dashed("no loss", [1.0, max(row[1] for row in rows)], [1.0, 1.0])
    columns = ["run", "x / L", "first harmonic [mm]", "second harmonic [mm]", "over periods"]
    result.table("Harmonics at the gauges", columns, rows)
    return result


def _along(run):
    """Wavelength [m], places x [m], first and second harmonics [m], periods: (n,) each.

    Each gauge is read from when the wave has come, at the speed of its group, until what the toe of
    the beach reflects comes back, or the run ends; harmonics are taken over the last whole periods.
    """
    maker, period = run.case["wavemaker"], run.case["wavemaker"]["period"]
    speed = group_celerity(period, run.depth, run.gravity)
    toe, rows = run.case["tank"]["bed"][1][0], []
    for gauge in run.case["gauge"]:
        x, (time, level) = gauge["x"], run.gauge(gauge["name"])
        came = maker["start"] + SETTLE * period + x / speed
        end = min(maker["start"] + (2.0 * toe - x) / speed, time[-1])
        periods = int((end - came) / period + 0.3)
        found = np.full(3, np.nan)
        if periods >= PERIODS:
            found = harmonics(time, level, period, end - periods * period, periods)
        rows.append((x, *np.abs(found[1:3]), periods))
    x, first, second, periods = np.array(rows).T
    return wavelength(period, run.depth, run.gravity), x, first, second, periods
