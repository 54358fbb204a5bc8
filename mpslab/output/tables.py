"""Tables of rows that grow at their end while others read them."""

import csv
import os
from pathlib import Path
from time import monotonic

import numpy as np

from mpslab.core.files import replacing


def read_rows(path):
    """Whole rows of a table, its header first; none if there is no file.

    A last line without its end is left out: it is being written, or a kill has cut it short.

    Raises ValueError, with the path, if the file cannot be read, or is no text in columns.
    """
    try:
        with path.open(newline="", encoding="utf-8") as file:
            return [row for row in csv.reader(line for line in file if line.endswith("\n")) if row]
    except FileNotFoundError:
        return []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"'{path}': cannot be read as a table of a run ({error})") from error


def read_table(path):
    """Columns of a table of numbers and words.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    dict of str to ndarray
        Header to column, of numbers where all entries are numbers; empty if there is no file, or
        no row in it.
    """
    header, *rows = read_rows(path) or [[]]
    if not rows:
        return {}
    return {name: _column(entries) for name, *entries in zip(header, *rows, strict=True)}


def _column(entries):
    try:
        return np.array(entries, float)
    except ValueError:
        return np.array(entries)


class CsvTable:
    """A table of rows that are added at its end, on the disk a second later at most.

    Numbers are written so that reading them back gives the same bits.

    Parameters
    ----------
    path : str or Path
        The file.
    columns : sequence of str
        The header. The first column never falls from row to row: a step or a time.
    last : float, optional
        Keep the rows of an existing file whose first entry is not above this, and go on after
        them. Without it the table starts empty.

    Raises
    ------
    ValueError
        If an existing table that is to go on has other columns.
    """

    def __init__(self, path, columns, last=None):
        self.path = Path(path)
        self.columns = tuple(columns)
        kept = [] if last is None else self._rows_until(last)
        with replacing(self.path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([self.columns, *kept])
        self._file = self.path.open("a", newline="", encoding="utf-8")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._flushed = monotonic()

    def _rows_until(self, last):
        """Rows of the file up to a step or time."""
        header, *rows = read_rows(self.path) or [self.columns]
        if tuple(header) != self.columns:
            raise ValueError(
                f"{self.path}: columns are {','.join(header)}, but the run writes "
                f"{','.join(self.columns)}"
            )
        try:
            return [row for row in rows if float(row[0]) <= last]
        except ValueError as error:
            raise ValueError(f"{self.path}: a row begins with no number ({error})") from None

    def append(self, row):
        """Add a row of numbers and strings, one for each column."""
        if len(row) != len(self.columns):
            raise ValueError(f"{self.path}: {len(row)} entries for {len(self.columns)} columns")
        self._writer.writerow(row)
        if monotonic() - self._flushed >= 1.0:
            self.flush()

    def flush(self):
        """Hand all rows to the operating system, so that they survive a kill of the process."""
        self._file.flush()
        self._flushed = monotonic()

    def in_place(self):
        """Whether the file is still the one that the rows go to, not one made since."""
        try:
            return os.path.samestat(os.stat(self.path), os.fstat(self._file.fileno()))
        except FileNotFoundError:
            return False

    def close(self):
        """Write what is left and close the file."""
        self._file.close()
