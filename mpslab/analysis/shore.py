"""What the waves of a run do at its shore: run-up, overtopping, and the force on upright walls."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mpslab.analysis import crossings

SHARE = 0.02  # of the incident waves reach R2%
FEW_RUNUPS = 500  # waves: with fewer, R2% is uncertain
RIPPLE = 0.1  # times 4 standard deviations: what does not pass the mean by as much is no wave
GAP = 0.5  # periods: least time from the peak of one event to that of the next
VALLEY = 0.5  # times the smaller of two peaks: between two events the flow falls below that
SMOOTHED = 0.2  # periods over which the flow is averaged before its peaks are looked for
LEAST = 3  # particles of an event: fewer are drops
RESOLVED = 4.0  # spacings: a thinner layer is not to be trusted


@dataclass(frozen=True)
class Runup:
    """The run-up of one thickness of water, above still water.

    Attributes
    ----------
    name : str
    thickness : float [m]
    peaks : (waves,) structured array
        "time" [s] and "level" [m] of each run-up.
    mean, highest, r2 : float [m]
        Of the peaks; `r2` is reached by 2 % of the incident waves, NaN for regular ones.
    fitted : bool
        Whether `r2` is that of Rayleigh's distribution with the mean square of the peaks: among
        fewer than 50 waves even the highest is reached by more than 2 %.
    crest : bool
        Whether the water has come to the crest of the slope, above which no level can be read.
    """

    name: str
    thickness: float
    peaks: np.ndarray
    mean: float
    highest: float
    r2: float
    fitted: bool
    crest: bool


@dataclass(frozen=True)
class Overtopped:
    """What has passed a plane in the window, onwards less back, for each metre across.

    Attributes
    ----------
    name : str
    freeboard : float [m]
        From still water up to the highest ground in front of the plane.
    volume : float [m3/m]
    discharge, quantum : float [m2/s]
        The mean; and the mean if a single particle had passed in the window.
    events : (events,) structured array
        "time" [s] of the largest flow, "volume" [m3/m], and the means, weighted with the flow, of
        "layer" [m] and "speed" [m/s]. Two events are half a period apart or more, and between them
        the flow falls below half of the smaller peak; late drops belong to the event before.
    largest : float [m3/m]
    share : float
        Events over incident waves.
    layer : float
        Mean thickness while water passes, weighted with the flow [spacings].
    """

    name: str
    freeboard: float
    volume: float
    discharge: float
    quantum: float
    events: np.ndarray
    largest: float
    share: float
    layer: float

    @property
    def resolved(self):
        """Whether the layer is 4 spacings thick or more."""
        return self.layer >= RESOLVED


@dataclass(frozen=True)
class Pushed:
    """The force of the waves on an upright wall, along the tank, without that of still water.

    Attributes
    ----------
    name : str
    peaks : (waves,) structured array
        "time" [s] and "force" [N/m], the largest of each wave.
    mean, largest, least : float [N/m]
        Mean of the peaks, and the extremes.
    still : float [N/m]
        The force of still water, which has been taken off.
    across : float [m]
        Width of the wall, 1 in 2-D.
    expected : mpslab.analysis.goda.Load or None
    """

    name: str
    peaks: np.ndarray
    mean: float
    largest: float
    least: float
    still: float
    across: float
    expected: object


def runup(name, time, level, window, thickness, waves, top, regular):
    """The run-up of one thickness.

    Parameters
    ----------
    name : str
    time, level : (n,) float64 [s], [m]
        Level of the water's edge above still water; NaN if there is no edge.
    window : mpslab.analysis.windows.Window
    thickness : float [m]
    waves : float
        Incident waves in the window.
    top : float [m]
        The level from which the water is at the crest.
    regular : bool

    Returns
    -------
    Runup
    """
    known = np.isfinite(level)
    peaks = _peaks(time[known], level[known], window, "level")
    high = np.sort(peaks["level"])[::-1]
    fitted, r2 = False, np.nan
    if len(high) and not regular:
        fitted = SHARE * waves < 1.0
        r2 = _rayleigh(high, waves) if fitted else high[min(int(SHARE * waves), len(high)) - 1]
    mean, highest = (np.mean(high), high[0]) if len(high) else (np.nan, np.nan)
    return Runup(name, thickness, peaks, float(mean), float(highest), float(r2), fitted,
                 bool(len(high) and high[0] >= top))  # fmt: skip


def _peaks(time, values, window, name):
    """Time and size of the largest value in each wave, from one up-crossing of the mean on."""
    kind = [("time", float), (name, float)]
    inside = (time >= window.start) & (time <= window.end)
    if not inside.any():
        return np.zeros(0, kind)
    found = []
    # Waves are found in the whole record: a wave that the window cuts counts if its peak is inside.
    for wave in crossings.waves(time, values - values[inside].mean(), "up", RIPPLE):
        rows = np.flatnonzero((time >= wave["time"]) & (time <= wave["time"] + wave["period"]))
        row = rows[np.argmax(values[rows])]
        if inside[row]:
            found.append((time[row], values[row]))
    return np.array(found, kind)


def _rayleigh(high, waves):
    """Level that 2 % of the waves exceed, if the peaks (n,) have Rayleigh's distribution."""
    often = len(high) / (SHARE * waves)
    square = np.mean(np.maximum(high, 0.0) ** 2)
    return np.sqrt(square * np.log(often)) if often > 1.0 else 0.0


def overtopped(name, table, window, freeboard, waves, period, particle, width, spacing):
    """What has passed a plane.

    Parameters
    ----------
    name : str
    table : structured array
        Rows of overtopping.csv.
    window : mpslab.analysis.windows.Window
    freeboard : float [m]
    waves, period : float, float [s]
        Incident waves in the window, and their mean period.
    particle : float
        Volume of a particle, [m3/m] in 2-D and [m3] in 3-D.
    width : float [m]
        Across the tank; 1 in 2-D.
    spacing : float [m]

    Returns
    -------
    Overtopped
    """
    time = table["time"]
    volume = (table[f"{name} onwards"] - table[f"{name} back"]) / width
    rows = np.flatnonzero((time >= window.start) & (time <= window.end))
    first = max(rows[0] - 1, 0)
    passed = np.diff(volume[first : rows[-1] + 1])
    part = table[first + 1 : rows[-1] + 1]
    events = _events(part, name, passed, period, particle / width)
    total = float(passed.sum())
    onwards = np.maximum(passed, 0.0)
    return Overtopped(
        name=name,
        freeboard=freeboard,
        volume=total,
        discharge=total / window.duration,
        quantum=particle / width / window.duration,
        events=events,
        largest=float(events["volume"].max(initial=0.0)),
        share=len(events) / waves,
        layer=_weighted(part[f"{name} layer"], onwards) / spacing,
    )


def _events(table, name, passed, period, particle):
    """The events, by the peaks of the flow: a table with a row for each."""
    from scipy.signal import find_peaks

    step = float(np.median(np.diff(table["time"]))) if len(passed) > 1 else period
    over = max(round(SMOOTHED * period / step), 1)
    rate = np.convolve(passed, np.full(over, 1.0 / over), "same")
    rate = np.concatenate([[0.0], np.maximum(rate, 0.0), [0.0]])
    peaks, facts = find_peaks(rate, distance=max(GAP * period / step, 1.0), prominence=0.0)
    peaks = peaks[facts["prominences"] >= VALLEY * rate[peaks]] - 1
    ends = [first + int(np.argmin(rate[first + 1 : last + 1])) for first, last in pairwise(peaks)]
    found, ends = [], [0, *ends, len(passed)]
    for peak, first, last in zip(peaks, ends, ends[1:], strict=False):
        part, flow = table[first:last], np.maximum(passed[first:last], 0.0)
        if (volume := float(passed[first:last].sum())) > (LEAST - 0.5) * particle:
            means = (_weighted(part[f"{name} {what}"], flow) for what in ("layer", "speed"))
            found.append((table["time"][peak], volume, *means))
    return np.array(found, [(field, float) for field in ("time", "volume", "layer", "speed")])


def _weighted(values, weight):
    known = np.isfinite(values)
    total = weight[known].sum()
    return float(np.sum(values[known] * weight[known]) / total) if total > 0.0 else np.nan


def pushed(name, table, before, window, still, width, expected):
    """The force on a wall.

    Parameters
    ----------
    name : str
    table : structured array
        Rows of forces.csv.
    before : float [s]
        Up to this time no wave has come to the wall.
    window : mpslab.analysis.windows.Window
    still : float [N]
        Force of still water, to be taken if the table has fewer than 16 rows before that time.
    width : float [m]
        Of the wall; 1 in 2-D.
    expected : mpslab.analysis.goda.Load or None

    Returns
    -------
    Pushed
    """
    time, force = table["time"], table[f"{name} fx"]
    # Where the piston starts without fading in, the force grows long before the wave is there.
    calm = (time > 0.25 * before) & (time <= 0.5 * before)
    still = float(np.mean(force[calm])) if np.count_nonzero(calm) >= 16 else still
    force = (force - still) / width
    peaks = _peaks(time, force, window, "force")
    force = force[(time >= window.start) & (time <= window.end)]
    mean = float(np.mean(peaks["force"])) if len(peaks) else np.nan
    return Pushed(name, peaks, mean, float(force.max()), float(force.min()), still / width, width,
                  expected)  # fmt: skip
