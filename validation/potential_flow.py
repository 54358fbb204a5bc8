"""Fully nonlinear potential flow, by a higher-order spectral method.

West, Brueckner, Janda, Milder & Milton (1987), J. Geophys. Res. 92, 11803: the potential is
expanded about the still water level, to an order in the steepness.
"""

import math
from functools import cache

import numpy as np

ORDER, MODES = 7, 64
STEPS = 400  # of time, a period
STEEP_ORDER, STEEP_MODES = 5, 16  # of a wave at a wall, which with more of them breaks up


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
    x, k, state = _at_start(amplitude, length, gravity, frequency, MODES)
    dt = 2.0 * np.pi / frequency / STEPS
    count = round(periods * STEPS)
    mode = np.zeros(count + 1)
    for n in range(count):
        state = _advanced(state, dt, k, depth, gravity)
        mode[n + 1] = 2.0 * np.mean(state[0] * np.cos(k[1] * x))
    return dt * np.arange(count + 1), mode


@cache
def wall_force(amplitude, length, depth, gravity, frequency, periods):
    """Force of a standing wave on the wall at x = 0, of a wave as in `standing_wave`.

    Returns
    -------
    time : (n,) float64 [s]
    force : (n,) float64 [m2]
        Less that of still water, over rho g.
    """
    _, k, state = _at_start(amplitude, length, gravity, frequency, STEEP_MODES)
    dt = 2.0 * np.pi / frequency / STEPS
    count = round(periods * STEPS)
    found = np.zeros((count + 1, 4))
    for n in range(count + 1):
        rise = _rates(state, k, depth, gravity, STEEP_ORDER)[0, 0]
        found[n] = state[0, 0], *_at_wall(*state, k, depth), state[1, 0] * rise
        state = _advanced(state, dt, k, depth, gravity, order=STEEP_ORDER)
    level, whole, speed, carried = found.T
    given = np.gradient(whole, dt, edge_order=2) - carried + speed
    return dt * np.arange(count + 1), -given / gravity - 0.5 * level**2


def _at_start(amplitude, length, gravity, frequency, modes):
    """Places [m], wave numbers [1/m] and state of a standing wave that is level at the start."""
    x = length / modes * np.arange(2 * modes)  # and the mirror image beyond the wall
    k = np.pi / length * np.fft.rfftfreq(2 * modes, 0.5 / modes)
    return x, k, np.array([np.zeros_like(x), amplitude * gravity / frequency * np.cos(k[1] * x)])


def _at_wall(eta, phi, k, depth):
    """Integrals over the wall at x = 0 of the potential, and of half the square of the velocity."""
    modes = np.fft.rfft(sum(_orders(eta, phi, k, depth, STEEP_ORDER))).real / STEEP_MODES
    modes[0] *= 0.5
    place, weight = np.polynomial.legendre.leggauss(40)
    z = 0.5 * (place + 1.0) * (eta[0] + depth)  # over the bed
    shape = np.exp(np.outer(z - depth, k)), np.exp(np.outer(-z - depth, k))
    scale = modes / (1.0 + np.exp(-2.0 * k * depth))
    potential, speed = (shape[0] + shape[1]) @ scale, (shape[0] - shape[1]) @ (k * scale)
    half = 0.5 * (eta[0] + depth) * weight
    return half @ potential, half @ (0.5 * speed**2)


def runge_kutta(rates, time, state, step):
    """The state at time + step, by the method of fourth order; rates(time, state) are its rates."""
    half = 0.5 * step
    first = rates(time, state)
    second = rates(time + half, state + half * first)
    third = rates(time + half, state + half * second)
    fourth = rates(time + step, state + step * third)
    return state + step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)


def _advanced(state, dt, k, depth, gravity, order=ORDER):
    return runge_kutta(lambda _, now: _rates(now, k, depth, gravity, order), 0.0, state, dt)


def _rates(state, k, depth, gravity, order):
    """Rates of the elevation and of the potential at the surface, (2, n), without aliases."""
    eta, phi = state
    w = _vertical_velocity(eta, phi, k, depth, order)
    eta_x, phi_x = _filtered(eta, 1j * k), _filtered(phi, 1j * k)
    steep = 1.0 + eta_x**2
    rates = steep * w - eta_x * phi_x, -gravity * eta - 0.5 * phi_x**2 + 0.5 * steep * w**2
    return np.array([_filtered(rate, 1.0) for rate in rates])


def _vertical_velocity(eta, phi, k, depth, order):
    """Of the water at the surface, from the potential there."""
    orders, w = _orders(eta, phi, k, depth, order), np.zeros_like(phi)
    for m in range(1, order + 1):
        w += sum(
            eta**n / math.factorial(n) * _derivative(orders[m - n - 1], n + 1, k, depth)
            for n in range(m)
        )
    return w


def _orders(eta, phi, k, depth, order):
    """The potential at the still water level, in orders of the steepness."""
    orders = [phi]
    for m in range(2, order + 1):
        orders.append(-sum(
            eta**n / math.factorial(n) * _derivative(orders[m - n - 1], n, k, depth)
            for n in range(1, m)
        ))  # fmt: skip
    return orders


def _derivative(phi, n, k, depth):
    """n-th derivative in z, at the still water level, of the potential that is phi there."""
    return _filtered(phi, k**n * (np.tanh(k * depth) if n % 2 else 1.0))


def _filtered(values, factor):
    """Values whose modes are multiplied, the upper half left out: products make no aliases."""
    modes = np.fft.rfft(values) * factor
    modes[len(values) // 4 :] = 0.0
    return np.fft.irfft(modes, len(values))
