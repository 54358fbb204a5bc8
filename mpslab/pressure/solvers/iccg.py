"""Conjugate gradients with an incomplete Cholesky factor (ICCG), in the order of the particles."""

import numpy as np

from mpslab.kernels import sparse
from mpslab.pressure.conjugate_gradient import conjugate_gradient

BY_SLAB = False  # each row waits for the one before it: on one rank only


def solve(system, x, tolerance, max_iterations):
    """Solve A x = b with A ~ (I + L) D (I + L)^T, no fill; see :mod:`mpslab.pressure.solvers`."""
    system.sort_rows()
    m = len(system)
    end, work = np.empty(m, np.int32), np.zeros(m)
    factor, pivot = np.empty(len(system.value)), np.empty(m)
    sparse.lower_ends(system.row, system.column, end)
    replaced = sparse.factorise(
        system.row, system.column, system.value, system.diagonal, end, factor, pivot, work
    )

    def precondition(r, z):
        sparse.substitute(system.row, system.column, end, factor, pivot, r, z)

    return conjugate_gradient(system, x, precondition, tolerance, max_iterations, replaced)
