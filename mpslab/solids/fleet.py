"""The free bodies of a tank together: what moves them, and how they answer it."""

import numpy as np

from mpslab.core.particles import make_particles
from mpslab.forcings import total
from mpslab.solids.contact import Contact, impulses
from mpslab.solids.moorings import lines
from mpslab.theory.algebra import dot, eliminate


class Fleet:
    """All free bodies of a run; arrays of six numbers are as in `mpslab.solids.floating`.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    solids : mpslab.solids.collection.Solids
    forcings : tuple
        Of the run: a body is pulled as water at its centre of mass would be.
    """

    def __init__(self, case, solids, forcings):
        self.bodies, self.forcings = solids.free, forcings
        self.lines = lines(case, self.bodies)
        self.contact = Contact(case, solids, self.bodies)

    def begin(self, time, dt):
        """Find what acts on the bodies from outside of the water in a step."""
        self.time, self.dt = time, dt
        self.loose = [body for body in self.bodies if not body.held(time)]
        self.free = np.flatnonzero(
            np.concatenate([body.free & (not body.held(time)) for body in self.bodies])
        )
        self.outer = np.array([dt * self._weight(body, time + 0.5 * dt) for body in self.bodies])
        self.struck = np.zeros_like(self.outer)
        for line in self.lines:
            self.outer[self.bodies.index(line.body)] += dt * line.force()

    def _weight(self, body, time):
        there = make_particles(body.center[np.newaxis], [0])
        there.velocity[0] = body.velocity[:3]
        pull = np.broadcast_to(total(self.forcings, there, time), (1, 3))[0]
        return np.concatenate([body.mass * pull, np.zeros(3)])

    def respond(self, given):
        """Aim at the velocities for which momentum and velocity agree, and which contacts allow.

        Parameters
        ----------
        given : (bodies, 6) float64 [N s, N m s]
            Impulses of the water on the bodies, at the velocities that they aim at so far.

        Returns
        -------
        float [m]
            Farthest that any point of a body comes to another place by it, in the step.
        """
        aimed = np.array([body.aimed for body in self.bodies])
        lack = [body.momentum + given[k] + self.outer[k] - body.times_mass(body.aimed)
                for k, body in enumerate(self.bodies)]  # fmt: skip
        free, velocity = self.free, aimed.flatten()
        self.struck = np.zeros_like(self.outer)
        resistance = self.resistance()[np.ix_(free, free)]
        velocity[free] += eliminate(resistance, np.ravel(lack)[free])
        rows, least = self.contact.limits(self.time, self.dt, velocity.reshape(-1, 6))
        if len(rows):
            mobility = np.zeros((len(velocity), len(velocity)))
            mobility[np.ix_(free, free)] = np.column_stack(
                [eliminate(resistance, unit) for unit in np.eye(len(free))]
            )
            struck = impulses(rows, least, velocity, mobility)
            velocity = velocity + dot(mobility, struck)
            self.struck = struck.reshape(-1, 6)
        velocity = velocity.reshape(-1, 6)
        for body, one in zip(self.bodies, velocity, strict=True):
            if body in self.loose:
                body.aim(one, self.dt)
        size = np.sqrt(np.sum((velocity - aimed).reshape(-1, 2, 3) ** 2, axis=2))
        reach = np.array([body.reach for body in self.bodies])
        return self.dt * float((size[:, 0] + reach * size[:, 1]).max())

    def resistance(self):
        """Mass and added mass of all bodies, (6 bodies, 6 bodies)."""
        found = np.vstack([body.added for body in self.bodies])
        for k, body in enumerate(self.bodies):
            found[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] += body.mass_matrix()
        return found

    def arrive(self, given):
        """End a step in which the water gave the bodies impulses (bodies, 6)."""
        for body, got in zip(self.bodies, given + self.outer + self.struck, strict=True):
            held = body not in self.loose  # and gives back what it gets
            body.arrive(self.dt, body.momentum + (0.0 if held else got))
