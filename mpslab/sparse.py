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
    column : (entries,) int32, ascending in a row
    value : (entries,) float64
    diagonal : (m,) float64
    right : (m,) float64
    """

    row: np.ndarray
    column: np.ndarray
    value: np.ndarray
    diagonal: np.ndarray
    right: np.ndarray

    def __len__(self):
        return len(self.diagonal)

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
