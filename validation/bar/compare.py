"""Harmonics along a bar."""

from pathlib import Path

import numpy as np

from mpslab.analysis.harmonics import harmonics
from validation.comparison import Comparison, rms

DATA = Path(__file__).parent / "data" / "beji_battjes_luth_bar_caseA.csv"
PERIODS = 2  # of the simulation, the last ones
MEASURED_FROM, MEASURED_PERIODS = 20.0, 5  # seconds; the record is steady
BEHIND = 14.0  # [m]
THIRD_TO = 16.0  # [m] so far the third harmonic is steady within the run
CLOCKS = (4.0, 5.2)  # [m] a gauge of either group, before the bar, that sets the clock of its group
SHOWN = (5.2, 12.5, 15.7)  # [m]
ORDERS = ("First", "Second", "Third")


def compare(runs):
    """Amplitudes of the first three harmonics at the gauges; the finest run is judged."""
    result = Comparison()
    runs = sorted(runs.values(), key=lambda run: -run.spacing)
    finest = runs[-1]
    period, height = finest.case.wavemaker.period, finest.case.wavemaker.height
    x = np.array([gauge.x for gauge in finest.case.gauge])
    gauges = {place: _Gauge(place) for place in x}
    measured = np.array([gauges[place].amplitudes(period) for place in x])
    seen = [_seen(run, x) for run in runs]
    _judge(result, x, seen[-1], measured, height)
    if len(runs) > 1:
        errors = [_error(amplitudes, measured, x, height) for amplitudes in seen]
        title = "Harmonics, rms difference over the height of the wave"
        result.converge(title, [run.spacing for run in runs], errors)
    _draw(result, runs, x, seen, measured)
    _hold_levels(result, finest, gauges)
    return result


def _judge(result, x, seen, measured, height):
    """Measure the criteria, from amplitudes (gauges, 3) [m] at places x (gauges,) [m]."""
    behind = x > BEHIND
    steady = behind & (x < THIRD_TO)
    result.measure("first", rms((seen - measured)[~behind, 0]) / height)
    result.measure("second", (seen[behind, 1] / measured[behind, 1]).mean())
    result.measure("third", (seen[steady, 2] / measured[steady, 2]).mean())


def _error(seen, measured, x, height):
    """Rms difference of the three harmonics at all gauges where they are steady, over height."""
    steady = np.ones(seen.shape, bool)
    steady[x > THIRD_TO, 2] = False
    return rms((seen - measured)[steady]) / height


def _start(run):
    """From when on the harmonics of a run are taken [s]."""
    return run.case.time.end - (PERIODS + 0.1) * run.case.wavemaker.period


def _fit(run, place):
    """Mean level and complex harmonics of a run at a gauge [m]."""
    period = run.case.wavemaker.period
    return harmonics(*run.gauge(f"x{place}"), period, _start(run), PERIODS)


def _seen(run, x):
    """Amplitudes of the first three harmonics of a run at places x (gauges,) [m]: (gauges, 3)."""
    return np.abs([_fit(run, place)[1:4] for place in x])


class _Gauge:
    """A gauge of the experiment.

    Attributes
    ----------
    time, level : (n,) float64
        By the clock of its group [s], from still water [m].
    """

    def __init__(self, place):
        table = np.loadtxt(DATA, delimiter=",", skiprows=1)
        _, self.time, self.level = table[np.isclose(table[:, 0], place)].T

    def fit(self, period):
        """Mean level and complex harmonics [m]."""
        return harmonics(self.time, self.level, period, MEASURED_FROM, MEASURED_PERIODS)

    def amplitudes(self, period):
        """Amplitudes of the first three harmonics [m]."""
        return np.abs(self.fit(period)[1:4])


def _hold_levels(result, run, gauges):
    """Put the waves at each gauge into the table of errors, the clocks of the groups set."""
    period, start = run.case.wavemaker.period, _start(run)
    ahead = {gauges[place].time[0]: _ahead(run, place, gauges[place]) for place in CLOCKS}
    for place, gauge in gauges.items():
        time, level = run.gauge(f"x{place}")
        part = (time >= start) & (time <= start + PERIODS * period)
        moved = gauge.time - ahead[gauge.time[0]]
        result.hold(f"surface at x = {place:g} m [m], [s]", time[part], level[part] - run.depth,
                    moved, gauge.level)  # fmt: skip
        if place in SHOWN:
            figure = result.figure(f"Surface at x = {place:g} m", "time [s]", "elevation [m]")
            figure.line(run.label, time[part], level[part] - run.depth)
            shown = (moved >= start) & (moved <= start + PERIODS * period)
            figure.points("Luth et al. 1994, clock set", moved[shown], gauge.level[shown])


def _ahead(run, place, gauge):
    """How far the clock of a gauge is ahead of that of a run [s], by the first harmonic there.

    Of the many times that fit, that for which the part of the run that is compared falls on the
    steady part of the record.
    """
    period = run.case.wavemaker.period
    turn = np.angle(_fit(run, place)[1] / gauge.fit(period)[1]) / (2.0 * np.pi)
    return period * (turn + np.ceil((MEASURED_FROM - _start(run)) / period - turn))


def _draw(result, runs, x, seen, measured):
    """Figures and table of the amplitudes."""
    for order, name in enumerate(ORDERS):
        figure = result.figure(f"{name} harmonic", "x [m]", "amplitude [mm]")
        for run, amplitudes in zip(runs, seen, strict=True):
            figure.line(run.label, x, 1e3 * amplitudes[:, order])
        figure.points("Luth et al. 1994", x, 1e3 * measured[:, order])
    columns = ["run", "x [m]"]
    columns += [f"{n} harmonic{w} [mm]" for w in ("", ", measured") for n in (1, 2, 3)]
    rows = [
        [run.label, *row]
        for run, amplitudes in zip(runs, seen, strict=True)
        for row in np.column_stack([x, 1e3 * amplitudes, 1e3 * measured]).tolist()
    ]
    result.table("Harmonics", columns, rows)
