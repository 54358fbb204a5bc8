"""The motion of the piston's face, as every wavemaker hands it to the run."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

SAMPLES = 400  # to a period: finds the extremes of a sine to 3e-5 of its amplitude
RECENT = 4  # times whose displacement is kept: a step asks for the same two several times


@dataclass(frozen=True)
class Paddle:
    """A piston that starts at rest at X = 0; X points onshore, into the water.

    Attributes
    ----------
    displacement : function (t [s]) -> X [m]
        Displacement of the face; exactly 0 for t <= 0.
    stroke : float [m]
        Largest less smallest displacement during the run.
    foremost : float [m]
        Largest displacement during the run.
    backmost, farthest : float [m]
        Smallest and largest displacement of the whole motion, whenever the run ends: the bed
        reaches as far, so that a run that goes on beyond its first end has the bed that it needs.
    height : float [m]
        Wave height that the theory expects of this motion; 0 where it says nothing.
    note : str
        The theory and its range in one line of plain words.
    facts : dict
        What else there is to say about the motion: "top_speed [m/s]" and "largest_acceleration
        [m/s2]"; of a recorded motion "rows", "begin [s]" and "end [s]" in the time of the run; of a
        sea "components", "peak_period [s]", "spectrum_left_out", "shortest_wavelength [m]",
        "repeats_after [s]", and of the waves that the run itself gets "significant_height [m]",
        "waves" and "largest_height [m]"; of a focused or steep wave "crest [m]".
    doubts : tuple of str
        What the run may suffer from, a line each.
    path : function (t : (n,) float64 [s]) -> X (n,) float64 [m]
        The displacement at many times, for code that has to know where the face has been.
    waves : (rate (n,) float64 [rad/s], amplitude (n,) float64 [m]), or ()
        The waves that the motion is made of, if its theory says so.
    beyond : function (reach : float [m]) -> function (t : float [s]) -> float [m], or None
        Mean level over a reach in front of the face, less the level that linear theory expects of
        the motion (`mpslab.solids.wavemakers._bound`).
    """

    displacement: Callable[[float], float]
    stroke: float
    foremost: float
    backmost: float
    farthest: float
    height: float
    note: str
    facts: dict = field(default_factory=dict)
    doubts: tuple = ()
    path: Callable | None = None
    waves: tuple = ()
    beyond: Callable | None = None

    def advance(self, time, dt, readings):
        """Decide on the move from time to time + dt [s]; a motion known beforehand has nothing to
        decide.

        Parameters
        ----------
        readings : dict of str to float
            What the gauges read last, by name [m]; the same on all ranks.
        """

    def state(self):
        """What a checkpoint keeps of it, a dict; empty for a motion known beforehand."""
        return {}

    def restore(self, state):
        """Take back what `state` gave."""


def from_motion(
    motion: Callable, times, height: float, note: str, whole=None, facts=None, doubts=(), waves=(),
    beyond=None,
) -> Paddle:  # fmt: skip
    """Paddle of a motion.

    Parameters
    ----------
    motion : function (t : float or (n,) float64 [s]) -> X [m]
        Displacement at t >= 0, with motion(0) = 0.
    times : (n,) float64 [s]
        Times from 0 to the end of the run among which the extremes are looked for.
    height, note, facts, doubts, waves, beyond
        As in `Paddle`.
    whole : (m,) float64 [s], optional
        Times that cover all of the motion: a period after the soft start, or a whole record. Left
        out if `times` cover it already.
    """
    run, always = (motion(t) for t in (times, times if whole is None else whole))
    stroke, foremost = float(np.max(run) - np.min(run)), float(np.max(run))
    backmost, farthest = float(np.min(always)), float(np.max(always))

    @lru_cache(maxsize=RECENT)
    def displacement(t: float) -> float:
        return 0.0 if t <= 0.0 else float(motion(t))

    def path(t):
        return np.where(t > 0.0, motion(np.maximum(t, 0.0)), 0.0)

    return Paddle(
        displacement, stroke, foremost, backmost, farthest, height, note, facts or {}, doubts, path,
        waves, beyond,
    )  # fmt: skip


def sample_times(end: float, period: float, start=0.0, samples=SAMPLES) -> np.ndarray:
    """Times at which a motion of a period [s] has its extremes until `end` [s].

    The motion fades in from 0 until `start` [s], so it goes farthest in its last period before the
    end, or in the first period after `start`. The number of times does not depend on the end.

    Returns
    -------
    (samples + 2,) float64 [s]
    """
    last = min(end, start + period)
    return np.append(0.0, np.linspace(max(last - period, 0.0), last, samples + 1))


def soft_start(t, start: float):
    """Factor that fades a motion in: s^2 (3 - 2 s), s = t / start, and 1 from t = start on [-].

    Parameters
    ----------
    t : float or (n,) float64 [s]
    start : float [s]
        Duration; 0 for none.
    """
    if start == 0.0:
        return np.ones_like(t)
    s = np.clip(np.divide(t, start), 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def require_positive(key: str, value: float, unit: str) -> None:
    """Raise ValueError unless a value is finite and above 0."""
    if not 0.0 < value < math.inf:
        raise ValueError(f"wavemaker.{key} = {value:g} {unit}: must be above 0 {unit}")


def refuse_stroke(wavemaker) -> None:
    """Raise ValueError if a stroke is given to a theory that derives its own."""
    if wavemaker.stroke != 0.0:
        raise ValueError(
            f"wavemaker.stroke = {wavemaker.stroke:g} m: must be 0 for wavemaker.type ="
            f" {wavemaker.type!r}, whose stroke follows from the height"
        )


def require_unbroken(key: str, value: float, limit: float, reason: str) -> None:
    """Raise ValueError if a height or stroke is at or above the limit of breaking at the maker."""
    if not value < limit:
        raise ValueError(
            f"wavemaker.{key} = {value:g} m: must be below {limit:.4g} m ({reason}),"
            " or the wave breaks at the maker"
        )
