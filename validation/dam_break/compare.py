"""Collapse of a column against Martin & Moyce, impact on a wall against Lobovsky et al."""

from pathlib import Path

import numpy as np
from scipy.optimize import minimize_scalar

from validation.comparison import Comparison, rms
from validation.data import foremost, read_columns

DATA = Path(__file__).parent / "data"
BASE = 0.05715  # [m]
HEIGHT = 0.30  # [m] of the column of Lobovsky et al.
IMPACT = 0.2  # of rho g H: a pressure that says the water has come
WINDOW = 0.5  # seconds from the impact on
MEAN = 0.01  # seconds over which pressures are averaged
COMPANY = 3  # others within two spacings, without which a particle is spray
GAUGES = ("H1", "H2", "H3", "H4")
SENSORS = ("P1", "P2", "P3", "P4")
BESIDE = ("mps", "paper", "lobovsky-smooth")  # not judged; the others are of `standard`


def compare(runs):
    """Fronts, levels and pressures."""
    result = Comparison()
    runs = {name: run for name, run in runs.items() if len(run.steps)}
    _compare_front(result, {n: r for n, r in runs.items() if n.startswith("martin-moyce")})
    impacts = {n: r for n, r in runs.items() if not n.startswith("martin-moyce")}
    _compare_levels(result, impacts)
    _compare_pressure(result, impacts)
    return result


def _from_coarse_to_fine(runs):
    """Runs by name, the finest last."""
    return dict(sorted(runs.items(), key=lambda pair: -pair[1].spacing))


def _standard(runs):
    """The 2-D runs of the recipe `standard` by name, the finest last."""
    flat = {n: r for n, r in runs.items() if n not in BESIDE and r.case.tank.width == 0.0}
    return _from_coarse_to_fine(flat)


def _label(run):
    """Recipe, spacing, and whether walls have no friction."""
    return run.label + (", no friction" if run.case.scheme.wall_slip else "")


def _converge(result, title, runs, errors):
    """Tell how errors (n,) of runs by name fall with the spacing, where there are several."""
    if len(runs) > 1:
        result.converge(title, [run.spacing for run in runs.values()], errors)


def _compare_front(result, runs):
    front, height = (
        read_columns(DATA / "mm1952_n2_front.csv"),
        read_columns(DATA / "mm1952_n2_height.csv"),
    )
    place = result.figure("Front of the column, time shifted", "T = t sqrt(2g/a)", "Z = x / a")
    top = result.figure("Height at the rear wall", "t sqrt(g/a)", "height / 2a")
    measured = front["t [s]"], front["x_front [m]"] / BASE
    heights = height["t [s]"], height["H=eta/(2a) [-]"]
    rows, scale, runs = [], np.sqrt(2.0 * 9.81 / BASE), _from_coarse_to_fine(runs)
    for run in runs.values():
        time, x = _front(run)
        shift, error = _fit(time, x / BASE, *measured)
        rear, level = run.gauge("rear")
        part = heights[0] <= rear[-1]
        seen = np.interp(heights[0][part], rear, level / (2.0 * BASE))
        place.line(run.label, (time - shift) * scale, x / BASE)
        top.line(run.label, rear * np.sqrt(9.81 / BASE), level / (2.0 * BASE))
        rows.append([run.label, shift * scale, error, rms(seen - heights[1][part])])
    place.points("Martin & Moyce 1952", measured[0] * scale, measured[1])
    top.points("Martin & Moyce 1952", height["tau=t*sqrt(g/a) [-]"], heights[1])
    _, shift, error, miss = rows[-1]
    result.measure("shift", shift)
    result.measure("front", error)
    result.measure("height", miss)
    result.hold("front of the column, moved by the fitted shift in time [a], [s]",
                time - shift / scale, x / BASE, *measured)  # fmt: skip
    result.hold("height of the column at the rear wall [2a], [s]",
                rear, level / (2.0 * BASE), *heights)  # fmt: skip
    _converge(result, "Front of the column [a]", runs, [row[2] for row in rows])
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
        return rms(np.interp(measured_time + shift, time, z) - measured_z)

    best = minimize_scalar(miss, bounds=(-0.03, 0.03), method="bounded")
    return best.x, best.fun


def _compare_levels(result, runs):
    data = read_columns(DATA / "lobovsky2014_levels_H300.csv")
    standard = _standard(runs)
    finest = list(standard)[-1]
    end = runs[finest].gauge("H1")[0][-1]
    shown = data["t [s]"] <= end
    errors = {name: [] for name in runs}
    for gauge in GAUGES:
        repeats = {name: data[name] for name in data if name.startswith(gauge)}
        figure = result.figure(f"Level at {gauge}", "time [s]", "level / H")
        for name, run in runs.items():
            time, level = run.gauge(gauge)
            level = np.nan_to_num(level) / HEIGHT
            figure.line(_label(run), time, level)
            part = data["t [s]"] <= time[-1]
            seen = np.interp(data["t [s]"][part], time, level)
            errors[name].append(rms([seen - repeat[part] for repeat in repeats.values()]))
            if name == finest:
                label = f"level at {gauge}, mean of the repeats [H], [s]"
                mean = np.mean(list(repeats.values()), axis=0)
                result.hold(label, time, level, data["t [s]"], mean)
        for name, repeat in repeats.items():
            figure.dashed(f"experiment {name.split()[0][-7:]}", data["t [s]"][shown], repeat[shown])
    result.measure("levels", max(errors[finest]))
    _converge(result, "Levels, mean of four gauges [H]", standard,
              [np.mean(errors[name]) for name in standard])  # fmt: skip
    rows = [[_label(run), *errors[name], np.mean(errors[name])] for name, run in runs.items()]
    apart = f"experiment, its repeats from each other to {end:.3g} s"
    rows.append([apart, *(_repeat(data, gauge, shown) for gauge in GAUGES), np.nan])
    result.table("Levels: rms difference from the experiment / H", ["run", *GAUGES, "mean"], rows)


def _repeat(data, gauge, part):
    """Rms difference between the two runs of the experiment at a gauge; NaN if there is one."""
    repeats = [data[name][part] for name in data if name.startswith(gauge)]
    return rms(repeats[0] - repeats[1]) if len(repeats) > 1 else np.nan


def _compare_pressure(result, runs):
    band = _Band(read_columns(DATA / "lobovsky2014_pressure_sensor2_H300_percentiles_1ms.csv"))
    event = read_columns(DATA / "lobovsky2014_pressure_H300_event5_1ms.csv")
    event = {name: _mean(band.time, np.interp(band.time, event["t [s]"], p))
             for name, p in list(event.items())[2:]}  # fmt: skip
    figure = result.figure("Pressure at sensor 2, mean over 10 ms, from the impact on",
                           "time from the impact [s]", "p / (rho g H)")  # fmt: skip
    came = band.came
    figure.band("experiment, 2.5 to 97.5 %", *_part(band.time - came, band.low, band.high))
    figure.dashed("experiment, median", *_part(band.time - came, band.median))
    finest, rows = list(_standard(runs))[-1], []
    for name, run in runs.items():
        time, pressure = _pressure(run, "P2", band.time)
        late, impulse, inside = band.judge(time, pressure)
        figure.line(_label(run), *_part(time - came - late, pressure))
        rows.append([_label(run), 1e3 * late, impulse, inside])
        if name == finest:
            result.measure("arrival", 1e3 * late)
            result.measure("impulse", impulse)
            result.measure("inside", inside)
    for label, column in (("sensor 2", "p2_"), ("sensor 2L, beside it", "p2L_")):
        late, *rest = band.judge(band.time, _column(event, column))
        rows.append([f"experiment, event 5, {label}", 1e3 * late, *rest])
    columns = ["run", "impact after the median's [ms]", "impulse over the median's", "share inside"]
    result.table("Pressure at sensor 2", columns, rows)
    _compare_sensors(result, finest, runs[finest], band, event)
    _compare_impulses(result, finest, runs, band, event)


class _Band:
    """Pressure at sensor 2 over some hundred repeats, means over 10 ms, in rho g H.

    Attributes
    ----------
    time : (n,) float64 [s]
    low, median, high : (n,) float64
        The 2.5, 50 and 97.5 % lines.
    came : float
        When the water hits in the median [s].
    """

    def __init__(self, data):
        self.time = data["t [s]"]
        self.low, self.median, self.high = (_mean(self.time, data[n]) for n in list(data)[2:])
        self.came = _arrival(self.time, self.median)

    def judge(self, time, pressure):
        """A pressure over the times (m,) [s] of the band, or the first of them, impacts aligned.

        Returns
        -------
        tuple of float
            How much later than the median it hits [s], its impulse over the window and that of the
            median as a ratio, and the share of the window in which it is inside the band.
        """
        late = _arrival(time, pressure) - self.came
        moved = np.interp(self.time + late, time, pressure)
        window = (self.time >= self.came) & (self.time <= self.came + WINDOW)
        window &= self.time + late <= time[-1]
        impulse = np.trapezoid(moved[window]) / np.trapezoid(self.median[window])
        inside = np.mean((moved >= self.low)[window] & (moved <= self.high)[window])
        return late, impulse, inside


def _compare_sensors(result, name, run, band, event):
    """Pressures of a run at four heights: at P2 against the median, else against one event."""
    for probe in SENSORS:
        time, pressure = _pressure(run, probe, band.time)
        measured = _column(event, probe.lower() + "_")
        if probe == "P2":
            label, measured = "the median", band.median
        else:
            label = "event 5"
            figure = result.figure(f"Pressure at {probe}, mean over 10 ms, one event", "time [s]",
                                   "p / (rho g H)")  # fmt: skip
            figure.line(_label(run), time, pressure)
            figure.dashed("experiment, event 5", time, measured[: len(time)])
        result.hold(f"pressure at {probe}, mean over 10 ms, against {label} [rho g H], [s]",
                    time, pressure, band.time, measured)  # fmt: skip


def _compare_impulses(result, finest, runs, band, event):
    """Impulses at the four sensors, and on the wall up to the highest, over those of event 5.

    From when the lowest sensor is hit, over as long as the run has gone on since.
    """
    measured = [_column(event, probe.lower() + "_") for probe in SENSORS]
    rows = []
    for name, run in runs.items():
        seen = [_pressure(run, probe, band.time) for probe in SENSORS]
        time, came = seen[0][0], _arrival(*seen[0])
        lasting = min(WINDOW, time[-1] - came)
        ours = np.array([_impulse(time, p, came, lasting) for _, p in seen])
        hit = _arrival(band.time, measured[0])
        theirs = np.array([_impulse(band.time, p, hit, lasting) for p in measured])
        height = [probe.z for probe in run.case.probe if probe.name in SENSORS]
        wall = _along(height, ours) / _along(height, theirs)
        rows.append([_label(run), *(ours / theirs), wall])
        if name == finest:
            result.measure("wall", wall)
    title = f"Impulses over {WINDOW:g} s from the impact, over those of event 5"
    result.table(title, ["run", *SENSORS, "wall up to P4"], rows)


def _impulse(time, pressure, start, lasting):
    """Integral of a pressure from a time on; NaN where that is one."""
    window = (time >= start) & (time <= start + lasting)
    return np.trapezoid(pressure[window], time[window]) if window.any() else np.nan


def _along(height, value):
    """Integral along the wall from its foot to the highest sensor, of values at their heights."""
    return np.trapezoid([value[0], *value], [0.0, *height])


def _pressure(run, probe, time):
    """Those of the times (n,) [s] that a run reaches, and the pressure then, mean over 10 ms."""
    seen, pressure = run.pressure(probe)
    time = time[time <= seen[-1]]
    pressure = np.nan_to_num(pressure) / (run.density * run.gravity * HEIGHT)
    return time, _mean(time, np.interp(time, seen, pressure))


def _column(data, beginning):
    """The column of a table whose heading begins so."""
    return next(column for name, column in data.items() if name.startswith(beginning))


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
