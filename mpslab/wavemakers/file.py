"""Paddle that replays a recorded displacement."""

import csv
import math

import numpy as np
import scipy

from mpslab import paddle


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle with the displacement of a CSV file, wavemaker.file.

    The file has two columns, time [s] and displacement [m], with or without a line of headings.
    Displacement counts from its first value. Between rows the motion is a monotone cubic (Fritsch &
    Carlson 1980), which never goes beyond the rows, and it leaves the first row and reaches the
    last one at rest; before and after, the paddle stands still.

    Raises ValueError with file and line if the file is missing, cannot be read, has fewer than two
    rows, a value that is not a finite number, a time below 0 or times that do not increase.
    """
    times, values = _read(wavemaker.file)
    slopes = scipy.interpolate.PchipInterpolator(times, values).derivative()(times)
    slopes[[0, -1]] = 0.0
    record = scipy.interpolate.CubicHermiteSpline(times, values - values[0], slopes)

    def motion(t):
        travel = record(np.clip(t, times[0], times[-1]))
        return paddle.soft_start(t, wavemaker.start) * travel

    note = f"recorded motion of {wavemaker.file}: {len(times)} rows, up to t = {times[-1]:g} s"
    # Between rows the motion is monotone, so its extremes lie at rows; a soft start may move them.
    samples = np.concatenate([times[times <= end], np.linspace(0.0, end, 2001)])
    whole = np.concatenate([times, np.linspace(0.0, max(times[-1], wavemaker.start), 2001)])
    return paddle.from_motion(motion, samples, wavemaker.height, note, whole)


def _read(path):
    """Times [s] and displacements [m], (n,) float64 each."""
    where = f"wavemaker.file = {str(path)!r}"
    try:
        with open(path, newline="", encoding="utf-8-sig") as stream:
            reader = csv.reader(stream)
            rows = [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{where}: cannot be read as a CSV file ({error})") from error
    if rows and not any(_is_number(cell) for cell in rows[0][1]):
        rows = rows[1:]
    numbers = np.array([_two_numbers(row, f"{where}, line {line}") for line, row in rows])
    if len(numbers) < 2:
        raise ValueError(f"{where}: has {len(numbers)} rows of numbers; must have 2 or more")
    _require_increasing(numbers[:, 0], [line for line, _ in rows], where)
    return numbers[:, 0], numbers[:, 1]


def _two_numbers(row, where):
    numbers = [float(cell) if _is_number(cell) else math.nan for cell in row]
    if len(row) != 2 or not all(map(math.isfinite, numbers)):
        raise ValueError(
            f"{where}: {','.join(row)!r} must be two finite numbers, time [s] and displacement [m]"
        )
    return numbers


def _is_number(cell):
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _require_increasing(times, lines, where):
    if times[0] < 0.0:
        raise ValueError(f"{where}, line {lines[0]}: time = {times[0]:g} s: must not be below 0 s")
    for i in np.flatnonzero(np.diff(times) <= 0.0)[:1] + 1:
        raise ValueError(
            f"{where}, line {lines[i]}: time = {times[i]:g} s: must be above that of the row"
            f" before, {times[i - 1]:g} s"
        )
