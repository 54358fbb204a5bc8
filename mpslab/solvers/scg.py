"""Scaled conjugate gradients (SCG): the preconditioner is the diagonal."""

import numpy as np

from mpslab.conjugate_gradient import conjugate_gradient

BY_SLAB = True


def solve(system, x, tolerance, max_iterations):
    """Solve A x = b with z = r / diag(A); see :mod:`mpslab.solvers`."""

    def precondition(r, z):
        np.divide(r, system.diagonal, out=z)

    return conjugate_gradient(system, x, precondition, tolerance, max_iterations)
