"""A motion as a table: cheap in every step however many waves it is made of."""

import numpy as np

POINTS = 16  # of the table to the shortest period: with them, quintics are right to 1e-7


class Table:
    """Quintics between equal steps, at which they have the given place, velocity and acceleration.

    The velocity and acceleration of the table are the derivatives of its place, without jumps.

    Parameters
    ----------
    step : float [s]
    place, velocity, acceleration : (n,) float64
        At the times i step, i from 0 on.
    cyclic : bool
        Whether the table repeats after n steps; if not, its ends hold before and after it.
    """

    def __init__(self, step, place, velocity, acceleration, cyclic):
        self.step, self.cyclic = step, cyclic
        if cyclic:
            place, velocity, acceleration = (
                np.append(part, part[0]) for part in (place, velocity, acceleration)
            )
        start, v, a = place[:-1], velocity[:-1] * step, acceleration[:-1] * step**2
        way = np.diff(place) - v - 0.5 * a
        gain = np.diff(velocity) * step - a
        bend = np.diff(acceleration) * step**2
        self.terms = np.array([
            start, v, 0.5 * a, 10.0 * way - 4.0 * gain + 0.5 * bend,
            7.0 * gain - 15.0 * way - bend, 6.0 * way - 3.0 * gain + 0.5 * bend,
        ])  # fmt: skip

    @property
    def length(self):
        """Time that it covers [s]."""
        return self.terms.shape[1] * self.step

    def __call__(self, t, derivative=0):
        """Place at t, or velocity (1) or acceleration (2); t: float or (n,) float64 [s]."""
        count = self.terms.shape[1]
        steps = np.divide(t, self.step)
        steps = np.mod(steps, count) if self.cyclic else np.clip(steps, 0.0, count)
        at = np.minimum(np.asarray(steps, int), count - 1)
        s, terms = steps - at, self.terms[:, at]
        for _ in range(derivative):
            terms = np.array([i * term for i, term in enumerate(terms)][1:]) / self.step
        found = terms[-1]
        for term in terms[-2::-1]:
            found = term + s * found
        return found


def of_series(series, step):
    """Table of the real part of the sum of a_i e^{i omega_i t}, omega_i = i step.

    Parameters
    ----------
    series : (n,) complex128
        Amplitudes a_i; the first, a constant, is left out.
    step : float [rad/s]
    """
    points = POINTS * len(series)
    rates = np.arange(len(series)) * step
    series = np.append(0.0, series[1:])
    parts = [np.fft.irfft((1j * rates) ** n * series, points) * (0.5 * points) for n in range(3)]
    return Table(2.0 * np.pi / step / points, *parts, cyclic=True)


class Faded:
    """A motion, faded in from rest, and faded out again if it has an end.

    Parameters
    ----------
    motion : function (t, derivative=0)
        For example a `Table`.
    rise : float [s]
        Time in which it fades in, from `begin`.
    begin, end : float [s]
        Before and after, it stands still at 0; the end is infinite if there is none.
    fall : float [s]
        Time in which it fades out, up to the end.
    """

    def __init__(self, motion, rise, begin=0.0, end=np.inf, fall=0.0):
        self.motion, self.begin, self.end = motion, begin, end
        self.rise, self.fall = rise, fall

    def share(self, t):
        """Share of the motion at t, from 0 to 1."""
        rise = _fade((np.asarray(t) - self.begin) / self.rise, 0)
        return rise * (_fade((self.end - np.asarray(t)) / self.fall, 0) if self.fall else 1.0)

    def __call__(self, t, derivative=0):
        """Place at t, or velocity (1) or acceleration (2); t: float or (n,) float64 [s]."""
        orders = range(derivative + 1)
        parts = _product(
            [self.motion(t, n) for n in orders],
            [_fade((np.asarray(t) - self.begin) / self.rise, n) / self.rise**n for n in orders],
        )
        if self.fall > 0.0:
            left = (self.end - np.asarray(t)) / self.fall
            parts = _product(parts, [_fade(left, n) / (-self.fall) ** n for n in orders])
        return parts[derivative]


def _product(one, other):
    """Derivatives of a product, from those of its factors: up to order 2 at most."""
    times = ((1,), (1, 1), (1, 2, 1))
    return [
        sum(n * one[i] * other[order - i] for i, n in enumerate(times[order]))
        for order in range(len(one))
    ]


def _fade(s, derivative):
    """s^2 (3 - 2 s) from s = 0 to 1, or its derivative by s; constant before and after."""
    inside = (s > 0.0) & (s < 1.0)
    s = np.clip(s, 0.0, 1.0)
    if derivative == 0:
        return s * s * (3.0 - 2.0 * s)
    return np.where(inside, 6.0 * s * (1.0 - s) if derivative == 1 else 6.0 - 12.0 * s, 0.0)
