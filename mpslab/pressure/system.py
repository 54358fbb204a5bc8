"""The pressure equation as a sparse system."""

from dataclasses import dataclass

import numpy as np

from mpslab.kernels import sparse


@dataclass
class PressureSystem:
    """A p = b, symmetric positive definite, in compressed rows without the diagonal.

    Attributes
    ----------
    row : (m + 1,) int32
    column : (entries,) int32
    value : (entries,) float32
    diagonal : (m,) float64
    right : (m,) float64
    first : (slabs + 1,) int32
        First row of each slab, and m; one slab unless given.
    domain : mpslab.parallel.domain.Domain, optional
        With it the rows of this rank's ghosts are among the m, but solved on the rank that owns
        them; `multiply` and `dot` see to that.
    cell : (m, 2) int, optional
        Cell across the tank, in y and z, that the particle of each row is in.
    begin, end : int
        First slab whose rows are solved here, and the slab after the last one.
    own : tuple of int
        First row that is solved here, and the row after the last one.
    """

    row: np.ndarray
    column: np.ndarray
    value: np.ndarray
    diagonal: np.ndarray
    right: np.ndarray
    first: np.ndarray = None
    domain: object = None
    cell: np.ndarray = None

    def __post_init__(self):
        if self.first is None:
            self.first = np.array([0, len(self)], np.int32)
        if self.cell is None:
            self.cell = np.zeros((len(self), 2), np.int32)
        self.begin, self.end = 0, len(self.first) - 1
        if self.domain:
            self.begin, self.end = self.domain.begin, self.domain.end
        self.own = int(self.first[self.begin]), int(self.first[self.end])

    def __len__(self):
        return len(self.diagonal)

    def dot(self, x, y):
        """x . y over all ranks."""
        return self.dots((x, y))[0]

    def dots(self, *pairs):
        """x . y of each pair (x, y) over all ranks, which meet once for all of them."""
        sums = np.zeros((len(pairs), len(self.first) - 1))
        for (x, y), into in zip(pairs, sums, strict=True):
            self.slab_dots(x, y, into)
        return [sum(row) for row in self.collect(sums).tolist()]

    def slab_dots(self, x, y, out):
        """out[s] = x . y in each slab of this rank; their sum over s is the same on any ranks."""
        sparse.slab_dots(x, y, self.first, self.begin, self.end, out)

    def refresh(self, x):
        """Give the ghosts' rows of x the values that their owners have."""
        if self.domain:
            self.domain.refresh_rows(x, self.first)

    def from_all(self, item):
        """What each rank gives, a list."""
        return self.domain.from_all(item) if self.domain else [item]

    def collect(self, sums):
        """Sum over the ranks of arrays in which no two ranks give to the same entry."""
        return self.domain.collect(sums) if self.domain else sums

    def sort_rows(self):
        """Put the entries of each row in the order of their columns, as a factor needs them."""
        sparse.sort_rows(self.row, self.column, self.value)

    def multiply(self, x, out):
        """out = A x in this rank's rows."""
        self.refresh(x)
        sparse.multiply(self.row, self.column, self.value, self.diagonal, x, out, *self.own)
        return out


@dataclass(frozen=True)
class SolverReport:
    """How a solve went.

    Attributes
    ----------
    iterations : int
    residual : float
        |b - A p| / |b| at the end.
    converged : bool
    replaced : int
        Pivots of the incomplete factor that had to be put back to their diagonal.
    """

    iterations: int
    residual: float
    converged: bool
    replaced: int = 0
