"""One time step of the semi-implicit particle method."""

from dataclasses import dataclass, field
from types import ModuleType

import numpy as np

from mpslab import plugins, pressure
from mpslab.kernels import density, viscosity
from mpslab.neighbors import NeighborList
from mpslab.particles import ParticleSet
from mpslab.piston import Piston
from mpslab.stencil import Stencil, make_stencil
from mpslab.stopwatch import Stopwatch
from mpslab.surface import mark_surface


@dataclass
class Flow:
    """All that a time step works on.

    Attributes
    ----------
    case : mpslab.parameters.Case
    particles : ParticleSet
    piston : Piston
    stencil, laplacian_stencil : Stencil
        Of gradient and number density, and of the Laplacian.
    neighbors : NeighborList
        At the last predicted positions.
    time : float [s]
    """

    case: object
    particles: ParticleSet
    piston: Piston
    stencil: Stencil
    laplacian_stencil: Stencil
    gradient: ModuleType
    source: ModuleType
    solver: ModuleType
    pair_terms: tuple
    stabilisers: tuple
    neighbors: NeighborList = field(default_factory=NeighborList)
    stopwatch: Stopwatch = field(default_factory=Stopwatch)
    time: float = 0.0


def make_flow(case, particles, piston, width):
    """Load the models that a case names.

    Parameters
    ----------
    width : float [m]
        Period across the tank, 0 when not periodic.
    """
    scheme, spacing = case.scheme, case.particles.spacing
    dim = 2 if case.tank.width == 0.0 else 3
    laplacian_stencil = make_stencil(dim, spacing, scheme.laplacian_radius, width)
    return Flow(
        case=case,
        particles=particles,
        piston=piston,
        stencil=make_stencil(dim, spacing, scheme.effective_radius, width),
        laplacian_stencil=laplacian_stencil,
        gradient=plugins.load("gradients", scheme.gradient),
        source=plugins.load("sources", scheme.source),
        solver=plugins.load("solvers", scheme.solver),
        pair_terms=plugins.load("laplacians", scheme.laplacian).pair_terms(laplacian_stencil),
        stabilisers=tuple(plugins.load("stabilisers", name) for name in scheme.stabiliser),
    )


def advance(flow, dt):
    """Advance the flow by one time step dt [s]; returns the solver's report.

    Predict with gravity and viscosity, solve for the pressure that keeps the number density,
    correct with its gradient (equations 1 to 4 of the paper).  One neighbour list serves the
    whole step: viscosity, too, is evaluated at the predicted positions.
    """
    particles, watch = flow.particles, flow.stopwatch
    _predict(flow, dt)
    with watch.phase("neighbours"):
        _find_neighbors(flow)
    with watch.phase("operators"):
        _add_viscosity(flow, dt)
        _stabilise(flow, "predicted", particles.position, dt)
        _update_density(flow)
    with watch.phase("assembly"):
        system, rows = _assemble(flow, dt)
    with watch.phase("solve"):
        scheme = flow.case.scheme
        report = pressure.solve(
            system, rows, particles, flow.solver, scheme.tolerance, scheme.max_iterations,
            scheme.clip_pressure,
        )  # fmt: skip
    with watch.phase("operators"):
        _correct(flow, dt)
    flow.time += dt
    return report


def _predict(flow, dt):
    """u' = u + g dt and r* = r + u' dt for the water; the piston takes its next place."""
    particles = flow.particles
    flow.piston.move(particles, flow.time, dt)
    fluid = particles.fluid
    particles.velocity[fluid, 2] -= flow.case.fluid.gravity * dt
    particles.position[fluid] += dt * particles.velocity[fluid]


def _find_neighbors(flow):
    radius = max(flow.stencil.radius, flow.laplacian_stencil.radius)
    active = flow.particles.carries_pressure
    flow.neighbors.build(flow.particles.position, radius, flow.stencil.width, active)


def _add_viscosity(flow, dt):
    """u* = u' + nu <lap u> dt; its share of r* is of second order in dt and left out."""
    particles, case = flow.particles, flow.case
    if case.fluid.viscosity == 0.0:
        return
    acceleration = np.zeros_like(particles.velocity)
    viscosity.viscous_acceleration(
        particles.position, particles.velocity, particles.kind, flow.neighbors.indptr,
        flow.neighbors.indices, flow.laplacian_stencil, case.fluid.viscosity,
        case.scheme.wall_slip, acceleration,
    )  # fmt: skip
    particles.velocity += dt * acceleration


def _update_density(flow):
    particles, neighbors = flow.particles, flow.neighbors
    density.number_density(
        particles.position, neighbors.indptr, neighbors.indices, flow.stencil,
        particles.number_density,
    )  # fmt: skip
    mark_surface(particles, neighbors, flow.stencil, flow.case.scheme.surface_threshold)


def _assemble(flow, dt):
    particles, neighbors = flow.particles, flow.neighbors
    right = np.empty(len(particles))
    flow.source.source(
        particles.position, particles.velocity, particles.number_density, neighbors.indptr,
        neighbors.indices, flow.stencil, dt, flow.case.scheme, right,
    )  # fmt: skip
    return pressure.assemble(
        particles, neighbors, flow.laplacian_stencil, flow.pair_terms, flow.case.fluid.density,
        right,
    )  # fmt: skip


def _correct(flow, dt):
    """u = u* - (dt/rho) grad p and r = r* + dt (u - u*), then keep the particles in order."""
    particles, neighbors = flow.particles, flow.neighbors
    before = particles.position.copy()
    change = np.zeros_like(particles.velocity)
    flow.gradient.gradient(
        particles.position, particles.pressure, particles.kind, neighbors.indptr,
        neighbors.indices, flow.stencil, change,
    )  # fmt: skip
    change *= -dt / flow.case.fluid.density
    particles.velocity += change
    particles.position += dt * change
    _stabilise(flow, "corrected", before, dt)
    if flow.stencil.width > 0.0:
        particles.position[:, 1] %= flow.stencil.width


def _stabilise(flow, stage, before, dt):
    for model in flow.stabilisers:
        if stage == model.STAGE:
            model.stabilise(
                flow.particles, before, flow.neighbors, flow.stencil, dt, flow.case.scheme
            )
