"""The first mode of a standing wave against potential flow."""

import numpy as np

from mpslab.theory.waves import standing_wave_frequency
from validation.comparison import Comparison
from validation.potential_flow import standing_wave

PEAKS = (0.25, 0.75, 1.25, 1.75)  # periods
NEAR = 0.06  # periods about a peak that its parabola is fitted to
STANDARD = ("low-4mm", "low-2.7mm", "low-2mm", "low-1mm", "high-2mm")


def compare(runs):
    """Amplitude, period and level of the waves, and the order of convergence."""
    result = Comparison()
    waves = {name: _Wave(run) for name, run in runs.items()}
    low, high = waves["low-2mm"], waves["high-2mm"]
    result.measure("kept", low.peak(1.75))
    if "low-1mm" in waves:
        result.measure("kept_fine", waves["low-1mm"].peak(1.75))
    result.measure("high", high.peak(1.75) / high.reference_peak(1.75))
    result.measure("period", low.period)
    standard = [waves[name] for name in STANDARD if name in waves]
    result.measure("level", max((wave.rise for wave in standard), key=abs))
    fine = [wave for wave in standard if wave is not high]
    order = result.converge(
        "Loss of the first mode at 1.75 periods, 0.1 h",
        [wave.spacing for wave in fine],
        [wave.peak(1.75) - wave.reference_peak(1.75) for wave in fine],
    )
    result.measure("order", order)
    for name in (name for name in STANDARD if name in waves):
        wave = waves[name]
        result.hold(f"first mode, {name} [linear amplitudes], [T]", wave.time, wave.mode,
                    *wave.reference)  # fmt: skip
    _draw(result, "Amplitude 0.1 h", [n for n in waves if n != "high-2mm"], waves)
    _draw(result, "Amplitude 0.25 h", ["high-2mm"], waves)
    columns = ["run", *(f"at {t:g} T" for t in PEAKS), "reference at 1.75 T", "level [spacings]"]
    result.table("Peaks of the first mode over its linear amplitude", columns, [
        [name, *(wave.peak(t) for t in PEAKS), wave.reference_peak(1.75), wave.rise]
        for name, wave in waves.items()
    ])  # fmt: skip
    return result


def _draw(result, title, names, waves):
    figure = result.figure(title, "t / T", "first mode / linear amplitude")
    first = waves[names[0]]
    for name in names:
        recipe = name if name in ("mps", "paper") else "standard"
        label = f"{recipe}, d0 = {1e3 * waves[name].spacing:.3g} mm"
        figure.line(label, waves[name].time, waves[name].mode)
    figure.dashed("potential flow", *first.reference)


class _Wave:
    """First mode of a run, in linear amplitudes, against time in linear periods."""

    def __init__(self, run):
        tank, initial = run.case.tank, run.case.initial
        self.spacing, length, depth = run.spacing, tank.length, tank.depth
        amplitude, k = initial.amplitude, np.pi / length
        frequency = standing_wave_frequency(1, length, depth, run.gravity)
        rows = [(t, 2.0 * self.spacing**2 / length * np.cos(k * x[:, 0]).sum(), x[:, 2].mean())
                for t, x, _ in run.water()]  # fmt: skip
        time, mode, height = np.array(rows).T
        self.time, self.mode = time * frequency / (2.0 * np.pi), mode / amplitude
        self.rise = 2.0 * (height[-1] - height[0]) / self.spacing
        time, mode = standing_wave(amplitude, length, depth, run.gravity, frequency, 2.0)
        self.reference = time * frequency / (2.0 * np.pi), mode / amplitude

    def peak(self, at):
        """Height of the peak near a time; NaN if the run ended before it."""
        return _peak(self.time, self.mode, at)

    def reference_peak(self, at):
        """The same of potential flow."""
        return _peak(*self.reference, at)

    @property
    def period(self):
        """Time from the first downward to the second downward pass of the still level."""
        down = np.flatnonzero((self.mode[:-1] > 0.0) & (self.mode[1:] <= 0.0))
        m, t = self.mode, self.time
        passes = [t[i] + m[i] / (m[i] - m[i + 1]) * (t[i + 1] - t[i]) for i in down]
        return passes[1] - passes[0]


def _peak(time, mode, at):
    size = np.abs(mode)
    near = np.abs(time - at) < 0.2
    if time[-1] < at:
        return np.nan
    top = time[near][np.argmax(size[near])]
    near = np.abs(time - top) < NEAR
    a, b, c = np.polyfit(time[near] - top, size[near], 2)
    return c - 0.25 * b**2 / a
