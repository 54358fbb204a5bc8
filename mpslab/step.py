"""One time step of the semi-implicit particle method."""

import math
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np

from mpslab import correction, friction, gates, geometry, plugins, pressure, surface, walls
from mpslab.domain import Domain
from mpslab.kernels import density
from mpslab.neighbors import NeighborList
from mpslab.particles import ParticleSet, on_axes
from mpslab.piston import Piston
from mpslab.slabs import make_slabs
from mpslab.stencil import Stencil, make_stencil

LAYERS = 20  # of water, up to which the weight of a density error does not depend on them
WAKING = 2.0  # sqrt(depth / gravity): in this time the density begins to count


@dataclass
class Flow:
    """All that a time step works on.

    Attributes
    ----------
    case : mpslab.parameters.Case
    particles : ParticleSet
        Those that this rank owns; within a step also its ghosts.
    piston : Piston
    stencil, laplacian_stencil : Stencil
        Of gradient and number density, and of the Laplacian.
    domain : Domain
    neighbors : NeighborList
        Where the pressure acted last.
    correction : (n, 6) float64 or None
        Matrices of `mpslab.correction` there, where a model needs them.
    time : float [s]
    done : dict
        What the loop says of the last step, for the table of steps; empty before the first.
    readings : dict of str to float
        What the gauges read last, by name [m], for what moves by it.
    reaction : mpslab.reaction.Reaction or None
        Adds up what solids give the water, where somebody asks for it.
    """

    case: object
    particles: ParticleSet
    piston: Piston
    stencil: Stencil
    laplacian_stencil: Stencil
    domain: Domain
    gradient: ModuleType
    source: ModuleType
    solver: ModuleType
    pair_terms: tuple
    stabilisers: tuple
    neighbors: NeighborList = field(default_factory=NeighborList)
    correction: np.ndarray | None = None
    time: float = 0.0
    done: dict = field(default_factory=dict)
    readings: dict = field(default_factory=dict)
    reaction: object = None

    @property
    def stopwatch(self):
        """That of the domain, which counts communication and waiting."""
        return self.domain.stopwatch

    @property
    def extrapolates(self):
        """Whether the walls take their pressure from the water in front of them."""
        return self.case.scheme.walls == "extrapolated"

    @property
    def unknowns(self):
        """Mask of the particles whose pressure is an unknown of the equation, (n,) bool."""
        return self.particles.fluid if self.extrapolates else self.particles.carries_pressure

    @property
    def needs_correction(self):
        """Whether a model works with the correction matrices."""
        models = (self.gradient, self.source, *self.stabilisers)
        wanted = any(getattr(model, "NEEDS_CORRECTION", False) for model in models)
        return wanted or self.case.scheme.smagorinsky > 0.0


def make_flow(case, particles, piston, width, comm=None):
    """Load the models that a case names.

    Parameters
    ----------
    particles : ParticleSet
        All particles of the tank, on rank 0; the flow keeps those of this rank.
    piston : Piston
        Of these particles, on rank 0; all ranks get it.
    width : float [m]
        Period across the tank, 0 when not periodic.
    comm : communicator, optional
        As for `mpslab.domain.Domain`.

    Raises
    ------
    ValueError
        If the models, or the tank, cannot be shared out among so many ranks.
    """
    scheme, spacing = case.scheme, case.particles.spacing
    dim = 2 if case.tank.width == 0.0 else 3
    stencil = make_stencil(dim, spacing, scheme.effective_radius, width)
    laplacian_stencil = make_stencil(dim, spacing, scheme.laplacian_radius, width)
    domain = Domain(slabs_of(case, piston.paddle), comm)
    solver = solver_of(case, domain.size)
    piston.share_out(domain.comm)
    return Flow(
        case=case,
        particles=domain.take_part(particles, case.parallel.balance),
        piston=piston,
        stencil=stencil,
        laplacian_stencil=laplacian_stencil,
        domain=domain,
        gradient=plugins.load("gradients", scheme.gradient),
        source=plugins.load("sources", scheme.source),
        solver=solver,
        pair_terms=plugins.load("laplacians", scheme.laplacian).pair_terms(laplacian_stencil),
        stabilisers=tuple(plugins.load("stabilisers", name) for name in scheme.stabiliser),
    )


def slabs_of(case, paddle):
    """The slabs of the tank of a case with a paddle, None for a fixed wall."""
    scheme, spacing = case.scheme, case.particles.spacing
    radius = max(scheme.effective_radius, scheme.laplacian_radius) * spacing
    return make_slabs(*geometry.extent(case, paddle.backmost if paddle else 0.0), radius)


def solver_of(case, ranks):
    """The solver that a case names; ValueError if it cannot work on so many ranks."""
    solver = plugins.load("solvers", case.scheme.solver)
    if ranks > 1 and not solver.BY_SLAB:
        raise ValueError(
            f'scheme.solver = "{case.scheme.solver}": runs on one rank only; on {ranks} ranks '
            'choose "deflated", "piccg" or "scg"'
        )
    return solver


def density_rate(case, time):
    """At which rate the mixed sources take back an error of the number density [1/s].

    ``scheme.gamma`` is its share in a largest step, up to 20 layers of water; of more layers it
    is less, so that the time is always the same part of that of a wave across the depth: under
    the weight of the layers, a change of rate needs a pressure that grows with their square.
    For the same reason it begins with nothing, and is whole after the time that a wave takes for
    twice the depth: at once, it would give the water at rest a blow of several times its weight.
    """
    layers = case.tank.deepest / case.particles.spacing if case.fluid.gravity else 0.0
    rate = case.scheme.gamma * LAYERS / max(layers, LAYERS) / case.time.maximum
    waking = WAKING * math.sqrt(case.tank.deepest / case.fluid.gravity) if layers else 0.0
    s = min(time / waking, 1.0) if waking else 1.0
    return rate * s * s * (3.0 - 2.0 * s)


def advance(flow, dt):
    """Advance the flow by one time step dt [s]; returns the solver's report.

    Predict with gravity and viscosity, solve for the pressure that keeps the number density,
    correct with its gradient (equations 1 to 4 of the paper).  One neighbour list serves the
    whole step: viscosity, too, is evaluated where the pressure acts.
    """
    watch, domain = flow.stopwatch, flow.domain
    start, before = flow.particles.position.copy(), flow.particles.velocity.copy()
    _predict(flow, dt)
    with watch.phase("ghosts"):
        flow.particles, (start, before) = domain.share_out(flow.particles, start, before)
    particles, reaction = flow.particles, flow.reaction
    if reaction:
        reaction.begin(particles, before)
    with watch.phase("neighbours"):
        find_neighbors(flow)
        if reaction:
            reaction.find(particles, flow.neighbors)
    with watch.phase("operators"):
        if flow.needs_correction:
            flow.correction = correction.matrices(particles, flow.neighbors, flow.stencil)
        _add_viscosity(flow, dt)
        _stabilise(flow, "predicted", particles.position, dt)
        graded = find_surface(flow)
    pull = walls.pull(particles, before, flow.case.fluid.gravity, dt)
    with watch.phase("assembly"):
        system, rows = _assemble(flow, graded, pull, dt)
    with watch.phase("solve"):
        report = _solve(flow, system, rows, pull)
    with watch.phase("operators"):
        _correct(flow, start, dt)
        if reaction:
            reaction.end(flow, dt)
    flow.particles = domain.without_ghosts(particles)
    flow.time += dt
    return report


def _predict(flow, dt):
    """u' = u + g dt; with projection "predicted" also r* = r + u' dt, and the piston's new place.

    The projection decides the damping.  In a wave of frequency w the pressure at r* takes away
    (w dt)^2/2 of the amplitude in each step; at the positions of the start it takes nothing.
    """
    particles = flow.particles
    flow.piston.push(particles, flow.time, dt)
    gates.push(flow.case, particles, flow.time, dt)
    particles.velocity[:, 2] -= flow.case.fluid.gravity * dt * particles.fluid
    if flow.case.scheme.projection == "predicted":
        particles.position += dt * particles.velocity * on_axes(particles.fluid)
        _move_solids(flow, dt)


def _move_solids(flow, dt):
    flow.piston.move(flow.particles, flow.time + dt)
    gates.move(flow.case, flow.particles, flow.time, dt)


def find_neighbors(flow):
    """The neighbour list of the particles as they are; of ghosts only those next to the border."""
    radius = max(flow.stencil.radius, flow.laplacian_stencil.radius)
    particles = flow.particles
    active = flow.unknowns
    if not getattr(flow.solver, "NEEDS_GHOST_ROWS", False):
        active &= flow.domain.within_reach(particles.position[:, 0], radius)
    flow.neighbors.build(particles.position, radius, flow.stencil.width, active)


def _add_viscosity(flow, dt):
    """u* = u' + nu <lap u> dt; its share of r* is of second order in dt and left out."""
    fluid, scheme = flow.case.fluid, flow.case.scheme
    if fluid.viscosity == scheme.smagorinsky == 0.0:
        return
    particles, stencil = flow.particles, flow.laplacian_stencil
    eddy = friction.eddies(
        particles, flow.neighbors, flow.stencil, flow.correction, scheme, flow.domain.refresh
    )

    def change(pairs):
        return dt * friction.acceleration(particles, pairs, stencil, eddy, fluid, scheme)

    if flow.reaction and not scheme.wall_slip:
        flow.reaction.add(change)
    particles.velocity += change(flow.neighbors)


def find_surface(flow):
    """Number density and surface; the grade of the surface where the scheme asks for it."""
    particles, neighbors = flow.particles, flow.neighbors
    density.number_density(
        particles.position, neighbors.indptr, neighbors.indices, flow.stencil,
        particles.number_density,
    )  # fmt: skip
    graded, scheme = None, flow.case.scheme
    if scheme.surface == "graded":
        graded = surface.grade_surface(particles, neighbors, flow.stencil)
    else:
        surface.mark_surface(
            particles, neighbors, flow.stencil, scheme.surface_threshold, flow.unknowns
        )
    flow.domain.refresh(particles.surface)
    return graded


def _assemble(flow, graded, pull, dt):
    particles, neighbors, rho = flow.particles, flow.neighbors, flow.case.fluid.density
    stencil, terms = flow.laplacian_stencil, flow.pair_terms
    velocity, n = particles.velocity, particles.number_density
    role = towards_zero = None
    if flow.extrapolates:
        velocity = walls.predicted_velocity(particles, pull, dt)
        role = walls.outside_system(particles)
    if graded is not None:
        towards_zero = surface.surface_pull(
            particles, graded, flow.stencil, stencil, terms, rho
        )
        n = surface.filled_density(n, graded, flow.stencil)
    right = np.empty(len(particles))
    flow.source.source(
        particles.position, velocity, particles.role, n, neighbors.indptr, neighbors.indices,
        flow.stencil, flow.correction, dt, density_rate(flow.case, flow.time),
        flow.case.scheme, right,
    )  # fmt: skip
    if flow.extrapolates:
        right += walls.flux(particles, neighbors, stencil, terms, pull)
    domain = flow.domain if flow.solver.BY_SLAB else None
    return pressure.assemble(
        particles, neighbors, stencil, terms, rho, right, role, towards_zero, domain
    )


def _solve(flow, system, rows, pull):
    particles, scheme = flow.particles, flow.case.scheme
    report = pressure.solve(
        system, rows, particles, flow.solver, scheme.tolerance, scheme.max_iterations,
        scheme.clip_pressure,
    )  # fmt: skip
    if flow.extrapolates:
        walls.fill(
            particles, flow.neighbors, flow.stencil, flow.case.fluid.density, pull,
            scheme.clip_pressure,
        )  # fmt: skip
        flow.domain.refresh(particles.pressure)
    return report


def _correct(flow, start, dt):
    """u = u* - (dt/rho) grad p and r = start + u dt, then keep the particles in order."""
    particles = flow.particles
    before = particles.position.copy()
    _press(flow, dt)
    moved = start + dt * particles.velocity
    np.copyto(particles.position, moved, where=on_axes(particles.fluid))
    if flow.case.scheme.projection == "start":
        _move_solids(flow, dt)
    _stabilise(flow, "corrected", before, dt)
    if flow.stencil.width > 0.0:
        particles.position[:, 1] %= flow.stencil.width


def _press(flow, dt):
    """u = u* - (dt/rho) grad p."""
    particles, stencil = flow.particles, flow.stencil
    role = walls.with_pressure(particles) if flow.extrapolates else particles.role
    gradient, pressure = flow.gradient.gradient, particles.pressure

    def change(pairs):
        out = np.zeros_like(particles.velocity)
        gradient(particles.position, pressure, role, pairs.indptr, pairs.indices, stencil,
                 flow.correction, out)  # fmt: skip
        return (-dt / flow.case.fluid.density) * out

    by_all = change(flow.neighbors)
    if flow.reaction:
        if hasattr(flow.gradient, "as_pairs"):
            gradient, pressure = flow.gradient.as_pairs(
                particles.position, pressure, role, flow.neighbors.indptr,
                flow.neighbors.indices, stencil,
            )  # fmt: skip
        flow.reaction.add(change)
    particles.velocity += by_all


def _stabilise(flow, stage, before, dt):
    particles, models = flow.particles, [m for m in flow.stabilisers if stage == m.STAGE]
    for model in models:
        flow.domain.refresh(particles.position, particles.velocity)
        _part(flow, model, before, dt)
    if models and stage == "predicted":
        flow.domain.refresh(particles.position, particles.velocity)


def _part(flow, model, before, dt):
    """Apply a stabiliser, pass by pass."""
    one_pass = getattr(model, "one_pass", model.stabilise)
    felt = flow.reaction and not getattr(model, "KEEPS_VELOCITY", False)

    def act(particles, pairs):
        one_pass(particles, before, pairs, flow.stencil, flow.correction, dt, flow.case.scheme)

    for _ in range(getattr(model, "PASSES", 1)):
        if felt:
            flow.reaction.stabilise(act, flow.particles)
        act(flow.particles, flow.neighbors)
