"""Conjugate gradients with an incomplete Cholesky factor in red-black order of slabs (PICCG-RP)."""

import numpy as np

from mpslab.kernels import coloured
from mpslab.pressure.conjugate_gradient import conjugate_gradient

BY_SLAB = True
NEEDS_GHOST_ROWS = True  # of the slabs beside its own, for its part of the factor
RED, BLACK = 0, 1


def solve(system, x, tolerance, max_iterations):
    """Solve A x = b with A ~ (I + L) D (I + L)^T, no fill; see :mod:`mpslab.pressure.solvers`.

    ICCG made parallel by renumbering (section 4 of the paper; Iwashita & Shimasaki 2000): all red
    slabs come before all black ones.  Slabs of one colour do not touch, so each substitution
    needs the neighbouring ranks once, between the colours.
    """
    factor = Factor(system)
    return conjugate_gradient(
        system, x, factor.substitute, tolerance, max_iterations, factor.replaced
    )


class Factor:
    """Incomplete factor of the whole matrix: no coupling between slabs or ranks is dropped."""

    def __init__(self, system):
        system.sort_rows()
        m, entries = len(system), len(system.value)
        self.blocks = blocks = system.blocks
        self.lower, self.middle = np.empty(m + 1, np.int32), np.empty(m, np.int32)
        left, factor = np.empty(entries, np.int32), np.empty(entries)
        used = coloured.split(
            system.row, system.column, system.value, blocks.of_rows, self.lower, self.middle, left,
            factor,
        )
        self.left, self.factor = left[:used], factor[:used]
        self.pivot = np.empty(m)
        self.replaced = coloured.factorise(
            blocks.first, blocks.begin, blocks.end, self.lower, self.middle, self.left,
            system.diagonal, self.factor, self.pivot, np.zeros(m),
        )  # fmt: skip

    def substitute(self, r, z):
        """z = M^-1 r: forward through red and black, backward through black and red."""
        self._forward(RED, r, z)
        self.blocks.refresh(z)
        self._forward(BLACK, r, z)
        own = slice(*self.blocks.own)  # the others come with the next refresh
        z[own] *= self.pivot[own]
        self._backward(BLACK, z)
        self.blocks.refresh(z)
        coloured.hand_back(
            self.blocks.first, self.lower, self.middle, self.left, self.factor, z
        )
        self._backward(RED, z)

    def _forward(self, colour, r, z):
        b = self.blocks
        coloured.forward(
            colour, b.first, b.begin, b.end, self.lower, self.left, self.factor, r, z
        )

    def _backward(self, colour, z):
        b = self.blocks
        coloured.backward(
            colour, b.first, b.begin, b.end, self.lower, self.middle, self.left, self.factor, z
        )
