"""Second-order piston for regular waves (Madsen 1971), which makes no free second harmonic."""

from math import acos, inf, sqrt, tanh

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _regular
from mpslab.theory import breaking, waves


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle X = (S / 2) sin(a) + B sin(2 a) less its value at t = 0, with a = omega t + a0.

    B = H^2 / (32 h) (3 cosh kh / sinh^3 kh - 2 S / H) (Madsen 1971) and S as for `linear`. a0 is a
    phase at which the piston is at rest and turns forward, with wavemaker.first = "backward" back.

    Raises ValueError as `_regular.first_order` does, or if H L^2 / h^3 >= 8 pi^2 / 3.
    """
    wave = _regular.first_order(wavemaker, depth, gravity)
    _require_range(wavemaker, wave, depth)
    first, second = 0.5 * wave.stroke, _second_harmonic(wave, depth)
    start = _rest_phase(first, second) * (1.0 if wavemaker.first == "forward" else -1.0)

    def path(phase):
        return first * np.sin(phase) + second * np.sin(2.0 * phase)

    def fade(t):
        return paddle.soft_start(t, wavemaker.start)

    def motion(t):
        return fade(t) * (path(wave.frequency * t + start) - path(start))

    note = (
        f"second-order piston (Madsen 1971): H L^2/h^3 = {wave.ursell:.1f}, below"
        f" {breaking.MADSEN_URSELL_LIMIT:.1f}; second harmonic {1e3 * second:.2f} mm"
    )
    times, whole = (
        paddle.sample_times(t, wavemaker.period, wavemaker.start) for t in (end, inf)
    )
    crest = 0.5 * wave.height * np.exp([1j * start])
    beyond = _bound.of_waves(np.array([wave.frequency]), crest, depth, gravity, fade)
    return paddle.from_motion(motion, times, wave.height, note, whole, beyond=beyond)


def _second_harmonic(wave, depth):
    kh = min(wave.kh, waves.LARGEST_KH)
    # cosh / sinh^3 = 1 / (tanh sinh^2), which does not overflow
    bound = 3.0 / (tanh(kh) * np.sinh(kh) ** 2)
    return float(wave.height**2 / (32.0 * depth) * (bound - 2.0 * wave.stroke / wave.height))


def _rest_phase(first, second):
    """Phase of zero velocity: cos a + e cos 2a = 0, e = 2 B / (S / 2), on the rearward side."""
    e = 2.0 * second / first
    return -acos(2.0 * e / (1.0 + sqrt(1.0 + 8.0 * e * e)))


def _require_range(wavemaker, wave, depth):
    if breaking.madsen_in_range(wave.height, wave.length, depth):
        return
    limit = breaking.MADSEN_URSELL_LIMIT * depth**3 / wave.length**2
    key, scale = ("stroke", wave.stroke / wave.height) if wavemaker.stroke else ("height", 1.0)
    raise ValueError(
        f"wavemaker.{key} = {scale * wave.height:g} m: must be below {scale * limit:.4g} m for"
        f" wavemaker.type = 'second_order' (H L^2/h^3 = {wave.ursell:.1f}, Madsen's theory holds"
        f" below 8 pi^2/3 = {breaking.MADSEN_URSELL_LIMIT:.1f}); take 'cnoidal' for so long a wave"
    )
