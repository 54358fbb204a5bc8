"""What a zone reflects in which the velocity of the water is damped, u' = - r(x) u.

In such water a linear wave has the complex wave number of omega (omega - i r) = g k tanh k h. Where
r grows over the zone, the potential at the surface follows from the mild-slope equation (Berkhoff
1972) with that k:

    (a phi')' + a k^2 phi = 0,   a = (g tanh k h / 2 k) (1 + 2 k h / sinh 2 k h)

from the wall behind the zone, phi' = 0, to its beginning, where phi = e^{-i k x} + R e^{i k x}.
"""

import numpy as np

from mpslab.theory.dispersion import LARGEST_KH, wave_numbers

POINTS = 400  # across the zone
STRENGTHS = np.geomspace(0.5, 4.0, 37)  # largest r over omega, among which the best is looked for


def profile(share):
    """Damping at a share of the way into the zone over the largest, both from 0 to 1."""
    return np.clip(share, 0.0, 1.0) ** 2


def reflection(rate, depth, gravity, length, largest, behind=0.0):
    """Reflection of a zone before a wall [-].

    Parameters
    ----------
    rate : float [rad/s]
    depth, gravity : float [m], [m/s2]
    length : float [m]
        Of the zone.
    largest : float [1/s]
        Largest r, at its end.
    behind : float [m]
        Between the end of the zone and the wall; there r stays as large.

    Returns
    -------
    float
    """
    step = (length + behind) / POINTS
    x = (np.arange(POINTS) + 0.5) * step
    number, a = _damped(rate, depth, gravity, largest * profile(x / length))
    # Over a step of constant k, from the wall on: phi' / phi at its near side.
    slope = 0.0
    for k, weight in zip(number[::-1], a[::-1], strict=True):
        turn = np.tan(k * step)
        flux = slope / weight
        slope = weight * k * (flux / k + turn) / (1.0 - flux / k * turn)
    (k,), (weight,) = _damped(rate, depth, gravity, np.zeros(1))
    flux = slope / weight
    return float(abs((-1j * k - flux) / (1j * k - flux)))


def best(rate, depth, gravity, length, behind=0.0):
    """Largest r over omega [-] with which a zone reflects least: less lets the wave through to the
    wall and back, more reflects it where the zone begins. As for `reflection`.
    """
    found = [reflection(rate, depth, gravity, length, s * rate, behind) for s in STRENGTHS]
    return float(STRENGTHS[np.argmin(found)])


def _damped(rate, depth, gravity, damping):
    """Complex wave numbers and weights a of the mild-slope equation, (n,) complex128 each."""
    target = rate * (rate - 1j * damping) * depth / gravity
    kh = wave_numbers(np.array([rate]), depth, gravity) * depth * np.sqrt(1.0 - 1j * damping / rate)
    for _ in range(20):
        tanh = np.tanh(kh)
        kh = kh - (kh * tanh - target) / (tanh + kh * (1.0 - tanh * tanh))
    twice = 2.0 * kh
    wide = np.where(kh.real < LARGEST_KH, twice, 1.0)
    share = np.where(kh.real < LARGEST_KH, wide / np.sinh(wide), 0.0)
    return kh / depth, gravity * depth * np.tanh(kh) / twice * (1.0 + share)
