"""Piston for a focused wave: the likely shape of the highest wave of a sea (NewWave)."""

import math

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _sea, _table
from mpslab.theory import breaking, dispersion, waves

GROUP = 5.0  # peak periods that a group lasts to either side of its crest
LATE = 0.01  # share of the motion that may be cut off at the start


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle for waves that all have a crest at wavemaker.place and wavemaker.time.

    a_i = A S(f_i) df / m0 (Tromans, Anaturk & Hagemeijer 1991). A is wavemaker.amplitude, or
    sqrt(2 m0 ln N), the highest of N = wavemaker.largest_of waves. wavemaker.phase turns all waves,
    180 degrees to a trough. Order 2 is as for `irregular`. Without a time, it is the earliest for
    which even the slowest wave sets out after t = 0.

    Raises ValueError as `_sea.of_wavemaker` and `_sea.require_range` do, or if a stroke is given,
    no place is given, or the wave would break.
    """
    paddle.refuse_stroke(wavemaker)
    paddle.require_positive("place", wavemaker.place, "m")
    paddle.require_positive("period", wavemaker.period, "s")
    period = wavemaker.period
    slow = dispersion.group_velocity(
        np.array([2.0 * math.pi * _sea.band_of(wavemaker)[1] / period]), depth, gravity
    )
    soonest = wavemaker.place / float(slow[0]) + GROUP * period
    focus = wavemaker.time or soonest
    last = focus + GROUP * period
    record = max(wavemaker.record, soonest + GROUP * period)
    sea = _sea.of_wavemaker(wavemaker, depth, gravity, record)
    doubts = _sea.require_range(wavemaker, sea, depth, gravity)
    crest = _crest(wavemaker, sea, depth, gravity)
    k = dispersion.wave_numbers(sea.rate, depth, gravity)
    phase = k * wavemaker.place - sea.rate * focus + math.radians(wavemaker.phase)
    amplitude = crest * sea.variance / sea.variance.sum() * np.exp(1j * phase)
    table = _sea.piston(sea, amplitude, wavemaker.order, depth, gravity)
    begin = max(last - record, 0.0)
    rise = max(wavemaker.start, 0.5 * period)
    motion = _table.Faded(table, rise, begin, last, period)
    times = _sea.samples_of(table, min(end, last))
    facts = _sea.facts_of(sea, amplitude, motion, times, depth, gravity)
    facts |= {"crest [m]": crest, "focus_time [s]": focus}
    del facts["repeats_after [s]"]
    note = (
        f"focused wave, {wavemaker.spectrum}, order {wavemaker.order}: crest of {crest:.4g} m at x "
        f"= {wavemaker.place:g} m, t = {focus:.4g} s, {len(amplitude)} components, steepness k A = "
        f"{k[np.argmax(sea.variance)] * crest:.2f}"
    )
    doubts += [*_early(table, rise, begin, last), *_cut(focus, end), *_sea.doubts_of(sea)]
    whole = _sea.samples_of(table, last)
    return paddle.from_motion(
        motion, times, sea.height, note, whole, facts, tuple(doubts), (sea.rate, np.abs(amplitude)),
        _sea.beyond(sea, amplitude, motion, depth, gravity),
    )  # fmt: skip


def _crest(wavemaker, sea, depth, gravity):
    """Amplitude at the focus [m]."""
    length = waves.wavelength(sea.period, depth, gravity)
    limit = 0.5 * breaking.miche_height(length, depth)
    if wavemaker.amplitude:
        paddle.require_unbroken("amplitude", wavemaker.amplitude, limit, "half of 0.142 L tanh(kh)")
        return wavemaker.amplitude
    crest = sea.height / 4.0 * math.sqrt(2.0 * math.log(wavemaker.largest_of))
    most = sea.height * limit / crest
    reason = f"the highest of {wavemaker.largest_of} waves has half of 0.142 L tanh(kh)"
    paddle.require_unbroken("height", sea.height, most, reason)
    return crest


def _early(table, rise, begin, last):
    """Whether some of the group would have to set out before the run begins."""
    if begin > 0.0:
        return []
    middle = min(0.5 * rise, last)
    before, after = (
        np.sum(table(np.arange(a, b, table.step), 1) ** 2)
        for a, b in ((last - table.length, middle), (middle, last))
    )
    share = before / (before + after)
    if share <= LATE:
        return []
    return [
        f"wavemaker.time: {100 * share:.0f} % of the paddle's motion lies before it has begun to "
        "move: the wave stays lower; a later time, or a narrower wavemaker.band, lets all of it in"
    ]


def _cut(focus, end):
    if focus < end:
        return []
    return [f"wavemaker.time: the wave comes to its focus at t = {focus:.4g} s, after time.end = "
            f"{end:g} s"]  # fmt: skip
