"""The rows of a system in blocks: which rank solves them, their exchange and their sums.

This is all that the pressure knows of ranks.
"""

import numpy as np

from mpslab.kernels import sparse


class Blocks:
    """Blocks of rows, of which some are solved here and others on the ranks that own them.

    Parameters
    ----------
    first : (blocks + 1,) int32
        First row of each block, and the number of rows.
    domain : mpslab.parallel.domain.Domain, optional
        Whose slabs the blocks are; without it all rows are solved here.

    Attributes
    ----------
    begin, end : int
        First block that is solved here, and the block after the last one.
    own : tuple of int
        First row that is solved here, and the row after the last one.
    """

    def __init__(self, first, domain=None):
        self.first, self.domain = np.asarray(first, np.int32), domain
        self.begin, self.end = (domain.begin, domain.end) if domain else (0, len(self))
        self.own = int(self.first[self.begin]), int(self.first[self.end])
        self._halo = domain.halo(self.first) if domain else ()

    def __len__(self):
        return len(self.first) - 1

    @property
    def of_rows(self):
        """Block of each row, (rows,) int32."""
        return np.repeat(np.arange(len(self), dtype=np.int32), np.diff(self.first))

    def of_other_rows(self, first):
        """The same blocks of other rows."""
        return Blocks(first, self.domain)

    def dots(self, *pairs):
        """x . y of each pair (x, y) over all ranks, which meet once for all of them."""
        sums = np.zeros((len(pairs), len(self)))
        for (x, y), into in zip(pairs, sums, strict=True):
            self.block_dots(x, y, into)
        return [sum(row) for row in self.collect(sums).tolist()]

    def block_dots(self, x, y, out):
        """out[b] = x . y in each block of this rank; their sum over b is the same on any ranks."""
        sparse.slab_dots(x, y, self.first, self.begin, self.end, out)

    def refresh(self, x):
        """Give the rows that are solved elsewhere, and seen here, the values they have there."""
        if self.domain:
            self.domain.exchange(self._halo, x)

    def collect(self, sums):
        """Sum over the ranks of arrays in which no two ranks give to the same entry."""
        return self.domain.collect(sums) if self.domain else sums

    def from_all(self, item):
        """What each rank gives, a list."""
        return self.domain.from_all(item) if self.domain else [item]
