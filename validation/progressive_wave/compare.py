"""First harmonic and height along a flat tank."""

import numpy as np

from mpslab.analysis.harmonics import harmonics
from mpslab.theory.waves import group_celerity, wavelength
from validation.comparison import Comparison
from validation.wave_analysis import decay

PERIODS = 2  # that harmonics are taken over at least
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
LENGTHS = {"short_tank": 2.0, "flat_tank": 5.0}  # over which the loss is told, by the tank
JUDGED = ("height-5", "height-10")  # other runs are drawn and listed
OTHERS = ("mps", "paper")  # recipes beside `standard`
FEWEST = 3  # gauges that a decay is fitted to


def compare(runs):
    """Decay of the first harmonic, from one wavelength off the piston on."""
    result = Comparison()
    trains = {name: _Train(run) for name, run in runs.items()}
    for name in (name for name in JUDGED if name in trains):
        particles = name.removeprefix("height-")
        result.measure(f"lost_{particles}", trains[name].lost(trains[name].over))
        result.measure(f"generated_{particles}", trains[name].first[0] / trains[name].half)
    _draw(result, trains)
    _list(result, trains)
    standard = [train for name, train in trains.items() if name not in OTHERS]
    if len(standard) > 1:
        _converge(result, standard)
    return result


def _label(name, train):
    recipe = f"{name}, " if name in OTHERS else ""
    return f"{recipe}{round(2.0 * train.half / train.spacing)} particles over the height"


def _draw(result, trains):
    first = result.figure("First harmonic along the tank", "x / L", "first harmonic / (H / 2)")
    height = result.figure("Height from crest to trough along the tank", "x / L", "height / H")
    for name, train in trains.items():
        place, part = train.x / train.length, train.used
        first.points(_label(name, train), place, train.first / train.half)
        height.points(_label(name, train), place, train.height / (2.0 * train.half))
        if np.isfinite(train.lost(train.over)):
            label = (f"fit: {train.lost(train.over):.2g} % over {train.over:g} L, standard error "
                     f"{train.error(train.over):.1g} %")  # fmt: skip
            first.line(label, place[part], train.fit(train.x[part]) / train.half)
    far = max((train.x / train.length).max() for train in trains.values())
    first.dashed("no loss", [1.0, far], [1.0, 1.0])
    height.dashed("no loss", [1.0, far], [1.0, 1.0])


def _list(result, trains):
    columns = ["run", "over", "lost [%]", "standard error [%]", "lost over L [%]",
               "first harmonic / (H / 2) at x = L"]  # fmt: skip
    result.table("Loss of the first harmonic, from the fits", columns, [
        [name, f"{train.over:g} L", train.lost(train.over), train.error(train.over),
         train.lost(1.0), train.first[0] / train.half]
        for name, train in trains.items()
    ])  # fmt: skip
    columns = ["run", "x / L", "crest to trough [mm]", "first harmonic [mm]",
               "second harmonic [mm]", "over periods"]  # fmt: skip
    result.table("Waves at the gauges", columns, [
        [name, x / train.length, 1e3 * height, 1e3 * first, 1e3 * second, int(periods)]
        for name, train in trains.items()
        for x, height, first, second, periods in train.rows
    ])  # fmt: skip


def _converge(result, trains):
    """Loss over a wavelength against the spacing, and how much of it is noise."""
    result.converge("Loss of the first harmonic over a wavelength [%]",
                    [train.spacing for train in trains],
                    [train.lost(1.0) for train in trains])  # fmt: skip
    losses = "; ".join(
        f"{train.lost(1.0):.2g} +- {train.error(1.0):.1g} % at {1e3 * train.spacing:.3g} mm"
        for train in trains
    )
    result.note(
        f"Loss over a wavelength with the standard error of its fit: {losses}. The order is worth "
        "no more than these: a loss that is no larger than its error says only that there is less."
    )


class _Train:
    """Waves along a tank.

    Attributes
    ----------
    spacing, length, half : float [m]
        Of the particles, of the wave, and half the height asked for.
    over : float
        Wavelengths that the loss is told over.
    rows : (n, 5) float64
        Of each gauge x, height from crest to trough, first and second harmonic [m], periods.
    x, height, first : (n,) float64 [m]
        Columns of it; NaN where the record is too short.
    used : (n,) bool
        Gauges that the decay is fitted to.
    """

    def __init__(self, run):
        maker = run.case.wavemaker
        self.spacing, self.half = run.spacing, 0.5 * maker.height
        self.length = wavelength(maker.period, run.depth, run.gravity)
        self.over = LENGTHS[run.case.name]
        self.rows = np.array([_gauge(run, gauge) for gauge in run.case.gauge])
        self.x, self.height, self.first = self.rows.T[:3]
        self.used = np.isfinite(self.first) & (self.x < (1.05 + self.over) * self.length)
        enough = np.count_nonzero(self.used) >= FEWEST
        fitted = decay(self.x[self.used], self.first[self.used]) if enough else [np.nan] * 3
        self._rate, self._start, self._error = fitted

    def fit(self, x):
        """The exponential at places x (n,) [m]."""
        return self._start * np.exp(-self._rate * x)

    def lost(self, lengths):
        """Loss over so many wavelengths [%]."""
        return 100.0 * (1.0 - np.exp(-self._rate * lengths * self.length))

    def error(self, lengths):
        """Standard error of that loss [%]."""
        return 100.0 * self._error * lengths * self.length


def _gauge(run, gauge):
    """Place, height from crest to trough, first and second harmonic [m] and periods of a gauge.

    It is read from when the wave has come, at the speed of its group, until the steady wave that
    the toe of the beach reflects comes back, or the run ends, over the last whole periods. What
    the toe reflects of the soft start, which comes before the steady wave, may be in them.
    """
    maker, period = run.case.wavemaker, run.case.wavemaker.period
    speed = group_celerity(period, run.depth, run.gravity)
    x, toe, (time, level) = gauge.x, run.case.tank.bed[1][0], run.gauge(gauge.name)
    came = maker.start + SETTLE * period + x / speed
    end = min(maker.start + (2.0 * toe - x) / speed, time[-1])
    periods = int((end - came) / period + 0.3)
    if periods < PERIODS:
        return x, np.nan, np.nan, np.nan, periods
    start = end - periods * period
    _, first, second = np.abs(harmonics(time, level, period, start, periods)[:3])
    return x, _height(time, level, period, start, periods), first, second, periods


def _height(time, level, period, start, periods):
    """Height from crest to trough [m], mean over whole periods from a time on."""
    starts = start + period * np.arange(periods)
    return np.mean([np.ptp(level[(time >= t) & (time < t + period)]) for t in starts])
