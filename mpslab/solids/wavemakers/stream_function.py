"""Piston for steep or long regular waves: the depth-mean velocity of stream function theory."""

import math

import numpy as np

from mpslab.later import scipy
from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _sea, _table
from mpslab.theory import stream_function, waves

POINTS = 64  # of the table to a period of a sine; more for a sharp crest


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle dX/dt = c eta / (h + eta), eta of a wave of permanent form at the moving face.

    In a closed tank as much water goes back as forward, so this is exactly the depth-mean velocity.
    With theta = k (X - c t) it is h dtheta + eta dtheta = - h k c dt: the motion has a closed form
    and closes after each period. It starts at rest, where eta = 0 and rises: the crest comes first.

    Raises ValueError if height or period is not positive, a stroke is given, or there is no such
    wave (`mpslab.theory.stream_function.solve`).
    """
    paddle.refuse_stroke(wavemaker)
    paddle.require_positive("height", wavemaker.height, "m")
    paddle.require_positive("period", wavemaker.period, "s")
    try:
        wave = stream_function.solve(wavemaker.height, wavemaker.period, depth, gravity)
    except ValueError as error:
        raise ValueError(f"wavemaker.height = {wavemaker.height:g} m: {error}") from None
    table = one_period(wave)

    def fade(t):
        return paddle.soft_start(t, wavemaker.start)

    def motion(t):
        return fade(t) * table(t)

    highest = stream_function.highest(wave.length, depth)
    note = (
        f"stream function (Rienecker & Fenton), {len(wave.surface)} terms: L = {wave.length:.4g} m,"
        f" H/h = {wave.height / depth:.3f}, {100 * wave.height / highest:.0f} % of the highest,"
        f" H L^2/h^3 = {waves.ursell(wave.height, wave.length, depth):.1f}"
    )
    samples = 4 * len(table.terms[0])
    times, whole = (
        paddle.sample_times(t, wave.period, wavemaker.start, samples) for t in (end, math.inf)
    )
    facts = {
        "crest [m]": float(wave.elevation(0.0)),
        "mean_current [m/s]": float(wave.current),
        **_sea.speeds(table, times),
    }
    beyond = _bound.of_permanent(
        table, wave.period, wave.celerity, wave.number, depth, gravity, fade
    )
    return paddle.from_motion(motion, times, wave.height, note, whole, facts, beyond=beyond)


def one_period(wave):
    """Table of the motion in one period."""
    start = scipy.optimize.brentq(wave.elevation, 0.0, math.pi, xtol=1e-15)
    sharp = 1.0 + 0.25 * math.sqrt(waves.ursell(wave.height, wave.length, wave.depth))
    count = math.ceil(POINTS * sharp)
    step = wave.period / count
    turned = 2.0 * math.pi * np.arange(count) / count  # k c t
    angle = _angle(wave, start, turned)
    eta, slope = wave.elevation(angle), wave.elevation(angle, 1)
    total = wave.depth + eta
    speed = wave.celerity * eta / total
    bent = wave.celerity * wave.depth * slope / total**2 * wave.number * (speed - wave.celerity)
    place = (angle - start + turned) / wave.number
    speed[0], place[0] = 0.0, 0.0
    return _table.Table(step, place, speed, bent, cyclic=True)


def _angle(wave, start, turned):
    """Angle k (X - c t) of the moving face, by Newton: h angle + volume(angle) falls evenly."""
    angle = start - turned
    goal = wave.depth * (start - turned) + wave.volume(start)
    for _ in range(50):
        change = (wave.depth * angle + wave.volume(angle) - goal) / (
            wave.depth + wave.elevation(angle)
        )
        angle = angle - change
        if np.max(np.abs(change)) < 1e-14 * 2.0 * math.pi:
            break
    return angle
