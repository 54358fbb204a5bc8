"""The conjugate gradient method with a preconditioner."""

import math

import numpy as np

from mpslab.kernels.sparse import axpy, xpay
from mpslab.sparse import SolverReport


def conjugate_gradient(
    system, x, precondition, tolerance, max_iterations, replaced=0, deflation=None
):
    """Solve A x = b from the given x, in place.

    Parameters
    ----------
    system : mpslab.sparse.PressureSystem
    x : (m,) float64
        Start, and solution at the end.
    precondition : callable
        ``precondition(r, z)`` writes M^-1 r to z.
    tolerance : float
        Of |b - A x| / |b|.
    max_iterations : int
    replaced : int
        Handed through to the report.
    deflation : mpslab.deflation.Deflation, optional
        Takes the smooth part out of the residual; x gets it at the end.
    """
    dot = system.dot
    b_norm = math.sqrt(dot(system.right, system.right))
    if b_norm == 0.0:
        x[:] = 0.0
        return SolverReport(0, 0.0, True, replaced)
    q, z = np.zeros_like(x), np.empty_like(x)
    r = system.right - system.multiply(x, q)
    p, rho, iterations = np.zeros_like(x), 1.0, 0
    residual = math.sqrt(dot(r, r)) / b_norm
    deflate = deflation is not None and residual > tolerance
    if deflate:
        deflation.project(r)
        residual = math.sqrt(dot(r, r)) / b_norm
    while residual > tolerance and iterations < max_iterations:
        precondition(r, z)
        rho, rho_old = dot(r, z), rho
        xpay(z, rho / rho_old if iterations else 0.0, p)
        system.multiply(p, q)
        if deflate:
            deflation.project(q)
        curvature = dot(p, q)
        if rho == 0.0 or curvature == 0.0:
            break  # no direction is left to go: the run stops, for it did not converge
        alpha = rho / curvature
        axpy(alpha, p, x)
        axpy(-alpha, q, r)
        residual = math.sqrt(dot(r, r)) / b_norm
        iterations += 1
    if deflate:
        deflation.complete(x, system.right - system.multiply(x, q))
    return SolverReport(iterations, residual, residual <= tolerance, replaced)


def by_diagonal(system):
    """The preconditioner z = r / diag(A)."""

    def precondition(r, z):
        np.divide(r, system.diagonal, out=z)

    return precondition
