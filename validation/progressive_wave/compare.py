"""First harmonic along a flat tank."""

import numpy as np

from mpslab.waves import group_celerity, wavelength
from validation.comparison import Comparison
from validation.wave_analysis import decay, harmonics

PERIODS = 2  # that harmonics are taken over
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
LENGTHS = {"height-5": 2.0, "height-10": 5.0, "height-20": 5.0}  # over which the loss is told


def compare(runs):
    """Decay of the first harmonic."""
    result = Comparison()
    figure = result.figure("First harmonic along the tank", "x / L", "first harmonic / (H / 2)")
    rows = []
    for name, run in runs.items():
        particles = name.removeprefix("height-")
        length, x, first, second = _along(run)
        steady = np.isfinite(first)
        rate, start = decay(x[steady], first[steady])
        lost = 100.0 * (1.0 - np.exp(-rate * LENGTHS[name] * length))
        half = 0.5 * run.case["wavemaker"]["height"]
        result.measure(f"lost_{particles}", lost)
        result.measure(f"generated_{particles}", first[0] / half)
        label = f"{particles} particles over the height"
        figure.points(label, x / length, first / half)
        figure.line(f"fit: {lost:.2g} % over {LENGTHS[name]:g} L", x / length,
                    start * np.exp(-rate * x) / half)  # fmt: skip
        rows += [
            [name, a / length, 1e3 * b, 1e3 * c] for a, b, c in zip(x, first, second, strict=True)
        ]
    figure.dashed("no loss", [1.0, max(row[1] for row in rows)], [1.0, 1.0])
    columns = ["run", "x / L", "first harmonic [mm]", "second harmonic [mm]"]
    result.table("Harmonics at the gauges", columns, rows)
    return result


def _along(run):
    """Wavelength [m], places x (n,) [m], first and second harmonics (n,) [m] of a run.

    Each gauge has its own time: the wave has to have come there, at the speed of its group.
    """
    maker = run.case["wavemaker"]
    period, depth = maker["period"], run.depth
    speed = group_celerity(period, depth, run.gravity)
    rows = []
    for gauge in run.case["gauge"]:
        time, level = run.gauge(gauge["name"])
        came = maker["start"] + SETTLE * period + gauge["x"] / speed
        found = harmonics(time, level, period, min(came, time[-1] - PERIODS * period), PERIODS)
        late = came + PERIODS * period > time[-1] + 0.3 * period
        rows.append((gauge["x"], *(np.full(2, np.nan) if late else np.abs(found[1:3]))))
    x, first, second = np.array(rows).T
    return wavelength(period, depth, run.gravity), x, first, second
