"""Deflation: the smooth part of the pressure, solved for at once.

What conjugate gradients are slow at is pressure that varies over many particles.  Its shape is
given by one number a group of neighbouring rows (Nicolaides 1987), and the system of these
numbers, Z^T A Z, is small enough for a direct solve in every iteration.
"""

import numpy as np

from mpslab.kernels import coarse, sparse

# What the factor of the band may cost at most: multiply-adds a row, a tenth of a step.
WORK = 1000
# Cells across the tank in the number of a group; far more than there are.
SIDE = 1 << 20


class Deflation:
    """The coarse system of a pressure equation.

    Rows belong to a group if they are in the same slab, and in the same cell across it.

    Parameters
    ----------
    system : mpslab.sparse.PressureSystem

    Attributes
    ----------
    group : (m,) int32
        Group of each row.
    count : int
        Groups on all ranks.
    """

    def __init__(self, system):
        self.system = system
        slab = np.repeat(np.arange(len(system.first) - 1), np.diff(system.first))
        begin, end = system.own
        rows = sum(system.from_all(end - begin))
        self.group, of, half = group_rows(
            slab, system.cell, slice(begin, end), rows, system.from_all
        )
        self.count = len(of)
        self._couplings(system)
        self._factor(half)

    def _couplings(self, system):
        most = len(system) + len(system.value)
        self.start = np.zeros(len(system) + 1, np.int32)
        member, entry = np.empty(most, np.int32), np.empty(most)
        used = coarse.by_group(
            system.row, system.column, system.value, system.diagonal, self.group, *system.own,
            np.full(self.count, -1, np.int32), self.start, member, entry,
        )  # fmt: skip
        self.member, self.entry = member[:used], entry[:used]

    def _factor(self, half):
        self.band, self.inverse = np.zeros((self.count, half + 1)), np.empty(self.count)
        coarse.couple(
            self.start, self.member, self.entry, self.group, *self.system.own, self.band
        )
        self.band = self.system.collect(self.band)
        coarse.factorise(self.band, self.inverse)

    def _solve(self, r):
        """(Z^T A Z)^-1 Z^T r, a value for each group."""
        y = np.zeros(self.count)
        coarse.gather(self.group, r, *self.system.own, y)
        y = self.system.collect(y)
        coarse.substitute(self.band, self.inverse, y)
        return y

    def project(self, r):
        """r = r - A Z (Z^T A Z)^-1 Z^T r, in place: what is left has no sum in any group."""
        self._take_off(self._solve(r), r)

    def project_product(self, p, q):
        """`project` for q = A p; returns p . q of what is left, and ranks meet but once for both.

        p . A Z y is (Z^T q) . y.
        """
        both = np.zeros(self.count + len(self.system.first) - 1)
        coarse.gather(self.group, q, *self.system.own, both[: self.count])
        self.system.slab_dots(p, q, both[self.count :])
        both = self.system.collect(both)
        sums, y = both[: self.count], both[: self.count].copy()
        coarse.substitute(self.band, self.inverse, y)
        self._take_off(y, q)
        return sum(both[self.count :].tolist()) - sparse.dot(sums, y)

    def _take_off(self, y, q):
        coarse.take_off(self.start, self.member, self.entry, y, *self.system.own, q)

    def complete(self, x, r):
        """x = x + Z (Z^T A Z)^-1 Z^T r, in place: the smooth part for the residual r of x."""
        coarse.spread(self.group, self._solve(r), x)


def group_rows(slab, cell, own, rows, from_all):
    """Group of each row; cells are merged until the factor of the band is cheap.

    Parameters
    ----------
    slab : (m,) int
        Slab of each row.
    cell : (m, 2) int
        Cell across the tank of each row.
    own : slice
        The rows of this rank.
    rows : int
        Rows of all ranks.
    from_all : callable
        What each rank gives, a list.

    Returns
    -------
    group : (m,) int32
        The same numbers on every rank.
    of : (groups,) int
        Slab of each group.
    half : int
        Half width of the band of their couplings.
    """
    merged = 1
    while True:
        part = cell.astype(np.int64) // merged + SIDE // 2
        key = (slab * SIDE + part[:, 0]) * SIDE + part[:, 1]
        groups = np.unique(np.concatenate(from_all(np.unique(key[own]))))
        of = groups // SIDE**2
        half = _half_width(np.bincount(of))
        if len(groups) * half**2 <= WORK * rows:
            return np.searchsorted(groups, key).astype(np.int32), of, half
        merged *= 2


def _half_width(size):
    """Of the band, for so many groups in each slab: they meet those of their slab and the next."""
    return max((size + np.append(size[1:], 0)).max(initial=0) - 1, 0)
