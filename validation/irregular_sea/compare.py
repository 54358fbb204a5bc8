"""A sea against the spectrum asked for, and the long waves that come with it."""

import numpy as np

from mpslab.analysis import seastate
from mpslab.analysis.reflection import separate
from mpslab.analysis.spectrum import Spectrum
from mpslab.theory import schaffer, spectra
from mpslab.theory.dispersion import wave_numbers
from validation import potential_tank
from validation.comparison import Comparison, rms

MEAN_OF = 5  # components that make a bin of the spectrum
LONGEST, LONG = 0.1, 0.5  # of the peak frequency: the band of long waves
CONFIDENCE = 0.95


def compare(runs):
    """Height, periods and spectrum of the first run; long waves of all."""
    result = Comparison()
    seas = {name: _of_run(run) for name, run in runs.items()}
    first = next(iter(seas))
    main, maker, ideal = seas[first], seas[first].maker, _in_potential_flow(runs[first])
    result.measure("height", main.height / maker.height)
    result.measure("height_in_flow", main.height / ideal.height)
    result.measure("mean_period", main.mean_period / main.asked_mean_period)
    result.measure("peak", (main.peak - maker.period) * main.bin * main.peak**-2)
    low, high = main.spectrum.band(CONFIDENCE)
    result.measure("inside", np.mean((low <= main.asked) & (main.asked <= high)))
    result.measure("level", 100.0 * max(main.levels, key=abs) / runs[first].depth)
    if "first-order" in seas:
        free = seas["second-order"].free_long / seas["first-order"].free_long
        result.measure("long_waves", free)
    _tell(result, {**seas, f"{first}, potential flow": ideal}, runs)
    _draw(result, main, ideal, runs)
    return result


def _tell(result, seas, runs):
    reflected = {name: _kr(run) for name, run in runs.items()}
    columns = ["run", "Hm0 [mm]", "Kr", "Tp [s]", "Tm-1,0 [s]", "asked for [s]",
               "long waves, rms [mm]", "bound ones by theory [mm]", "the rest [mm]"]  # fmt: skip
    result.table("Incident waves", columns, [
        [name, 1e3 * sea.height, reflected.get(name, np.nan), sea.peak, sea.mean_period,
         sea.asked_mean_period, 1e3 * sea.long, 1e3 * sea.bound_long, 1e3 * sea.free_long]
        for name, sea in seas.items()
    ])  # fmt: skip


def _draw(result, main, ideal, runs):
    figure = result.figure("Spectrum of the incident waves", "f Tp", "S / (Hm0^2 Tp)")
    scale = main.maker.height**2 * main.maker.period
    share = main.spectrum.frequency * main.maker.period
    edges = main.spectrum.band(CONFIDENCE)
    figure.band("95 % confidence", share, *(edge / scale for edge in edges))
    figure.line("measured", share, main.spectrum.density / scale)
    figure.dashed("asked for", share, main.asked / scale)
    figure.dashed("potential flow", share, ideal.spectrum.density / scale)
    for name, run in runs.items():
        gauge, maker = run.case.gauge[0], run.case.wavemaker
        figure = result.figure(f"Level at x = {gauge.x:g} m, {name}", "t / Tp", "level / Hm0")
        time, level = run.gauge(gauge.name)
        figure.line("level", time / maker.period, (level - run.depth) / maker.height)


def _of_run(run):
    levels = np.stack([run.gauge(gauge.name)[1] for gauge in run.case.gauge], axis=1)
    return _Sea(run.case, run.gauges["time"], levels - run.depth)


def _in_potential_flow(run):
    """The sea that the same piston makes in fully nonlinear potential flow."""
    return _Sea(run.case, *potential_tank.levels(run.case, [gauge.x for gauge in run.case.gauge]))


def _kr(run):
    end = run.case.time.end
    return seastate.analyse(run, end - run.case.wavemaker.record, end).reflection.kr_primary


class _Sea:
    """The waves of the last record of a case.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    time : (n,) float64 [s]
    levels : (n, gauges) float64 [m]
        Above still water.

    Attributes
    ----------
    height, peak, mean_period : float [m], [s], [s]
        Hm0, Tp and Tm-1,0 of the incident waves.
    spectrum : mpslab.analysis.spectrum.Spectrum
        Of the incident waves.
    asked, asked_mean_period : (n,) float64 [m2 s], float [s]
        The spectrum asked for, at the same frequencies.
    levels : (gauges,) float64 [m]
        Mean level above still water.
    long, bound_long, free_long : float [m]
        Root mean square of the long waves, of the bound ones by theory, and of their difference.
    """

    def __init__(self, case, time, levels):
        self.maker, self.depth, self.gravity = case.wavemaker, case.tank.depth, case.fluid.gravity
        self.x = np.array([gauge.x for gauge in case.gauge])
        record, period = self.maker.record, self.maker.period
        count = round(record / case.output.gauge_interval)
        times = case.time.end - record + record / count * np.arange(count)
        series = 2.0 / count * np.fft.rfft(
            np.stack([np.interp(times, time, level) for level in levels.T], axis=1), axis=0
        )  # fmt: skip
        series[0] *= 0.5  # complex amplitudes of all multiples of 1 / record (n, gauges) [m]
        self.levels = series[0].real
        self.bin = MEAN_OF / record
        self._waves(series, record, period)
        self._long_waves(series, record, period)

    def _waves(self, series, record, period):
        low, high = self.maker.band
        first, last = np.ceil(low * record / period), np.floor(high * record / period)
        number = np.arange(int(first), int(last) + 1)
        self.frequency = number / record
        k = wave_numbers(2.0 * np.pi * self.frequency, self.depth, self.gravity)
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
        maker = self.maker
        density = spectra.density(maker.spectrum, frequency, maker.height, maker.period,
                                  maker.gamma, self.depth, self.gravity)  # fmt: skip
        return density * (maker.height**2 / 16.0 * maker.record / density.sum())

    def _long_waves(self, series, record, period):
        """What is below the waves of the sea: the bound waves of their pairs, and free ones."""
        first, step = round(self.frequency[0] * record), 2.0 * np.pi / record
        part = slice(int(np.ceil(LONGEST * record / period)), int(LONG * record / period))
        sea = series[first : first + len(self.frequency)]

        def pair(one, other, sign):
            return schaffer.bound_wave(one, other, sign, self.depth, self.gravity)

        bound = np.stack([
            schaffer.of_pairs(waves, first, step, pair)[part] for waves in sea.T
        ], axis=1)  # fmt: skip
        self.long, self.bound_long, self.free_long = (
            np.sqrt(0.5 * len(waves)) * rms(np.abs(waves))
            for waves in (series[part], bound, series[part] - bound)
        )
