"""Gauges of a run in equal steps of time."""

from dataclasses import dataclass

import numpy as np

DRY = 0.05  # share of readings that may be missing: up to it, gaps are bridged
FEWEST = 16  # readings in a window
LEAST_STEPS = 40  # to a period of regular waves


@dataclass(frozen=True)
class Readings:
    """Water levels at gauges, in equal steps of time.

    Attributes
    ----------
    names : tuple of str
    time : (n,) float64 [s]
    elevation : (n, gauges) float64 [m]
        Above still water; NaN throughout at a gauge that was dry too long.
    dry : (gauges,) float64
        Share of the readings that are missing. Up to 5 %, the gaps are bridged.
    """

    names: tuple
    time: np.ndarray
    elevation: np.ndarray
    dry: np.ndarray

    @property
    def step(self):
        """Step of the times [s]."""
        return float(self.time[1] - self.time[0])

    @property
    def wet(self):
        """Mask (gauges,) of those that have an elevation."""
        return np.isfinite(self.elevation[0])


def read(gauges, level, window, period=None):
    """Readings of all gauges over a window.

    Between its own times a level is interpolated (Akima 1970). The step is the median distance of
    the run's readings.

    Parameters
    ----------
    gauges : structured array (n,)
        As of `mpslab.analysis.results.Run`.
    level : float [m]
        Of the still water.
    window : mpslab.analysis.windows.Window
    period : float [s], optional
        Of regular waves. A period is then a whole number of steps, 40 or more, and the window is
        shortened to a whole number of periods.

    Returns
    -------
    Readings

    Raises
    ------
    ValueError
        If the window holds fewer than 16 readings, or less than two whole periods.
    """
    time, rows = np.unique(gauges["time"], return_index=True)
    inside = (time >= window.start) & (time <= window.end)
    if np.count_nonzero(inside) < FEWEST:
        raise ValueError(
            f"window from {window.start:.4g} to {window.end:.4g} s: holds "
            f"{np.count_nonzero(inside)} readings, must hold {FEWEST} or more; the run has "
            f"{len(time)}, from {time[0]:.4g} to {time[-1]:.4g} s"
        )
    begin, end = time[inside][[0, -1]]
    step = float(np.median(np.diff(time[inside])))
    if period:
        step = period / max(np.ceil(period / step), LEAST_STEPS)
        whole = int((end - begin) / period + 1e-6)
        if whole < 2:
            raise ValueError(
                f"window from {window.start:.4g} to {window.end:.4g} s: must hold two whole "
                f"periods of {period:g} s or more"
            )
        count = round(whole * period / step)
    else:
        count = int((end - begin) / step + 1e-6) + 1
    even = begin + step * np.arange(count)
    names = gauges.dtype.names[1:]
    columns, dry = [], []
    for name in names:
        values = gauges[name][rows]
        known = np.isfinite(values)
        dry.append(1.0 - np.mean(known[inside]))
        columns.append(_bridged(time, values - level, known, even) if dry[-1] <= DRY
                       else np.full(count, np.nan))  # fmt: skip
    return Readings(names, even, np.stack(columns, axis=1), np.array(dry))


def _bridged(time, values, known, even):
    from scipy.interpolate import Akima1DInterpolator

    curve = Akima1DInterpolator(time[known], values[known])
    return curve(np.clip(even, *time[known][[0, -1]]))
