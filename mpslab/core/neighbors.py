"""Neighbour lists in compressed rows."""

from dataclasses import dataclass, field

import numpy as np

from mpslab.core.cells import make_cells
from mpslab.kernels import cells as kernels
from mpslab.kernels import neighbors

ROOM = 8  # particles past the last one that the search may read


@dataclass
class NeighborList:
    """Neighbours of each active particle within a radius, as compressed sparse rows.

    Attributes
    ----------
    indptr : (n + 1,) int32
        Row i is ``indices[indptr[i]:indptr[i + 1]]``; rows of inactive particles are empty.
    indices : (m,) int32
        Neighbours of a row, ascending, the particle itself left out; once the pairs are measured
        (`mpslab.core.neighbourhood`), water before solids.
    """

    indptr: np.ndarray = field(default_factory=lambda: np.zeros(1, np.int32))
    indices: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    _indices: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32), repr=False)
    _scratch: int = field(default=1024, repr=False)

    def build(self, position, radius, width=0.0, active=None, cells=None):
        """Search all pairs closer than `radius`.

        Parameters
        ----------
        position : (n, 3) float64 [m]
            Particles that are in the order of the cells are searched much faster.
        radius : float [m]
        width : float [m]
            Period of the tank across (y); 0 when it is not periodic.
        active : (n,) bool, optional
            Particles that need a row; all by default.
        cells : mpslab.core.cells.Cells, optional
            Of the same period; by default those of a box around the particles.
        """
        if len(position) == 0:
            self.indptr, self.indices = np.zeros(1, np.int32), np.zeros(0, np.int32)
            return self
        active = np.ones(len(position), bool) if active is None else active
        if cells is None:
            cells = make_cells(position.min(axis=0), position.max(axis=0), radius, width)
        cell, start, count = cells.number(position)
        if kernels.ascend(cell):
            self._search(position, active, cells, start, count, radius)
            return self
        order = np.argsort(cell, kind="stable")
        self._search(position.take(order, 0), active.take(order), cells, start, count, radius)
        self._put_back(order)
        return self

    def _search(self, position, active, cells, start, count, radius):
        """Rows of particles in the order of the cells."""
        n, reach = len(position), cells.reach(radius)
        packed = np.zeros((3, n + ROOM))
        packed[:, :n] = position.T
        if cells.width > 0.0:
            packed[1] -= cells.width * np.floor(packed[1] / cells.width)
        beside = _beside(count[1], reach[1], cells.width > 0.0)
        self.indptr, begin = np.empty(n + 1, np.int32), np.empty(n, np.int32)
        while True:
            nearby = np.empty(self._scratch, np.int32)
            used = neighbors.search(
                packed, active.view(np.uint8), start, count, reach, beside, radius, cells.width,
                self.indptr, self._indices, nearby, np.zeros((3, self._scratch)), begin,
                np.empty_like(self._indices),
            )  # fmt: skip
            if used >= 0:
                break
            if used == -1:
                self._indices = np.empty(max(2 * len(self._indices), 32 * n), np.int32)
            else:
                self._scratch *= 2
        self.indices = self._indices[:used]

    def _put_back(self, order):
        """Give rows of particles sorted by cell, and their entries, the numbers of before."""
        row = order.repeat(np.diff(self.indptr))
        entry = order.take(self.indices).astype(np.int32)
        self.indices = entry[np.lexsort((entry, row))]
        lengths = np.bincount(row, minlength=len(order))
        self.indptr = np.append(0, np.cumsum(lengths)).astype(np.int32)


def _beside(count, reach, periodic):
    """Cells across the tank within a reach of each, ascending and then -1: (count, .) int32."""
    near = np.arange(count)[:, np.newaxis] + np.arange(-reach, reach + 1)
    if periodic and count > 2 * reach:
        return np.sort(near % count, axis=1).astype(np.int32)
    if periodic:
        return np.tile(np.arange(count, dtype=np.int32), (count, 1))
    inside = np.where((near >= 0) & (near < count), near, count)
    inside.sort(axis=1)
    return np.where(inside < count, inside, -1).astype(np.int32)
