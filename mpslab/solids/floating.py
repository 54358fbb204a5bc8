"""Free bodies: solids that the water moves, ``motion = "free"``.

A body keeps two things that are one in theory: its velocity, by which its particles move, and its
momentum, the sum of all impulses that it has got. A step finds the velocity for which both agree
(`mpslab.run.coupling`), to a small error; the momentum knows of the error, and the next step
makes it good. So no momentum is lost, and a light body, whose momentum is next to nothing, is not
thrown about by what is left.

Of the six numbers of a velocity, momentum or force the first three are along x, y and z, the others
about axes through the centre of mass in these directions.
"""

import numpy as np

from mpslab.core import lattice, rotation
from mpslab.core.particles import FIRST_SOLID
from mpslab.core.structures import MODES
from mpslab.solids.mass import bulk
from mpslab.solids.shaped import Shaped, shapes

INDEX = dict(zip(MODES, (0, 1, 2, 4, 3, 5), strict=True))  # of a mode among the six numbers
FLAT = ("x", "z", "roll")  # the modes of 2-D


def make(case, tank):
    """The solids of any shape of a case, in their order."""
    kinds = [Floating if given.motion == "free" else Shaped for given in case.solid]
    return [kind(case, number, tank) for number, kind in enumerate(kinds)]


def weigh(case, number):
    """Mass [kg], centre of mass (3,) [m] and inertia (3, 3) [kg m2] of a free body; in 2-D of a
    slice 1 m wide.
    """
    given = case.solid[number]
    body = bulk(shapes(case)[number], case.dim)
    mass = given.mass or given.density * body.volume
    center = body.center if given.center_of_mass is None else np.array(given.center_of_mass)
    inertia = mass / body.volume * body.inertia
    if given.inertia:
        inertia = np.diag(given.inertia) if case.dim == 3 else given.inertia[0] * np.eye(3)
    if case.dim == 2:
        center = center * [1.0, 0.0, 1.0]
    return mass, center, inertia


class Floating(Shaped):
    """A rigid body that the water moves.

    Attributes
    ----------
    body : int
        Its number among the bodies of the particles.
    width : float [m]
        Period across the tank, 0 when not periodic.
    reach : float [m]
        No point of it is farther from its centre.
    mass, inertia : as of `weigh`; the inertia about axes that turn with the body
    center : (3,) float64 [m]
        Centre of mass.
    turn : (4,) float64
        Rotation since the start (`mpslab.core.rotation`).
    velocity : (6,) float64 [m/s, rad/s]
        In the last step.
    momentum : (6,) float64 [kg m/s, kg m2/s]
    guess : (6,) float64 [m/s2, rad/s2]
        Acceleration in the last step.
    added : (6, k) float64 [kg, kg m, kg m2]
        Added mass: what it takes to give the k / 6 bodies of the tank an acceleration in water.
    age : int
        Steps since the added mass was found; < 0 for none.
    aimed : (6,) float64
        Velocity in the step that is under way.
    """

    def __init__(self, case, number, tank):
        super().__init__(case, number, tank)
        given = case.solid[number]
        self.body = FIRST_SOLID + len(case.obstacle) + len(case.gate) + number
        self.mass, self.start, self.inertia = weigh(case, number)
        self.release = given.release
        periodic = case.dim == 3 and case.tank.periodic
        self.width = lattice.rows_across(case) * case.particles.spacing if periodic else 0.0
        free = FLAT if case.dim == 2 else MODES
        self.free = np.zeros(6, bool)
        self.free[[INDEX[mode] for mode in free if mode not in given.locked]] = True
        corners = np.maximum(self.shape.high - self.start, self.start - self.shape.low)
        self.reach = np.sqrt(np.sum(np.where(np.isfinite(corners), corners, 0.0) ** 2))
        self.gid, self.rest = np.zeros(0, int), np.zeros((0, 3))
        self.center, self.turn = self.start.copy(), rotation.STILL.copy()
        self.velocity = np.where(self.free, [*given.velocity, 0.0, 0.0, 0.0], 0.0)
        self.momentum = self.times_mass(self.velocity)
        self.guess, self.added, self.age = np.zeros(6), np.zeros((6, 0)), -1
        self.motion = self.gone
        self.aim(self.velocity, 0.0)

    def gone(self, time):
        """How far it has gone in the plane x-z, (x, z, roll) [m, m, rad]; now, at any time."""
        x, _, z = self.center - self.start
        return np.array([x, z, rotation.angles(rotation.matrix(self.turn))[0]])

    def held(self, time):
        """Whether it is held in place in a step that begins at a time [s]."""
        return time < self.release

    def mass_matrix(self):
        """Momentum over velocity as the body lies now, (6, 6)."""
        found = np.zeros((6, 6))
        found[[0, 1, 2], [0, 1, 2]] = self.mass
        turn = rotation.matrix(self.turn)
        found[3:, 3:] = rotation.apply(turn, rotation.apply(turn, self.inertia.T).T)
        return found

    def times_mass(self, velocity):
        """Momentum of a velocity, both (6,)."""
        return np.sum(self.mass_matrix() * velocity, axis=1)

    def begin(self, particles):
        """Find its particles."""
        mine = np.flatnonzero(particles.body == self.body)
        self.gid, self.rest = particles.gid[mine], particles.position[mine] - self.start

    def set_off(self, particles):
        """Give its particles the velocity that they start with."""
        particles.velocity[particles.body == self.body] = self.velocity[:3]

    def state(self):
        return {"gid": self.gid, "rest": self.rest, "center": self.center, "turn": self.turn,
                "velocity": self.velocity, "momentum": self.momentum, "guess": self.guess,
                "added": self.added, "age": self.age}  # fmt: skip

    def restore(self, state):
        self.__dict__.update(state)

    def advance(self, time, dt, readings):
        """Aim at the velocity that the last acceleration leads to."""
        self.aim(self.velocity + dt * self.guess if not self.held(time) else np.zeros(6), dt)

    def aim(self, velocity, dt):
        """Take a velocity (6,) for the step of a length [s]."""
        self.aimed = velocity
        self._next = (self.center + dt * velocity[:3],
                      rotation.turned(self.turn, velocity[3:], dt))  # fmt: skip

    def push(self, particles, rows, time, dt):
        (center, turn), rest = self._next, self._rest_of(particles, rows)
        turning = rotation.matrix(turn) - rotation.matrix(self.turn)
        step = center - self.center + rotation.apply(turning, rest)
        particles.velocity[rows] = step / dt

    def move(self, particles, rows, time, dt):
        (center, turn), rest = self._next, self._rest_of(particles, rows)
        particles.position[rows] = center + rotation.apply(rotation.matrix(turn), rest)

    def arrive(self, dt, momentum):
        """The step is done: where the body is, and the momentum (6,) that it has got."""
        self.momentum = np.where(self.free, momentum, self.times_mass(self.aimed))
        self.guess = (self.aimed - self.velocity) / dt
        self.velocity, (self.center, self.turn) = self.aimed, self._next
        self.age += self.age >= 0

    def places(self, rest):
        """Where points of the body are; `rest` (n, 3) [m] as laid out, from the centre of mass."""
        return self.center + rotation.apply(rotation.matrix(self.turn), rest)

    def laid_out(self, points):
        """Where places (n, 3) [m] would be if they went with the body back to its start."""
        back = rotation.matrix(self.turn).T
        return self.start + rotation.apply(back, self.arm(points))

    def arm(self, points):
        """From its centre to places (n, 3) [m]; in a periodic tank to the nearest image."""
        found = points - self.center
        if self.width:
            found[:, 1] -= self.width * np.round(found[:, 1] / self.width)
        return found

    def deep_inside(self, points):
        """Which places (n, 3) [m] are more than a spacing inside it as it lies now, (n,) bool."""
        found = np.zeros(len(points), bool)
        near = np.flatnonzero(np.sum(self.arm(points) ** 2, axis=1) < self.reach**2)
        depth = -self.shape.distance(self.laid_out(points[near]))
        found[near] = depth > self.case.particles.spacing
        return found

    def _rest_of(self, particles, rows):
        return self.rest[np.searchsorted(self.gid, particles.gid[rows])]
