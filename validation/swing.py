"""The first swing of a body that was let go: down, and up again."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Swing:
    """First trough and the crest after it, of parabolas; NaN where there is none.

    Unlike times of zero crossings these do not depend on the level, which the body changes.

    Attributes
    ----------
    trough, crest : float
        In the unit of the motion.
    crest_at : float [s]
    """

    trough: float
    crest: float
    crest_at: float


def first_swing(time, place, about):
    """Swing of a motion (n,) that begins at its highest.

    Parameters
    ----------
    time, place : (n,)
    about : float [s]
        Before and after the extreme a parabola is fitted over so long.
    """
    low = int(np.argmin(place))
    _, depth = _top(time, -place, low, about)
    if low + 1 >= len(place):
        return Swing(-depth, np.nan, np.nan)
    crest_at, crest = _top(time, place, low + 1 + int(np.argmax(place[low + 1 :])), about)
    return Swing(-depth, crest, crest_at)


def _top(time, place, row, about):
    """When [s] and how high the parabola through the rows about one is highest."""
    rows = np.abs(time - time[row]) < about
    if np.count_nonzero(rows) < 3:
        return time[row], place[row]
    bend = np.polyfit(time[rows] - time[row], place[rows], 2)
    at = -0.5 * bend[1] / bend[0]
    return time[row] + at, float(np.polyval(bend, at))
