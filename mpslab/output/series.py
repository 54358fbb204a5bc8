"""Rows in memory that grow at their end."""

import numpy as np


class Series:
    """Rows as a structured array, at the cost of one row for each that is added.

    Parameters
    ----------
    names : sequence of str
        Of the columns, all of them numbers but those in `words`.
    words : dict of str to int, optional
        Columns of words, and how many letters these have at most.
    """

    def __init__(self, names, words=None):
        letters = words or {}
        kinds = [f"U{letters[name]}" if name in letters else float for name in names]
        self._rows = np.zeros(16, dtype=list(zip(names, kinds, strict=True)))
        self._count = 0

    def __len__(self):
        return self._count

    def add(self, row):
        """Add a row, a tuple with an entry for each column."""
        if self._count == len(self._rows):
            # A new array, because somebody may hold the old one.
            self._rows = np.concatenate([self._rows, np.zeros_like(self._rows)])
        self._rows[self._count] = row
        self._count += 1

    @property
    def rows(self):
        """The rows so far, a structured array (n,) that cannot be written to."""
        rows = self._rows[: self._count]
        rows.flags.writeable = False
        return rows
