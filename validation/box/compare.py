"""Levels and pressures of a dam break onto a box."""

from pathlib import Path

import numpy as np

from validation.comparison import Comparison
from validation.data import read_columns

DATA = Path(__file__).parent / "data" / "spheric2_kleefsman2005.csv"
IMPACT = 500.0  # [Pa] at P1: the water has come
FRONT, TOP = ("P1", "P2", "P3", "P4"), ("P5", "P6", "P7", "P8")
WINDOW = 0.5  # seconds from the impact on: the wave hits the front
UNTIL_END = 1.55  # seconds from the impact on: water falls onto the top from 0.65 s on


def compare(runs):
    """Levels, impact and impulses; the finest run is judged."""
    result = Comparison()
    runs = sorted(runs.values(), key=lambda run: -run.spacing)
    data = read_columns(DATA)
    _compare_levels(result, runs, data)
    _compare_impulses(result, runs, data)
    _compare_pressures(result, runs, data)
    return result


def _compare_levels(result, runs, data):
    time, gauges = data["t [s]"], [gauge.name for gauge in runs[-1].case.gauge]
    errors = np.array([[_level_error(run, gauge, data) for gauge in gauges] for run in runs])
    for gauge in gauges:
        measured, place = data[f"depth_{gauge} [m]"], gauge.replace("x", "x = ")
        figure = result.figure(f"Level at {place} m", "time [s]", "level [m]")
        for run in runs:
            figure.line(run.label, *_level(run, gauge))
        part = time <= runs[-1].case.time.end
        figure.dashed("Kleefsman et al. 2005", time[part], measured[part])
        result.hold(f"level at {place} m [m], [s]", *_level(runs[-1], gauge), time, measured)
    result.measure("levels", errors[-1].max())
    means = errors.mean(axis=1)
    if len(runs) > 1:
        spacings = [run.spacing for run in runs]
        result.converge("Levels, mean of four gauges, over the column", spacings, means)
    rows = [[run.label, *error, error.mean()] for run, error in zip(runs, errors, strict=True)]
    columns = ["run", *(gauge.replace("x", "x = ") + " m" for gauge in gauges), "mean"]
    result.table("Levels: rms difference from the experiment over the column", columns, rows)


def _level(run, gauge):
    """Time [s] and level [m] at a gauge, 0 where it is dry."""
    time, level = run.gauge(gauge)
    return time, np.nan_to_num(level)


def _level_error(run, gauge, data):
    """Rms difference of the level over the height of the column."""
    time, level = _level(run, gauge)
    part = data["t [s]"] <= time[-1]
    error = np.interp(data["t [s]"][part], time, level) - data[f"depth_{gauge} [m]"][part]
    return np.sqrt(np.mean(error**2)) / run.depth


def _pressure(run, probe):
    """Time [s] and pressure [Pa] at a probe, 0 where it is dry."""
    time, pressure = run.pressure(probe)
    return time, np.nan_to_num(pressure)


def _compare_impulses(result, runs, data):
    """Impulses of the runs over those of the experiment, from the impact of each on."""
    measured = {probe: (data["t [s]"], data[f"{probe} [Pa]"]) for probe in FRONT + TOP}
    experiment, rows = _Impulses(measured), []
    for run in runs:
        seen = _Impulses({probe: _pressure(run, probe) for probe in FRONT + TOP})
        late = 1e3 * (seen.start - experiment.start)
        ratios = [seen.of(probe) / experiment.of(probe) for probe in FRONT + TOP]
        front, top = (seen.over(face) / experiment.over(face) for face in (FRONT, TOP))
        rows.append([run.label, late, *ratios, front, top])
    result.measure("arrival", late)
    result.measure("impulse", ratios[0])
    result.measure("impulse_front", front)
    result.measure("impulse_top", top)
    columns = ["run", "impact after the experiment's [ms]", *FRONT, *TOP, "P1 to P4", "P5 to P8"]
    result.table(
        f"Impulses over those of the experiment, P1 to P4 in {WINDOW:g} s from the impact, "
        f"P5 to P8 in {UNTIL_END:g} s", columns, rows,
    )  # fmt: skip


class _Impulses:
    """Impulses on the box, of an experiment or a run.

    Attributes
    ----------
    start : float
        When the water hits the box, by P1 [s]; NaN if it does not.
    """

    def __init__(self, records):
        self._records = records
        time, pressure = records["P1"]
        hit = np.flatnonzero(pressure > IMPACT)
        self.start = time[hit[0]] if len(hit) else np.nan

    def of(self, probe):
        """Integral of the pressure over the time that is looked at [Pa s]; NaN if none is hit."""
        time, pressure = self._records[probe]
        end = self.start + (WINDOW if probe in FRONT else UNTIL_END)
        part = (time >= self.start) & (time <= end)
        return np.trapezoid(pressure[part], time[part]) if end <= time[-1] else np.nan

    def over(self, probes):
        """Sum over some probes [Pa s]."""
        return sum(map(self.of, probes))


def _compare_pressures(result, runs, data):
    """Figures of the finest run, its errors and peaks."""
    run, measured_time, rows = runs[-1], data["t [s]"], []
    for probe in FRONT + TOP:
        (time, pressure), measured = _pressure(run, probe), data[f"{probe} [Pa]"]
        part = measured_time <= time[-1]
        figure = result.figure(f"Pressure at {probe}", "time [s]", "pressure [Pa]")
        figure.line(run.label, time, pressure)
        figure.dashed("Kleefsman et al. 2005", measured_time[part], measured[part])
        result.hold(f"pressure at {probe} [Pa], [s]", time, pressure, measured_time, measured)
        peaks = np.argmax(pressure), np.argmax(measured[part])
        rows.append([probe, pressure[peaks[0]], time[peaks[0]],
                     measured[peaks[1]], measured_time[peaks[1]]])  # fmt: skip
    columns = ["probe", "peak [Pa]", "at [s]", "measured [Pa]", "at [s]"]
    result.table(f"Peaks of the pressure, {run.label}", columns, rows)
