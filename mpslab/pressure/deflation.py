"""Deflation: the smooth part of the pressure, solved for at once.

Conjugate gradients are slow where the pressure varies over many particles.  This smooth part is
given by one number for each group of neighbouring rows (Nicolaides 1987), and the system of these
numbers, Z^T A Z, is small.  It is solved directly in every iteration, or, where its factor would
cost too much, by conjugate gradients with a deflation of their own, whose groups are four of these.
"""

import numpy as np

from mpslab.kernels import coarse, sparse
from mpslab.pressure.conjugate_gradient import by_diagonal, conjugate_gradient
from mpslab.pressure.groups import SIDE, group_rows, narrow
from mpslab.pressure.system import PressureSystem

# What the factor of the band may cost at most, in multiply-adds for each row of the finest system.
# That is a hundredth of a step; but every rank does all of it, so on 16 ranks it is a sixth.
WORK = 200
# Of a coarse system that is solved by iterations: the residual to reach, as a share of that of the
# system above it (no iteration there takes out what it leaves), and the most iterations.
SHARPER, FINEST, MOST = 0.01, 1e-14, 200


class Deflation:
    """The coarse system of a pressure equation.

    Rows belong to a group if they are in the same slab, and in the same cell across it.

    Parameters
    ----------
    system : mpslab.pressure.system.PressureSystem
    tolerance : float
        Of the residual that it is to be solved to.
    merged : int
        Cells in either direction that are taken together.
    budget : float, optional
        Multiply-adds that a factor may cost.

    Attributes
    ----------
    group : (m,) int32
        Group of each row.
    groups : (count,) int64
        Keys of the groups of all ranks, in the order of their numbers.
    coarse : Band or Nested
        Solves for a value of each group.
    """

    def __init__(self, system, tolerance, merged=1, budget=None):
        self.system = system
        self.group, self.groups = group_rows(system, merged)
        rows, half = self._couplings(system)
        budget = WORK * rows if budget is None else budget
        if self.count * half**2 > budget:
            half = self._narrow(half, budget)
        if self.count * half**2 <= budget or self.count <= len(system.blocks):
            self.coarse = Band(self, half)
        else:
            self.coarse = Nested(self, max(SHARPER * tolerance, FINEST), budget)

    @property
    def count(self):
        """Groups on all ranks."""
        return len(self.groups)

    @property
    def missed(self):
        """Largest residual that a solve of the coarse system was left with, of those that did not
        converge; 0 if all did.
        """
        return self.coarse.missed

    def _couplings(self, system):
        """A Z; returns the rows of all ranks, and half the width of the band of Z^T A Z."""
        most = len(system) + len(system.value)
        self.start = np.zeros(len(system) + 1, np.int32)
        member, entry = np.empty(most, np.int32), np.empty(most)
        begin, end = system.blocks.own
        used, half = coarse.by_group(
            system.row, system.column, system.value, system.diagonal, self.group, begin, end,
            np.full(self.count, -1, np.int32), self.start, member, entry,
        )  # fmt: skip
        self.member, self.entry = member[:used], entry[:used]
        rows, halves = zip(*system.blocks.from_all((end - begin, half)), strict=True)
        return sum(rows), max(halves)

    def _narrow(self, half, budget):
        """Number the groups in another way, if that makes a band cheap; returns half its width.

        Where water is thrown up, the few slabs that have many groups make the band of all as wide.
        """
        number, (begin, end) = narrow(self.groups), self.system.blocks.own
        own = np.repeat(self.group[begin:end], np.diff(self.start[begin : end + 1]))
        far = np.abs(number[self.member] - number[own]).max(initial=0)
        narrower = max(self.system.blocks.from_all(int(far)))
        if self.count * narrower**2 > budget:
            return half
        groups = np.empty_like(self.groups)
        groups[number] = self.groups
        self.group, self.groups, self.member = number[self.group], groups, number[self.member]
        return narrower

    def _sums(self, r):
        """Z^T r of this rank's rows, (groups,)."""
        sums = np.zeros(self.count)
        coarse.gather(self.group, r, *self.system.blocks.own, sums)
        return sums

    def project(self, r):
        """r = r - A Z (Z^T A Z)^-1 Z^T r, in place: what is left has no sum in any group."""
        self._take_off(self.coarse.solve(self._sums(r)), r)

    def project_product(self, p, q):
        """`project` for q = A p; returns p . q of what is left.

        p . A Z y is (Z^T q) . y.
        """
        by_block = np.zeros(len(self.system.blocks))
        self.system.blocks.block_dots(p, q, by_block)
        y, product = self.coarse.solve_and_dot(self._sums(q), by_block)
        self._take_off(y, q)
        return product

    def _take_off(self, y, q):
        coarse.take_off(self.start, self.member, self.entry, y, *self.system.blocks.own, q)

    def complete(self, x, r):
        """x = x + Z (Z^T A Z)^-1 Z^T r, in place: the smooth part for the residual r of x."""
        coarse.spread(self.group, self.coarse.solve(self._sums(r)), x)


class Band:
    """Z^T A Z as a band, which every rank factors; half of it is as wide as `half` groups."""

    missed = 0.0

    def __init__(self, deflation, half):
        self.system = system = deflation.system
        self.band, self.inverse = np.zeros((deflation.count, half + 1)), np.empty(deflation.count)
        coarse.couple(
            deflation.start, deflation.member, deflation.entry, deflation.group, *system.blocks.own,
            self.band,
        )  # fmt: skip
        self.band = system.blocks.collect(self.band)
        coarse.factorise(self.band, self.inverse)

    def solve(self, sums):
        """(Z^T A Z)^-1 of the sums that the ranks have, a value for each group."""
        y = self.system.blocks.collect(sums).copy()
        coarse.substitute(self.band, self.inverse, y)
        return y

    def solve_and_dot(self, sums, by_block):
        """`solve`, and the sum of by_block less sums . y; ranks meet only once for both."""
        both = self.system.blocks.collect(np.concatenate([sums, by_block]))
        sums, y = both[: len(sums)], both[: len(sums)].copy()
        coarse.substitute(self.band, self.inverse, y)
        return y, sum(both[len(sums) :].tolist()) - sparse.dot(sums, y)


class Nested:
    """Z^T A Z as a system whose rows the ranks share out slab by slab, as those of A."""

    def __init__(self, deflation, tolerance, budget):
        self.tolerance, self.missed = tolerance, 0.0
        above, count = deflation.system.blocks, deflation.count
        slab = deflation.groups // SIDE**2
        blocks = above.of_other_rows(np.searchsorted(slab, np.arange(len(above) + 1)))
        own = slice(*above.own)
        rows = np.argsort(deflation.group[own], kind="stable") + own.start
        size = np.bincount(deflation.group[own], minlength=count)
        row, diagonal = np.zeros(count + 1, np.int32), np.zeros(count)
        column = np.empty(len(deflation.member), np.int32)
        value = np.empty(len(deflation.member))
        entries = coarse.condense(
            deflation.start, deflation.member, deflation.entry, rows.astype(np.int32),
            np.concatenate([[0], np.cumsum(size)]).astype(np.int32), *blocks.own,
            np.full(count, -1, np.int32), row, column, value, diagonal,
        )  # fmt: skip
        cell = np.column_stack([deflation.groups // SIDE % SIDE, deflation.groups % SIDE])
        self.system = PressureSystem(
            row, column[:entries], value[:entries], diagonal, np.zeros(count),
            blocks, (cell - cell.min(axis=0, initial=SIDE)).astype(np.int32),
        )  # fmt: skip
        blocks.refresh(diagonal)
        diagonal[diagonal == 0.0] = 1.0  # of groups that no row here is coupled to
        self.deflation = Deflation(self.system, tolerance, 2, budget)

    def solve(self, sums):
        """(Z^T A Z)^-1 of the sums of this rank's groups: a value for each of them and of its
        ghosts.
        """
        system, y = self.system, np.zeros(len(sums))
        system.right = sums
        report = conjugate_gradient(
            system, y, by_diagonal(system), self.tolerance, MOST, deflation=self.deflation
        )
        if not report.converged:
            self.missed = max(self.missed, report.residual)
        system.blocks.refresh(y)
        return y

    def solve_and_dot(self, sums, by_block):
        """`solve`, and the sum of by_block less sums . y."""
        y, dots = self.solve(sums), np.zeros_like(by_block)
        self.system.blocks.block_dots(sums, y, dots)
        return y, sum(self.system.blocks.collect(by_block - dots).tolist())
