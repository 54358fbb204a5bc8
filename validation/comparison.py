"""What a case finds: measured values, figures, tables, orders of convergence and notes."""

from dataclasses import dataclass, field

import numpy as np

POINTS = 800  # of a series, at most
DIGITS = 5  # of a number in a series


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


@dataclass
class Comparison:
    """What `compare` of a case returns.

    Attributes
    ----------
    measured : dict of str to float
        Values by the names of the criteria; a value that is not finite is a miss.
    figures, tables, convergence, notes : list
        As in the JSON file of a case (see ``validation/README.md``).
    """

    measured: dict = field(default_factory=dict)
    figures: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    convergence: list = field(default_factory=list)
    notes: list = field(default_factory=list)

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
        self.tables.append(
            {"title": title, "columns": list(columns), "rows": [list(r) for r in rows]}
        )

    def converge(self, title, spacing, error):
        """Add the errors (n,) at the spacings (n,) [m] and the order fitted to them.

        Returns
        -------
        float
            The order: the slope of log |error| over log spacing.
        """
        order = np.polyfit(np.log(spacing), np.log(np.abs(error)), 1)[0]
        self.convergence.append({
            "title": title,
            "spacing": [float(d) for d in spacing],
            "error": [float(e) for e in error],
            "order": float(order),
        })  # fmt: skip
        return float(order)

    def note(self, text):
        """Add a sentence."""
        self.notes.append(text)
