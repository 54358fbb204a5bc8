"""Waves one by one, from one crossing of the mean level to the next."""

import numpy as np

WAVE = np.dtype([(name, float) for name in ("time", "period", "height", "crest", "trough")])
RIPPLE = 0.02  # times 4 standard deviations; see `waves`


def waves(time, elevation, crossing="down", ripple=RIPPLE):
    """The waves of a record.

    A wave goes from one crossing of the mean level to the next in the same direction. A crossing
    counts only if the water goes beyond a small distance from the level on both sides of it.

    Parameters
    ----------
    time, elevation : (n,) float64 [s], [m]
        The elevation above its mean.
    crossing : str
        "down": a wave is a trough and the crest after it; "up": a crest and the trough after it.
    ripple : float
        That distance, over 4 standard deviations (the significant height).

    Returns
    -------
    (waves,) structured array
        "time" [s] of the first crossing, "period" [s], "height" from trough to crest, "crest" and
        "trough" [m].
    """
    if crossing not in ("down", "up"):
        raise ValueError(f"crossing = {crossing!r}: must be 'down' or 'up'")
    signal = elevation if crossing == "down" else -elevation
    at = _downward(signal, ripple * 4.0 * np.std(elevation))
    moments = time[at] + (time[at + 1] - time[at]) * signal[at] / (signal[at] - signal[at + 1])
    found = np.zeros(max(len(at) - 1, 0), WAVE)
    for wave, first, last in zip(found, at, at[1:], strict=False):
        part = elevation[first + 1 : last + 1]
        wave["crest"], wave["trough"] = part.max(), part.min()
    found["time"], found["period"] = moments[:-1], np.diff(moments)
    found["height"] = found["crest"] - found["trough"]
    return found


def _downward(signal, least):
    """Rows (m,) before the crossings downwards, between swings that pass `least` on both sides."""
    side = np.where(signal > least, 1, np.where(signal < -least, -1, 0))
    swings = np.flatnonzero(side)
    falls = swings[1:][np.diff(side[swings]) < 0]
    crossed = np.flatnonzero((signal[:-1] >= 0.0) & (signal[1:] < 0.0))
    return crossed[np.searchsorted(crossed, falls) - 1]


def statistics(found):
    """Heights and periods of waves.

    Parameters
    ----------
    found : (waves,) structured array
        Of `waves`.

    Returns
    -------
    dict of str to float
        "N"; mean height "Hmean" and period "Tmean"; "H1/3" and "T1/3", means over the highest third
        of the waves; "H1/10", over the highest tenth; "Hmax"; "crest" and "trough", the extremes.
        [m] and [s]. NaN if there are too few waves: below three, for the tenth below ten.
    """
    order = np.argsort(found["height"])[::-1]
    height, period = found["height"][order], found["period"][order]

    def highest(values, part):
        return values[: round(len(values) / part)].mean() if len(values) >= part else np.nan

    return {
        "N": len(found),
        "Hmean": highest(height, 1),
        "Tmean": highest(period, 1),
        "H1/3": highest(height, 3),
        "T1/3": highest(period, 3),
        "H1/10": highest(height, 10),
        "Hmax": height[0] if len(found) else np.nan,
        "crest": found["crest"].max() if len(found) else np.nan,
        "trough": found["trough"].min() if len(found) else np.nan,
    }
