"""The level at a piston that absorbs, less the level that linear theory expects of its motion.

To second order this difference has two parts. The first is the bound waves, less the free waves
that the second-order motion of Schaffer (1996) makes by linear theory. With that motion linear
theory counts these free waves and the tank has none; without it the tank has their opposites and
linear theory counts none: the difference is the same. The second is X d eta/dx, because the gauge
moves with the piston. Where the motion fades in, the difference grows with the square of its share.

`of_waves`, `of_sea` and `of_permanent` give a function of the reach of the piston's gauge [m] that
gives a function of time [s]: the difference, `mpslab.solids.paddle.Paddle.beyond`.
"""

import numpy as np

from mpslab.solids.wavemakers import _table
from mpslab.theory import dispersion, schaffer
from mpslab.theory.absorption import Gauge, seen

HARMONICS, POINTS = 12, 256  # of a wave of permanent form: its harmonics, and points to a period


def level(depth, gravity, reach):
    """Level of a pair of waves over A_n A_m (sign +1) or A_n A_m* (sign -1).

    Returns a function (first, second : (n,) float64 [rad/s], sign) -> (n,) complex128.
    """

    def of(first, second, sign):
        rate = first + sign * second
        number = dispersion.wave_numbers(first, depth, gravity)
        number = number + sign * dispersion.wave_numbers(second, depth, gravity)
        bound = schaffer.bound_wave(first, second, sign, depth, gravity) * seen(number, reach)
        free = Gauge(rate, depth, gravity, reach).level
        free = free * schaffer.transfer(first, second, sign, depth, gravity)
        return bound - free + carried(first, second, sign)

    def carried(first, second, sign):
        (x, slope), (y, other) = moved(first), moved(second)
        if sign < 0:
            y, other = y.conj(), other.conj()
        return np.where(first == second, 0.25, 0.5) * x * y * (slope + other)

    def moved(rate):
        """Amplitude of the piston for a wave of one metre, and the slope of the level there."""
        ratio = dispersion.biesel(dispersion.wave_numbers(rate, depth, gravity) * depth)
        return -1j / ratio, Gauge(rate, depth, gravity, reach).slope

    return of


def of_waves(rate, amplitude, depth, gravity, fade):
    """`Paddle.beyond` of one wave or two.

    Parameters
    ----------
    rate : (n,) float64 [rad/s]
    amplitude : (n,) complex128 [m]
    fade : function (t [s]) -> share of the motion
    """

    def beyond(reach):
        pair = level(depth, gravity, reach)
        rates, parts = [2.0 * rate], [amplitude**2 * pair(rate, rate, 1)]
        if len(rate) == 2:
            fast, slow = (np.array([pick(rate)]) for pick in (np.argmax, np.argmin))
            for sign in (1, -1):
                a, b = amplitude[fast], amplitude[slow]
                product = a * (b if sign > 0 else b.conj())
                parts.append(product * pair(rate[fast], rate[slow], sign))
                rates.append(rate[fast] + sign * rate[slow])
        return _sum(np.concatenate(rates), np.concatenate(parts), fade)

    return beyond


def of_sea(amplitude, first, step, depth, gravity, fade, lowest=0.0):
    """`Paddle.beyond` of many waves, of frequencies (first + i) step, as in `schaffer.of_pairs`."""

    def beyond(reach):
        pair = level(depth, gravity, reach)
        table = _table.of_series(schaffer.of_pairs(amplitude, first, step, pair, lowest), step)
        return lambda t: table(t) * fade(t) ** 2

    return beyond


def of_permanent(motion, period, celerity, number, depth, gravity, fade):
    """`Paddle.beyond` of a wave of permanent form, whose level at the face is h U / (c - U).

    Parameters
    ----------
    motion : function (t, derivative) -> X or its velocity
        One period of it.
    celerity, number : float [m/s], [1/m]
    """

    def beyond(reach):
        times = period * np.arange(POINTS) / POINTS
        place, speed = motion(times, 0), motion(times, 1)
        order = np.arange(1, HARMONICS + 1)
        rate = 2.0 * np.pi / period * order
        found, moved = (
            2.0 / POINTS * np.fft.rfft(one)[order]
            for one in (depth * speed / (celerity - speed), place)
        )
        gauge = Gauge(rate, depth, gravity, reach)
        return _sum(rate, found * seen(order * number, reach) - 1j * gauge.out * moved, fade)

    return beyond


def _sum(rate, series, fade):
    return lambda t: float(np.real(np.sum(np.exp(1j * rate * t) * series))) * fade(t) ** 2
