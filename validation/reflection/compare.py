"""Reflection coefficients of a wall and of smooth slopes."""

import numpy as np

from mpslab.theory import waves
from validation.comparison import Comparison
from validation.wave_analysis import separate, travel

PERIODS = 4  # that harmonics are taken over
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
SLOPES = ("slope-2", "slope-3", "slope-10")


def compare(runs):
    """Kr of each run by its end, and the incident height before 1:2 over that of no reflection."""
    result = Comparison()
    runs = {name.removesuffix("-fine"): run for name, run in runs.items()}
    found = {name: _separate(run, alone=name == "open") for name, run in runs.items()}
    result.measure("wall", found["wall"].kr_primary)
    for name in SLOPES:
        if name in found:
            result.measure(name.replace("-", "_"), found[name].kr_primary)
    result.measure("incident", found["slope-2"].incident_height / found["open"].incident_height)
    rows, points = [], []
    for name, run in runs.items():
        one, xi = found[name], _xi(run)
        law = [np.nan, np.nan] if not xi else [seelig_ahrens(xi), zanuttigh(xi)]
        if xi:
            points.append([xi, one.kr_primary])
        rows.append([name, 1e3 * one.incident_height, xi, one.kr_primary, *law,
                     100.0 * one.unexplained, one.floor])  # fmt: skip
    columns = ["end", "incident H [mm]", "xi", "Kr", "Seelig & Ahrens", "Zanuttigh & v.d. Meer",
               "residual [%]", "Kr of such noise"]  # fmt: skip
    result.table("Reflection", columns, rows)
    figure = result.figure("Reflection of smooth slopes", "xi", "Kr")
    xi = np.linspace(0.2, 3.5, 100)
    figure.dashed("Seelig & Ahrens 1981", xi, seelig_ahrens(xi))
    figure.dashed("Zanuttigh & van der Meer 2008", xi, zanuttigh(xi))
    figure.points("mpslab", *np.array(points).T)
    _draw_gauge(result, runs)
    return result


def seelig_ahrens(xi):
    """Kr of smooth slopes, xi^2 / (5.5 + xi^2) (Seelig & Ahrens 1981)."""
    return xi**2 / (5.5 + xi**2)


def zanuttigh(xi):
    """Kr of smooth slopes, tanh(0.16 xi^1.43) (Zanuttigh & van der Meer 2008)."""
    return np.tanh(0.16 * xi**1.43)


def _xi(run):
    """Surf similarity of the wave asked for; 0 of a wall."""
    (x0, z0), (x1, z1) = run.case.tank.bed[-2:]
    slope, maker = (z1 - z0) / (x1 - x0), run.case.wavemaker
    return slope / np.sqrt(maker.height / waves.deep_wavelength(maker.period, run.gravity))


def _start(run, alone):
    """From when both waves, or the incident one alone, are steady at all gauges [s]."""
    maker, x = run.case.wavemaker, [gauge.x for gauge in run.case.gauge]
    ready = maker.start + SETTLE * maker.period
    return ready + (travel(run, max(x)) if alone else 2.0 * travel(run) - travel(run, min(x)))


def _separate(run, alone):
    """Incident and reflected waves."""
    return separate(run, run.case.gauge, _start(run, alone), PERIODS)


def _draw_gauge(result, runs):
    figure = result.figure("Level at G3, and where the window begins", "time [s]", "level [mm]")
    for name, run in runs.items():
        time, level = run.gauge("G3")
        figure.line(name, time, 1e3 * (level - run.depth))
        start = _start(run, alone=name == "open")
        figure.points(f"window of {name}", [start], [0.0])
