"""The solids of a run, by their bodies."""

import numpy as np

from mpslab.core.keys import NAME, check_value
from mpslab.core.particles import FIRST_SOLID, PISTON, TANK
from mpslab.solids import floating, gates, obstacles
from mpslab.solids.piston import Piston
from mpslab.solids.tank import Tank

# The name of a user's solid: without a dot, which stands between it and the key of its state.
OWN_NAME = {**NAME, "forbidden": NAME["forbidden"] + ".", "unit": ""}
# What a case may have several of, in the order of their bodies.
KINDS = (obstacles, gates, floating)


def solids_of(case, paddle=None, own=(), backmost=0.0):
    """The solids of a case: tank, piston, obstacles, gates, solids of any shape; then the user's.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    paddle : mpslab.solids.paddle.Paddle, optional
        Motion of the wavemaker; without it the solids can be laid out, but not move.
    own : sequence of solids
    backmost : float [m]
        Least displacement of the piston, if there is no paddle to tell it.

    Returns
    -------
    Solids
    """
    for number, solid in enumerate(own):
        check_value(f"solids.{number}.name", solid.name, OWN_NAME)
    tank = Tank(case, paddle.backmost if paddle else backmost)
    bodies = {TANK: tank}
    if case.wavemaker.type != "none":
        bodies[PISTON] = Piston(case, tank, paddle)
    several = [solid for kind in KINDS for solid in kind.make(case, tank)]
    return Solids(bodies | dict(enumerate([*several, *own], FIRST_SOLID)))


class Solids:
    """All solids of a run.

    Parameters
    ----------
    bodies : dict of int to solid
        `mpslab.solids` has the contract.
    """

    def __init__(self, bodies):
        names = [solid.name for solid in bodies.values()]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"solid {name!r}: must have a name that no other solid has")
        self.bodies = bodies
        self.moving = {body: solid for body, solid in bodies.items() if solid.motion is not None}
        self.felt = [body for body, solid in self.moving.items() if not solid.jumps]

    @property
    def free(self):
        """The bodies that the water moves, in their order."""
        return [one for one in self.bodies.values() if isinstance(one, floating.Floating)]

    @property
    def piston(self):
        """The piston, None for a tank without one."""
        return self.bodies.get(PISTON)

    def face(self, time):
        """x of the piston's face [m]; 0 without a wavemaker."""
        return self.piston.face(time) if self.piston else 0.0

    def begin(self, particles, comm):
        """Let the solids look at all particles of the tank, which rank 0 has; all ranks call it."""
        if comm.rank == 0:
            for solid in self.bodies.values():
                solid.begin(particles)
        self.restore(comm.bcast(self.state()))

    def state(self):
        """What a checkpoint keeps of the solids: "piston.rest" and the like."""
        return {
            f"{solid.name}.{key}": value
            for solid in self.bodies.values()
            for key, value in solid.state().items()
        }

    def restore(self, state):
        """Take back what `state` gave; other entries are ignored."""
        for solid in self.bodies.values():
            head = f"{solid.name}."
            mine = {k.removeprefix(head): v for k, v in state.items() if k.startswith(head)}
            if mine:
                solid.restore(mine)

    def advance(self, time, dt, readings):
        """Let the solids that move decide on their move from time to time + dt."""
        for solid in self.moving.values():
            solid.advance(time, dt, readings)

    def push(self, particles, time, dt):
        """Give the solids that move the velocity of their move from time to time + dt, in place."""
        for body, solid in self.moving.items():
            solid.push(particles, np.flatnonzero(particles.body == body), time, dt)

    def move(self, particles, time, dt):
        """Take the solids that move to their places at time + dt, in place."""
        for body, solid in self.moving.items():
            solid.move(particles, np.flatnonzero(particles.body == body), time, dt)

    def still(self, particles):
        """Mask of the particles of solids that never change, (n,) bool."""
        found = ~particles.fluid
        for body in self.moving:
            found &= particles.body != body
        if self.piston:
            found &= particles.position[:, 0] >= self.piston.near  # the bed that it may cover
        return found

    def accelerates(self, particles):
        """Mask of the solids' particles whose acceleration the water feels, (n,) bool."""
        found = np.zeros(len(particles), bool)
        for body in self.felt:
            found |= particles.body == body
        return found
