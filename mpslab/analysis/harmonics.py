"""Harmonics of a regular wave."""

import numpy as np

HARMONICS = 4


def harmonics(time, level, period, start, periods):
    """Complex amplitudes of the harmonics at a gauge, by least squares.

    Parameters
    ----------
    time, level : (n,) float64 [s], [m]
    period, start : float [s]
    periods : int
        Whole periods from the start on.

    Returns
    -------
    (HARMONICS + 1,) complex128
        The mean level, then amplitude and phase of each harmonic [m], A in Re(A exp(i n w t)); NaN
        if the record ends earlier or is dry.
    """
    end = start + periods * period
    part = (time >= start) & (time <= end)
    if time[-1] < end - 0.05 * period or not np.isfinite(level[part]).all():
        return np.full(HARMONICS + 1, np.nan + 0j)
    phase = 2.0 * np.pi / period * time[part]
    orders = np.arange(1, HARMONICS + 1)
    terms = [
        np.ones_like(phase),
        *np.cos(np.outer(orders, phase)),
        *np.sin(np.outer(orders, phase)),
    ]
    mean, *fit = np.linalg.lstsq(np.stack(terms, axis=1), level[part], rcond=None)[0]
    return np.array([mean, *(np.array(fit[:HARMONICS]) - 1j * np.array(fit[HARMONICS:]))])
