"""A piston that absorbs the waves that come back to it, in addition to its own motion.

The level that its gauge reads, less the level that its own waves would have there, is a wave that
comes in. `mpslab.theory.absorption` has the law by which the piston gives way to it.
"""

import math
from dataclasses import dataclass

import numpy as np

from mpslab.core.keys import require
from mpslab.solids.paddle import Paddle
from mpslab.theory import absorption

LEVEL, EXPECTED = "piston/level", "piston/expected"  # no gauge has such a name

WINDOW = 3.0  # spacings over which the gauge takes the mean
FASTEST = 0.5  # sqrt(g h): largest speed; no wave needs as much before it breaks
HARDEST = 0.5  # gravity: largest acceleration
ROOM = 2.0  # strokes to either side, unless the case says otherwise
SLOWING = 0.05  # periods of the peak: at its speed it is at least so long from the end of its room
SEAS = ("irregular", "focused", "bichromatic")


@dataclass(frozen=True)
class Absorbing(Paddle):
    """A paddle with an `Absorber`, which adds to its displacement.

    Attributes
    ----------
    window : float [m]
        Length of water, from its face on, over which its gauge takes the mean.
    absorber : Absorber
    """

    window: float = 0.0
    absorber: object = None

    def advance(self, time, dt, readings):
        self.absorber.advance(time, dt, readings)

    def state(self):
        return self.absorber.state()

    def restore(self, state):
        self.absorber.restore(state)


def absorbing(case, paddle):
    """The paddle of a case with absorption.

    Raises CaseError if the piston has no room for it, or if nothing says which waves to absorb.
    """
    maker, gravity, depth = case.wavemaker, case.fluid.gravity, case.tank.paddle_depth
    require(gravity > 0.0, "fluid.gravity", gravity, "> 0 for wavemaker.absorption = true")
    require(
        type(paddle) is Paddle,
        "wavemaker.absorption",
        True,
        "false for an object with a method advance, which moves the piston by what it reads",
    )
    rate, amplitude = _waves(maker, paddle)
    room = maker.room or ROOM * (paddle.farthest - paddle.backmost)
    require(room > 0.0, "wavemaker.room", maker.room, "> 0 m for a piston without its own motion")
    require(
        room < case.tank.length,
        "wavemaker.room",
        maker.room,
        f"< tank.length = {case.tank.length:g} m; 0 takes {ROOM:g} times the longest stroke, "
        f"{ROOM * (paddle.farthest - paddle.backmost):.4g} m",
    )
    window = WINDOW * case.particles.spacing
    gauge = absorption.Gauge(rate, depth, gravity, window)
    delay = 0.5 * case.time.maximum
    one = len(rate) == 1
    law = absorption.tuned(gauge, delay) if one else absorption.fitted(gauge, amplitude, delay)
    level = _Level(paddle, absorption.Memory(depth, gravity, window), window)
    bias = case.initial.type == "rest" and not case.water
    absorber = Absorber(
        law, level, room, None if bias else case.tank.depth, FASTEST * math.sqrt(gravity * depth),
        HARDEST * gravity,
    )  # fmt: skip

    def displacement(t):
        return paddle.displacement(t) + absorber.at(t)

    return Absorbing(
        displacement, paddle.stroke, paddle.foremost + room, paddle.backmost - room,
        paddle.farthest + room, paddle.height, paddle.note,
        {**paddle.facts, **_facts(law, gauge, amplitude, room)}, paddle.doubts, paddle.path,
        paddle.waves, paddle.beyond, window, absorber,
    )  # fmt: skip


def _waves(maker, paddle):
    """Frequencies (n,) [rad/s] and amplitudes (n,) [m] of the waves that the law is made for."""
    if maker.period > 0.0 and maker.type not in SEAS:
        return np.array([2.0 * math.pi / maker.period]), np.ones(1)
    require(
        bool(paddle.waves),
        "wavemaker.period",
        maker.period,
        f"> 0 s, of the waves to absorb, for wavemaker.type = {maker.type!r}",
    )
    return paddle.waves


def _facts(law, gauge, amplitude, room):
    """Numbers of the absorption for people to read, by the names of `Paddle.facts`."""
    found = gauge.reflection(law)
    peak = int(np.argmax(amplitude))
    facts = {
        "absorption": "tuned" if len(law.lags) == 1 else "fitted",
        "absorption_period [s]": float(2.0 * math.pi / gauge.rate[peak]),
        "reflection_at_peak": float(abs(found[peak])),
        "room [m]": room,
    }
    if len(found) > 1:
        facts["reflection_over_spectrum"] = absorption.over(found, amplitude)
    return facts


class _Level:
    """Level above still water that a paddle's own motion is expected to make at its gauge [m]."""

    def __init__(self, paddle, memory, window):
        self.path, self.memory = paddle.path, memory
        self.beyond = paddle.beyond(window) if paddle.beyond else None

    def __call__(self, time):
        found = self.memory(self.path, time)
        return found + float(self.beyond(time)) if self.beyond else found


class Absorber:
    """Moves the piston off its own motion, by the law, as far as there is room.

    Parameters
    ----------
    law : mpslab.theory.absorption.Law
    expected : function (t) -> float [m]
        Level above still water that the piston's own motion makes at its gauge.
    room : float [m]
        How far it may go to either side.
    still : float or None [m]
        What the gauge reads in still water, z; None if its first reading is to be taken for that.
    fastest, hardest : float [m/s], [m/s2]
        Largest speed, and change of speed.
    """

    def __init__(self, law, expected, room, still, fastest, hardest):
        self.law, self.expected, self.room, self.still = law, expected, room, still
        self.fastest, self.hardest = fastest, hardest
        self.slowing = SLOWING * law.washout / absorption.WASHOUT
        self.begin = self.end = self.old = self.new = self.speed = self.error = self.mean = 0.0
        self.lagged = np.zeros(len(law.lags))

    def at(self, time):
        """How far the piston is off its own motion, at a time within its last move [m]."""
        if time >= self.end:
            return self.new
        share = (time - self.begin) / (self.end - self.begin)
        return self.old + max(share, 0.0) * (self.new - self.old)

    def advance(self, time, dt, readings):
        """Decide on the move from time to time + dt, as `Paddle.advance`."""
        if self.still is None:
            self.still = readings[LEVEL]
        self._listen(readings[LEVEL] - self.still - readings[EXPECTED], self.end - self.begin)
        wanted = -float(np.sum(self.law.gains * self.lagged)) - self.new / self.law.washout
        most = self.hardest * dt
        speed = self.speed + min(max(wanted - self.speed, -most), most)
        ahead, behind = ((self.room - side * self.new) / self.slowing for side in (1.0, -1.0))
        speed = min(max(speed, -behind, -self.fastest), ahead, self.fastest)
        self.begin, self.end, self.speed = time, time + dt, speed
        self.old, self.new = self.new, self.new + speed * dt

    def _listen(self, error, since):
        """Take in the error of the level [m], `since` [s] after the one before."""
        between = 0.5 * (self.error + error)
        self.error = error
        self.mean += -math.expm1(-since / self.law.washout) * (between - self.mean)
        self.lagged += -np.expm1(-since / self.law.lags) * (between - self.mean - self.lagged)

    NUMBERS = ("begin", "end", "old", "new", "speed", "error", "mean", "still")

    def state(self):
        """As `Paddle.state`; before the first step there is nothing to keep."""
        if self.still is None:
            return {}
        return {"lagged": self.lagged, **{name: getattr(self, name) for name in self.NUMBERS}}

    def restore(self, state):
        """As `Paddle.restore`."""
        for name in self.NUMBERS:
            setattr(self, name, state[name])
        self.lagged = np.array(state["lagged"])
