"""Deflation: the smooth part of the pressure, solved for at once.

What conjugate gradients are slow at is pressure that varies over many particles.  Its shape is
given by one number a group of neighbouring rows (Nicolaides 1987), and the system of these
numbers, Z^T A Z, is small enough for a direct solve in every iteration.
"""

import numpy as np

from mpslab.kernels import coarse

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
        self.group, self.count, half = _group(system)
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

    def project(self, q):
        """q = q - A Z (Z^T A Z)^-1 Z^T q, in place: what is left has no sum in any group."""
        coarse.take_off(
            self.start, self.member, self.entry, self._solve(q), *self.system.own, q
        )

    def complete(self, x, r):
        """x = x + Z (Z^T A Z)^-1 Z^T r, in place: the smooth part for the residual r of x."""
        coarse.spread(self.group, self._solve(r), x)


def _group(system):
    """Group of each row, (m,) int32, how many there are, and the half width of their band.

    The same numbers on every rank.  Cells are merged until the factor of the band is cheap.
    """
    slab = np.repeat(np.arange(len(system.first) - 1), np.diff(system.first))
    merged, cell = 1, system.cell.astype(np.int64)
    begin, end = system.own
    rows = sum(system.from_all(end - begin))
    while True:
        part = cell // merged + SIDE // 2
        key = (slab * SIDE + part[:, 0]) * SIDE + part[:, 1]
        mine = np.unique(key[begin:end])
        groups = np.unique(np.concatenate(system.from_all(mine)))
        half = _half_width(np.bincount(groups // SIDE**2))
        if len(groups) * half**2 <= WORK * rows:
            return np.searchsorted(groups, key).astype(np.int32), len(groups), half
        merged *= 2


def _half_width(size):
    """Of the band, for so many groups in each slab: they meet those of their slab and the next."""
    return max((size + np.append(size[1:], 0)).max(initial=0) - 1, 0)
