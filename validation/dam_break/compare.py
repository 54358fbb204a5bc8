"""Collapse of a column against Martin & Moyce, impact on a wall against Lobovsky et al."""

from pathlib import Path

import numpy as np
from scipy.optimize import minimize_scalar

from validation.comparison import Comparison
from validation.data import foremost, read_columns

DATA = Path(__file__).parent / "data"
BASE = 0.05715  # [m]
HEIGHT = 0.30  # [m] of the column of Lobovsky et al.
IMPACT = 0.2  # of rho g H: a pressure that says the water has come
WINDOW = 0.5  # seconds from the impact on
MEAN = 0.01  # seconds over which pressures are averaged
COMPANY = 3  # others within two spacings, without which a particle is spray


def compare(runs):
    """Fronts, levels and pressures."""
    result = Comparison()
    _compare_front(result, {n: r for n, r in runs.items() if n.startswith("martin-moyce")})
    impacts = {n: r for n, r in runs.items() if not n.startswith("martin-moyce")}
    _compare_levels(result, impacts)
    _compare_pressure(result, impacts)
    return result


def _standard(runs):
    """Name of the finest 2-D run of the recipe `standard`."""
    flat = [n for n, r in runs.items() if n != "mps" and r.case["tank"]["width"] == 0.0]
    return min(flat, key=lambda name: runs[name].spacing)


def _label(name, run):
    recipe = "mps" if name == "mps" else "standard"
    width = ", 3-D" if run.case["tank"]["width"] else ""
    return f"{recipe}{width}, d0 = {1e3 * run.spacing:.3g} mm"


def _compare_front(result, runs):
    front, height = (
        read_columns(DATA / "mm1952_n2_front.csv"),
        read_columns(DATA / "mm1952_n2_height.csv"),
    )
    place = result.figure("Front of the column, time shifted", "T = t sqrt(2g/a)", "Z = x / a")
    top = result.figure("Height at the rear wall", "t sqrt(g/a)", "height / 2a")
    measured = front["t [s]"], front["x_front [m]"] / BASE
    rows, scale = [], np.sqrt(2.0 * 9.81 / BASE)
    for name, run in runs.items():
        time, x = _front(run)
        shift, error = _fit(time, x / BASE, *measured)
        rear, level = run.gauge("rear")
        part = height["t [s]"] <= rear[-1]
        seen = np.interp(height["t [s]"][part], rear, level / (2.0 * BASE))
        miss = np.sqrt(np.mean((seen - height["H=eta/(2a) [-]"][part]) ** 2))
        place.line(_label(name, run), (time - shift) * scale, x / BASE)
        top.line(_label(name, run), rear * np.sqrt(9.81 / BASE), level / (2.0 * BASE))
        rows.append([_label(name, run), shift * scale, error, miss])
    place.points("Martin & Moyce 1952", measured[0] * scale, measured[1])
    top.points("Martin & Moyce 1952", height["tau=t*sqrt(g/a) [-]"], height["H=eta/(2a) [-]"])
    _, shift, error, miss = rows[-1]
    result.measure("shift", shift)
    result.measure("front", error)
    result.measure("height", miss)
    result.table("Column", ["run", "shift in T", "rms of Z", "rms of height / 2a"], rows)


def _front(run):
    """Time [s] and place [m] of the foremost water on the bed that is not spray."""
    rows = []
    for time, x, _ in run.water():
        low = x[x[:, 2] < 2.0 * run.spacing]
        rows.append((time, foremost(low, run.spacing, COMPANY) + 0.5 * run.spacing))
    return np.array(rows).T


def _fit(time, z, measured_time, measured_z):
    """Shift [s] to add to the measured times so that the fronts agree best, and the rms left."""

    def miss(shift):
        return np.sqrt(np.mean((np.interp(measured_time + shift, time, z) - measured_z) ** 2))

    best = minimize_scalar(miss, bounds=(-0.03, 0.03), method="bounded")
    return best.x, best.fun


def _compare_levels(result, runs):
    data = read_columns(DATA / "lobovsky2014_levels_H300.csv")
    finest, rows = _standard(runs), []
    for gauge in ("H1", "H2", "H3", "H4"):
        columns = [name for name in data if name.startswith(gauge)]
        figure = result.figure(f"Level at {gauge}", "time [s]", "level / H")
        for name, run in runs.items():
            time, level = run.gauge(gauge)
            level = np.nan_to_num(level) / HEIGHT
            figure.line(_label(name, run), time, level)
            part = data["t [s]"] <= time[-1]
            seen = np.interp(data["t [s]"][part], time, level)
            error = [seen - data[c][part] for c in columns]
            rows.append([gauge, _label(name, run), float(np.sqrt(np.mean(np.square(error)))),
                         float(np.mean(error)), name])  # fmt: skip
        for name in columns:
            part = data["t [s]"] <= time[-1]
            figure.dashed(
                f"experiment {name.split()[0][-7:]}", data["t [s]"][part], data[name][part]
            )
    result.measure("levels", max(row[2] for row in rows if row[-1] == finest))
    result.table("Levels", ["gauge", "run", "rmse / H", "bias / H"], [row[:-1] for row in rows])


def _compare_pressure(result, runs):
    band = read_columns(DATA / "lobovsky2014_pressure_sensor2_H300_percentiles_1ms.csv")
    event = read_columns(DATA / "lobovsky2014_pressure_H300_event5_1ms.csv")
    time = band["t [s]"]
    low, median, high = (_mean(time, band[name]) for name in list(band)[2:])
    came = _arrival(time, median)
    figure = result.figure("Pressure at sensor 2, mean over 10 ms, from the impact on",
                           "time from the impact [s]", "p / (rho g H)")  # fmt: skip
    figure.band("experiment, 2.5 to 97.5 %", *_part(time - came, low, high))
    figure.dashed("experiment, median", *_part(time - came, median))
    finest, rows = _standard(runs), []
    for name, run in runs.items():
        seen, pressure = run.pressure("P2")
        pressure = np.nan_to_num(pressure) / (run.density * run.gravity * HEIGHT)
        pressure = _mean(time, np.interp(time, seen, pressure))
        hit = _arrival(time, pressure)
        moved = np.interp(time - came + hit, time, pressure)
        window = (time >= came) & (time <= came + WINDOW) & (time - came + hit <= seen[-1])
        impulse = np.trapezoid(moved[window]) / np.trapezoid(median[window])
        inside = np.mean((moved >= low)[window] & (moved <= high)[window])
        figure.line(_label(name, run), *_part(time - hit, pressure))
        rows.append([_label(name, run), 1e3 * (hit - came), impulse, inside])
        if name == finest:
            result.measure("arrival", 1e3 * (hit - came))
            result.measure("impulse", impulse)
            result.measure("inside", inside)
    columns = ["run", "impact after the median's [ms]", "impulse over the median's", "share inside"]
    result.table("Pressure at sensor 2", columns, rows)
    _draw_sensors(result, runs[finest], event)


def _draw_sensors(result, run, event):
    for probe, column in zip(("P1", "P3", "P4"), (2, 5, 6), strict=True):
        figure = result.figure(f"Pressure at {probe}, one event", "time [s]", "p / (rho g H)")
        time, pressure = run.pressure(probe)
        figure.line("standard", time, pressure / (run.density * run.gravity * HEIGHT))
        part = event["t [s]"] <= time[-1]
        figure.dashed("experiment", event["t [s]"][part], event[list(event)[column]][part])


def _arrival(time, pressure):
    """When the water hits [s]; NaN if it does not."""
    hit = np.flatnonzero(pressure > IMPACT)
    return time[hit[0]] if len(hit) else np.nan


def _mean(time, values):
    """Running mean over 10 ms of values at equal steps of time."""
    count = max(round(MEAN / (time[1] - time[0])), 1)
    return np.convolve(values, np.full(count, 1.0 / count), "same")


def _part(time, *values):
    """Time and values in the window."""
    part = (time >= -0.05) & (time <= WINDOW)
    return time[part], *(v[part] for v in values)
