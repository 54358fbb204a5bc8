"""Piston for two waves of similar periods, which make groups, to first or second order."""

import math

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _sea, _table
from mpslab.theory import breaking, dispersion, schaffer, waves

CLOSEST = 0.02  # least difference of the frequencies over their mean
WIDEST = 5.0  # largest ratio of the periods
GROUPS = 50  # among which the extremes are looked for
POINTS = 100  # to a period


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle X = Re sum of -i A / c0 e^{i omega t} for two waves; order 2 adds what Schaffer says.

    The waves have wavemaker.height and wavemaker.period, wavemaker.second_height (0 for the same)
    and wavemaker.second_period; both have a crest at the piston at t = 0. Faded in as `irregular`.

    Raises ValueError if a height or period is not positive, the periods are too near or far apart,
    both waves together break at the maker or are too long for second order, or a stroke is given.
    """
    paddle.refuse_stroke(wavemaker)
    heights = np.array([wavemaker.height, wavemaker.second_height or wavemaker.height])
    periods = np.array([wavemaker.period, wavemaker.second_period])
    for key, value in (("height", heights[0]), ("second_height", heights[1])):
        paddle.require_positive(key, value, "m")
    for key, value in (("period", periods[0]), ("second_period", periods[1])):
        paddle.require_positive(key, value, "s")
    _require_apart(*periods)
    doubts = _require_range(wavemaker, heights, periods, depth, gravity)
    rates, series = _series(wavemaker.order, heights, periods, depth, gravity)

    def whole_motion(t, derivative=0):
        turned = series * (1j * rates) ** derivative
        return np.sum(np.real(np.exp(1j * np.multiply.outer(t, rates)) * turned), axis=-1)

    fade = max(wavemaker.start, 0.5 * float(periods.max()))
    motion = _table.Faded(whole_motion, fade)
    group = 1.0 / abs(1.0 / periods[0] - 1.0 / periods[1])
    last = fade + GROUPS * group
    times, whole = (_sea.times_of(periods.min() / POINTS, t) for t in (min(end, last), last))
    facts = {"group_period [s]": float(group), **_sea.speeds(motion, times)}
    note = (
        f"bichromatic, order {wavemaker.order}: T = {periods[0]:g} s and {periods[1]:g} s, H = "
        f"{heights[0]:g} m and {heights[1]:g} m, groups of {group:.4g} s"
    )
    asked = 2.0 * math.pi / periods, 0.5 * heights
    return paddle.from_motion(
        motion, times, wavemaker.height, note, whole, facts, tuple(doubts), asked,
        _bound.of_waves(*asked, depth, gravity, motion.share),
    )  # fmt: skip


def _series(order, heights, periods, depth, gravity):
    """Frequencies [rad/s] and complex amplitudes of X [m]."""
    rate = 2.0 * math.pi / periods
    k = dispersion.wave_numbers(rate, depth, gravity)
    first = -0.5j * heights / dispersion.biesel(k * depth)
    if order == 1:
        return rate, first
    a = 0.5 * heights
    fast, slow = (rate[i : i + 1] for i in (np.argmax(rate), np.argmin(rate)))
    twice = a**2 * schaffer.transfer(rate, rate, 1, depth, gravity)
    both = [a[0] * a[1] * schaffer.transfer(fast, slow, s, depth, gravity) for s in (1, -1)]
    rates = np.concatenate([rate, 2.0 * rate, fast + slow, fast - slow])
    return rates, np.concatenate([first, twice, *both])


def _require_apart(one, other):
    gap = abs(one - other) / (0.5 * (one + other))
    if max(one, other) > WIDEST * min(one, other):
        raise ValueError(
            f"wavemaker.second_period = {other:g} s: must be from {one / WIDEST:.4g} to "
            f"{one * WIDEST:.4g} s, within {WIDEST:g} times wavemaker.period = {one:g} s"
        )
    if gap < CLOSEST:
        raise ValueError(
            f"wavemaker.second_period = {other:g} s: must differ from wavemaker.period = {one:g} s "
            f"by {100 * CLOSEST:g} % or more"
        )


def _require_range(wavemaker, heights, periods, depth, gravity):
    longest, total = float(periods.max()), float(heights.sum())
    length = waves.wavelength(float(periods.min()), depth, gravity)
    share = wavemaker.height / total
    limit = share * breaking.miche_height(length, depth)
    reason = "where both waves add up, 0.142 L tanh(kh) of the shorter"
    paddle.require_unbroken("height", wavemaker.height, limit, reason)
    if wavemaker.order == 1:
        return []
    length = waves.wavelength(longest, depth, gravity)
    ursell, most = waves.ursell(float(heights.max()), length, depth), breaking.MADSEN_URSELL_LIMIT
    if ursell >= most:
        raise ValueError(
            f"wavemaker.order = 2: must be 1 for so long a wave: H L^2/h^3 = {ursell:.1f}, and "
            f"second-order theory holds below 8 pi^2/3 = {most:.1f}"
        )
    together = waves.ursell(total, length, depth)
    if together < most:
        return []
    return [
        f"wavemaker.order = 2: where both waves add up, H L^2/h^3 = {together:.1f} is beyond the "
        f"{most:.1f} of second-order theory: expect secondary crests there"
    ]
