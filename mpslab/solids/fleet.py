"""The free bodies of a tank together: what moves them, and how they answer it."""

import numpy as np

from mpslab.forcings import total
from mpslab.core.particles import make_particles
from mpslab.theory.algebra import dot, eliminate


class Fleet:
    """All free bodies of a run; arrays of six numbers are as in `mpslab.solids.floating`.

    Parameters
    ----------
    bodies : sequence of mpslab.solids.floating.Floating
    forcings : tuple
        Of the run: a body is pulled as water at its centre of mass would be.
    """

    def __init__(self, bodies, forcings):
        self.bodies, self.forcings = tuple(bodies), forcings
        self.outer = np.zeros((len(self.bodies), 6))

    def begin(self, time, dt):
        """Find what acts on the bodies from outside of the water in a step."""
        self.free = np.flatnonzero(
            np.concatenate([body.free & (not body.held(time)) for body in self.bodies])
        )
        self.outer = np.array([dt * self._weight(body, time + 0.5 * dt) for body in self.bodies])

    def _weight(self, body, time):
        there = make_particles(body.center[np.newaxis], [0])
        there.velocity[0] = body.velocity[:3]
        pull = np.broadcast_to(total(self.forcings, there, time), (1, 3))[0]
        return np.concatenate([body.mass * pull, np.zeros(3)])

    def respond(self, given, dt):
        """Aim at the velocities for which momentum and velocity agree.

        Parameters
        ----------
        given : (bodies, 6) float64 [N s, N m s]
            Impulses of the water on the bodies, at the velocities that they aim at so far.
        """
        lack = [body.momentum + given[k] + self.outer[k] - body.times_mass(body.aimed)
                for k, body in enumerate(self.bodies)]  # fmt: skip
        change = np.zeros(6 * len(self.bodies))
        free = self.free
        change[free] = eliminate(self.resistance()[np.ix_(free, free)], np.ravel(lack)[free])
        for body, part in zip(self.bodies, change.reshape(-1, 6), strict=True):
            body.aim(body.aimed + part, dt)

    def resistance(self):
        """Mass and added mass of all bodies, (6 bodies, 6 bodies)."""
        found = np.vstack([body.added for body in self.bodies])
        for k, body in enumerate(self.bodies):
            found[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] += body.mass_matrix()
        return found

    def arrive(self, given, dt):
        """End a step in which the water gave the bodies impulses (bodies, 6)."""
        for body, got, more in zip(self.bodies, given, self.outer, strict=True):
            body.arrive(dt, body.momentum + got + more)
