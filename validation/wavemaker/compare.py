"""The waves that the piston makes against the theories it follows."""

import numpy as np
from scipy.optimize import curve_fit

from mpslab.analysis.harmonics import harmonics
from mpslab.theory import waves
from validation.comparison import Comparison

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
        period, height = maker.period, maker.height
        speed = waves.group_celerity(period, run.depth, run.gravity)
        came = maker.start + SETTLE * period + gauge.x / speed
        found = harmonics(time, level - run.depth, period, came, PERIODS)
        figure.line(name.replace("-", " = "), time / period, (level - run.depth) / height)
        rows.append([name, 1e3 * height, 2e3 * abs(found[1]), 2.0 * abs(found[1]) / height])
    worst = max((row[-1] for row in rows), key=lambda ratio: abs(np.log(ratio)))
    result.measure("biesel", worst)
    columns = ["run", "asked for [mm]", "twice the first harmonic [mm]", "ratio"]
    result.table("Biesel's transfer function", columns, rows)


def _compare_solitary(result, runs):
    """Height, speed and shape of each run; the finest is judged."""
    figure = result.figure(
        "Solitary wave, 20 depths from the piston", "c (t - t_crest) / d", "level / H"
    )
    found = {name: _Solitary(run) for name, run in runs.items()}
    name = min(found, key=lambda name: found[name].spacing)
    finest = found[name]
    for wave in found.values():
        figure.line(wave.label, wave.x, wave.level)
    figure.dashed("sech^2", finest.x, finest.theory)
    held = {name: wave.hold(result) for name, wave in found.items()}
    result.measure("solitary_height", finest.height)
    result.measure("solitary_speed", finest.speed)
    result.measure("solitary_shape", 100.0 * finest.shape)
    result.measure("solitary_at", 100.0 * held[name]["rms error"])
    if len(found) > 1:
        result.converge(
            "Height of the solitary wave lost from 10 to 20 depths, over that asked for",
            [wave.spacing for wave in found.values()],
            [wave.lost for wave in found.values()],
        )
    places = [gauge.name for gauge in next(iter(runs.values())).case.gauge]
    columns = ["run", *(f"height at {g}" for g in places), "speed ratio", "shape [% of H]"]
    result.table("Solitary wave over theory", columns, [
        [wave.label, *wave.heights, wave.speed, 100.0 * wave.shape] for wave in found.values()
    ])  # fmt: skip


class _Solitary:
    """The solitary wave of a run, 20 depths from the piston.

    Attributes
    ----------
    spacing : float [m]
    heights : list of float
        At the gauges, over the height asked for.
    height, speed : float
        At 20 depths, and from 10 to 20 depths, over those of theory.
    lost : float
        Height lost from 10 to 20 depths, over that asked for.
    shape : float
        Rms difference from sech^2 of its own height, over that.
    x, level, theory : (n,) float
        Way of the crest since it passed [depths], level over the height asked for, and sech^2.
    late : float
        How far the crest is behind that of theory which passed 5 depths with it [depths].
    """

    def __init__(self, run):
        self.spacing, depth = run.spacing, run.depth
        asked = run.case.wavemaker.height
        self.label = f"standard, d0 = d / {depth / run.spacing:.0f}"
        celerity = waves.solitary_celerity(asked, depth, run.gravity)
        gauges = [gauge.name for gauge in run.case.gauge]
        crests = {name: _crest(*run.gauge(name), depth, asked, celerity) for name in gauges}
        self.heights = [top / asked for _, top in crests.values()]
        moment, top = crests["20d"]
        self.height = top / asked
        self.lost = (crests["10d"][1] - top) / asked
        self.speed = 10.0 * depth / (moment - crests["10d"][0]) / celerity
        time, level = run.gauge("20d")
        x = celerity * (time - moment)
        near = np.abs(x) < REACH / waves.solitary_wave_number(asked, depth)
        level = level[near] - depth
        own = waves.solitary_elevation(x[near], top, depth)
        self.shape = np.sqrt(np.mean((level - own) ** 2)) / top
        self.x, self.level = x[near] / depth, level / asked
        self.theory = waves.solitary_elevation(x[near], asked, depth) / asked
        self.late = celerity * (moment - crests["5d"][0]) / depth - 15.0

    def hold(self, result):
        """Against sech^2 of the height asked for, timed by the crest at 5 depths; the errors."""
        label = f"{self.label}: level 20 d from the piston against sech^2 [H], [d / c]"
        return result.hold(label, self.x + self.late, self.level, self.x, self.theory)


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
