"""Paddle that replays a recorded displacement, or makes a recorded surface elevation."""

import numpy as np

from mpslab.later import scipy
from mpslab.solids import paddle
from mpslab.solids.wavemakers import _elevation, _record

LATE = 0.1  # share of the run that may pass before the record begins
SHORT = 0.5  # share of the run that it has to cover
ROUNDED = 0.1  # share of the acceleration that may come from the last digit
MOST_SMOOTHED = 1000  # rows: beyond, round-off takes over
FEW = 20  # rows: fewer were drawn by hand, and their last digit is exact


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle with the displacement of a file, wavemaker.file (`_record.read` has its form).

    With wavemaker.quantity = "elevation" it makes what the file holds (`_elevation.make`).

    The run begins at the time wavemaker.offset of the record, and displacement counts from its
    value there. Between rows the motion is a monotone cubic (Fritsch & Carlson 1980), which never
    goes beyond the rows; it is at rest at the first row and at the last one, and the paddle stands
    still before and after. With wavemaker.smoothing a smoothing spline gives the rows.

    Raises ValueError as `_record.read` does, or if the record lies outside of the run, begins
    before 0 s without an offset, or is too short for the smoothing.
    """
    record = _record.read(wavemaker.file, _elevation.COLUMNS if _is_elevation(wavemaker) else
                          _record.MOTION)  # fmt: skip
    _require_overlap(record, wavemaker, end)
    if _is_elevation(wavemaker):
        return _elevation.make(record, wavemaker, depth, gravity, end)
    times, values = record.times - wavemaker.offset, record.values
    slopes = scipy.interpolate.PchipInterpolator(times, values).derivative()(times)
    if wavemaker.smoothing > 0.0:
        values, slopes = _smoothed(record, wavemaker.smoothing)
    times, values, slopes = _from_rest(times, values, slopes)
    curve = scipy.interpolate.CubicHermiteSpline(times, values, slopes)

    def motion(t):
        travel = curve(np.clip(t, times[0], times[-1]))
        return paddle.soft_start(t, wavemaker.start) * travel

    note = f"recorded motion of {wavemaker.file}: {len(times)} rows, up to t = {times[-1]:g} s"
    # Between rows the motion is monotone, so its extremes lie at rows; a soft start and a smoothing
    # may move them.
    samples = np.concatenate([times[times <= end], np.linspace(0.0, end, 2001)])
    whole = np.concatenate([times, np.linspace(0.0, max(times[-1], wavemaker.start), 2001)])
    speed, acceleration = _fastest(curve, end)
    facts = {
        "rows": len(times),
        "begin [s]": times[0],
        "end [s]": times[-1],
        "top_speed [m/s]": speed,
        "largest_acceleration [m/s2]": acceleration,
    }
    doubts = (
        _late(times, wavemaker, end),
        _short(times, end),
        _rounded(record, wavemaker, acceleration),
        _violent(acceleration, wavemaker, gravity),
    )
    doubts = tuple(doubt for doubt in doubts if doubt)
    return paddle.from_motion(motion, samples, 0.0, note, whole, facts, doubts)


def _is_elevation(wavemaker):
    return wavemaker.quantity == "elevation"


def _smoothed(record, width):
    times = record.times
    most = min(0.5 * (times[-1] - times[0]), MOST_SMOOTHED * float(np.median(np.diff(times))))
    try:
        if width <= most and len(times) > 2:
            return smooth(times, record.values, width)
    except np.linalg.LinAlgError:  # rows much closer together than most are
        most = 0.1 * width
    raise ValueError(
        f"wavemaker.smoothing = {width:g} s: must be at most {most:.4g} s for this record, half of "
        f"it and {MOST_SMOOTHED} rows, and it must have 3 rows or more"
    )


def smooth(times, values, width):
    """Smoothing spline: values and slopes at the times, (n,) float64 each.

    The cubic spline f with the least integral of (f - x)^2 + (width / 2 pi)^4 f''^2: it halves
    wiggles of the period `width` and leaves longer ones and straight lines as they are; of shorter
    ones it keeps a share that falls with the fourth power of their period (Reinsch 1967; n >= 3).
    """
    step, count = np.diff(times), len(times)
    weight = np.empty(count)  # the time that each row stands for
    weight[1:-1], weight[[0, -1]] = 0.5 * (step[:-1] + step[1:]), 0.5 * step[[0, -1]]
    # Second differences, Q^T x, are three bands; f'' follows from (R + a Q^T W^-1 Q) f'' = Q^T x.
    bands = np.array([1.0 / step[:-1], -1.0 / step[:-1] - 1.0 / step[1:], 1.0 / step[1:]])
    scaled = (width / (2.0 * np.pi)) ** 4 * bands / np.array(
        [weight[:-2], weight[1:-1], weight[2:]]
    )
    matrix = np.zeros((3, count - 2))
    matrix[2] = (step[:-1] + step[1:]) / 3.0 + np.sum(bands * scaled, axis=0)
    matrix[1, 1:] = step[1:-1] / 6.0 + (bands[1:, :-1] * scaled[:2, 1:]).sum(axis=0)
    matrix[0, 2:] = bands[2, :-2] * scaled[0, 2:]
    bent = scipy.linalg.solveh_banded(matrix, np.diff(np.diff(values) / step))
    values = values.astype(float)
    for k in range(3):
        values[k : count - 2 + k] -= scaled[k] * bent
    bent = np.concatenate([[0.0], bent, [0.0]])
    slopes = np.diff(values) / step - step / 6.0 * (2.0 * bent[:-1] + bent[1:])
    last = slopes[-1] + 0.5 * step[-1] * (bent[-2] + bent[-1])
    return values, np.append(slopes, last)


def _from_rest(times, values, slopes):
    """The rows from t = 0 on: at 0 and at rest at the first of them, at rest at the last."""
    if times[0] < 0.0:
        start = scipy.interpolate.CubicHermiteSpline(times, values, slopes)(0.0)
        rows = times > 0.0
        times = np.append(0.0, times[rows])
        values, slopes = np.append(start, values[rows]), np.append(0.0, slopes[rows])
    slopes[[0, -1]] = 0.0
    return times, values - values[0], slopes


def _fastest(curve, end):
    """Largest speed [m/s] and acceleration [m/s2] of a piecewise cubic until the end of the run."""
    step, rows = np.diff(curve.x), curve.x[:-1] < end
    cubic, square, slope, _ = curve.c[:, rows]
    step = step[rows]
    parts = np.linspace(0.0, 1.0, 9)[:, np.newaxis] * step
    speed = slope + parts * (2.0 * square + parts * 3.0 * cubic)
    acceleration = 2.0 * square + np.array([[0.0], [6.0]]) * cubic * step
    return float(np.abs(speed).max()), float(np.abs(acceleration).max())


def _require_overlap(record, wavemaker, end):
    first, last, offset = record.times[0], record.times[-1], wavemaker.offset
    if first < offset == 0.0:
        raise ValueError(
            f"{record.where}, line {record.line}: time = {first:g} s: must not be below 0 s, "
            f"unless wavemaker.offset says where the run begins; {first:g} takes all of the record"
        )
    if last <= offset:
        raise ValueError(
            f"wavemaker.offset = {offset:g} s: must be below {last:g} s, the end of the record "
            f"{str(wavemaker.file)!r}, which begins at {first:g} s"
        )
    if first - offset >= end:
        raise ValueError(
            f"{record.where}: begins at {first:g} s, so {first - offset:g} s into the run: must "
            f"begin before its end, time.end = {end:g} s; wavemaker.offset = {first:g} lets the "
            "run begin with the record"
        )


def _late(times, wavemaker, end):
    if times[0] <= LATE * end:
        return ""
    return (
        f"wavemaker.file: the paddle stands still until t = {times[0]:g} s, where its record begins"
        f"; wavemaker.offset = {times[0] + wavemaker.offset:g} lets the run begin with it"
    )


def _short(times, end):
    if times[-1] >= SHORT * end:
        return ""
    return (
        f"wavemaker.file: its record ends at t = {times[-1]:g} s, and the paddle stands still to "
        f"the end of the run, time.end = {end:g} s"
    )


def _rounded(record, wavemaker, acceleration):
    """Whether much of the acceleration comes from the last digit alone."""
    step = float(np.median(np.diff(record.times)))
    noise = 2.0 * record.digit / step / step
    if len(record.times) < FEW or wavemaker.smoothing >= 4.0 * step:
        return ""
    if noise <= ROUNDED * acceleration:
        return ""
    return (
        f"wavemaker.file: rounded to {record.digit * 1e3:g} mm, {step:.3g} s apart, its rows make "
        f"the paddle jerk: up to {noise:.2g} of its largest acceleration of {acceleration:.2g} "
        f"m/s2, and jumps of speed of {record.digit / step:.2g} m/s, are rounding; "
        f"wavemaker.smoothing = {5.0 * step:.2g} takes them out"
    )


def _violent(acceleration, wavemaker, gravity):
    if not acceleration > gravity > 0.0:
        return ""
    return (
        f"wavemaker.file: the paddle's largest acceleration, {acceleration:.3g} m/s2, is above "
        "gravity: water will splash; wavemaker.smoothing or wavemaker.start softens it"
    )
