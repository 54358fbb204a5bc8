"""Piston for a solitary wave (Goring 1978)."""

import math

import numpy as np

from mpslab.solids import paddle
from mpslab.theory import breaking, waves

# The motion has no beginning; it is cut where the paddle moves at this share of its top speed.
TAIL_SPEED = 1e-3

NEWTON_STEPS = 10  # 5 reach round-off for every H / h below 0.78


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle dX/dt = c eta(X, t) / (h + eta(X, t)), eta = H sech^2 k (c t - X).

    In closed form X = (H / (k h)) tanh k (c t - X), with k = sqrt(3 H / (4 h^3)) and
    c = sqrt(g (h + H)); the stroke is 2 H / (k h). At t = 0 the speed is small but not 0; it is
    faded in within the time 1 / (k c), or within wavemaker.start where that is longer.

    Raises ValueError if the height is not positive or not below 0.78 h, or if a stroke is given.
    """
    height = wavemaker.height
    paddle.refuse_stroke(wavemaker)
    paddle.require_positive("height", height, "m")
    paddle.require_unbroken("height", height, breaking.mccowan_height(depth), "0.78 of the depth")
    k = waves.solitary_wave_number(height, depth)
    rate = k * waves.solitary_celerity(height, depth, gravity)
    amplitude, ratio = height / (k * depth), height / depth
    tail = _tail_phase(ratio)
    delay, first = tail + ratio * math.tanh(tail), amplitude * math.tanh(tail)
    fade = max(wavemaker.start, 1.0 / rate)

    def motion(t):
        travel = amplitude * np.tanh(_phase(rate * t - delay, ratio)) + first
        return paddle.soft_start(t, fade) * travel

    note = (
        f"solitary wave (Goring 1978): H/h = {ratio:.3f} (below 0.78),"
        f" stroke {2e3 * amplitude:.1f} mm in {2.0 * delay / rate:.2f} s"
    )
    # It only ever goes forward, so its extremes are its ends.
    times, whole = (np.array([0.0, t]) for t in (end, max(fade, 2.0 * delay / rate)))
    celerity = rate / k

    def beyond(reach):
        """At the face the level is H sech^2, where a long wave of small height is U sqrt(h/g)."""

        def of(t):
            phase = _phase(rate * t - 0.5 * k * reach - delay, ratio)
            level = height / np.cosh(phase) ** 2
            speed = celerity * level / (depth + level)
            return float(level - speed * math.sqrt(depth / gravity))

        return of

    waves_of = np.array([rate]), np.array([height])
    return paddle.from_motion(motion, times, height, note, whole, waves=waves_of, beyond=beyond)


def _tail_phase(ratio):
    """Phase k (c t - X), without its sign, where the speed is down to TAIL_SPEED of its maximum.

    The speed is c s / (1 + s) with s = (H / h) sech^2; its maximum is where sech = 1.
    """
    target = TAIL_SPEED * ratio / (1.0 + ratio)
    sech_squared = target / (1.0 - target) / ratio
    return math.acosh(1.0 / math.sqrt(sech_squared))


def _phase(time, ratio):
    """Root p of p + (H / h) tanh p = time, by Newton; the slope is between 1 and 1 + H / h < 2."""
    phase = time
    for _ in range(NEWTON_STEPS):
        tanh = np.tanh(phase)
        residual = phase + ratio * tanh - time
        phase = phase - residual / (1.0 + ratio * (1.0 - tanh * tanh))
    return phase
