"""The waves that the piston makes against those of fully nonlinear potential flow."""

import numpy as np
from scipy.optimize import curve_fit

from mpslab.analysis.harmonics import harmonics
from mpslab.theory import waves
from validation import potential_tank
from validation.comparison import Comparison, rms

PERIODS = 2  # that harmonics are taken over
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
REACH = 2.0  # to either side of the crest, in units of 1/k: there sech^2 is 0.07


def compare(runs):
    """Regular waves by depth, and the solitary wave."""
    result = Comparison()
    _compare_regular(result, {n: run for n, run in runs.items() if n.startswith("kh")})
    _compare_solitary(result, {n: run for n, run in runs.items() if n.startswith("solitary")})
    return result


def _compare_regular(result, runs):
    figure = result.figure("Regular waves one wavelength from the piston", "t / T", "level / H")
    rows = []
    for name, run in runs.items():
        maker, (gauge,) = run.case.wavemaker, run.case.gauge
        time, level = run.gauge(gauge.name)
        ideal_time, ideal = potential_tank.levels(run.case, [gauge.x])
        period, height = maker.period, maker.height
        speed = waves.group_celerity(period, run.depth, run.gravity)
        came = maker.start + SETTLE * period + gauge.x / speed
        seen, theory = (
            2.0 * np.abs(harmonics(*readings, period, came, PERIODS)[1:3]) / height
            for readings in ((time, level - run.depth), (ideal_time, ideal[:, 0]))
        )
        label = name.replace("-", " = ")
        figure.line(label, time / period, (level - run.depth) / height)
        figure.dashed(f"{label}, potential flow", ideal_time / period, ideal[:, 0] / height)
        rows.append([name, 1e3 * height, *seen, *theory, seen[0] / theory[0]])
    worst = max((row[-1] for row in rows), key=lambda ratio: abs(np.log(ratio)))
    result.measure("first_harmonic", worst)
    columns = ["run", "H asked for [mm]", "twice the first harmonic / H", "the second",
               "potential flow: the first", "the second", "first over that"]  # fmt: skip
    result.table("Harmonics one wavelength from the piston", columns, rows)


def _compare_solitary(result, runs):
    """Height, speed and shape of each run; the finest is judged."""
    figure = result.figure(
        "Solitary wave, 20 depths from the piston", "c (t - t_crest) / d", "level / H"
    )
    ideal = _in_potential_flow(next(iter(runs.values())))
    found = sorted((_of_run(run) for run in runs.values()), key=lambda wave: -wave.spacing)
    rows = []
    for wave in found:
        theory = np.interp(wave.x, ideal.x, ideal.level)
        figure.line(wave.label, wave.x, wave.level)
        late = wave.celerity * (wave.took("5d", "20d") - ideal.took("5d", "20d"))
        held = result.hold(f"{wave.label}: level 20 d from the piston, timed by the crest at 5 d, "
                           "against potential flow [H], [d / c]",
                           wave.x + late, wave.level, wave.x, theory)  # fmt: skip
        rows.append([
            wave.label, *(wave.heights[g] / ideal.heights[g] for g in ideal.heights),
            ideal.took("10d", "20d") / wave.took("10d", "20d"),
            100.0 * rms(wave.level - theory), 100.0 * held["rms error"],
        ])  # fmt: skip
    figure.dashed("potential flow", ideal.x, ideal.level)
    *_, height, speed, shape, timed = rows[-1]
    result.measure("solitary_height", height)
    result.measure("solitary_speed", speed)
    result.measure("solitary_shape", shape)
    result.measure("solitary_at", timed)
    if len(found) > 1:
        result.converge(
            "Height lost from 10 to 20 depths, less that in potential flow, over that asked for",
            [wave.spacing for wave in found],
            [wave.lost - ideal.lost for wave in found],
        )
    columns = ["run", *(f"height at {g}" for g in ideal.heights), "speed",
               "rms difference [% of H]", "timed by the crest at 5 d"]  # fmt: skip
    result.table("Solitary wave over that in potential flow", columns, rows)


def _of_run(run):
    return _Solitary(run, {gauge.name: run.gauge(gauge.name) for gauge in run.case.gauge})


def _in_potential_flow(run):
    period = potential_tank.solitary_period(run.case.wavemaker.height, run.depth, run.gravity)
    gauges = run.case.gauge
    time, level = potential_tank.levels(run.case, [gauge.x for gauge in gauges], period)
    readings = [(time, run.depth + one) for one in level.T]
    return _Solitary(run, dict(zip([gauge.name for gauge in gauges], readings, strict=True)))


class _Solitary:
    """A solitary wave as the gauges of a run see it.

    Parameters
    ----------
    run : validation.run.Run
    readings : dict of str to ((n,) float64 [s], (n,) float64 [m])
        Time and level, by gauge.

    Attributes
    ----------
    spacing : float [m]
    label : str
    celerity : float [depths/s]
        Of theory, by which times are told as ways.
    heights : dict of str to float
        By gauge, over the height asked for.
    lost : float
        From 10 to 20 depths, over the height asked for.
    x, level : (n,) float64
        Way of the crest since it passed 20 depths [depths], and the level there over the height
        asked for.
    """

    def __init__(self, run, readings):
        self.spacing, depth, asked = run.spacing, run.depth, run.case.wavemaker.height
        self.label = f"standard, d0 = d / {depth / run.spacing:.0f}"
        celerity = waves.solitary_celerity(asked, depth, run.gravity)
        crests = {name: _crest(*one, depth, asked, celerity) for name, one in readings.items()}
        self._moments = {name: moment for name, (moment, _) in crests.items()}
        self.heights = {name: top / asked for name, (_, top) in crests.items()}
        self.lost = self.heights["10d"] - self.heights["20d"]
        self.celerity = celerity / depth
        time, level = readings["20d"]
        x = celerity * (time - self._moments["20d"])
        near = np.abs(x) < REACH / waves.solitary_wave_number(asked, depth)
        self.x, self.level = x[near] / depth, (level[near] - depth) / asked

    def took(self, first, second):
        """Time from one gauge to another [s]."""
        return self._moments[second] - self._moments[first]


def _crest(time, level, depth, asked, celerity):
    """When the crest passes a gauge [s] and its height over still water [m], by least squares.

    Of the wave of theory that comes nearest: the crest alone is as grainy as its particles.
    """
    level = np.where(np.isfinite(level), level - depth, 0.0)
    top = time[np.argmax(level)]
    near = celerity * np.abs(time - top) < REACH / waves.solitary_wave_number(asked, depth)

    def wave(time, moment, height):
        return waves.solitary_elevation(celerity * (time - moment), height, depth)

    (moment, height), _ = curve_fit(wave, time[near], level[near], [top, asked])
    return moment, height
