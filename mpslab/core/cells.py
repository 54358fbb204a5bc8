"""Cells: a grid over the tank, by which particles lie in memory and find their neighbours.

Particles that are near in the tank should be near in memory.  So they are sorted slab by slab, in
a slab cell by cell, and in a cell by gid.  The grid follows from the case: it is the same on any
number of ranks, and so is the order of the particles, and of all sums over them.
"""

from dataclasses import dataclass

import numpy as np

from mpslab.kernels import cells

PER_SLAB = 4  # along x; a power of two, so that a particle's slab follows from its cell exactly
# In radii.  To find the 37 particles that are near, the search looks at 250 with cells of a whole
# radius, at 145 with half a radius, and at 107 with a third, where most cells are empty.
WIDTH = 0.5
WIDER = 1.0 + 1e-9  # so that rounding never puts neighbours one cell too far apart
MOST = 2**24


@dataclass(frozen=True)
class Cells:
    """Equal boxes in rows along z, rows side by side along y, and these along x.

    The outermost cells have no outer end; in a periodic tank the last cell along y lies beside the
    first.

    Attributes
    ----------
    lower : (3,) float64 [m]
        Where the first cell begins.
    per : (3,) float64 [1/m]
        Cells per metre.
    count : (3,) int32
        Cells along x, y and z.
    width : float [m]
        Period across the tank (y), 0 when not periodic.
    """

    lower: np.ndarray
    per: np.ndarray
    count: np.ndarray
    width: float = 0.0

    def order(self, position, gid):
        """Particles cell by cell, and in a cell by gid, (n,) int32."""
        order = np.empty(len(position), np.int32)
        cell, start, _ = self.number(position)
        cells.sort(cell, gid, start, order)
        return order

    def number(self, position):
        """Cells of particles, counted in the least box of cells that holds them all.

        Returns
        -------
        cell : (n,) int32
            Cell of each particle.
        start : (cells + 1,) int32
            First particle of each cell, were they sorted.
        count : (3,) int32
            Cells of the box along x, y and z; along a period all of them.
        """
        cell, count = np.empty(len(position), np.int32), np.empty(3, np.int32)
        cells.assign(position, self.lower, self.per, self.count, self.width, cell, count)
        start = np.empty(int(count.prod()) + 1, np.int32)
        cells.count(cell, start)
        return cell, start, count

    def near(self, position, ones, others):
        """Those of the ones that may be within a radius of one of the others: masks (n,) bool.

        Looked at are blocks of 2 x 2 x 2 cells, which are a radius wide at least, and those beside
        them.  Across a periodic tank all of a row counts as one block.
        """
        blocks = (self.count + 1) // 2
        blocks[1] = 1 if self.width > 0.0 else blocks[1]
        marks, out = np.zeros(blocks, np.uint8), np.empty(len(position), np.uint8)
        grid = self.lower, self.per, self.count, blocks
        cells.mark(position, others.view(np.uint8), *grid, marks.ravel())
        for axis in range(3):
            line = marks.swapaxes(0, axis)
            before = line.copy()
            line[1:] |= before[:-1]
            line[:-1] |= before[1:]
        cells.marked(position, ones.view(np.uint8), *grid, marks.ravel(), out)
        return out.view(bool)

    def reach(self, radius):
        """How many cells away a neighbour within a radius [m] may be, along x, y and z: (3,)."""
        return np.ceil(radius * self.per).astype(np.int32)


def make_cells(lower, upper, radius, width=0.0, slabs=None):
    """Cells between two corners, each at least half as wide as the radius.

    Parameters
    ----------
    lower, upper : (3,) float [m]
    radius : float [m]
    width : float [m]
        Period across the tank, 0 when not periodic.
    slabs : mpslab.parallel.slabs.Slabs, optional
        The cells along x are parts of these.
    """
    lower, extent = np.array(lower, float), np.subtract(upper, lower)
    if width > 0.0:
        lower[1], extent[1] = 0.0, width
    count = np.fmin(np.fmax(extent / (WIDTH * radius * WIDER), 1.0), MOST).astype(np.int64)
    if slabs is not None:
        lower[0], count[0] = slabs.lower, slabs.count * PER_SLAB
    # Wider cells, rather than more than memory holds; along x they stay parts of slabs.
    free = np.array([slabs is None, True, True])
    while count.prod(dtype=float) > MOST and np.any(count[free] > 1):
        axis = np.argmax(count * free)
        count[axis] = (count[axis] + 1) // 2
    per = count / np.maximum(extent, radius)
    if slabs is not None:
        per[0] = PER_SLAB * slabs.per
    return Cells(lower, per, count.astype(np.int32), width)
