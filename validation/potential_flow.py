"""Fully nonlinear potential flow in a closed tank, by a higher-order spectral method.

West, Brueckner, Janda, Milder & Milton (1987), J. Geophys. Res. 92, 11803: the potential is
expanded about the still water level, to an order in the steepness.
"""

import math
from functools import cache

import numpy as np

ORDER, MODES = 7, 64
STEPS = 400  # of time, a period


@cache
def standing_wave(amplitude, length, depth, gravity, frequency, periods):
    """A standing wave that starts level with the velocities of linear theory.

    Parameters
    ----------
    amplitude : float [m]
        Of linear theory, at the walls.
    length, depth : float [m]
        Of the tank, half a wavelength long.
    gravity : float [m/s2]
    frequency : float [rad/s]
        Of linear theory.
    periods : float
        How many of them.

    Returns
    -------
    time : (n,) float64 [s]
    mode : (n,) float64 [m]
        Amplitude of cos(pi x / length) in the surface.
    """
    x = length / MODES * np.arange(2 * MODES)  # and its mirror image beyond the wall
    k = np.pi / length * np.fft.rfftfreq(2 * MODES, 0.5 / MODES)
    state = np.array([np.zeros_like(x), amplitude * gravity / frequency * np.cos(k[1] * x)])
    dt = 2.0 * np.pi / frequency / STEPS
    count = round(periods * STEPS)
    mode = np.zeros(count + 1)
    for n in range(count):
        state = _runge_kutta(state, dt, k, depth, gravity)
        mode[n + 1] = 2.0 * np.mean(state[0] * np.cos(k[1] * x))
    return dt * np.arange(count + 1), mode


def _runge_kutta(state, dt, k, depth, gravity):
    first = _rates(state, k, depth, gravity)
    second = _rates(state + 0.5 * dt * first, k, depth, gravity)
    third = _rates(state + 0.5 * dt * second, k, depth, gravity)
    fourth = _rates(state + dt * third, k, depth, gravity)
    return state + dt / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)


def _rates(state, k, depth, gravity):
    """Rates of the elevation and of the potential at the surface, (2, n), without aliases."""
    eta, phi = state
    w = _vertical_velocity(eta, phi, k, depth)
    eta_x, phi_x = _filtered(eta, 1j * k), _filtered(phi, 1j * k)
    steep = 1.0 + eta_x**2
    rates = steep * w - eta_x * phi_x, -gravity * eta - 0.5 * phi_x**2 + 0.5 * steep * w**2
    return np.array([_filtered(rate, 1.0) for rate in rates])


def _vertical_velocity(eta, phi, k, depth):
    """Of the water at the surface, from the potential there."""
    orders, w = [phi], np.zeros_like(phi)
    for m in range(2, ORDER + 1):
        orders.append(-sum(
            eta**n / math.factorial(n) * _derivative(orders[m - n - 1], n, k, depth)
            for n in range(1, m)
        ))  # fmt: skip
    for m in range(1, ORDER + 1):
        w += sum(
            eta**n / math.factorial(n) * _derivative(orders[m - n - 1], n + 1, k, depth)
            for n in range(m)
        )
    return w


def _derivative(phi, n, k, depth):
    """n-th derivative in z, at the still water level, of the potential that is phi there."""
    return _filtered(phi, k**n * (np.tanh(k * depth) if n % 2 else 1.0))


def _filtered(values, factor):
    """Values whose modes are multiplied, the upper half left out: products make no aliases."""
    modes = np.fft.rfft(values) * factor
    modes[MODES // 2 :] = 0.0
    return np.fft.irfft(modes, 2 * MODES)
