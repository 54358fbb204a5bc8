"""A sea against the spectrum asked for, and the long waves that come with it."""

import numpy as np

from mpslab.analysis import seastate
from mpslab.analysis.reflection import separate
from mpslab.analysis.spectrum import Spectrum
from mpslab.theory import schaffer, spectra
from mpslab.theory.dispersion import wave_numbers
from validation.comparison import Comparison, rms

MEAN_OF = 5  # components that make a bin of the spectrum
LONGEST, LONG = 0.1, 0.5  # of the peak frequency: the band of long waves
CONFIDENCE = 0.95


def compare(runs):
    """Height, periods and spectrum of the first run; long waves of all."""
    result = Comparison()
    seas = {name: _Sea(run) for name, run in runs.items()}
    main = next(iter(seas.values()))
    result.measure("height", main.height / main.maker.height)
    result.measure("mean_period", main.mean_period / main.asked_mean_period)
    result.measure("peak", (main.peak - main.maker.period) * main.bin * main.peak**-2)
    low, high = main.spectrum.band(CONFIDENCE)
    result.measure("inside", np.mean((low <= main.asked) & (main.asked <= high)))
    result.measure("level", 100.0 * max(main.levels, key=abs) / main.run.depth)
    if "first-order" in seas:
        free = seas["second-order"].free_long / seas["first-order"].free_long
        result.measure("long_waves", free)
    _draw(result, seas, main)
    return result


def _draw(result, seas, main):
    columns = ["run", "Hm0 [mm]", "Kr", "Tp [s]", "Tm-1,0 [s]", "asked for [s]",
               "long waves, rms [mm]", "bound ones by theory [mm]", "the rest [mm]"]  # fmt: skip
    result.table("Incident waves", columns, [
        [name, 1e3 * sea.height, sea.kr, sea.peak, sea.mean_period, sea.asked_mean_period,
         1e3 * sea.long, 1e3 * sea.bound_long, 1e3 * sea.free_long]
        for name, sea in seas.items()
    ])  # fmt: skip
    figure = result.figure("Spectrum of the incident waves", "f Tp", "S / (Hm0^2 Tp)")
    scale = main.maker.height**2 * main.maker.period
    share = main.spectrum.frequency * main.maker.period
    edges = main.spectrum.band(CONFIDENCE)
    figure.band("95 % confidence", share, *(edge / scale for edge in edges))
    figure.line("measured", share, main.spectrum.density / scale)
    figure.dashed("asked for", share, main.asked / scale)
    for name, sea in seas.items():
        figure = result.figure(f"Level at x = {sea.x[0]:g} m, {name}", "t / Tp", "level / Hm0")
        time, level = sea.run.gauge(sea.run.case.gauge[0].name)
        figure.line("level", time / sea.maker.period, (level - sea.run.depth) / sea.maker.height)


class _Sea:
    """The waves of one record.

    Attributes
    ----------
    height, kr, peak, mean_period : float [m], [-], [s], [s]
        Hm0, Kr, Tp and Tm-1,0 of the incident waves.
    spectrum : mpslab.analysis.spectrum.Spectrum
        Of the incident waves.
    asked, asked_mean_period : (n,) float64 [m2 s], float [s]
        The spectrum asked for, at the same frequencies.
    levels : (gauges,) float64 [m]
        Mean level above still water.
    long, bound_long, free_long : float [m]
        Root mean square of the long waves, of the bound ones by theory, and of their difference.
    """

    def __init__(self, run):
        self.run, self.maker = run, run.case.wavemaker
        self.x = np.array([gauge.x for gauge in run.case.gauge])
        record, period = self.maker.record, self.maker.period
        self.start = run.case.time.end - record
        series = self._series()
        self.levels = series[0].real
        self.bin = MEAN_OF / record
        self._waves(series, record, period)
        found = seastate.analyse(run, self.start, run.case.time.end)
        self.kr = found.reflection.kr_primary
        self._long_waves(series, record, period)

    def _series(self):
        """Complex amplitudes of all multiples of 1 / record at the gauges (n, gauges) [m]."""
        count = round(self.maker.record / self.run.case.output.gauge_interval)
        times = self.start + self.maker.record / count * np.arange(count)
        levels = np.stack([
            np.interp(times, *self.run.gauge(gauge.name)) for gauge in self.run.case.gauge
        ], axis=1) - self.run.depth  # fmt: skip
        found = 2.0 / count * np.fft.rfft(levels, axis=0)
        found[0] *= 0.5
        return found

    def _waves(self, series, record, period):
        low, high = self.maker.band
        first, last = np.ceil(low * record / period), np.floor(high * record / period)
        number = np.arange(int(first), int(last) + 1)
        self.frequency = number / record
        k = wave_numbers(2.0 * np.pi * self.frequency, self.run.depth, self.run.gravity)
        incident = separate(series[number].T, self.x, k)[0]
        variance = 0.5 * np.abs(incident) ** 2
        wanted = self._asked(self.frequency) / record
        self.height = 4.0 * np.sqrt(variance.sum())
        self.mean_period = np.sum(variance / self.frequency) / variance.sum()
        self.asked_mean_period = np.sum(wanted / self.frequency) / wanted.sum()
        bins = len(number) // MEAN_OF
        mean = [part[: bins * MEAN_OF].reshape(bins, MEAN_OF).mean(axis=1)
                for part in (self.frequency, variance * record, wanted * record)]  # fmt: skip
        self.spectrum = Spectrum(mean[0], mean[1], 2.0 * MEAN_OF)
        self.asked = mean[2]
        self.peak = 1.0 / mean[0][np.argmax(mean[1])]

    def _asked(self, frequency):
        """The spectrum asked for, with all of its variance within the band."""
        maker, run = self.maker, self.run
        density = spectra.density(maker.spectrum, frequency, maker.height, maker.period,
                                  maker.gamma, run.depth, run.gravity)  # fmt: skip
        return density * (maker.height**2 / 16.0 * maker.record / density.sum())

    def _long_waves(self, series, record, period):
        """What is below the waves of the sea: the bound waves of their pairs, and free ones."""
        first, step = round(self.frequency[0] * record), 2.0 * np.pi / record
        part = slice(int(np.ceil(LONGEST * record / period)), int(LONG * record / period))
        sea = series[first : first + len(self.frequency)]

        def pair(one, other, sign):
            return schaffer.bound_wave(one, other, sign, self.run.depth, self.run.gravity)

        bound = np.stack([
            schaffer.of_pairs(waves, first, step, pair)[part] for waves in sea.T
        ], axis=1)  # fmt: skip
        self.long, self.bound_long, self.free_long = (
            np.sqrt(0.5 * len(waves)) * rms(np.abs(waves))
            for waves in (series[part], bound, series[part] - bound)
        )
