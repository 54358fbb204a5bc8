"""Linear waves at an upright cylinder that stands in a channel, alone or in a row.

Alone it is the solution of MacCamy & Fuchs (1954). Side walls act as mirrors: the cylinder in the
middle of a channel is one of an endless row across the waves, and each of the row meets what the
others scatter (Linton & Evans 1990, Journal of Fluid Mechanics 215, 549-569).
"""

import numpy as np
from scipy.special import h1vp, hankel1, jv, jvp

MODES = 8  # of exp(i m theta), m = -MODES ... MODES
ROW = 100_000  # cylinders of the row on each side
FADING = 2e-4  # share of k by which their waves fade, so that the sum over them has an end


def force(k, radius, depth, width=np.inf):
    """Amplitude of the horizontal force, and its phase before the crest at the axis.

    Parameters
    ----------
    k : float [1/m]
        Wave number.
    radius, depth : float [m]
    width : float [m]
        Of the channel, less than a wavelength.

    Returns
    -------
    size : float [m2]
        Force over rho g and the amplitude of the wave.
    lead : float [rad]
    """
    m = np.arange(-MODES, MODES + 1)
    slope, scattered = jvp(m, k * radius), h1vp(m, k * radius)
    row = _row(k, width)
    share = slope / scattered
    meets = np.eye(len(m)) + share[:, None] * row[m[None, :] - m[:, None] + 2 * MODES]
    sent = np.linalg.solve(meets, -share * 1j**m)
    there = sent * (-2j / (np.pi * k * radius)) / slope  # whole potential on the cylinder
    total = np.pi * (there[MODES + 1] + there[MODES - 1])
    found = -radius * np.tanh(k * depth) / k * total
    return abs(found), -float(np.angle(found))


def _row(k, width):
    """What all others of the row add to mode l at one of them, l = -2 MODES ... 2 MODES."""
    orders = np.arange(-2 * MODES, 2 * MODES + 1)
    if not np.isfinite(width):
        return np.zeros(len(orders), complex)
    apart = k * (1.0 + 1j * FADING) * width * np.arange(1, ROW + 1)
    sums = np.array([hankel1(order, apart).sum() for order in orders])
    return 2.0 * np.cos(0.5 * np.pi * orders) * sums


def level(k, radius, x):
    """Amplitude of the level over that of the wave at x [m] on the axis of the waves, alone."""
    m = np.arange(-MODES, MODES + 1)
    angle = 0.0 if x > 0.0 else np.pi
    sent = -(1j**m) * jvp(m, k * radius) / h1vp(m, k * radius)
    here = 1j**m * jv(m, k * abs(x)) + sent * hankel1(m, k * abs(x))
    return abs(np.sum(here * np.exp(1j * m * angle)))
