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
    column : (entries,) int32, in a row in the order of the particles' gid
    value : (entries,) float64
    diagonal : (m,) float64
    right : (m,) float64
    first : (slabs + 1,) int32
        First row of each slab, and m; one slab unless given.
    """

    row: np.ndarray
    column: np.ndarray
    value: np.ndarray
    diagonal: np.ndarray
    right: np.ndarray
    first: np.ndarray = None

    def __post_init__(self):
        if self.first is None:
            self.first = np.array([0, len(self)], np.int32)

    def __len__(self):
        return len(self.diagonal)

    @property
    def begin(self):
        """First slab whose rows are solved here."""
        return 0

    @property
    def end(self):
        """Slab after the last one whose rows are solved here."""
        return len(self.first) - 1

    def dot(self, x, y):
        """x . y from the sums of the slabs, added in the order of the slabs."""
        sums = np.zeros(len(self.first) - 1)
        sparse.slab_dots(x, y, self.first, self.begin, self.end, sums)
        return sum(sums.tolist())

    def refresh(self, x):
        """Bring the rows of other ranks up to date; here there are none."""

    def multiply(self, x, out):
        """out = A x."""
        sparse.multiply(self.row, self.column, self.value, self.diagonal, x, out)
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
