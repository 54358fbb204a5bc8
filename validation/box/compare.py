"""Levels and pressures of a dam break onto a box."""

from pathlib import Path

import numpy as np

from validation.comparison import Comparison
from validation.data import read_columns

DATA = Path(__file__).parent / "data" / "spheric2_kleefsman2005.csv"
IMPACT = 500.0  # [Pa] at P1: the water has come
WINDOW = 0.5  # seconds from the impact on


def compare(runs):
    """Levels, impact and impulses of the one run."""
    result = Comparison()
    (run,) = runs.values()
    data = read_columns(DATA)
    _compare_levels(result, run, data)
    _compare_pressures(result, run, data)
    return result


def _compare_levels(result, run, data):
    rows = []
    for gauge in run.case["gauge"]:
        time, level = run.gauge(gauge["name"])
        level = np.nan_to_num(level)
        part = data["t [s]"] <= time[-1]
        measured = data[f"depth_{gauge['name']} [m]"][part]
        error = np.interp(data["t [s]"][part], time, level) - measured
        rows.append([gauge["name"], np.sqrt(np.mean(error**2)) / run.depth,
                     error.mean() / run.depth])  # fmt: skip
        figure = result.figure(f"Level at {gauge['name']} m", "time [s]", "level [m]")
        figure.line(f"standard, d0 = {1e3 * run.spacing:.3g} mm", time, level)
        figure.dashed("Kleefsman et al. 2005", data["t [s]"][part], measured)
    result.measure("levels", max(row[1] for row in rows))
    result.table("Levels", ["gauge", "rmse / column", "bias / column"], rows)


def _compare_pressures(result, run, data):
    measured_time = data["t [s]"]
    came, hit = _arrival(measured_time, data["P1 [Pa]"]), _arrival(*run.pressure("P1"))
    result.measure("arrival", 1e3 * (hit - came))
    rows, ratios = [], {}
    for probe in run.case["probe"]:
        name = probe["name"]
        time, pressure = run.pressure(name)
        pressure = np.nan_to_num(pressure)
        measured = data[f"{name} [Pa]"]
        pushes = _impulse(time, pressure, hit), _impulse(measured_time, measured, came)
        ratios[name] = pushes[0] / pushes[1]
        rows.append([name, pressure.max(), measured.max(), *pushes, ratios[name]])
        figure = result.figure(f"Pressure at {name}", "time [s]", "pressure [Pa]")
        figure.line(f"standard, d0 = {1e3 * run.spacing:.3g} mm", time, pressure)
        part = measured_time <= time[-1]
        figure.dashed("Kleefsman et al. 2005", measured_time[part], measured[part])
    result.measure("impulse", ratios["P1"])
    result.measure("impulse_top", 0.5 * (ratios["P5"] + ratios["P6"]))
    columns = ["probe", "peak [Pa]", "measured", "impulse [Pa s]", "measured", "ratio"]
    result.table("Pressures", columns, rows)


def _arrival(time, pressure):
    """When the water hits [s]; NaN if it does not."""
    hit = np.flatnonzero(np.nan_to_num(pressure) > IMPACT)
    return time[hit[0]] if len(hit) else np.nan


def _impulse(time, pressure, start):
    """Integral of the pressure over the window [Pa s]."""
    part = (time >= start) & (time <= start + WINDOW)
    return np.trapezoid(pressure[part], time[part])
