"""The window of time in which the waves of a run are looked at."""

from dataclasses import dataclass

import numpy as np

from mpslab.theory.waves import group_celerity

SETTLED = 1.5  # periods, after the ramp and the group's way to a place, until waves are steady
SLOW = 1.5  # times the peak frequency: the slowest waves of a sea that are waited for
FIRST = 0.1  # share of the largest elevation at a gauge from which on it is a wave
FEWEST = 5.0  # periods for which reflected waves have to be there


@dataclass(frozen=True)
class Window:
    """A window of time, and why it is this one.

    Attributes
    ----------
    start, end : float [s]
    reason : str
    """

    start: float
    end: float
    reason: str

    @property
    def duration(self):
        """Its length [s]."""
        return self.end - self.start

    def __str__(self):
        return f"{self.start:.4g} to {self.end:.4g} s ({self.reason})"


def asked(start, end, last):
    """The window that was asked for.

    Parameters
    ----------
    start, end : float [s] or None
        None for the first and the last reading.
    last : float [s]
        Time of the last reading.

    Raises
    ------
    ValueError
        If it does not end after its start.
    """
    first = 0.0 if start is None else start
    final = last if end is None else min(end, last)
    if not final > first:
        raise ValueError(
            f"window from {first:g} to {final:g} s: must end after its start; the run ends at "
            f"{last:.4g} s"
        )
    return Window(first, final, "as asked for")


@dataclass(frozen=True)
class Arrival:
    """When the waves of a wavemaker have come to a place, by linear theory.

    That is 1.5 periods after its ramp (the soft start) plus the time that the group takes; for a
    sea, the group of 1.5 times the peak frequency.

    Attributes
    ----------
    period : float [s]
    ramp : float [s]
    speed : float [m/s]
        Of the group.
    """

    period: float
    ramp: float
    speed: float

    @classmethod
    def of(cls, period, ramp, regular, depth, gravity):
        """The arrival of regular waves, or of a sea with a peak period, in a depth [m]."""
        slowest = period if regular else period / SLOW
        return cls(period, ramp, group_celerity(slowest, depth, gravity))

    def at(self, way):
        """Time [s] at which the waves have gone a way [m]."""
        return self.ramp + SETTLED * self.period + way / self.speed

    def window(self, places, last):
        """The window from the arrival at the last of some places (n,) [m] to the last reading [s].

        Raises
        ------
        ValueError
            If less than two periods are left.
        """
        far = float(np.max(places))
        start = self.at(far)
        if last - start < 2.0 * self.period:
            raise ValueError(
                f"the waves have come to the last gauge, x = {far:g} m, at t = {start:.4g} s, and "
                f"the last reading is of t = {last:.4g} s: must leave two periods of "
                f"{self.period:.4g} s; --from chooses another start"
            )
        return Window(start, last, f"from when the waves have come to x = {far:g} m")

    def back(self, near, far, window):
        """The part of a window in which waves reflected at `far` are back at `near` [m].

        Returns
        -------
        Window
            The whole window, if less than five periods are left.
        note : str
            Says so if it is the whole window; else empty.
        """
        start = max(self.at(2.0 * far - near), window.start)
        if window.end - start >= FEWEST * self.period:
            reason = f"from when waves reflected at x = {far:.4g} m are back at x = {near:.4g} m"
            return Window(start, window.end, reason), ""
        return window, (
            f"reflection: waves reflected at x = {far:.4g} m are back at x = {near:.4g} m from t = "
            f"{start:.4g} s on only: the reflected wave is not in all of the window"
        )


def from_readings(gauges, level, places):
    """The window from when a wave is first seen at the gauge that it reaches last.

    A wave is an elevation of a tenth of the largest one at the gauge.

    Parameters
    ----------
    gauges : structured array (n,)
        As of `mpslab.analysis.results.Run`.
    level : float [m]
        Of the still water.
    places : sequence of str
        The gauges to look at.
    """
    firsts = {}
    for name in places:
        size = np.abs(gauges[name] - level)
        if np.isfinite(size).any():
            firsts[name] = gauges["time"][np.flatnonzero(size >= FIRST * np.nanmax(size))[0]]
    last = float(gauges["time"][-1])
    if not firsts:
        return Window(0.0, last, "all of the run")
    name = max(firsts, key=firsts.get)
    reason = f"from the first wave at '{name}', the last gauge that it reaches"
    return Window(float(firsts[name]), last, reason)
