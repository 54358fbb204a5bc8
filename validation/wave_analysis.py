"""What a wave loses along the tank, what comes back, and the modes of a closed one."""

import numpy as np

from mpslab.analysis import reflection
from mpslab.analysis.harmonics import harmonics
from mpslab.theory.waves import group_celerity


def decay(x, amplitude):
    """Rate b [1/m] of the fit A exp(-b x) to amplitudes (n,) at places x (n,) [m].

    Returns
    -------
    (3,) float64
        The rate b, A, and the standard error of b.
    """
    (slope, intercept), covariance = np.polyfit(x, np.log(amplitude), 1, cov=True)
    return np.array([-slope, np.exp(intercept), np.sqrt(covariance[0, 0])])


def travel(run, to=None):
    """Time that a group of the wavemaker's waves takes from the piston [s].

    With the group velocity of linear theory in the local depth.

    Parameters
    ----------
    run : validation.run.Run
    to : float [m], optional
        The still shoreline, or the end wall, when left out.
    """
    case = run.case
    x = np.linspace(0.0, case.tank.length if to is None else to, 4000)
    middle = 0.5 * (x[1:] + x[:-1])
    depth = case.tank.depth - case.tank.bed_height(middle)
    wet = middle < middle[np.argmax(depth <= 0.0)] if (depth <= 0.0).any() else depth > 0.0
    speed = [group_celerity(case.wavemaker.period, h, run.gravity) for h in depth[wet]]
    return float(np.sum(np.diff(x)[wet] / speed))


def separate(run, gauges, start, periods):
    """Incident and reflected waves of a run's wavemaker at some gauges.

    Parameters
    ----------
    run : validation.run.Run
    gauges : list
        Of those of its case.
    start : float [s]
    periods : int
        How many, from the start on, the harmonics are taken over.

    Returns
    -------
    mpslab.analysis.reflection.Reflection
    """
    period = run.case.wavemaker.period
    amplitudes = np.array([
        harmonics(*run.gauge(gauge.name), period, start, periods)[1:] for gauge in gauges
    ])  # fmt: skip
    x = np.array([gauge.x for gauge in gauges])
    return reflection.of_harmonics(amplitudes, x, period, run.depth, run.gravity)


def last_harmonic(time, signal, period, end, periods):
    """First harmonic of the last periods before a time, with exp(i w t)."""
    return harmonics(time, signal, period, end - periods * period, periods)[1]


def modes(run, number):
    """Time [s], and amplitude of cos(n pi x / l) in the surface from all water [m], (n,) each."""
    length = run.case.tank.length
    rows = [(t, np.cos(number * np.pi * x[:, 0] / length).sum()) for t, x, _ in run.water()]
    time, mode = np.array(rows).T
    return time, 2.0 * run.spacing**2 / length * mode
