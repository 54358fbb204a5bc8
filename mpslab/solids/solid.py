"""A solid that stands still, or follows a prescribed motion."""

import numpy as np

from mpslab.core.motion import displacement


class Solid:
    """What all solids share; `mpslab.solids` has the contract.

    Attributes
    ----------
    motion : as there
    jumps : bool
        Whether its speed jumps; if so, the water beside it does not feel its acceleration.
    """

    motion = None
    jumps = False

    def __init__(self, name):
        self.name = name

    def particles(self, case):
        """Its particles at t = 0: positions (n, 3) [m] and roles (n,) int8."""
        raise NotImplementedError

    def holds(self, points):
        """Which places (n, 3) [m] are inside it as it was laid out, (n,) bool."""
        return np.zeros(len(points), bool)

    def begin(self, particles):
        """Look at all particles of the tank as laid out, before the first step."""

    def state(self):
        """What a checkpoint keeps of it: names to numbers, strings and arrays."""
        return {}

    def restore(self, state):
        """Take back what `state` gave."""

    def advance(self, time, dt, readings):
        """Decide on the move from time to time + dt, as `Paddle.advance` does."""

    def push(self, particles, rows, time, dt):
        """Give its particles the velocity of their move from time to time + dt, in place."""
        step = displacement(self.motion, particles.position[rows], time, time + dt)
        particles.velocity[rows] = step / dt

    def move(self, particles, rows, time, dt):
        """Move its particles as from time to time + dt, in place."""
        step = displacement(self.motion, particles.position[rows], time, time + dt)
        particles.position[rows] += step
