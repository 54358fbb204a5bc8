"""Harmonics along a bar."""

from pathlib import Path

import numpy as np

from validation.comparison import Comparison
from validation.wave_analysis import harmonics

DATA = Path(__file__).parent / "data" / "beji_battjes_luth_bar_caseA.csv"
PERIODS = 2  # of the simulation, the last ones
MEASURED_FROM, MEASURED_PERIODS = 20.0, 5  # seconds; the record is steady
BEHIND = 14.0  # [m]


def compare(runs):
    """Amplitudes of the first three harmonics at the gauges."""
    result = Comparison()
    (run,) = runs.values()
    period, height = run.case["wavemaker"]["period"], run.case["wavemaker"]["height"]
    x = np.array([gauge["x"] for gauge in run.case["gauge"]])
    start = run.case["time"]["end"] - (PERIODS + 0.1) * period
    seen = np.array([
        np.abs(harmonics(*run.gauge(gauge["name"]), period, start, PERIODS)[1:4])
        for gauge in run.case["gauge"]
    ])  # fmt: skip
    measured = np.array([_measured(place, period) for place in x])
    for order, name in enumerate(("First", "Second", "Third")):
        figure = result.figure(f"{name} harmonic", "x [m]", "amplitude [mm]")
        figure.line(f"standard, d0 = {1e3 * run.spacing:.3g} mm", x, 1e3 * seen[:, order])
        figure.points("Luth et al. 1994", x, 1e3 * measured[:, order])
    behind = x > BEHIND
    error = (seen - measured)[~behind, 0]
    result.measure("first", np.sqrt(np.mean(error**2)) / height)
    result.measure("second", (seen[behind, 1] / measured[behind, 1]).mean())
    result.measure("third", (seen[behind, 2] / measured[behind, 2]).mean())
    columns = ["x [m]", *(f"{n} harmonic{w} [mm]" for w in ("", ", measured") for n in (1, 2, 3))]
    rows = np.column_stack([x, 1e3 * seen, 1e3 * measured]).tolist()
    result.table("Harmonics", columns, rows)
    return result


def _measured(place, period):
    """Amplitudes of the first three harmonics at a gauge of the experiment [m]."""
    table = np.loadtxt(DATA, delimiter=",", skiprows=1)
    _, time, level = table[np.isclose(table[:, 0], place)].T
    return np.abs(harmonics(time, level, period, MEASURED_FROM, MEASURED_PERIODS)[1:4])
