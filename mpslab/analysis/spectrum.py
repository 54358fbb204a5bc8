"""Variance spectrum of a water level, and the heights and periods that follow from it."""

from dataclasses import dataclass

import numpy as np
from scipy import special

OVERLAP = 1.0 / 36.0  # squared correlation of two Hann windows that overlap by half


@dataclass(frozen=True)
class Spectrum:
    """One-sided variance density.

    Attributes
    ----------
    frequency : (n,) float64 [Hz]
        In equal steps from 0 on.
    density : (n,) float64 [m2 s]
    freedom : float
        Degrees of freedom of the chi-squared distribution that each density has.
    """

    frequency: np.ndarray
    density: np.ndarray
    freedom: float

    @property
    def step(self):
        """Step of the frequencies [Hz]."""
        return float(self.frequency[1])

    def band(self, confidence=0.95):
        """Lower and upper edge, (n,) each [m2 s], between which the true density lies.

        It does so with the probability `confidence`, at each frequency by itself:
        nu S / chi2(nu, 1 - q) and nu S / chi2(nu, q), q = (1 - confidence) / 2.
        """
        rest = 0.5 * (1.0 - confidence)
        edges = (2.0 * special.gammaincinv(0.5 * self.freedom, q) for q in (1.0 - rest, rest))
        return tuple(self.freedom * self.density / edge for edge in edges)

    def within(self, low, high):
        """Mask (n,) of the frequencies from low to high [Hz]."""
        rounding = 1e-9 * self.step
        return (self.frequency >= low - rounding) & (self.frequency <= high + rounding)


def welch(elevation, step, length):
    """Spectrum as the mean over segments that overlap by half (Welch 1967).

    Each segment loses its mean and trend and is weighted with a Hann window. With K segments there
    are 2 K / (1 + 2 (1 - 1/K) / 36) degrees of freedom, 1.89 K where there are many.

    Parameters
    ----------
    elevation : (n,) float64 [m]
        In equal steps of time.
    step : float [s]
        Between two readings.
    length : int
        Readings in a segment, from 4 to n.

    Returns
    -------
    Spectrum
    """
    length = 2 * (length // 2)
    starts = range(0, len(elevation) - length + 1, length // 2)
    window = np.sin(np.pi * np.arange(length) / length) ** 2
    parts = np.stack([without_trend(elevation[s : s + length]) for s in starts])
    power = np.mean(np.abs(np.fft.rfft(parts * window)) ** 2, axis=0)
    density = 2.0 * step * power / np.sum(window**2)
    density[[0, -1]] *= 0.5
    count = len(parts)
    freedom = 2.0 * count / (1.0 + 2.0 * (1.0 - 1.0 / count) * OVERLAP)
    return Spectrum(np.fft.rfftfreq(length, step), density, freedom)


def of_periods(elevation, step):
    """Spectrum of regular waves over whole periods, as it is: a line at each harmonic.

    Parameters
    ----------
    elevation : (n,) float64 [m]
        In equal steps of time, over a whole number of periods.
    step : float [s]
        Between two readings.

    Returns
    -------
    Spectrum
    """
    count = len(elevation)
    density = 2.0 * step / count * np.abs(np.fft.rfft(elevation - elevation.mean())) ** 2
    if count % 2 == 0:
        density[-1] *= 0.5
    return Spectrum(np.fft.rfftfreq(count, step), density, 2.0)


def without_trend(values):
    """Values (n, ...) less their mean and linear trend."""
    place = np.linspace(-1.0, 1.0, len(values))
    slope = np.tensordot(place, values, 1) / np.sum(place**2)
    return values - values.mean(axis=0) - np.multiply.outer(place, slope)


def moment(spectrum, order, low, high):
    """Moment of a spectrum, the integral of f^order S from low to high [Hz]; [m2 Hz^order]."""
    part = spectrum.within(low, high)
    return float(np.sum(spectrum.frequency[part] ** order * spectrum.density[part]) * spectrum.step)


def parameters(spectrum, low, high, duration):
    """Heights and periods of a sea state, from its spectrum between two frequencies.

    Parameters
    ----------
    spectrum : Spectrum
    low, high : float [Hz]
        Above 0: Tm-1,0 has no meaning with the slowest motions in it.
    duration : float [s]
        Of the record.

    Returns
    -------
    dict of str to float
        "Hm0" = 4 sqrt(m0) [m]. "Hm0 scatter", the standard error of Hm0 over Hm0, for one such
        record of a Gaussian sea: 0.5 sqrt(integral of S^2 df / duration) / m0. "Hm0 slow" [m], of
        the frequencies below the band. "Tp" [s], 1 over the mean frequency weighted with S^4 (Young
        1995): it scatters less than the period of the highest point, and is shorter by 1 % for
        JONSWAP (gamma = 3.3) and 5 % for Pierson-Moskowitz.
        "Tm-1,0" = m-1 / m0, "Tm01" = m0 / m1 and "Tm02" = sqrt(m0 / m2) [s].
    """
    m = {order: moment(spectrum, order, low, high) for order in (-1, 0, 1, 2)}
    slow = moment(spectrum, 0, 0.5 * spectrum.step, low - 0.5 * spectrum.step)
    part = spectrum.within(low, high)
    weight = (spectrum.density[part] / spectrum.density[part].max()) ** 4
    # On average the square of an estimate is 1 + 2 / nu times too large.
    square = np.sum(spectrum.density[part] ** 2) * spectrum.step / (1.0 + 2.0 / spectrum.freedom)
    return {
        "Hm0": 4.0 * np.sqrt(m[0]),
        "Hm0 scatter": 0.5 * np.sqrt(square / duration) / m[0],
        "Hm0 slow": 4.0 * np.sqrt(slow),
        "Tp": np.sum(weight) / np.sum(weight * spectrum.frequency[part]),
        "Tm-1,0": m[-1] / m[0],
        "Tm01": m[0] / m[1],
        "Tm02": np.sqrt(m[0] / m[2]),
    }
