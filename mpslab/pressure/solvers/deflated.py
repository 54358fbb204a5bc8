"""Deflated conjugate gradients: the diagonal for what is rough, a coarse system for the rest."""

from mpslab.pressure.conjugate_gradient import by_diagonal, conjugate_gradient
from mpslab.pressure.deflation import Deflation

BY_SLAB = True


def solve(system, x, tolerance, max_iterations):
    """Solve A x = b with z = r / diag(A), smooth errors taken out; see
    :mod:`mpslab.pressure.solvers`.

    Nicolaides (1987); in the form DEF1 of Tang, Nabben, Vuik & Erlangga (2009).
    """
    system.prepared = system.prepared or Deflation(system, tolerance)
    return conjugate_gradient(
        system, x, by_diagonal(system), tolerance, max_iterations, deflation=system.prepared
    )
