"""The piston: wall particles that follow the wavemaker."""

import numpy as np

from mpslab.core import lattice, plugins
from mpslab.core.keys import CaseError, shown
from mpslab.core.particles import FACE, FILLER, TANK
from mpslab.solids import shaped
from mpslab.solids.absorption import absorbing
from mpslab.solids.solid import Solid

ROOM = 3  # spacings that must stay free between the piston and what stands in the tank


def make_paddle(case):
    """Motion of a case's wavemaker, None for a tank with a fixed wall in its place.

    Raises ValueError if the wavemaker cannot make its wave, would leave the tank, or would run into
    the shore, an obstacle, a gate or a solid.
    """
    if case.wavemaker.type == "none":
        return None
    maker = plugins.load("wavemakers", case.wavemaker.type)
    paddle = maker.make(case.wavemaker, case.tank.paddle_depth, case.fluid.gravity, case.time.end)
    if case.wavemaker.absorption:
        paddle = absorbing(case, paddle)
    _stay_in_tank(case, paddle)
    reach = paddle.foremost + ROOM * case.particles.spacing
    for i, box in enumerate(case.obstacle):
        _leave_room(f"obstacle.{i}.from", box.start, box.start[0], reach)
    for i, gate in enumerate(case.gate):
        _leave_room(f"gate.{i}.x", gate.x, gate.x, reach)
    for i, (given, shape) in enumerate(zip(case.solid, shaped.shapes(case), strict=True)):
        name = shaped.place_of(given)
        _leave_room(f"solid.{i}.{name}", getattr(given, name), float(shape.low[0]), reach)
    return paddle


def _stay_in_tank(case, paddle):
    """Refuse a motion that is longer than the tank, or leaves no water between piston and shore."""
    maker, tank = case.wavemaker, case.tank
    end, name = _end_of_water(tank)
    most = end - ROOM * case.particles.spacing
    stroke = max(paddle.stroke, paddle.foremost - paddle.backmost)
    if stroke < tank.length and paddle.foremost <= most:
        return
    key = "file" if maker.type == "file" else "stroke" if maker.stroke else "height"
    periodic = maker.period > 0.0 and key != "file"
    period = f" with wavemaker.period = {maker.period:g} s" if periodic else ""
    hint = "; are its displacements in m, and not in cm or mm?" if key == "file" else ""
    raise CaseError(
        f"wavemaker.{key} = {shown(getattr(maker, key))}{period}: moves the piston by "
        f"{stroke:.4g} m, up to x = {paddle.foremost:.4g} m; the stroke must be < tank.length = "
        f"{tank.length:g} m, and end at x <= {most:.4g} m, {ROOM} spacings before the {name}{hint}"
    )


def _end_of_water(tank):
    """x of the still water's shoreline or of the end wall [m], and which of the two it is."""
    bed = np.array(tank.bed)
    dry = np.flatnonzero(bed[:, 1] >= tank.depth)
    if len(dry) == 0:
        return tank.length, "end wall"
    (x0, z0), (x1, z1) = bed[dry[0] - 1], bed[dry[0]]
    return float(x0 + (tank.depth - z0) / (z1 - z0) * (x1 - x0)), "shore"


def _leave_room(key, value, x, reach):
    """Refuse the value of a key that puts a solid at x [m], if the piston reaches it there."""
    if x < reach:
        raise CaseError(
            f"{key} = {shown(value)}: must be at x >= {reach:.4g} m, {ROOM} spacings ahead of the "
            "foremost place of the piston"
        )


class Piston(Solid):
    """Wall particles that follow the wavemaker, and cover the bed behind their face.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    tank : mpslab.solids.tank.Tank
    paddle : mpslab.solids.paddle.Paddle or None
        Motion of the wavemaker; None where the piston is only laid out.
    """

    def __init__(self, case, tank, paddle=None):
        super().__init__("piston")
        self.tank, self.paddle = tank, paddle
        self.margin = 0.75 * case.particles.spacing
        self.near = paddle.farthest + case.particles.spacing if paddle else -np.inf
        self.gid, self.rest, self.bed = np.zeros(0, int), np.zeros(0), np.zeros(0, int)

    def particles(self, case):
        """Vertical layers, at rest with their face at x = 0."""
        section, role = self.tank.end_wall(-1)
        return lattice.across(case, section), np.tile(role, lattice.rows_across(case))

    def motion(self, time):
        """How far its face has gone along x."""
        return np.array([self.face(time), 0.0, 0.0])

    def holds(self, points):
        return points[:, 0] < 0.0

    def begin(self, particles):
        """Find the piston's particles, and the bed that it may cover."""
        moving = particles.moves_with_piston
        self.gid = particles.gid[moving]
        self.rest = particles.position[moving, 0].copy()
        bed = (particles.role == FACE) & (particles.body == TANK)
        bed &= particles.position[:, 0] < self.near
        self.bed = particles.gid[bed]

    def state(self):
        own = {f"paddle.{key}": value for key, value in self.paddle.state().items()}
        return {"gid": self.gid, "rest": self.rest, "bed": self.bed, **own}

    def restore(self, state):
        self.gid, self.rest, self.bed = state["gid"], state["rest"], state["bed"]
        head = "paddle."
        own = {k.removeprefix(head): v for k, v in state.items() if k.startswith(head)}
        if own:
            self.paddle.restore(own)

    def advance(self, time, dt, readings):
        self.paddle.advance(time, dt, readings)

    def face(self, time):
        """x of the piston's face [m]."""
        return self.paddle.displacement(time)

    def push(self, particles, rows, time, dt):
        particles.velocity[rows, 0] = (self.face(time + dt) - self.face(time)) / dt

    def move(self, particles, rows, time, dt):
        """Take the piston to its place at time + dt, and cover the bed behind it."""
        face = self.face(time + dt)
        rest = self.rest[np.searchsorted(self.gid, particles.gid[rows])]
        particles.position[rows, 0] = rest + face
        self.cover(particles, face)

    def cover(self, particles, face):
        """Make fillers of the bed behind the face: as faces they would tie the corner to p = 0."""
        rows = np.flatnonzero((particles.body == TANK) & (particles.position[:, 0] < self.near))
        rows = rows[_among(particles.gid[rows], self.bed)]
        behind = particles.position[rows, 0] < face - self.margin
        particles.role[rows] = np.where(behind, FILLER, FACE)
        particles.pressure[rows[behind]] = 0.0


def _among(numbers, some):
    """Which of (n,) numbers are among some in ascending order, (n,) bool."""
    at = np.searchsorted(some, numbers)
    return np.append(some, -1)[at] == numbers
