"""The pressure equation as a sparse system."""

from dataclasses import dataclass

import numpy as np

from mpslab.kernels import sparse
from mpslab.pressure.blocks import Blocks


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
    blocks : Blocks
        Which rows are solved here; all of them unless given.
    cell : (m, 2) int, optional
        Cell across the tank, in y and z, that the particle of each row is in.
    prepared : object
        What a solver keeps of the matrix, for another right-hand side.
    """

    row: np.ndarray
    column: np.ndarray
    value: np.ndarray
    diagonal: np.ndarray
    right: np.ndarray
    blocks: Blocks = None
    cell: np.ndarray = None
    prepared: object = None

    def __post_init__(self):
        if self.blocks is None:
            self.blocks = Blocks([0, len(self)])
        if self.cell is None:
            self.cell = np.zeros((len(self), 2), np.int32)

    def __len__(self):
        return len(self.diagonal)

    def sort_rows(self):
        """Put the entries of each row in the order of their columns, as a factor needs them."""
        sparse.sort_rows(self.row, self.column, self.value)

    def multiply(self, x, out):
        """out = A x in this rank's rows."""
        self.blocks.refresh(x)
        sparse.multiply(
            self.row, self.column, self.value, self.diagonal, x, out, *self.blocks.own
        )  # fmt: skip
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
    coarse : float
        Largest residual that the coarse system of a deflation was left with where it did not
        converge, 0 if it always did.
    """

    iterations: int
    residual: float
    converged: bool
    replaced: int = 0
    coarse: float = 0.0
