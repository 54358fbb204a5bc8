"""Steep regular waves on a level bed: stream function theory (Rienecker & Fenton 1981).

The stream function in a frame that goes with the wave is a Fourier series that satisfies the
equations in the water and on the bed exactly; its coefficients are found so that both conditions at
the surface hold at points from crest to trough. Notation and unknowns are those of Fenton (1988).
"""

from dataclasses import dataclass

import numpy as np

from mpslab.theory.algebra import dot, eliminate

TERMS = (16, 32, 64, 128)  # of the series: the first of these that is enough
SMALLEST = 3e-4  # share of the height that the last term may have, and a fall that rises again
LONGEST = 100.0  # wavelengths over depth, by linear theory: beyond, crests are solitary waves
STEPS = 8  # in which the height grows from a linear wave to the highest there is
SHORTEST = 1e-3  # of these steps, in depths
HIGHEST = 0.97  # of the highest wave: beyond, the series hardly converges
TOLERANCE = 1e-11


def highest(length, depth):
    """Height of the highest wave of a length on a depth [m].

    Fenton (1990), a fit to the waves of Williams (1981): deep water 0.141 L, long waves 0.83 h.
    """
    ratio = length / depth
    above = ((0.0077829 * ratio + 0.0095721) * ratio + 0.141063) * ratio
    below = ((0.0093407 * ratio + 0.0317567) * ratio + 0.0788340) * ratio + 1.0
    return depth * above / below


@dataclass(frozen=True)
class Wave:
    """A wave of permanent form.

    Attributes
    ----------
    height, period, depth : float [m], [s], [m]
    length, celerity : float [m], [m/s]
    surface : (n,) float64 [m]
        Amplitudes of the surface's harmonics: eta = sum over j of surface[j - 1] cos j k x, with
        the crest at x = 0. There is no mean: the level is the still water's.
    speed : (n,) float64 [m/s]
        Of the velocity at the bed: u = speed[j - 1] cosh(j k z) cos j k x, z from the bed.
    current : float [m/s]
        Mean velocity at a place below the troughs; negative: it carries back what drifts forward.
    """

    height: float
    period: float
    depth: float
    length: float
    celerity: float
    surface: np.ndarray
    speed: np.ndarray
    current: float

    @property
    def number(self):
        """Wave number k [1/m]."""
        return 2.0 * np.pi / self.length

    def elevation(self, angle, derivative=0):
        """eta [m] at angles k (x - c t) [rad], (n,) float64; or its derivative by the angle."""
        order = np.arange(1, len(self.surface) + 1)
        turned = np.multiply.outer(angle, order)
        if derivative:
            return -dot(np.sin(turned), order * self.surface)
        return dot(np.cos(turned), self.surface)

    def volume(self, angle):
        """Integral of eta by the angle from 0 [m rad], (n,) float64."""
        order = np.arange(1, len(self.surface) + 1)
        return dot(np.sin(np.multiply.outer(angle, order)), self.surface / order)


def solve(height, period, depth, gravity, closed=True):
    """The wave of a height and period.

    Parameters
    ----------
    height, period, depth, gravity : float [m], [s], [m], [m/s2]
    closed : bool
        Whether as much water goes back as forward, as in a closed tank (Stokes' second definition
        of the speed); otherwise the mean velocity at a place below the troughs is zero (the first).

    Returns
    -------
    Wave

    Raises
    ------
    ValueError
        If it is higher than HIGHEST of the highest wave, longer than LONGEST depths, or no series
        of `TERMS` holds it.
    """
    if _linear_length(period * np.sqrt(gravity / depth)) > LONGEST:
        raise ValueError(f"too long for stream function theory, L > {LONGEST:g} h")
    for terms in TERMS:
        found = _wave(height, period, depth, gravity, closed, terms)
        if found and abs(found.surface[-1]) <= SMALLEST * height:
            return found
    raise ValueError(f"too long, or too high, for {TERMS[-1]} terms of stream function theory")


def _wave(height, period, depth, gravity, closed, terms):
    """The wave by so many terms, None where Newton's method does not find it."""
    time = np.sqrt(depth / gravity)  # in units of depth and gravity from here
    goal, tau = height / depth, period / time
    state = _grow(goal, tau, terms, closed, depth)
    if state is None:
        return None
    k, c, mean = state[2 * terms + 1 : 2 * terms + 4]
    order, angles = np.arange(1, terms + 1), np.pi * np.arange(terms + 1) / terms
    weight = np.full(terms + 1, 2.0 / terms)
    weight[[0, -1]] *= 0.5
    surface = dot(np.cos(np.outer(order, angles)), weight * (state[: terms + 1] - 1.0))
    surface[-1] *= 0.5
    speed = k * order * state[terms + 1 : 2 * terms + 1] / np.cosh(np.minimum(order * k, 300.0))
    unit = depth / time
    return Wave(height, period, depth, 2.0 * np.pi / k * depth, c * unit, surface * depth,
                speed * unit, (c - mean) * unit)  # fmt: skip


def _grow(goal, tau, terms, closed, depth):
    """Unknowns of a wave, found by way of lower ones, in steps that are halved where Newton's
    method fails.
    """
    step = highest(_linear_length(tau), 1.0) / STEPS
    reached, state = 0.0, _linear(0.0, tau, terms)
    slope = _linear(1.0, tau, terms) - state
    while reached < goal:
        part = min(reached + step, goal)
        found = _newton(state + (part - reached) * slope, part, tau, terms, closed)
        if found is None or np.any(np.diff(found[: terms + 1]) > SMALLEST * part):
            step *= 0.5
            if step < SHORTEST:
                return None
            continue
        most = HIGHEST * highest(2.0 * np.pi / found[2 * terms + 1], 1.0)
        if part > most:
            raise ValueError(f"must be up to about {most * depth:.4g} m, {HIGHEST:g} of the highest"
                             " wave of this period (Fenton 1990)")  # fmt: skip
        slope = (found - state) / (part - reached)
        reached, state = part, found
    return state


def _linear_length(tau):
    goal = (2.0 * np.pi / tau) ** 2
    k = goal / np.sqrt(np.tanh(goal))
    for _ in range(6):
        tanh = np.tanh(k)
        k -= (k * tanh - goal) / (tanh + k * (1.0 - tanh * tanh))
    return 2.0 * np.pi / k


def _linear(height, tau, terms):
    """Unknowns of a linear wave: surface at the points, B, and k, c, mean speed, Q, R."""
    k = 2.0 * np.pi / _linear_length(tau)
    c = 2.0 * np.pi / tau / k
    eta = 1.0 + 0.5 * height * np.cos(np.pi * np.arange(terms + 1) / terms)
    series = np.zeros(terms)
    series[0] = 0.5 * height / (c * k)  # of linear theory, u = a g k / omega cosh kz / cosh kh
    return np.concatenate([eta, series, [k, c, c, c, 1.0 + 0.5 * c * c]])


def _newton(state, height, tau, terms, closed):
    """Unknowns that satisfy the equations, by Newton's method; None if it finds none."""
    with np.errstate(all="ignore"):
        for _ in range(15):
            value, matrix = _equations(state, height, tau, terms, closed)
            if not np.all(np.isfinite(matrix)):
                return None
            change = eliminate(matrix, value)
            state = state - change
            if np.max(np.abs(change)) < TOLERANCE:
                return state
    return None


def _equations(state, height, tau, terms, closed):
    """How far the equations are from holding, (m,), and their derivatives, (m, m); m = 2 n + 6."""
    points, order = np.arange(terms + 1), np.arange(1, terms + 1)
    eta, series = state[: terms + 1], state[terms + 1 : 2 * terms + 1]
    k, c, mean, flow, head = state[2 * terms + 1 :]
    cosine, sine = (f(np.pi / terms * np.outer(points, order)) for f in (np.cos, np.sin))
    high, wide = _hyperbolic(order * k, eta[:, np.newaxis])
    # Stream function and velocities of unit amplitudes, and how these change with k.
    each, each_u, each_w = high * cosine, k * order * wide * cosine, k * order * high * sine
    z, tanh = eta[:, np.newaxis], np.tanh(order * k)
    each_k = order * (z * wide - tanh * high) * cosine
    each_uk = each_u / k + k * order**2 * (z * high - tanh * wide) * cosine
    each_wk = each_w / k + k * order**2 * (z * wide - tanh * high) * sine
    u, w = dot(each_u, series) - mean, dot(each_w, series)
    u_z = dot(k**2 * order**2 * high * cosine, series)
    w_z = dot(k**2 * order**2 * wide * sine, series)

    matrix = np.zeros((len(state), len(state)))
    stream, bernoulli = points, terms + 1 + points
    b, last = slice(terms + 1, 2 * terms + 1), 2 * terms + 1
    matrix[stream, points] = u
    matrix[: terms + 1, b] = each
    matrix[: terms + 1, last] = dot(each_k, series)
    matrix[: terms + 1, last + 2] = -eta
    matrix[: terms + 1, last + 3] = 1.0
    matrix[bernoulli, points] = u * u_z + w * w_z + 1.0
    rows = slice(terms + 1, 2 * terms + 2)
    matrix[rows, b] = u[:, np.newaxis] * each_u + w[:, np.newaxis] * each_w
    matrix[rows, last] = u * dot(each_uk, series) + w * dot(each_wk, series)
    matrix[rows, last + 2] = -u
    matrix[rows, last + 4] = -1.0
    level, top, time, frame = 2 * terms + 2 + np.arange(4)
    weight = np.full(terms + 1, 1.0 / terms)
    weight[[0, -1]] *= 0.5
    matrix[level, points] = weight
    matrix[top, [0, terms]] = 1.0, -1.0
    matrix[time, [last, last + 1]] = c * tau, k * tau
    matrix[frame, [last + 1, last + (3 if closed else 2)]] = -1.0, 1.0
    value = np.concatenate([
        dot(each, series) - mean * eta + flow,
        0.5 * (u * u + w * w) + eta - head,
        [dot(weight, eta) - 1.0, eta[0] - eta[-1] - height, k * c * tau - 2.0 * np.pi,
         (flow if closed else mean) - c],
    ])  # fmt: skip
    return value, matrix


def _hyperbolic(rate, z):
    """sinh(a z) / cosh a and cosh(a z) / cosh a, which do not overflow."""
    scale = 1.0 / (1.0 + np.exp(-2.0 * rate))
    rising, falling = np.exp(rate * (z - 1.0)), np.exp(-rate * (z + 1.0))
    return scale * (rising - falling), scale * (rising + falling)
