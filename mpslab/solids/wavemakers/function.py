"""Paddle that follows a function of the user's own."""

from dataclasses import dataclass, replace

import numpy as np

from mpslab.core import own
from mpslab.solids import paddle

SAMPLES = 2001  # of the run, among which its extremes are looked for


@dataclass(frozen=True)
class Own(paddle.Paddle):
    """A paddle that lets an object of the user's own decide on each of its moves.

    Attributes
    ----------
    maker : object
        With methods advance, state and restore, as `mpslab.solids.paddle.Paddle`.
    """

    maker: object = None

    def advance(self, time, dt, readings):
        self.maker.advance(time, dt, readings)

    def state(self):
        return self.maker.state()

    def restore(self, state):
        self.maker.restore(state)


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle with the displacement X(t) [m] that wavemaker.function names, "module:name".

    A function is called with t >= 0 and starts from rest, X(0) = 0. A class is called once without
    arguments; the object that it makes is then called as a function is. If the object has a method
    `advance`, it also has `state` and `restore`, and is called only with times within its last
    move. Neither may go farther from 0 than wavemaker.stroke, for which the bed is laid.

    Raises ValueError if there is no such function, or if it breaks one of these rules.
    """
    paddle.require_positive("stroke", wavemaker.stroke, "m")
    maker, most = _found(wavemaker.function), wavemaker.stroke
    note = f"displacement of {wavemaker.function}"
    if hasattr(maker, "advance"):
        return Own(maker, 2.0 * most, most, -most, most, 0.0, note, maker=maker)

    def motion(t):
        try:
            travel = np.vectorize(maker, otypes=[float])(t)
        except (ArithmeticError, TypeError, ValueError) as error:
            raise ValueError(
                f"wavemaker.function = {wavemaker.function!r}: must give a displacement [m] for "
                f"any time from 0 to the end of the run ({error})"
            ) from error
        return paddle.soft_start(t, wavemaker.start) * travel

    times = np.linspace(0.0, end, SAMPLES)
    path = motion(times)
    if path[0] != 0.0 or not np.all(np.abs(path) <= most):
        worst = times[np.argmax(np.where(np.isfinite(path), np.abs(path), np.inf))]
        raise ValueError(
            f"wavemaker.function = {wavemaker.function!r}: is {path[0]:g} m at t = 0 and "
            f"{motion(worst):g} m at t = {worst:.4g} s: must be 0 at first, and never farther than "
            f"wavemaker.stroke = {most:g} m"
        )
    drawn = paddle.from_motion(motion, times, 0.0, note)
    return replace(drawn, backmost=-most, farthest=most)


def _found(name):
    try:
        found = own.find(name)
        maker = found() if isinstance(found, type) else found
    except (ValueError, TypeError) as error:
        raise ValueError(
            f'wavemaker.function = {name!r}: must be "module:name" of a function, or of a class '
            f"that is made without arguments ({error})"
        ) from error
    if not callable(maker):
        raise ValueError(f"wavemaker.function = {name!r}: must be a function of time")
    return maker
