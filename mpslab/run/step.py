"""One time step of the semi-implicit particle method."""

import math

import numpy as np

from mpslab.core.particles import add_where, put_where
from mpslab.core.timestep import pace, share
from mpslab.forcings import total
from mpslab.models import (
    crowding,
    friction,
    hyperviscosity,
    residue,
    surface,
    wall_law,
    wall_pressure,
)
from mpslab.pressure import equation
from mpslab.run import pressing

LAYERS = 20  # of water, up to which the weight of a density error does not depend on them
WAKING = 2.0  # sqrt(depth / gravity): in this time the density begins to count
FURTHEST = 1.0  # spacings that a particle goes in a step
SURE = 2  # passes of a stabiliser, after which ghosts are no longer what their owners have


def advance(flow, dt):
    """Advance a `mpslab.run.flow.Flow` by one time step dt [s]; returns the solver's report.

    Predict with forcings and viscosity, solve for the pressure that keeps the number density,
    correct with its gradient (equations 1 to 4 of the paper).  One neighbour list serves the
    whole step: viscosity, too, is evaluated where the pressure acts.
    """
    watch, domain = flow.stopwatch, flow.domain
    start, before = flow.particles.position.copy(), flow.particles.velocity.copy()
    _predict(flow, dt)
    with watch.phase("ghosts"):
        flow.particles, (start, before) = domain.share_out(
            flow.particles, start, before, idle=flow.idle
        )
        _unload(domain.aside)
    particles = flow.particles
    for one in flow.exchanges:
        one.begin(particles, before)
    with watch.phase("neighbours"):
        find_neighbors(flow)
    with watch.phase("operators"):
        moves = any(model.STAGE == "predicted" for model in flow.stabilisers)
        measure(flow, with_gradient=not moves)
        for one in flow.exchanges:
            one.find(flow.near)
        _add_viscosity(flow, dt)
        _add_drag(flow, dt)
        if moves:
            _stabilise(flow, "predicted", dt)
            measure(flow)
        graded = find_surface(flow)
    moving = flow.solids.accelerates(particles)
    pull = wall_pressure.pull(particles, before, force_on(flow, dt), dt, moving)
    with watch.phase("assembly"):
        system, rows = _assemble(flow, graded, pull, dt)
    with watch.phase("solve"):
        if flow.coupling:
            report = flow.coupling.solve(flow, system, rows, pull, dt)
        else:
            report = pressing.solve(flow, system, rows, pull)
        system.prepared = None  # it refers to the system, and would keep its memory for a while
    with watch.phase("operators"):
        _correct(flow, start, dt)
        for one in flow.exchanges:
            one.end(flow, dt)
    flow.particles = domain.without_ghosts(particles)
    flow.time += dt
    return report


def _predict(flow, dt):
    """u' = u + f dt with the forcings f; with projection "predicted" also r* = r + u' dt.

    With that projection the solids are at their new places from here on.

    The projection decides the damping.  In a wave of frequency w the pressure at r* takes away
    (w dt)^2/2 of the amplitude in each step; at the positions of the start it takes nothing.
    """
    particles = flow.particles
    flow.solids.advance(flow.time, dt, flow.readings)
    flow.solids.push(particles, flow.time, dt)
    add_where(particles.fluid, particles.velocity, dt * force_on(flow, dt))
    if flow.case.scheme.projection == "predicted":
        add_where(particles.fluid, particles.position, _flight(flow, dt))
        flow.solids.move(particles, flow.time, dt)


def _unload(particles):
    """Leave on particles that are not in the step what it would find: that no water is near."""
    particles.pressure[:] = particles.number_density[:] = 0.0
    particles.surface[:] = 0


def force_on(flow, dt):
    """Acceleration of the particles by the forcings in the middle of a step, (3,) or (n, 3)."""
    return total(flow.forcings, flow.particles, flow.time + 0.5 * dt)


def find_neighbors(flow):
    """The neighbour list of the particles as they are; of ghosts only those next to the border."""
    radius = flow.case.scheme.reach * flow.stencil.spacing
    particles = flow.particles
    active = np.ones(len(particles), bool) if flow.copies else flow.unknowns
    if not getattr(flow.solver, "NEEDS_GHOST_ROWS", False):
        active &= flow.domain.within_reach(particles.position[:, 0], radius)
    flow.neighbors.build(
        particles.position, radius, flow.stencil.width, active, flow.domain.cells
    )


def measure(flow, with_gradient=True):
    """Geometry of the pairs in the list, and number density, where the particles are now.

    The pairs of a gradient with a radius of its own are left out where nothing needs them yet.
    """
    everywhere = np.ones(len(flow.particles), bool) if flow.extrapolates else None
    flow.near.measure(flow.particles, flow.neighbors, everywhere, smooth=flow.extrapolates)
    if with_gradient and flow.near_gradient is not flow.near:
        flow.near_gradient.measure_as(flow.near)
    flow.particles.number_density[:] = flow.near.number_density


def _add_viscosity(flow, dt):
    """u* = u' + nu <lap u> dt; what it adds to r* is of second order in dt, and left out."""
    fluid, scheme = flow.case.fluid, flow.case.scheme
    if fluid.viscosity == scheme.smagorinsky == 0.0:
        return
    seen = friction.velocity_seen(flow.near, scheme, flow.domain.refresh)
    eddy = friction.eddies(flow.near, seen, scheme, flow.domain.refresh)

    def change(near):
        mine = near.pick(seen), near.pick(eddy)
        return dt * friction.acceleration(near, flow.laplacian_stencil, *mine, fluid, scheme)

    if scheme.wall_slip:
        flow.particles.velocity += change(flow.near)  # no solid has a part in it
    else:
        _act(flow, flow.near, change)


def _add_drag(flow, dt):
    """Let the walls hold the water back, as the law of the wall says."""
    if not flow.case.scheme.wall_law:
        return
    fluid, roughness = flow.case.fluid, flow.case.tank.roughness
    held = wall_law.grip(flow.near, fluid, roughness, flow.domain.refresh)
    _act(flow, flow.near, lambda near: dt * wall_law.acceleration(near, near.pick(held)))


def find_surface(flow):
    """Find the free surface; returns its grade where the scheme asks for it, else None."""
    graded, scheme = None, flow.case.scheme
    if scheme.surface == "graded":
        graded = surface.grade_surface(flow.near)
    else:
        surface.mark_surface(flow.near, scheme.surface_threshold, flow.unknowns)
    flow.domain.refresh(flow.particles.surface)
    return graded


def _assemble(flow, graded, pull, dt):
    particles, near, rho = flow.particles, flow.near, flow.case.fluid.density
    stencil, terms = flow.laplacian_stencil, flow.pair_terms
    velocity, n = particles.velocity, particles.number_density
    towards_zero = None
    if flow.extrapolates:
        velocity = wall_pressure.predicted_velocity(particles, pull, dt)
    if graded is not None:
        towards_zero = surface.surface_pull(
            particles, graded, flow.stencil, stencil, terms, rho
        )
        n = surface.filled_density(n, graded, flow.stencil)
    rate = density_rate(flow.case, flow.time)
    right = flow.source.source(near, velocity, n, dt, rate, flow.case.scheme)
    if graded is not None and getattr(flow.source, "INSIDE_ONLY", False):
        right *= 1.0 - graded
    if flow.case.scheme.projection == "start":
        flow.domain.refresh(right)
        flow.compression = dt * near.largest_together(right, flow.domain.owned)
        right += _relief(flow, n, dt) / dt
    if flow.extrapolates:
        right += wall_pressure.flux(near, stencil, terms, pull)
    if graded is not None and flow.case.scheme.residue:
        towards_zero += _residue(flow)
    domain = flow.domain if flow.solver.BY_SLAB else None
    return equation.assemble(near, stencil, terms, rho, right, flow.unknowns, towards_zero, domain)


def _relief(flow, number_density, dt):
    """Rate at which crowded water is let go, (n,) [1/s]; see `mpslab.models.crowding`."""
    share = flow.case.scheme.relief
    return crowding.rate(number_density, flow.stencil, share, dt, pace(flow.case))


def _residue(flow):
    """What a uniform pressure adds to the diagonal, (n,) [m/kg]; see `mpslab.models.residue`."""
    if not getattr(flow.gradient, "HAS_RESIDUE", False):
        return 0.0
    found = residue.stiffness(flow.near, flow.case.scheme.residue, flow.case.fluid.density)
    if getattr(flow.solver, "NEEDS_GHOST_ROWS", False):
        flow.domain.refresh(found)  # it takes the neighbours' neighbours of a particle
    return found


def density_rate(case, time):
    """Rate at which the mixed sources take back an error of the number density [1/s].

    ``scheme.gamma`` is the share that is taken back in `timestep.pace`, in up to 20 layers of
    water. In more layers it is less, so that the time for it stays the same part of the time that a
    wave takes across the depth: the pressure that a change of rate needs grows with the square of
    the layers. For the same reason the rate is zero at t = 0, and whole after the time that a wave
    takes for twice the depth: if it were whole at once, it would give the water at rest a blow of
    several times its weight.
    """
    layers = case.tank.deepest / case.particles.spacing if case.fluid.gravity else 0.0
    rate = case.scheme.gamma * LAYERS / max(layers, LAYERS) / pace(case)
    waking = WAKING * math.sqrt(case.tank.deepest / case.fluid.gravity) if layers else 0.0
    s = min(time / waking, 1.0) if waking else 1.0
    return rate * s * s * (3.0 - 2.0 * s)


def _correct(flow, start, dt):
    """u = u* - (dt/rho) grad p and r = start + u dt, then keep the particles in order."""
    particles = flow.particles
    _press(flow, dt)
    _even_out(flow, dt)
    put_where(particles.fluid, particles.position, start + _flight(flow, dt))
    if flow.case.scheme.projection == "start":
        flow.solids.move(particles, flow.time, dt)
    _stabilise(flow, "corrected", dt)
    if flow.stencil.width > 0.0:
        particles.position[:, 1] %= flow.stencil.width


def _press(flow, dt):
    """u = u* - (dt/rho) grad p."""
    _act(flow, *pressing.push(flow, dt))


def _even_out(flow, dt):
    """Take a share of the differences from particle to particle off the velocities."""
    strength, velocity = flow.case.scheme.hyperviscosity, flow.particles.velocity
    if strength > 0.0:
        part = share(strength, dt, pace(flow.case))
        velocity += hyperviscosity.change(flow.near, velocity, part, flow.domain.refresh)


def _act(flow, near, change):
    """Change the velocity of the water by a sum over pairs, and note the solids' part in it."""
    for one in flow.exchanges:
        one.add(near, change)
    flow.particles.velocity += change(near)


def _flight(flow, dt):
    """u dt, but no more than a spacing [m], (n, 3).

    Only a particle that was alone before the step, and so did not limit it, can be as fast; it must
    not pass through what it meets.
    """
    path, furthest = dt * flow.particles.velocity, FURTHEST * flow.stencil.spacing
    if max(path.max(initial=0.0), -path.min(initial=0.0)) < 0.5 * furthest:
        return path
    square = np.einsum("ij,ij->i", path, path)
    far = np.flatnonzero(square > furthest**2)
    path[far] *= (furthest / np.sqrt(square[far]))[:, np.newaxis]
    return path


def _stabilise(flow, stage, dt):
    """Let the models of a stage move the particles."""
    particles, models = flow.particles, [m for m in flow.stabilisers if stage == m.STAGE]
    for model in models:
        flow.domain.refresh(particles.position, particles.velocity)
        _part(flow, model, dt)
    if models and stage == "predicted":
        flow.domain.refresh(particles.position, particles.velocity)


def _part(flow, model, dt):
    """Apply a stabiliser, pass by pass."""
    one_pass = getattr(model, "one_pass", model.stabilise)
    felt = [] if getattr(model, "KEEPS_VELOCITY", False) else flow.exchanges

    def act(near):
        one_pass(near, dt, pace(flow.case), flow.case.scheme)

    for turn in range(getattr(model, "PASSES", 1)):
        if turn and turn % SURE == 0:
            flow.domain.refresh(flow.particles.position, flow.particles.velocity)
        for one in felt:
            one.stabilise(flow.near, act)
        act(flow.near)
