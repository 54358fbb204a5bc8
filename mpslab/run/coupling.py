"""How water and free bodies move each other in a step.

The pressure equation knows the acceleration of a body: it stands in the pull on its particles
(`mpslab.models.wall_pressure`). So pressure and accelerations are unknowns together. They are found
in two solves: the first with the accelerations of the last step; the forces that it gives, and the
added mass of the bodies, tell the accelerations to take; the second solve, which starts from the
first, has the pressure for these. What its forces still differ from mass times acceleration is made
good in the next step (`mpslab.solids.floating`).

The added mass is that of the discrete equations: the forces by the pressure that answers a unit
acceleration. It is found anew now and then; until then the water has hardly changed. Where a
body hits the water it has: there the answer moves the body by more than a little, and so the added
mass is found at once, and the bodies answer again until little is left to change.
"""

from dataclasses import replace

import numpy as np

from mpslab.models import wall_pressure
from mpslab.models.reaction import Exchange
from mpslab.pressure.system import SolverReport
from mpslab.run import pressing
from mpslab.solids.fleet import Fleet

EVERY = 100  # steps: the added mass is found anew
CLOSE = 1e-3  # spacings: more than that an answer must not change a move, or it is not the last one
MOST = 6  # answers of the bodies in a step
SUCTION = 2.0  # spacings of water, whose weight may pull at a body
ROUGH = 1e-3  # residual of its pressures, and of the first solve of a step


def coupling_of(case, solids, forcings):
    """The coupling of a run, None without free bodies."""
    return Coupling(case, Fleet(case, solids, forcings)) if solids.free else None


class Coupling(Exchange):
    """Finds velocities of free bodies and the pressure together, step by step.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    fleet : mpslab.solids.fleet.Fleet
    """

    def __init__(self, case, fleet):
        self.case, self.fleet = case, fleet

    def begin(self, particles, before):
        """Nothing has to be known of what acts on each particle alone."""

    def find(self, near):
        """Find the pairs of the water with each body."""
        body = near.particles.body
        super().find(near, [body == one.body for one in self.fleet.bodies])

    def solve(self, flow, system, rows, pull, dt):
        """Solve for the pressure in a step, and aim the bodies; returns the solvers' report.

        The system, its rows and the pull are those of `mpslab.run.pressing.solve`, for the
        velocities that the bodies have aimed at so far.
        """
        fleet, particles = self.fleet, flow.particles
        fleet.begin(flow.time, dt)
        solution = particles.pressure[rows]
        least = self._least(flow)
        if not len(fleet.free):
            return pressing.solve(flow, system, rows, pull, solution, least=least)
        reports = [pressing.solve(flow, system, rows, pull, solution, ROUGH, least)]
        if not all(0 <= one.age < EVERY for one in fleet.loose):
            self._find_added(flow, system, rows)
        for turn in range(MOST):
            moved = fleet.respond(self._given(flow, dt))
            changed = self._push(flow, pull, dt)
            system.right += self._flux(flow, changed - pull)[rows]
            pull = changed
            reports.append(pressing.solve(flow, system, rows, pull, solution, least=least))
            if moved <= CLOSE * flow.stencil.spacing:
                break
            if turn == 0 and any(one.age > 0 for one in fleet.loose):
                self._find_added(flow, system, rows)
        return SolverReport(
            sum(one.iterations for one in reports), reports[-1].residual,
            all(one.converged for one in reports), max(one.replaced for one in reports),
            max(one.coarse for one in reports),
        )  # fmt: skip

    def _least(self, flow):
        """Pressure that those of the particles are clipped to, (n,) [Pa].

        That is 0, and beside a body less. To clip at 0 would make a mean of what is noise: a light
        body, which next to no pressure carries, would rise out of the water. But where a body hits
        the bed, nothing else holds the water below it together.
        """
        fluid, spacing = flow.case.fluid, flow.stencil.spacing
        found = np.zeros(len(flow.particles))
        low = -SUCTION * spacing * fluid.density * fluid.gravity
        found[np.isin(flow.particles.body, [one.body for one in self.fleet.bodies])] = low
        for rows in self.beside:
            found[rows] = low
        return found

    def _push(self, flow, pull, dt):
        """Give the bodies' particles the velocity aimed at; returns the pull on all particles."""
        particles, found = flow.particles, pull.copy()
        for one in self.fleet.bodies:
            mine = np.flatnonzero(particles.body == one.body)
            old = particles.velocity[mine]
            one.push(particles, mine, flow.time, dt)
            found[mine] -= (particles.velocity[mine] - old) / dt
        return found

    def _flux(self, flow, pull):
        return wall_pressure.flux(flow.near, flow.laplacian_stencil, flow.pair_terms, pull)

    def _find_added(self, flow, system, rows):
        """Find the added mass of all bodies."""
        bodies = self.fleet.bodies
        size = 6 * len(bodies)
        found, right = np.zeros((size, size)), system.right
        for k in self.fleet.free:
            pull = self._unit_pull(flow, k)
            system.right, answer = self._flux(flow, pull)[rows], np.zeros(len(rows))
            flow.solver.solve(system, answer, ROUGH, flow.case.scheme.max_iterations)
            found[:, k] = -self._force(flow, rows, answer, pull)
        system.right = right
        for k, one in enumerate(bodies):
            one.added = found[6 * k : 6 * k + 6]
        for one in self.fleet.loose:
            one.age = 0

    def _unit_pull(self, flow, k):
        """Pull on all particles by a unit acceleration of mode k alone, (n, 3)."""
        particles, (number, mode) = flow.particles, divmod(int(k), 6)
        body, pull = self.fleet.bodies[number], np.zeros_like(flow.particles.velocity)
        mine = np.flatnonzero(particles.body == body.body)
        axis = np.eye(3)[mode % 3]
        pull[mine] = -axis if mode < 3 else -np.cross(axis, body.arm(particles.position[mine]))
        return pull

    def _force(self, flow, rows, answer, pull):
        """Forces on all bodies by a pressure that solves the equation, (6 bodies,)."""
        particles = replace(flow.particles, pressure=np.zeros(len(flow.particles)))
        particles.pressure[rows] = answer
        wall_pressure.fill(flow.near.of(particles), flow.case.fluid.density, pull, False)
        flow.domain.refresh(particles.pressure)
        near, act = pressing.push(flow, 1.0, particles)
        return self._impulses(flow, self.parts(near, act)).ravel()

    def _given(self, flow, dt):
        """Impulses of the water in the step so far, and those that the pressure will give."""
        now = self.parts(*pressing.push(flow, dt))
        return self._impulses(flow, [a + b for a, b in zip(self.changes, now, strict=True)])

    def _impulses(self, flow, changes):
        """Impulses (bodies, 6) [N s, N m s] for changes of the water's velocity by each."""
        domain, width, bodies = flow.domain, flow.stencil.width, self.fleet.bodies
        parts = [
            self.totals(domain, k, self.on_solid(k, change, bodies[k].center, width))
            for k, change in enumerate(changes)
        ]
        mass = flow.case.fluid.density * flow.stencil.spacing**flow.stencil.dim
        return mass * domain.totals(*parts).reshape(-1, 6)

    def end(self, flow, dt):
        """End the step, while its ghosts are still there."""
        self.fleet.arrive(self._impulses(flow, self.changes))
