"""Scaled conjugate gradients (SCG): the preconditioner is the diagonal."""

from mpslab.pressure.conjugate_gradient import by_diagonal, conjugate_gradient

BY_SLAB = True


def solve(system, x, tolerance, max_iterations):
    """Solve A x = b with z = r / diag(A); see :mod:`mpslab.pressure.solvers`."""
    return conjugate_gradient(system, x, by_diagonal(system), tolerance, max_iterations)
