"""Deflation: the smooth part of the pressure, solved for at once.

What conjugate gradients are slow at is pressure that varies over many particles.  Its shape is
given by one number a group of neighbouring rows (Nicolaides 1987), and the system of these
numbers, Z^T A Z, is small enough for a direct solve in every iteration.
"""

import numpy as np

from mpslab.kernels import coarse, sparse

# What the factor of the band may cost at most: multiply-adds a row.  That is a hundredth of a step,
# but every rank does all of it, on 16 ranks a sixth.
WORK = 200
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
        self.system, merged = system, 1
        while True:  # the width of the band is only known with the couplings
            self.group, self.count = group_rows(system, merged)
            rows, half = self._couplings(system)
            if self.count * half**2 <= WORK * rows:
                break
            merged *= 2
        self._factor(half)

    def _couplings(self, system):
        """A Z; returns the rows of all ranks, and half the width of the band of Z^T A Z."""
        most = len(system) + len(system.value)
        self.start = np.zeros(len(system) + 1, np.int32)
        member, entry = np.empty(most, np.int32), np.empty(most)
        begin, end = system.own
        used, half = coarse.by_group(
            system.row, system.column, system.value, system.diagonal, self.group, begin, end,
            np.full(self.count, -1, np.int32), self.start, member, entry,
        )  # fmt: skip
        self.member, self.entry = member[:used], entry[:used]
        rows, halves = zip(*system.from_all((end - begin, half)), strict=True)
        return sum(rows), max(halves)

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


def group_rows(system, merged):
    """Group of each row, (m,) int32, the same numbers on every rank; and how many there are."""
    slab = np.repeat(np.arange(len(system.first) - 1), np.diff(system.first))
    key = keys(slab, system.cell, merged)
    begin, end = system.own
    groups, number = number_groups(system.from_all(np.unique(key[begin:end])))
    return number[np.searchsorted(groups, key)], len(groups)


def keys(slab, cell, merged):
    """A number for each slab and cell, (m,) int64.

    Parameters
    ----------
    slab : (m,) int
    cell : (m, 2) int
        Across the tank, and upwards.
    merged : int
        Cells that are taken together in either direction.
    """
    part = cell.astype(np.int64) // merged + SIDE // 2
    return (slab * SIDE + part[:, 0]) * SIDE + part[:, 1]


def number_groups(several):
    """Sorted keys of all groups, and the number of each, (groups,) int32.

    Groups are numbered slab by slab, in a slab layer by layer, and in a layer from both sides by
    turns, so that across a periodic tank first and last are near: the band is narrow.
    """
    groups = np.unique(np.concatenate(several))
    slab, aside, up = groups // SIDE**2, groups // SIDE % SIDE, groups % SIDE
    places, aside = np.unique(aside, return_inverse=True)
    aside = np.minimum(2 * aside, 2 * (len(places) - 1 - aside) + 1)
    number = np.empty(len(groups), np.int32)
    number[np.lexsort((aside, up, slab))] = np.arange(len(groups))
    return groups, number
