"""The conjugate gradient method with a preconditioner."""

import math

import numpy as np

from mpslab.kernels.sparse import axpy, xpay
from mpslab.pressure.system import SolverReport


def conjugate_gradient(
    system, x, precondition, tolerance, max_iterations, replaced=0, deflation=None
):
    """Solve A x = b from the given x, in place.

    Parameters
    ----------
    system : mpslab.pressure.system.PressureSystem
    x : (m,) float64
        Start, and solution at the end.
    precondition : callable
        ``precondition(r, z)`` writes M^-1 r to z.
    tolerance : float
        Of |b - A x| / |b|.
    max_iterations : int
    replaced : int
        For the report.
    deflation : mpslab.pressure.deflation.Deflation, optional
        Takes the smooth part out of the residual; x gets it at the end.
    """
    dots = system.blocks.dots
    q, z, p = np.zeros_like(x), np.empty_like(x), np.zeros_like(x)
    r = system.right - system.multiply(x, q)
    b_norm, residual = map(math.sqrt, dots((system.right, system.right), (r, r)))
    if b_norm == 0.0:
        x[:] = 0.0
        return SolverReport(0, 0.0, True, replaced)
    deflate = deflation is not None and residual > tolerance * b_norm
    if deflate:
        deflation.project(r)
    iterations, beta = 0, 0.0
    precondition(r, z)
    rho, square = dots((r, z), (r, r))
    residual = math.sqrt(square) / b_norm
    while residual > tolerance and iterations < max_iterations:
        xpay(z, beta, p)
        system.multiply(p, q)
        curvature = deflation.project_product(p, q) if deflate else dots((p, q))[0]
        if rho == 0.0 or curvature == 0.0:
            break  # no direction is left to go: not converged, and the run stops
        alpha = rho / curvature
        axpy(alpha, p, x)
        axpy(-alpha, q, r)
        iterations += 1
        precondition(r, z)  # once more than needed at the end, so that both dots meet at once
        rho_old = rho
        rho, square = dots((r, z), (r, r))
        beta, residual = rho / rho_old, math.sqrt(square) / b_norm
    missed = 0.0
    if deflate:
        deflation.complete(x, system.right - system.multiply(x, q))
        missed = deflation.missed
    if missed > 0.0:  # the residual of x has a smooth part that r has not
        r = system.right - system.multiply(x, q)
        residual = math.sqrt(dots((r, r))[0]) / b_norm
    return SolverReport(iterations, residual, residual <= tolerance, replaced, missed)


def by_diagonal(system):
    """The preconditioner z = r / diag(A)."""

    def precondition(r, z):
        np.divide(r, system.diagonal, out=z)

    return precondition
