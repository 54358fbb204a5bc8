"""From the pressure equation to what the pressure does, with the models of a flow."""

from dataclasses import replace

import numpy as np

from mpslab.models import copied, wall_pressure
from mpslab.pressure import equation


def solve(flow, system, rows, pull, solution=None, tolerance=0.0, least=None):
    """Solve for the pressure, and give the walls theirs; returns the solver's report.

    Parameters
    ----------
    solution : (m,) float64 [Pa], optional
        Where to start, and what was found, in place.
    tolerance : float
        Of the residual, if it is to be larger than that of the scheme.
    least : (n,) float64 [Pa], optional
        What a scheme that clips pressures clips them to, if not to 0.
    """
    particles, scheme = flow.particles, flow.case.scheme
    lower = least is not None and scheme.clip_pressure
    clip = scheme.clip_pressure and not lower
    report = equation.solve(
        system, rows, particles, flow.solver, max(tolerance, scheme.tolerance),
        scheme.max_iterations, clip, solution,
    )  # fmt: skip
    if lower:
        np.maximum(particles.pressure, least, out=particles.pressure)
    if flow.extrapolates:
        wall_pressure.fill(flow.near, flow.case.fluid.density, pull, clip)
        if lower:
            np.maximum(particles.pressure, least, out=particles.pressure)
        flow.domain.refresh(particles.pressure)
    return report


def push(flow, dt, particles=None):
    """What the pressure does in a step: the pairs of the gradient, loaded with it, and a function
    of a `Neighbourhood` that gives the change of velocity (n, 3) [m/s] of its particles.

    particles : ParticleSet, optional
        With another pressure than the flow's.
    """
    near, gradient = flow.near_gradient, flow.gradient.gradient
    near = near.of(particles) if particles else near
    if flow.copies:
        near.loaded = copied.fill(near)
        # The face that is nearest to a ghost may be on another rank alone.
        flow.domain.refresh(near.particles.pressure, near.loaded)
    if flow.exchanges and hasattr(flow.gradient, "as_pairs"):
        gradient, pressure = flow.gradient.as_pairs(near)
        near = near.of(replace(near.particles, pressure=pressure))

    def change(near):
        out = np.empty_like(near.particles.velocity)
        gradient(near, out)
        return (-dt / flow.case.fluid.density) * out

    return near, change
