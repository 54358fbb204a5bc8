"""What a case finds: measured values, figures, tables, orders of convergence and notes."""

from dataclasses import dataclass, field

import numpy as np

POINTS = 800  # of a series, at most
DIGITS = 5  # of a number in a series
LAGS = np.linspace(-0.1, 0.1, 201)  # tried for the phase, in spans of the measurement
ERRORS = ("curve", "rms error", "bias", "late by", "peak / measured")


@dataclass
class Figure:
    """A figure as numbers, for `validation.figures` to draw."""

    title: str
    x: str
    y: str
    equal: bool = False
    series: list = field(default_factory=list)

    def line(self, label, x, y):
        """A simulation: a full line through (n,) x and y."""
        self._add(label, "line", x, y)

    def dashed(self, label, x, y):
        """A theory or another reference: a dashed line."""
        self._add(label, "dashed", x, y)

    def points(self, label, x, y):
        """Measurements: points."""
        self._add(label, "points", x, y)

    def band(self, label, x, low, high):
        """The range between two lines."""
        self._add(label, "band", x, low, high)

    def _add(self, label, style, *columns):
        columns = [np.asarray(c, float) for c in columns]
        known = np.isfinite(columns).all(axis=0)
        every = max(int(np.ceil(known.sum() / POINTS)), 1)
        names = ("x", "y", "y2")[: len(columns)]
        numbers = {n: _short(c[known][::every]) for n, c in zip(names, columns, strict=True)}
        self.series.append({"label": label, "style": style, **numbers})


def _short(column):
    """Numbers cut to a few digits, a list."""
    return [float(f"{value:.{DIGITS}g}") for value in column]


def rms(error):
    """Root of the mean square of an error, (n,) or a list."""
    return float(np.sqrt(np.mean(np.square(error))))


def _known(entry):
    """An entry of a table as JSON can hold it: None for what is not a finite number."""
    if isinstance(entry, float | np.floating):
        return float(entry) if np.isfinite(entry) else None
    return entry.item() if isinstance(entry, np.generic) else entry


@dataclass
class Comparison:
    """What `compare` of a case returns.

    Attributes
    ----------
    measured : dict of str to float
        Values by the names of the criteria; a value that is not finite is a miss.
    draws : list of dict
        The same of each draw, this one the first; filled in by the suite.
    figures, tables, convergence, notes : list
        As in the JSON file of a case (see ``validation/README.md``).
    errors : list of dict
        Rows of the table of errors, from `hold`.
    """

    measured: dict = field(default_factory=dict)
    draws: list = field(default_factory=list)
    figures: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    convergence: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    errors: list = field(default_factory=list)

    def measure(self, name, value):
        """Measure a criterion."""
        self.measured[name] = float(value) + 0.0  # never -0

    def figure(self, title, x, y, equal=False):
        """Add a figure; fill it with `Figure.line` and so on."""
        self.figures.append(Figure(title, x, y, equal))
        return self.figures[-1]

    def picture(self, title, drawn):
        """Add a matplotlib Figure, of particles for example; it is kept as a PNG file."""
        self.figures.append({"title": title, "picture": drawn})

    def table(self, title, columns, rows):
        """Add a table; the entries are numbers and texts."""
        self.tables.append({
            "title": title,
            "columns": list(columns),
            "rows": [[_known(entry) for entry in row] for row in rows],
        })  # fmt: skip

    @property
    def all_tables(self):
        """The tables, that of the errors first."""
        rows = [list(map(_known, row.values())) for row in self.errors]
        title = "Errors: simulation less measurement, in the units of each curve"
        errors = {"title": title, "columns": list(ERRORS), "rows": rows}
        return [errors, *self.tables] if rows else self.tables

    def hold(self, label, x, seen, at, measured):
        """Add a curve to the table of errors: a simulation against what was measured.

        Parameters
        ----------
        label : str
            What it is, with the units of the errors and of the lag: "level at H1 [m], [s]".
        x, seen : (n,) float
            The simulation, over time or place; it is interpolated.
        at, measured : (m,) float
            The measurement; what lies outside the simulation is left out.

        Returns
        -------
        dict of str to float
            By the columns: rms error and bias (seen - measured), lag (how far the simulation has
            to be moved back along x for the least rms error, a tenth of the span at most), and
            the ratio of the largest values.
        """
        inside = (at >= x[0]) & (at <= x[-1]) & np.isfinite(measured)
        at, measured = np.asarray(at)[inside], np.asarray(measured)[inside]
        error = np.interp(at, x, seen) - measured
        lags = LAGS * np.ptp(at)
        missed = [rms(np.interp(at + lag, x, seen) - measured) for lag in lags]
        peak = np.interp(at, x, seen).max() / measured.max()
        row = dict(zip(ERRORS, (label, rms(error), error.mean(), lags[np.argmin(missed)], peak),
                       strict=True))  # fmt: skip
        self.errors.append(row)
        return row

    def converge(self, title, spacing, error):
        """Add the errors (n,) at the spacings (n,) [m] and the order fitted to them.

        Returns
        -------
        float
            The order: the slope of log |error| over log spacing; NaN where fewer than two errors
            are finite and not zero.
        """
        spacing, size = np.asarray(spacing, float), np.abs(np.asarray(error, float))
        fits = np.isfinite(size) & (size > 0.0)
        order = np.nan
        if np.count_nonzero(fits) > 1:
            order = float(np.polyfit(np.log(spacing[fits]), np.log(size[fits]), 1)[0])
        self.convergence.append({
            "title": title,
            "spacing": spacing.tolist(),
            "error": [_known(e) for e in np.asarray(error, float).tolist()],
            "order": _known(order),
        })  # fmt: skip
        return order

    def note(self, text):
        """Add a sentence."""
        self.notes.append(text)
