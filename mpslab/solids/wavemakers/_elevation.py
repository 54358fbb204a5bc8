"""The motion of a piston that makes a recorded surface elevation, by linear theory."""

import numpy as np

from mpslab.later import scipy
from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _sea, _table
from mpslab.theory import breaking, dispersion

COLUMNS = (("time", "s"), ("elevation", "m"))
TAPER = 0.05  # share of the record over which each of its ends fades to zero
POINTS = 4  # equal steps to the median time between two rows
MOST_POINTS = 200_000
LONGEST = 0.25  # share of the record: the longest period that the piston makes


def make(record, wavemaker, depth, gravity, end):
    """Paddle X = Re sum of -i A / c0 e^{i omega t}, with A of a record and c0 of Biesel.

    The elevation counts from the mean of the record. The steps of its times may differ: a monotone
    cubic goes through the rows. The ends of the record fade to zero. Periods longer than a quarter
    of it are left out: the longer they are, the farther the piston would have to go.

    Raises ValueError if a stroke or smoothing is given, or the record breaks or has too few rows.
    """
    paddle.refuse_stroke(wavemaker)
    if wavemaker.smoothing != 0.0:
        raise ValueError(
            f"wavemaker.smoothing = {wavemaker.smoothing:g} s: must be 0 for wavemaker.quantity = "
            "'elevation'"
        )
    begin, last = record.times[0] - wavemaker.offset, record.times[-1] - wavemaker.offset
    length = last - begin
    even, eta = _even(record)
    largest = float(np.ptp(eta))
    limit = breaking.MCCOWAN_RATIO * depth
    if largest >= limit:
        raise ValueError(
            f"{record.where}: its elevation goes through {largest:.4g} m: must be below "
            f"{limit:.4g} m, 0.78 of the depth, or the waves break at the maker"
        )
    series, amplitude = _motion(eta, length, depth, gravity)
    table = _table.of_series(series, np.pi / length)
    rise = max(wavemaker.start, TAPER * length)

    def motion(t, derivative=0):
        return table(np.asarray(t) - begin, derivative)

    moved = _table.Faded(motion, rise, max(begin, 0.0), last, TAPER * length)
    times, whole = (_sea.times_of(even, t) for t in (min(end, last), last))
    facts = {
        "rows": len(record.times), "begin [s]": begin, "end [s]": last,
        "significant_height [m]": 4.0 * float(np.std(eta)), **_sea.speeds(moved, times),
    }  # fmt: skip
    note = f"recorded elevation of {wavemaker.file}, by linear theory"
    kept = np.flatnonzero(amplitude)

    def beyond(reach):
        """The table of the bound waves, as late as that of the motion."""
        late = _bound.of_sea(
            amplitude[kept[0] :], kept[0], np.pi / length, depth, gravity,
            lambda t: moved.share(t + begin),
        )(reach)  # fmt: skip
        return lambda t: late(t - begin)

    waves = kept * np.pi / length, np.abs(amplitude[kept])
    return paddle.from_motion(moved, times, 0.0, note, whole, facts, (), waves, beyond)


def _even(record):
    """An equal step of time [s], and the record in such steps less its mean, (n,) float64 [m]."""
    length = record.times[-1] - record.times[0]
    step = max(float(np.median(np.diff(record.times))) / POINTS, length / MOST_POINTS)
    count = int(np.ceil(length / step))
    curve = scipy.interpolate.PchipInterpolator(record.times, record.values)
    eta = curve(record.times[0] + length * np.arange(count) / count)
    return length / count, eta - eta.mean()


def _motion(eta, length, depth, gravity):
    """Complex amplitudes of X and of the waves at multiples of half the record's frequency [m]."""
    count = len(eta)
    at = np.arange(count) / count
    edge = np.clip(np.minimum(at, 1.0 - at) / TAPER, 0.0, 1.0)
    series = np.fft.rfft(np.append(eta * edge * edge * (3.0 - 2.0 * edge), np.zeros(count)))
    rate = np.arange(1, len(series)) * np.pi / length
    kept = rate >= 2.0 * np.pi / (LONGEST * length)
    kept &= rate <= np.pi * count / (POINTS * length)
    ratio = dispersion.biesel(dispersion.wave_numbers(rate, depth, gravity) * depth)
    amplitude = np.append(0.0, np.where(kept, series[1:], 0.0)) / count
    moved = -1j * amplitude / np.append(1.0, ratio)
    last = np.flatnonzero(kept)[-1] + 2 if kept.any() else 2
    return moved[:last], amplitude[:last]
