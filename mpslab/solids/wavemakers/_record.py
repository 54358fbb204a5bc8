"""Reads two columns of numbers, as loggers and spreadsheets write them: a motion, or a spectrum."""

import csv
import math
import os
import re
from array import array
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mpslab.core.files import stamp

MOST_ROWS = 50_000
MOST_BYTES = 20_000_000
LARGEST, CLOSEST = 1e9, 1e-9  # largest number, and least time between two rows [s], of a record
FINEST = 1e-15  # [m] less counts as nothing
SEPARATORS = (";", "\t", ",", None)  # None: blanks
NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE)
# What may stand for a missing number; none of these is a word of a heading.
MISSING = ("nan", "inf", "infinity", "na", "n/a", "null", "none")
# Ways in which a heading may write a unit, by the unit that the column must have.
OTHERS = {
    "s": ("ms", "msec", "us", "min", "minutes", "h", "hours"),
    "m": ("mm", "cm", "dm", "km", "um", "ft", "feet", "inch", "inches"),
    "Hz": ("rad", "mhz", "khz", "min"),
    "m2/Hz": ("mm", "cm", "ft", "rad"),
}
MOTION = (("time", "s"), ("displacement", "m"))


@dataclass(frozen=True)
class Record:
    """Two columns as recorded.

    Attributes
    ----------
    where : str
        Key and file, to begin a message with.
    times, values : (n,) float64
        The columns; of a motion in s and m.
    digit : float
        Value of the last digit that the second column is written with.
    line : int
        Number of the line of the file that holds the first row.
    """

    where: str
    times: np.ndarray
    values: np.ndarray
    digit: float
    line: int


def read(path, columns=MOTION) -> Record:
    """Read a record of time [s] and displacement [m], with or without a line of headings.

    `columns` names other columns, (name, unit) each. Columns are parted by commas, semicolons, tabs
    or blanks. Where they are not parted by commas, a decimal comma may take the place of the point
    throughout the file.

    Raises ValueError with file and line if the file is missing or cannot be read, has fewer than
    two rows or too many, names other units, has a value that is not a finite number, or
    times that do not increase.
    """
    return _read(path, columns, stamp(path))


@lru_cache(maxsize=4)
def _read(path, columns, _):
    where = f"wavemaker.file = {str(path)!r}"
    lines = _lines(path, where)
    separator = _separator(lines)
    heading = _cells(lines[0][1].lstrip("# "), separator) if lines else []
    if heading and _is_heading(heading):
        _require_units(heading, columns, f"{where}, line {lines[0][0]}")
        lines = lines[1:]
    numbers, digits, mark = array("d"), -300.0, ""
    for line, text in lines:
        cells = _cells(text, separator)
        found = "." * any("." in cell for cell in cells) + "," * any("," in cell for cell in cells)
        mark = mark or found[:1]
        alike = found in ("", mark)
        numbers.extend(_two_numbers(cells, text, alike, columns, f"{where}, line {line}"))
        digits = max(digits, _digits(cells[1]))
    times, values = np.array(numbers).reshape(-1, 2).T
    if len(times) < 2:
        raise ValueError(f"{where}: has {len(times)} rows of numbers; must have 2 or more")
    values = np.where(np.abs(values) < FINEST, 0.0, values)
    _require_increasing(times, [line for line, _ in lines], columns[0], where)
    times.flags.writeable = values.flags.writeable = False  # for all that read the file again
    return Record(where, times, values, 10.0**-digits, lines[0][0])


def _lines(path, where):
    """Lines that are not empty, with their numbers."""
    lines = []
    try:
        with open(path, encoding="utf-8-sig") as stream:
            large = os.fstat(stream.fileno()).st_size > MOST_BYTES
            for number, line in enumerate(() if large else stream, 1):
                if line.strip():
                    lines.append((number, line.strip("\n")))
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{where}: cannot be read as a CSV file ({error})") from error
    if large or len(lines) > MOST_ROWS + 1:
        raise ValueError(
            f"{where}: must have at most {MOST_ROWS:,} rows and {MOST_BYTES / 1e6:g} MB; leave out "
            "what lies before and after the run, or every other row"
        )
    return lines


def _separator(lines):
    """What parts the columns: the first of SEPARATORS that parts some line into two numbers."""
    for _, text in lines:
        for separator in SEPARATORS:
            cells = _cells(text, separator)
            if len(cells) == 2 and all(map(NUMBER.fullmatch, cells)):
                return separator
    return ","


def _cells(text, separator):
    if separator is None:
        return text.split()
    if '"' not in text:
        return [cell.strip() for cell in text.split(separator)]
    try:
        row = next(csv.reader([text], delimiter=separator), [])
    except csv.Error:
        row = text.split(separator)
    return [cell.strip() for cell in row]


def _is_heading(cells):
    """Whether every cell is a word: none is a number, looks like one or stands for one."""
    return all(
        re.search(r"[^\W\d_]", cell)
        and not re.match(r"[+-]?[.,]?\d", cell)
        and cell.lower().lstrip("+-") not in MISSING
        for cell in cells
    )


def _require_units(cells, columns, where):
    for cell, (_, unit) in zip(cells, columns, strict=False):
        words = re.findall(r"[^\W\d_]+", cell.lower().replace("µ", "u"))
        found = [word for word in OTHERS[unit] if word in words]
        if words[-1:] == ["in"] and unit == "m":
            found = ["in"]
        if found:
            raise ValueError(
                f"{where}: {cell!r} says {found[0]}: must be in {unit}, and its heading must name "
                "no other unit; convert the column"
            )


def _two_numbers(cells, text, alike, columns, where):
    """The two numbers of a row, whose decimal mark must be that of the rows before."""
    good = len(cells) == 2 and alike and all(map(NUMBER.fullmatch, cells))
    numbers = [float(cell.replace(",", ".")) for cell in cells] if good else [math.nan]
    if not all(abs(number) <= LARGEST for number in numbers):
        shown = text if len(text) <= 60 else text[:57] + "..."
        (first, unit), (second, other) = columns
        raise ValueError(
            f"{where}: {shown!r} must be two finite numbers, {first} [{unit}] and {second} "
            f"[{other}], parted by a comma, semicolon, tab or blanks, with decimal points "
            "throughout, or with decimal commas throughout where no comma parts them; a heading "
            "above them holds words only"
        )
    return numbers


def _digits(cell):
    """Decimal places of a number as it is written; negative for a large exponent, as in 1e3."""
    mantissa, _, exponent = cell.lower().partition("e")
    decimals = len(mantissa.replace(",", ".").partition(".")[2])
    return min(max(decimals - float(exponent or 0), -300.0), 300.0)


def _require_increasing(times, lines, column, where):
    name, unit = column
    for i in np.flatnonzero(np.diff(times) < CLOSEST)[:1] + 1:
        raise ValueError(
            f"{where}, line {lines[i]}: {name} = {times[i]:g} {unit}: must be above that of the row"
            f" before, {times[i - 1]:g} {unit}"
        )
