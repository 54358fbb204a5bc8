"""First-order piston for regular waves (Biesel & Suquet 1951)."""

from math import inf

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _bound, _regular
from mpslab.theory import breaking


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle X = (S / 2) (1 - cos omega t): it starts at rest, from its rearmost place.

    With wavemaker.first = "backward" from its foremost place: X = -(S / 2) (1 - cos omega t).
    S is wavemaker.stroke or, where that is 0, follows from the height by H / S = 4 sinh^2 kh /
    (sinh 2kh + 2kh).

    Raises ValueError as `_regular.first_order` does.
    """
    wave = _regular.first_order(wavemaker, depth, gravity)
    half = 0.5 * wave.stroke * (1.0 if wavemaker.first == "forward" else -1.0)

    def fade(t):
        return paddle.soft_start(t, wavemaker.start)

    def motion(t):
        return fade(t) * half * (1.0 - np.cos(wave.frequency * t))

    times, whole = (
        paddle.sample_times(t, wavemaker.period, wavemaker.start) for t in (end, inf)
    )
    crest = np.array([-0.5j * np.copysign(wave.height, half)])
    beyond = _bound.of_waves(np.array([wave.frequency]), crest, depth, gravity, fade)
    return paddle.from_motion(motion, times, wave.height, _note(wave), whole, beyond=beyond)


def _note(wave):
    note = (
        f"first-order piston (Biesel): kh = {wave.kh:.3f}, stroke {1e3 * wave.stroke:.1f} mm"
        f" for a wave of {1e3 * wave.height:.1f} mm, H L^2/h^3 = {wave.ursell:.1f}"
    )
    if wave.ursell < breaking.MADSEN_URSELL_LIMIT:
        return note
    return note + f", above {breaking.MADSEN_URSELL_LIMIT:.1f}: expect secondary crests"
