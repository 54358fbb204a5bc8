"""Sea states of a run: what its gauges tell of the waves, and of incident and reflected ones."""

from dataclasses import dataclass

import numpy as np

from mpslab.analysis import (
    arrays,
    coast,
    crossings,
    currents,
    readings,
    reflection,
    spectrum,
    windows,
)
from mpslab.analysis.harmonics import HARMONICS, harmonics
from mpslab.analysis.still import at_rest, still_level
from mpslab.core import bed
from mpslab.run.preflight import REGULAR

BAND = (1.0 / 3.0, 6.0)  # times the peak frequency
FEW_WAVES = 20
TOLD = 1e-3  # share of the variance: if less is left out of a reflection, no note says so
CALM = 0.25  # spacings: levels of still water differ by less, and particles carry no such waves
SEGMENT = 20.0  # peak periods in a segment of a record that is twice as long

AMPLITUDES = tuple(f"a{n}" for n in range(1, HARMONICS + 1))
UNITS = {
    "x": "m", "depth": "m", "mean": "m", "Hm0": "m", "Hm0 scatter": "-", "Hm0 slow": "m",
    "Tp": "s", "Tm-1,0": "s", "Tm01": "s", "Tm02": "s", "N": "-", "Hmean": "m", "Tmean": "s",
    "H1/3": "m", "T1/3": "s", "H1/10": "m", "Hmax": "m", "crest": "m", "trough": "m", "dry": "-",
    **dict.fromkeys(AMPLITUDES, "m"),
}  # fmt: skip


@dataclass(frozen=True)
class Sea:
    """What the gauges of a run tell of the waves.

    Attributes
    ----------
    run : mpslab.analysis.results.Run
    regular : bool
        Whether the waves are regular, with the period `period`.
    period : float [s]
        Of regular waves; for a sea the peak period by which band and segments were chosen.
    window, back : mpslab.analysis.windows.Window
        Of the gauges, and of the reflection.
    band : (float, float) [Hz]
        Frequencies that heights and periods are taken from.
    crossing : str
        "down" or "up".
    readings : mpslab.analysis.readings.Readings
        Those in the window.
    gauges : (gauges,) structured array
        "name" and the fields of `UNITS`, in these units: place and still depth; mean level above
        still water; `mpslab.analysis.spectrum.parameters`; `mpslab.analysis.crossings.statistics`;
        "dry", the share of missing readings; and for regular waves the amplitudes "a1" to "a4" of
        the harmonics. NaN if a gauge has no such number.
    spectra : dict of str to mpslab.analysis.spectrum.Spectrum
        Of each wet gauge; for regular waves, lines over the whole window.
    waves : dict of str to structured array
        Of each wet gauge, as `mpslab.analysis.crossings.waves`.
    reflection : mpslab.analysis.reflection.Reflection or None
    array : tuple of str
        Gauges that the reflection was taken from.
    currents : (probes,) structured array
        Mean velocities at the probes, as of `mpslab.analysis.currents.look`.
    coast : mpslab.analysis.coast.Coast
        Run-up, overtopping, the force on walls, and what is expected for the incident waves.
    notes : tuple of str
        What one has to know about these numbers, a line each.
    """

    run: object
    regular: bool
    period: float
    window: windows.Window
    back: windows.Window
    band: tuple
    crossing: str
    readings: readings.Readings
    gauges: np.ndarray
    spectra: dict
    waves: dict
    reflection: object
    array: tuple
    currents: np.ndarray
    coast: coast.Coast
    notes: tuple

    @property
    def expected(self):
        """What EurOtop expects for the incident waves, as from `mpslab.analysis.eurotop.table`."""
        return self.coast.expected


def analyse(
    run, start=None, end=None, gauges=None, period=None, crossing="down", segment=None, band=None,
    weights="equal",
):  # fmt: skip
    """What the gauges of a run tell of the waves.

    Parameters
    ----------
    run : mpslab.analysis.results.Run
        Finished or not.
    start, end : float [s], optional
        The window. By default (`mpslab.analysis.windows`) it begins when the waves have come to all
        gauges and ends with the last reading; for the reflection it begins when reflected waves are
        back, if five periods are then left.
    gauges : sequence of str, optional
        Those that the reflection is taken from; by default `mpslab.analysis.arrays.most`.
    period : float [s], optional
        Take the waves as regular ones of this period; by default that of a wavemaker for regular
        waves.
    crossing : str
        "down" or "up": the direction in which waves cross the mean level.
    segment : float [s], optional
        Length of the segments for the spectra of a sea; by default 20 peak periods, or half the
        window if it is short.
    band : (float, float) [Hz], optional
        Frequencies that heights and periods are taken from; by default from a third of the peak
        frequency to six times it.
    weights : str
        "equal" or "spacing", of the gauges in the reflection.

    Returns
    -------
    Sea

    Raises
    ------
    ValueError
        For bad input, in one line.
    """
    known = _Known(run, period)
    rows = known.line(gauges)
    asked = start is not None or end is not None
    window = windows.asked(start, end, known.last) if asked else known.window()
    seen = readings.read(known.series, known.level, window, known.whole)
    notes = _dry_notes(seen)
    if not seen.wet.any():
        raise ValueError(f"'{run.folder}': all gauges are dry, {window}")
    _refuse_still(known, seen)
    period = known.period or _peak_period(seen)
    band = _band(band, period, seen.step)
    length = _segment(segment, period, seen)
    spectra, waves, numbers = {}, {}, []
    for k, name in enumerate(known.names):
        row = {"name": name, "x": known.x[k], "depth": known.depth[k], "dry": seen.dry[k]}
        if seen.wet[k]:
            spectra[name], waves[name], found = _of_gauge(
                seen, k, known.whole, length, band, crossing
            )
            row |= found
        numbers.append(row)
    counts = [row["N"] for row in numbers if "N" in row]
    if not known.whole and max(counts) < FEW_WAVES:
        notes.append(
            f"{max(counts)} waves at most are in the window: a sea state wants {FEW_WAVES} or "
            "more, and a single wave has none"
        )
    back, note = (window, "") if asked else known.back(rows, window)
    notes += [note] * bool(note)
    try:
        found, array = _reflected(known, rows, back, band, length * seen.step, weights)
        notes += _left_out_notes(found)
    except ValueError as error:
        found, array = None, ()
        notes.append(f"no reflection: {error}")
    table = _table(numbers, known.whole is not None)
    means = table["Tmean"][np.isfinite(table["Tmean"])]
    each = known.whole or (float(means.mean()) if len(means) else period)
    shore = coast.look(
        run, known.level, known.whole is not None, known.arrival, window, asked, each, found
    )
    return Sea(
        run=run,
        regular=known.whole is not None,
        period=period,
        window=window,
        back=back,
        band=band,
        crossing=crossing,
        readings=seen,
        gauges=table,
        spectra=spectra,
        waves=waves,
        reflection=found,
        array=array,
        currents=currents.look(run, window, each),
        coast=shore,
        notes=(*notes, *shore.notes),
    )


class _Known:
    """What is known of a run before its readings are looked at.

    Attributes
    ----------
    series : structured array
        Its gauges, which have the names `names`, places `x` and still depths `depth`.
    level, gravity, last
        Level of the still water [m], gravity [m/s2], and the time of the last reading [s].
    period : float [s] or None
        Of the waves, if it is known.
    whole : float [s] or None
        The same, if the waves are regular.
    arrival : mpslab.analysis.windows.Arrival or None
        Of the waves of the wavemaker.
    """

    def __init__(self, run, period):
        self.run, self.case, self.series = run, run.tables, run.gauges
        instruments = {gauge["name"]: gauge for gauge in self.case.get("gauge", ())}
        if not instruments or not len(self.series):
            raise ValueError(f"'{run.folder}': has no readings of gauges; allowed: a run with some")
        if period is not None and not 0.0 < period < np.inf:
            raise ValueError(f"--period {period:g}: must be above 0 s")
        maker = self.case["wavemaker"]
        self.gravity = self.case["fluid"]["gravity"]
        self.level = still_level(self.case) or 0.0
        self.names = self.series.dtype.names[1:]
        self.x = np.array([instruments[name]["x"] for name in self.names], float)
        self.depth = self.level - self._bed(self.x)
        self.last = float(self.series["time"][-1])
        self.period = period or maker["period"] or None
        self.whole = self.period if period or maker["type"] in REGULAR else None
        self.arrival = None
        paddle = self.level - float(self._bed(0.0))
        if maker["period"] and paddle > 0.0 and self.gravity and (self.depth > 0.0).any():
            self.arrival = windows.Arrival.of(
                maker["period"], maker.get("start", 0.0), self.whole, paddle, self.gravity
            )

    def _bed(self, x):
        line = self.case["tank"].get("bed")
        return bed.elevation(line, x) if line else np.zeros_like(x, dtype=float)

    def line(self, wanted):
        """Rows of the gauges that the reflection is to be taken from."""
        if wanted is None:
            return arrays.most(self.x, self.depth, self.case["wavemaker"]["type"] != "none")
        return arrays.asked(wanted, self.names, self.x, self.depth)

    def window(self):
        """The window to take if the user asks for none."""
        wet = self.depth > 0.0
        if self.arrival:
            return self.arrival.window(self.x[wet], self.last)
        if self.case["initial"]["type"] == "standing_wave":
            return windows.Window(0.0, self.last, "all of the run")
        names = [name for name, deep in zip(self.names, wet, strict=True) if deep]
        return windows.from_readings(self.series, self.level, names)

    def back(self, rows, window):
        """The window of the reflection, and a note, which may be empty."""
        if not self.arrival or not rows:
            return window, ""
        far = coast.Site(self.case, self.level).place
        return self.arrival.back(self.x[rows].min(), far, window)


def _dry_notes(seen):
    return [
        f"gauge '{name}': dry in {100.0 * dry:.2g} % of the readings: "
        + ("these are bridged" if wet else "no numbers")
        for name, dry, wet in zip(seen.names, seen.dry, seen.wet, strict=True)
        if dry > 0.0
    ]


def _refuse_still(known, seen):
    """Refuse water that nothing moves, and whose levels are no waves that particles could carry."""
    most = CALM * known.case["particles"]["spacing"]
    if at_rest(known.case) and np.all(4.0 * seen.elevation[:, seen.wet].std(axis=0) < most):
        raise ValueError(
            f"'{known.run.folder}': no waves: the levels at all gauges stay as those of still water"
            f" (Hm0 below {most:.3g} m, a quarter of a spacing), and nothing in the case moves it"
        )


def _peak_period(seen):
    """Peak period of the mean spectrum of the gauges, in segments of half the record [s]."""
    half = len(seen.time) // 2
    found = [
        spectrum.welch(seen.elevation[:, k], seen.step, half) for k in np.flatnonzero(seen.wet)
    ]
    mean = np.mean([one.density for one in found], axis=0)
    mean[:2] = 0.0  # the mean, and what takes as long as a segment
    if not mean.max() > 0.0:
        raise ValueError("no waves: the levels at all gauges stay as they are")
    return float(1.0 / found[0].frequency[np.argmax(mean)])


def _band(band, period, step):
    most = 0.5 / step
    if band is None:
        return BAND[0] / period, min(BAND[1] / period, most)
    low, high = band
    if not 0.0 < low < high <= most:
        raise ValueError(
            f"--band {low:g} {high:g}: must rise, from above 0 to {most:.4g} Hz at most, half the "
            "rate of the readings"
        )
    return float(low), float(high)


def _segment(segment, period, seen):
    """Readings in a segment of the spectra of a sea."""
    count, step = len(seen.time), seen.step
    if segment is None:
        return min(round(SEGMENT * period / step), count // 2)
    if not 4.0 * period <= segment <= count * step:
        raise ValueError(
            f"--segment {segment:g}: must be from {4.0 * period:.4g} s, four wave periods, to "
            f"{count * step:.4g} s, the window"
        )
    return round(segment / step)


def _of_gauge(seen, k, whole, length, band, crossing):
    """Spectrum, single waves and numbers of a wet gauge."""
    elevation = seen.elevation[:, k]
    duration = len(elevation) * seen.step
    row = {"mean": elevation.mean()}
    if whole:  # a few whole periods seem to have a trend, which must not be taken off
        level = elevation - row["mean"]
        found = spectrum.of_periods(level, seen.step)
        row |= dict(zip(AMPLITUDES, np.abs(_amplitudes(seen, k, whole)), strict=True))
    else:
        level = spectrum.without_trend(elevation)
        found = spectrum.welch(level, seen.step, length)
    waves = crossings.waves(seen.time, level, crossing)
    row |= spectrum.parameters(found, *band, duration) | crossings.statistics(waves)
    if whole:
        row["Hm0 scatter"] = np.nan
    return found, waves, row


def _amplitudes(seen, k, period):
    """Complex amplitudes of the harmonics at a gauge, (HARMONICS,) [m]."""
    periods = round(len(seen.time) * seen.step / period)
    return harmonics(seen.time, seen.elevation[:, k], period, seen.time[0], periods)[1:]


def _table(rows, regular):
    fields = [name for name in UNITS if regular or name not in AMPLITUDES]
    width = max(len(row["name"]) for row in rows)
    table = np.full(len(rows), np.nan, [("name", f"U{width}"), *((f, float) for f in fields)])
    for entry, row in zip(table, rows, strict=True):
        for field, value in row.items():
            entry[field] = value
    return table


def _reflected(known, rows, window, band, segment, weights):
    """Reflection, and the names of the gauges that it was taken from."""
    if not known.gravity:
        raise ValueError("there is no gravity")
    seen = readings.read(known.series, known.level, window, known.whole)
    rows = [k for k in rows if seen.wet[k]]
    if len(rows) < 2:
        raise ValueError(f"{len(rows)} gauges that stay wet, in water of one depth: must be 2")
    x, depth = known.x[rows], float(np.mean(known.depth[rows]))
    if known.whole:
        amplitudes = np.array([_amplitudes(seen, k, known.whole) for k in rows])
        found = reflection.of_harmonics(amplitudes, x, known.whole, depth, known.gravity, weights)
    else:
        found = reflection.of_sea(
            seen.elevation[:, rows], x, seen.step, *band, 1.0 / segment, depth, known.gravity,
            weights,
        )  # fmt: skip
    return found, tuple(known.names[k] for k in rows)


def _left_out_notes(found):
    if found.lost < TOLD:
        return []
    bands = ", ".join(f"{f:.3g}" for f in found.frequency[found.left_out])
    return [
        f"reflection: {100.0 * found.lost:.2g} % of the variance is left out, where the distances "
        "of the gauges cannot tell incident from reflected waves"
        + (f" (all of {bands} Hz)" if bands else "")
    ]
