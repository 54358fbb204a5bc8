"""A piston that absorbs: what its gauge sees, what its law reflects, and the law to choose.

Linear waves of depth h.  The surface is the real part of A e^{i (omega t - k x)}; a piston at
X e^{i omega t} makes waves of i c0 X, with c0 of Biesel, and a swell beside it that dies out as
e^{-kappa_j x / h}, C_j X in all.  Its gauge takes the mean over the first b metres of water, with
W = (1 - e^{-i k b}) / (i k b) of an outgoing wave, W* of an incoming one, and C = sum of C_j (1 -
e^{-kappa_j b / h}) / (kappa_j b / h) of the swell.  The law gives the piston the velocity -
G(omega) times what the gauge reads beside the level that the piston's own waves would have, and

    R = (1 - G (c0 W* + i C) / omega) / (1 + G (c0 W - i C) / omega)

is what it reflects of an incoming wave: nothing where G = omega / (c0 W* + i C).  That law asks for
a lag: the gauge is ahead of the piston, and the swell beside it leads it.  So first-order lags can
make the law, and take out noise besides.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from mpslab.theory.algebra import dot, eliminate
from mpslab.theory.dispersion import biesel, evanescent, wave_numbers

MODES = 60  # of the swell beside the piston
WASHOUT = 10.0  # periods in which the mean level, and the piston's place, are forgotten
LAGS = (0.02, 0.1, 0.5, 2.0)  # of a fitted law, times 1 / (angular frequency of the peak)
WIDE = (0.03, 10.0)  # times the peak: where a fitted law is not to reflect more than all
FLOOR = 1e-3  # weight of all that, over that of the spectrum
MOST = 1.3  # that a fitted law may reflect of any wave of this range
PASSES = 30  # of the fit


@dataclass(frozen=True)
class Gauge:
    """What a gauge beside the piston sees of waves of some frequencies.

    Parameters
    ----------
    rate : (n,) float64 [rad/s], above 0
    depth, gravity : float [m], [m/s2]
    reach : float [m]
        b, over which it takes the mean, from the piston's face.
    """

    rate: np.ndarray
    depth: float
    gravity: float
    reach: float
    out: np.ndarray = field(init=False)  # c0 W
    back: np.ndarray = field(init=False)  # c0 W*
    swell: np.ndarray = field(init=False)  # C
    slope: np.ndarray = field(init=False)  # of the surface, for a piston of unit amplitude [1/m]

    def __post_init__(self):
        number = wave_numbers(self.rate, self.depth, self.gravity)
        out = biesel(number * self.depth) * seen(number, self.reach)
        kappa = evanescent(self.rate, self.depth, self.gravity, MODES)
        across = kappa * self.reach / self.depth
        share = 4.0 * np.sin(kappa) ** 2 / (2.0 * kappa + np.sin(2.0 * kappa))
        share *= -np.expm1(-across) / across
        found = {
            "out": out, "back": out.conj(),
            "swell": np.sum(share, axis=0),
            "slope": number * out - np.sum(share * kappa, axis=0) / self.depth,
        }  # fmt: skip
        for name, value in found.items():
            object.__setattr__(self, name, value)

    @property
    def level(self):
        """Its reading for a piston of unit amplitude and the waves that it makes [-]."""
        return 1j * self.out + self.swell

    @property
    def perfect(self):
        """G of the law that reflects nothing [1/s]."""
        return self.rate / (self.back + 1j * self.swell)

    def reflection(self, law):
        """R of a law, a function of the rates that gives G [1/s]."""
        gain = law(self.rate) / self.rate
        return (1.0 - gain * (self.back + 1j * self.swell)) / (
            1.0 + gain * (self.out - 1j * self.swell)
        )


def seen(number, reach):
    """Share of a wave of unit amplitude that a mean over its first metres sees, (n,) complex128."""
    turn = 1j * number * reach
    return -np.expm1(-turn) / turn


@dataclass(frozen=True)
class Law:
    """A law of first-order lags, behind two washouts.

    Attributes
    ----------
    gains : (m,) float64 [1/s]
    lags : (m,) float64 [s]
    washout : float [s]
        Time in which it forgets the mean level, and where the piston is.
    delay : float [s]
        Between a reading and the middle of the move that follows from it.
    """

    gains: np.ndarray
    lags: np.ndarray
    washout: float
    delay: float

    def __call__(self, rate):
        """G at these rates [1/s], (n,) complex128."""
        return dot(_parts(rate, self.lags, self.washout, self.delay), self.gains)


def _parts(rate, lags, washout, delay):
    """G of each lag with a gain of 1, (n, m) complex128."""
    turn = 1j * np.asarray(rate)[:, np.newaxis]
    past = turn * washout / (1.0 + turn * washout)
    return past**2 * np.exp(-turn * delay) / (1.0 + turn * lags)


def tuned(gauge, delay):
    """The law of one lag that reflects nothing at the one frequency of a gauge."""
    rate = gauge.rate[0]
    washout = WASHOUT * 2.0 * np.pi / rate
    wanted = (gauge.perfect / _parts(gauge.rate, np.zeros(1), washout, delay)[:, 0])[0]
    lag = max(np.tan(-np.angle(wanted)), 0.0) / rate
    gain = abs(wanted) * np.hypot(1.0, rate * lag)
    return Law(np.array([gain]), np.array([lag]), washout, delay)


def fitted(gauge, amplitude, delay):
    """The law that reflects least of a spectrum, by least squares, re-weighted (Yang 2016).

    R is a fraction of two expressions that are linear in the gains: the denominator is taken from
    the pass before. Where the law would not be stable, the one that is `tuned` to the peak.

    Parameters
    ----------
    gauge : Gauge
        At the frequencies of the waves.
    amplitude : (n,) float64 [m]
    delay : float [s]
    """
    peak = gauge.rate[np.argmax(amplitude)]
    wide = replace(gauge, rate=np.geomspace(WIDE[0], WIDE[1], 200) * peak)
    lags, washout = np.array(LAGS) / peak, WASHOUT * 2.0 * np.pi / peak
    energy = np.square(amplitude)
    weight = np.sqrt(np.append(energy / energy.sum(), np.full(200, FLOOR / 200)))
    above, below = [], []
    for one in (gauge, wide):
        parts = _parts(one.rate, lags, washout, delay) / one.rate[:, np.newaxis]
        above.append(parts * (one.back + 1j * one.swell)[:, np.newaxis])
        below.append(parts * (one.out - 1j * one.swell)[:, np.newaxis])
    above, below = np.concatenate(above), np.concatenate(below)
    under = np.ones(len(above))
    for _ in range(PASSES):
        scale = weight / np.abs(under)
        rows = above * scale[:, np.newaxis]
        square = np.real(np.sum(rows[:, :, np.newaxis].conj() * rows[:, np.newaxis], axis=0))
        gains = eliminate(square, np.sum(rows.real * scale[:, np.newaxis], axis=0))
        under = 1.0 + dot(below, gains)
    law = Law(gains, lags, washout, delay)
    return law if _is_safe(law, wide) else tuned(replace(gauge, rate=np.array([peak])), delay)


def _is_safe(law, wide):
    """Whether a law is stable, by Nyquist, and makes nothing much larger."""
    under = 1.0 + law(wide.rate) / wide.rate * (wide.out - 1j * wide.swell)
    turned = np.unwrap(np.angle(under))
    steady = np.abs(turned[-1] - turned[0]) < np.pi
    return steady and np.max(np.abs(wide.reflection(law))) < MOST


def over(reflection, amplitude):
    """Reflection of a spectrum: root of the reflected share of its energy [-]."""
    energy = np.square(amplitude)
    return float(np.sqrt(np.sum(energy * np.abs(reflection) ** 2) / energy.sum()))


class Memory:
    """The level that linear theory expects at the gauge of a piston, from where it has been.

    A piston that has jumped forward by one lifts its gauge by s(tau) a time tau later, with s the
    cosine transform of Re(level / (i omega)): the moves of the last `LENGTH` sqrt(h/g), `STEPS` to
    each of these times, count with the mean of s over each step.

    Parameters
    ----------
    depth, gravity, reach : as in `Gauge`
    """

    LENGTH, STEPS = 24.0, 16  # sqrt(h/g), and to each
    HIGHEST = 30.0  # sqrt(g/h): the frequency up to which the transform goes

    def __init__(self, depth, gravity, reach):
        unit = np.sqrt(depth / gravity)
        step = unit / self.STEPS
        highest = self.HIGHEST / unit
        count = int(4.0 * highest * self.LENGTH * unit / np.pi)
        rate = (np.arange(count) + 0.5) * highest / count
        number = wave_numbers(rate, depth, gravity)
        shape = biesel(number * depth) * np.real(seen(number, reach)) / rate
        self.ago = np.arange(int(self.LENGTH * self.STEPS) + 1) * step
        turn = dot(np.sin(np.multiply.outer(self.ago, rate)), shape / rate)
        self.share = 2.0 / np.pi * highest / count * np.diff(turn) / step

    def __call__(self, place, time):
        """Level at a time [m]; `place` is a function of (n,) float64 [s] that gives X [m]."""
        been = place(time - self.ago)
        return float(dot(been[:-1] - been[1:], self.share))
