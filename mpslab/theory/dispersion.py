"""Linear waves of many frequencies at once, and what stays near the piston that makes them."""

import numpy as np

LARGEST_KH = 300.0  # formulas in kh have reached deep water long before


def wave_numbers(frequency, depth, gravity):
    """Wave numbers [1/m] of angular frequencies [rad/s]: omega^2 = g k tanh(k h).

    Parameters
    ----------
    frequency : (n,) float64 [rad/s], above 0
    depth, gravity : float [m], [m/s2]

    Returns
    -------
    (n,) float64
    """
    target = np.asarray(frequency, float) ** 2 * depth / gravity
    kh = target / np.sqrt(np.tanh(target))  # Eckart (1952), within 5 %
    for _ in range(6):  # Newton: four reach round-off
        tanh = np.tanh(kh)
        kh = kh - (kh * tanh - target) / (tanh + kh * (1.0 - tanh * tanh))
    return kh / depth


def group_velocity(frequency, depth, gravity):
    """Speed of a group of waves [m/s], (omega / 2 k) (1 + 2 k h / sinh 2 k h), (n,) float64."""
    k = wave_numbers(frequency, depth, gravity)
    kh = np.minimum(k * depth, LARGEST_KH)
    return 0.5 * frequency / k * (1.0 + 2.0 * kh / np.sinh(2.0 * kh))


def biesel(kh):
    """Amplitude of the wave over that of the piston's motion (Biesel & Suquet 1951) [-].

    4 sinh^2 kh / (sinh 2kh + 2kh); kh is an array.
    """
    kh = np.minimum(kh, LARGEST_KH)
    return 4.0 * np.sinh(kh) ** 2 / (np.sinh(2.0 * kh) + 2.0 * kh)


def evanescent(frequency, depth, gravity, count):
    """Decay numbers kappa h [-] of the waves that stay near a piston, (count, n) float64.

    The roots of kappa h tan(kappa h) = -omega^2 h / g, one in each ((j - 1/2) pi, j pi).
    """
    target = np.asarray(frequency, float) ** 2 * depth / gravity
    whole = np.pi * np.arange(1, count + 1)[:, np.newaxis]
    short = np.zeros((count, len(target)))  # by how much it falls short of j pi
    for _ in range(40):  # each pass takes two thirds of the error away, or more
        short = np.arctan(target / (whole - short))
    return whole - short
