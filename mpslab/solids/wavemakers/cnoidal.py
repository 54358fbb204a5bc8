"""Long-wave piston for regular waves: follows the depth-averaged velocity of a cnoidal wave."""

import math

import numpy as np

from mpslab.later import scipy
from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound
from mpslab.theory import breaking, waves

STEPS = 100  # Runge-Kutta steps to the period of a sine; more for a sharp crest


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle dX/dt = c eta / (h + eta), eta of a cnoidal wave at the moving face (Goring 1978).

    It starts where eta = 0 and rises, so from rest and with the crest first. In a period as much
    water goes forward as back at the moving face, so the motion closes after each period.

    Raises ValueError if height or period is not positive, the period is outside of the theory's
    range, the wave breaks at the maker, or a stroke is given.
    """
    wave = _wave(wavemaker, depth, gravity)
    one_period = _one_period(wave)

    def fade(t):
        return paddle.soft_start(t, wavemaker.start)

    def motion(t):
        return fade(t) * one_period(np.mod(t, wave.period))

    note = (
        f"long-wave piston (first-order cnoidal, Goring): L = {wave.length:.3f} m,"
        f" L/h = {wave.length / depth:.1f} (above 8), m = {wave.m:.5f},"
        f" H L^2/h^3 = {waves.ursell(wave.height, wave.length, depth):.1f}"
    )
    samples = math.ceil(paddle.SAMPLES * _sharpness(wave))
    times, whole = (
        paddle.sample_times(t, wave.period, wavemaker.start, samples) for t in (end, math.inf)
    )
    beyond = _bound.of_permanent(
        one_period, wave.period, wave.celerity, 2.0 * math.pi / wave.length, depth, gravity, fade
    )
    return paddle.from_motion(motion, times, wave.height, note, whole, beyond=beyond)


def _wave(wavemaker, depth, gravity):
    paddle.refuse_stroke(wavemaker)
    height, period = wavemaker.height, wavemaker.period
    paddle.require_positive("height", height, "m")
    paddle.require_positive("period", period, "s")
    paddle.require_unbroken("height", height, breaking.mccowan_height(depth), "0.78 of the depth")
    shortest, longest = waves.cnoidal_period_range(height, depth, gravity)
    if not shortest <= period <= longest:
        raise ValueError(
            f"wavemaker.period = {period:g} s: must be from {shortest:.4g} to {longest:.4g} s for"
            " wavemaker.type = 'cnoidal' (a wave longer than 8 depths; 'linear' for a shorter one,"
            " 'solitary' for a longer one)"
        )
    wave = waves.cnoidal_wave(height, period, depth, gravity)
    limit = breaking.miche_height(wave.length, depth)
    paddle.require_unbroken("height", height, limit, "0.142 L tanh(kh)")
    return wave


def _sharpness(wave):
    """How much narrower the crest is than that of a sine: a long wave is mostly trough."""
    return 1.0 + 0.25 * math.sqrt(waves.ursell(wave.height, wave.length, wave.depth))


def _one_period(wave):
    """Displacement over one period: classical Runge-Kutta on fixed times, cubics between them."""
    steps = math.ceil(STEPS * _sharpness(wave))
    times, dt = np.linspace(0.0, wave.period, steps + 1, retstep=True)
    phase0 = wave.rising_phase

    def speed(t, x):
        eta = wave.eta(phase0 + x / wave.length - t / wave.period)
        return wave.celerity * eta / (wave.depth + eta)

    path = np.zeros_like(times)
    for i, t in enumerate(times[:-1]):
        path[i + 1] = path[i] + _runge_kutta_increment(speed, t, path[i], dt)
    return scipy.interpolate.CubicHermiteSpline(times, path, speed(times, path))


def _runge_kutta_increment(speed, t, x, dt):
    k1 = speed(t, x)
    k2 = speed(t + 0.5 * dt, x + 0.5 * dt * k1)
    k3 = speed(t + 0.5 * dt, x + 0.5 * dt * k2)
    k4 = speed(t + dt, x + dt * k3)
    return dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
