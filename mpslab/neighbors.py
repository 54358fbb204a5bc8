"""Neighbour lists in compressed rows."""

from dataclasses import dataclass, field

import numpy as np

from mpslab.kernels import cells, neighbors

MOST_CELLS = 2**24


def _cell_grid(lower, upper, radius, width):
    """Number and size of the cells along x, y and z; each is at least as wide as the radius."""
    extent = np.maximum(upper - lower, radius)
    if width > 0.0:
        extent[1] = width
    count = np.maximum(np.fmin(extent / radius, MOST_CELLS).astype(np.int64), 1)
    # A runaway particle stretches the grid: wider cells, rather than more than memory holds.
    while count.prod(dtype=float) > MOST_CELLS:
        count[np.argmax(count)] //= 2
    if width > 0.0 and count[1] < 3:
        # With two cells around, the one to the left is the one to the right.
        count[1] = 1
    return count.astype(np.int32), extent / count


@dataclass
class NeighborList:
    """Neighbours of each active particle within a radius, as compressed sparse rows.

    Attributes
    ----------
    indptr : (n + 1,) int32
        Row i is ``indices[indptr[i]:indptr[i + 1]]``; rows of inactive particles are empty.
    indices : (m,) int32
        Neighbours of a row in the order of their gid, the particle itself left out; once the pairs
        are measured (`mpslab.core.neighbourhood`), water before solids.
    """

    indptr: np.ndarray = field(default_factory=lambda: np.zeros(1, np.int32))
    indices: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    _found: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32), repr=False)
    _indices: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32), repr=False)

    def build(self, position, radius, width=0.0, active=None, order=None):
        """Search all pairs closer than `radius`.

        Parameters
        ----------
        position : (n, 3) float64 [m]
        radius : float [m]
        width : float [m]
            Period of the tank across (y); 0 when it is not periodic.
        active : (n,) bool, optional
            Particles that need a row; all by default.
        order : (n,) int32, optional
            Particles in the order of their gid; by default they are stored in that order.
        """
        n = len(position)
        if n == 0:
            self.indptr, self.indices = np.zeros(1, np.int32), np.zeros(0, np.int32)
            return self
        active = np.ones(n, np.uint8) if active is None else active.astype(np.uint8)
        order = np.arange(n, dtype=np.int32) if order is None else order
        lower = position.min(axis=0)
        if width > 0.0:
            lower[1] = 0.0
        count, size = _cell_grid(lower, position.max(axis=0), radius, width)
        start, member = self._sort(_folded(position, width), lower, size, count)
        first, used = self._search(position, member, active, start, count, radius, width)
        self._transpose(member, order, first, used)
        return self

    @staticmethod
    def _sort(position, lower, size, count):
        cell = np.empty(len(position), np.int32)
        cells.assign(position, lower, size, count, cell)
        start = np.empty(int(count.prod()) + 1, np.int32)
        member = np.empty(len(position), np.int32)
        cells.sort(cell, start, member)
        return start, member

    def _search(self, position, member, active, start, count, radius, width):
        packed = np.ascontiguousarray(position.take(member, 0).T)
        first = np.empty(len(member) + 1, np.int32)
        scratch = _most_candidates(start, count)
        nearby, block = np.empty(scratch, np.int32), np.empty((4, scratch))
        while True:
            used = neighbors.search(packed, member, active[member], start, count, radius,
                                    width, first, self._found, nearby, block)
            if used >= 0:
                return first, used
            self._found = np.empty(max(2 * len(self._found), 64 * len(member), scratch), np.int32)

    def _transpose(self, member, order, first, used):
        place_of = np.empty_like(member)
        place_of[member] = np.arange(len(member), dtype=np.int32)
        if len(self._indices) < used:
            self._indices = np.empty(int(1.2 * used) + 1, np.int32)
        self.indptr = np.empty(len(member) + 1, np.int32)
        self.indices = self._indices[:used]
        neighbors.transpose(order, place_of, first, self._found, self.indptr, self.indices)


def _folded(position, width):
    """Positions with y brought back into the period."""
    if width == 0.0:
        return position
    folded = position.copy()
    folded[:, 1] %= width
    return folded


def _most_candidates(start, count):
    """Upper bound of the particles in a block of 3 x 3 x 3 cells."""
    inside = np.diff(start).reshape(count).astype(np.int64)
    for axis in range(3):
        padded = np.concatenate([inside.take([-1], axis), inside, inside.take([0], axis)], axis)
        n = inside.shape[axis]
        inside = sum(np.take(padded, range(s, s + n), axis) for s in range(3))
    return int(inside.max()) + 1
