"""Spectra of a sea: variance of the surface by frequency, S(f) [m2/Hz].

Every spectrum is made so that Hm0 = 4 sqrt(m0) over all frequencies is the height asked for: the
formulas in books mean heights of other kinds, and differ by up to 9 %.
"""

import numpy as np

from mpslab.theory.dispersion import LARGEST_KH, wave_numbers

NAMES = ("jonswap", "pierson_moskowitz", "tma")
# Frequencies over that of the peak, which hold a spectrum except for a millionth.
ALL = np.geomspace(0.2, 40.0, 8001)


def density(name, frequency, height, period, gamma, depth, gravity):
    """Variance density of a sea.

    Parameters
    ----------
    name : str
        One of NAMES.
    frequency : (n,) float64 [Hz]
    height, period : float [m], [s]
        Hm0 and the period Tp of the peak.
    gamma : float [-]
        How much higher the peak is than that of Pierson and Moskowitz; they have 1.
    depth, gravity : float [m], [m/s2]

    Returns
    -------
    (n,) float64 [m2/Hz]
    """
    if name == "pierson_moskowitz":
        return pierson_moskowitz(frequency, height, period)
    gauge = ALL / period

    def shape(f):
        found = pierson_moskowitz(f, 1.0, period) * peak(f, period, gamma)
        return found * depth_factor(f, depth, gravity) if name == "tma" else found

    return height**2 / 16.0 / moment(gauge, shape(gauge)) * shape(frequency)


def pierson_moskowitz(frequency, height, period):
    """S = (5/16) Hm0^2 fp^4 f^-5 exp(-1.25 (fp / f)^4) (Bretschneider 1959) [m2/Hz]."""
    f = np.asarray(frequency, float) * period
    return 0.3125 * height**2 * period * f**-5 * np.exp(-1.25 * f**-4)


def peak(frequency, period, gamma):
    """The factor of Hasselmann et al. (1973) on it: gamma^r, r = exp(-(f/fp - 1)^2 / 2 s^2) [-].

    s = 0.07 below the peak and 0.09 above.
    """
    f = np.asarray(frequency, float) * period
    width = np.where(f <= 1.0, 0.07, 0.09)
    return gamma ** np.exp(-0.5 * ((f - 1.0) / width) ** 2)


def depth_factor(frequency, depth, gravity):
    """What the depth leaves of a spectrum (Kitaigorodskii et al. 1975; TMA: Bouws et al. 1985) [-].

    tanh^2 kh / (1 + 2 kh / sinh 2 kh): omega^2 h / 2 g in shallow water, 1 in deep water.
    """
    kh = wave_numbers(2.0 * np.pi * np.asarray(frequency, float), depth, gravity) * depth
    kh = np.minimum(kh, LARGEST_KH)
    return np.tanh(kh) ** 2 / (1.0 + 2.0 * kh / np.sinh(2.0 * kh))


def moment(frequency, spectrum, order=0):
    """m_n, the integral of f^n S by the trapezoidal rule; order n may be negative."""
    part = frequency**order * spectrum
    return float(np.sum(0.5 * (part[1:] + part[:-1]) * np.diff(frequency)))


def share_outside(frequency, spectrum, low, high):
    """Share of the variance that lies below `low` or above `high` [Hz]."""
    inside = np.concatenate([[low], frequency[(frequency > low) & (frequency < high)], [high]])
    part = moment(inside, np.interp(inside, frequency, spectrum, 0.0, 0.0))
    return max(1.0 - part / moment(frequency, spectrum), 0.0)
