"""Where and when the parts of a focused wave meet, and how high the wave is."""

from types import SimpleNamespace

import numpy as np

from mpslab.analysis.reflection import separate
from mpslab.theory import dispersion
from validation import potential_tank
from validation.comparison import Comparison

WINDOW = 3.5  # periods to either side of the focus
ENDS = 0.1  # share of the window in which readings fade in and out
AROUND = 0.7  # wavelengths and periods within which the focus is looked for
POINTS = 141  # each way; looked at twice, the second time around the best


def compare(runs):
    """Place, time and crest of each wave against potential flow."""
    result = Comparison()
    rows = []
    for name, run in runs.items():
        case, found = run.case, _of_run(run)
        theory = _of_potential_flow(run)
        length = 2.0 * np.pi / found.k
        steep = "steep_" if name == "steep" else ""
        result.measure(f"{steep}place", 100.0 * (found.place - theory.place) / length)
        result.measure(f"{steep}time", 100.0 * (found.time - theory.time) / found.period)
        if steep:
            result.measure("steep_crest", found.highest / theory.highest)
        else:
            result.measure("crest", found.crest / theory.crest)
        for label, one in ((name, found), ("potential flow", theory)):
            rows.append([label, found.k * case.wavemaker.amplitude, one.place / length,
                         one.time / found.period, one.crest / case.wavemaker.amplitude,
                         one.highest / case.wavemaker.amplitude])  # fmt: skip
        _draw(result, name, run, found, theory)
    columns = ["wave", "k A", "place off by [L]", "time off by [T]", "crest of first harmonics / A",
               "highest level / A"]  # fmt: skip
    result.table("Focus", columns, rows)
    return result


def _draw(result, name, run, found, theory):
    for place in (run.case.wavemaker.place, run.case.gauge[-1].x):
        gauge = int(np.argmin(np.abs(found.x + run.case.wavemaker.place - place)))
        figure = result.figure(f"Level at x = {place:g} m, {name}", "(t - focus) / T", "level / A")
        for label, one in (("mpslab", found), ("potential flow", theory)):
            draw = figure.line if one is found else figure.dashed
            draw(label, one.times / found.period,
                 one.levels[:, gauge] / run.case.wavemaker.amplitude)  # fmt: skip


def _of_run(run):
    """The waves of a run, places and times from the focus asked for."""
    maker = run.case.wavemaker
    x = np.array([gauge.x for gauge in run.case.gauge]) - maker.place
    times = run.gauges["time"] - maker.time
    levels = np.stack([run.gauges[g.name] for g in run.case.gauge], axis=1) - run.depth
    return _focus(times, levels, x, run)


def _of_potential_flow(run):
    """What the same piston makes in fully nonlinear potential flow, at the same gauges."""
    maker, x = run.case.wavemaker, np.array([gauge.x for gauge in run.case.gauge])
    times, levels = potential_tank.levels(run.case, x)
    return _focus(times - maker.time, levels, x - maker.place, run)


def _focus(times, levels, x, run):
    """Where and when the first harmonics of waves meet.

    Parameters
    ----------
    times : (n,) float64 [s]
    levels : (n, gauges) float64 [m]
    x : (gauges,) float64 [m]

    Returns
    -------
    SimpleNamespace
        x, times, levels; k [1/m] and period [s] of the peak; place [m], time [s] and crest [m] of
        the focus; highest level at the gauges [m].
    """
    maker = run.case.wavemaker
    period, span = maker.period, 2.0 * WINDOW * maker.period
    count = 1024
    even = -0.5 * span + span / count * np.arange(count)
    rise = np.clip(np.minimum(even + 0.5 * span, 0.5 * span - even) / (ENDS * span), 0.0, 1.0)
    fade = (np.sin(0.5 * np.pi * rise) ** 2)[:, np.newaxis]
    series = np.stack([np.interp(even, times, level, 0.0, 0.0) for level in levels.T], axis=1)
    found = 2.0 / count * np.fft.rfft(fade * (series - series.mean(axis=0)), axis=0)
    number = np.arange(int(np.ceil(maker.band[0] * span / period)),
                       int(maker.band[1] * span / period) + 1)  # fmt: skip
    rate = 2.0 * np.pi / span * number
    waves = found[number] * np.exp(1j * rate * 0.5 * span)[:, np.newaxis]
    k = dispersion.wave_numbers(rate, run.depth, run.gravity)
    incident = separate(waves.T, x, k)[0]
    (peak,) = dispersion.wave_numbers(np.array([2.0 * np.pi / period]), run.depth, run.gravity)
    place, time, crest = _meet(incident, rate, k, 2.0 * np.pi / peak, period)
    near = np.abs(times) < WINDOW * period
    return SimpleNamespace(x=x, times=times, levels=levels, k=float(peak), period=period,
                           place=place, time=time, crest=crest,
                           highest=float(levels[near].max()))  # fmt: skip


def _meet(incident, rate, k, length, period):
    """Place, time and height of the highest crest that waves make by linear theory."""
    place = time = 0.0
    reach = AROUND
    for _ in range(2):
        places = place + reach * length * np.linspace(-1.0, 1.0, POINTS)
        times = time + reach * period * np.linspace(-1.0, 1.0, POINTS)
        level = np.real(
            (incident * np.exp(-1j * np.outer(places, k))) @ np.exp(1j * np.outer(rate, times))
        )
        i, j = np.unravel_index(np.argmax(level), level.shape)
        place, time, reach = places[i], times[j], reach / 20.0
    return float(place), float(time), float(level.max())
