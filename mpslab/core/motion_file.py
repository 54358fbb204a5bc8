"""Motions in the plane x-z from CSV files, those of a tank and of solids alike."""

import csv
from functools import lru_cache

import numpy as np

from mpslab.core.files import is_file, stamp
from mpslab.core.keys import CaseError, require
from mpslab.core.motion import Table

COLUMNS = {"x": 1.0, "z": 1.0, "roll": np.pi / 180.0}  # of a file, in m, m and rad
UNITS = {"time": "s", "x": "m", "z": "m", "roll": "deg"}


def read(path, key, center):
    """The `mpslab.core.motion.Table` in a file.

    Parameters
    ----------
    path : str
    key : str
        That names the file, for messages.
    center : (x, z) [m]
        Axis of the roll.

    Raises
    ------
    CaseError
        If the file cannot be read, or is no such table.
    """
    require(is_file(path), key, path, "a CSV file that exists")
    return Table(*_table(path, f"{key} = {str(path)!r}", stamp(path)), center)


@lru_cache(maxsize=8)
def _table(path, where, _):
    """Times (n,) [s] and values (n, 3) [m], [m], [rad] of a file."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as stream:
            rows = [row for row in csv.reader(stream) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise CaseError(f"{where}: cannot be read as a CSV file ({error})") from error
    heading = [cell.partition("[") for cell in rows[0]] if rows else []
    names = [name.strip() for name, _, _ in heading]
    meant = all(unit.strip(" ]") in ("", UNITS.get(name))
                for name, (_, _, unit) in zip(names, heading, strict=True))  # fmt: skip
    known = set(names[1:]) <= set(COLUMNS) and len(names) == len(set(names))
    if not meant or names[:1] != ["time"] or not known:
        raise CaseError(
            f"{where}: heading {','.join(rows[0] if rows else [])!r}: must be time [s] and any of "
            "x [m], z [m] and roll [deg], parted by commas"
        )
    table = np.array([_numbers(row, len(names), where, i) for i, row in enumerate(rows[1:], 2)])
    if len(table) < 3 or len(names) < 2:
        raise CaseError(f"{where}: must have 3 rows of numbers or more, in 2 columns or more")
    late = np.flatnonzero(np.diff(table[:, 0]) <= 0.0)
    if len(late):
        raise CaseError(f"{where}, row {late[0] + 3}: time must be above that of the row before")
    values = np.zeros((len(table), len(COLUMNS)))
    for k, (name, unit) in enumerate(COLUMNS.items()):
        if name in names:
            values[:, k] = unit * table[:, names.index(name)]
    return table[:, 0], values


def _numbers(row, count, where, line):
    try:
        numbers = [float(cell) for cell in row]
    except ValueError:
        numbers = []
    if len(numbers) != count or not np.all(np.abs(numbers) < 1e9):
        raise CaseError(f"{where}, row {line}: {','.join(row)!r} must be {count} finite numbers")
    return numbers
