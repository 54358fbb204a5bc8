"""The piston: wall particles that follow the wavemaker."""

import numpy as np

from mpslab import plugins
from mpslab.keys import CaseError, shown
from mpslab.particles import FACE, FILLER, TANK

ROOM = 3  # spacings that are left between the piston and an obstacle or a gate


def make_paddle(case):
    """Motion of a case's wavemaker, None when the tank has a fixed wall.

    Raises ValueError where the wavemaker cannot make its wave, would leave the tank, or run into
    the shore, an obstacle or a gate.
    """
    if case.wavemaker.type == "none":
        return None
    maker = plugins.load("wavemakers", case.wavemaker.type)
    paddle = maker.make(case.wavemaker, case.tank.paddle_depth, case.fluid.gravity, case.time.end)
    _stay_in_tank(case, paddle)
    reach = paddle.foremost + ROOM * case.particles.spacing
    for i, box in enumerate(case.obstacle):
        _leave_room(f"obstacle.{i}.from", box.start, box.start[0], reach)
    for i, gate in enumerate(case.gate):
        _leave_room(f"gate.{i}.x", gate.x, gate.x, reach)
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
    """x of the shore of the still water, or of the end wall [m], and which of the two it is."""
    bed = np.array(tank.bed)
    dry = np.flatnonzero(bed[:, 1] >= tank.depth)
    if len(dry) == 0:
        return tank.length, "end wall"
    (x0, z0), (x1, z1) = bed[dry[0] - 1], bed[dry[0]]
    return float(x0 + (tank.depth - z0) / (z1 - z0) * (x1 - x0)), "shore"


def _leave_room(key, value, x, reach):
    """Refuse the value of a key that puts a solid at x, short of the reach of the piston [m]."""
    if x < reach:
        raise CaseError(
            f"{key} = {shown(value)}: must be at x >= {reach:.4g} m, {ROOM} spacings ahead of the "
            "foremost place of the piston"
        )


class Piston:
    """Moves the piston's particles and covers the bed behind its face.

    Parameters
    ----------
    particles : ParticleSet
        All of the tank as laid out, the piston at rest with its face at x = 0.
    paddle : mpslab.paddle.Paddle or None
        Motion of the wavemaker; None for a tank without one.
    spacing : float [m]
    """

    def __init__(self, particles, paddle, spacing):
        self.paddle = paddle
        self.margin = 0.75 * spacing
        moving = particles.moves_with_piston
        self.gid = particles.gid[moving]
        self.rest = particles.position[moving, 0].copy()
        self.near = paddle.farthest + spacing if paddle else -np.inf
        bed = (particles.role == FACE) & (particles.body == TANK)
        bed &= particles.position[:, 0] < self.near
        self.bed = particles.gid[bed]

    def share_out(self, comm):
        """Give all ranks the piston of rank 0, which has seen all particles."""
        self.gid, self.rest, self.bed = comm.bcast((self.gid, self.rest, self.bed))

    def face(self, time):
        """x of the piston's face [m]; 0 without a wavemaker."""
        return self.paddle.displacement(time) if self.paddle else 0.0

    def push(self, particles, time, dt):
        """Give the piston the velocity of its move from time to time + dt."""
        if self.paddle is not None:
            moving = particles.moves_with_piston
            particles.velocity[moving, 0] = (self.face(time + dt) - self.face(time)) / dt

    def move(self, particles, time):
        """Take the piston to its place at a time, and cover the bed behind it."""
        if self.paddle is None:
            return
        moving = np.flatnonzero(particles.moves_with_piston)
        rest = self.rest[np.searchsorted(self.gid, particles.gid[moving])]
        particles.position[moving, 0] = rest + self.face(time)
        self.cover(particles, self.face(time))

    def cover(self, particles, face):
        """Bed behind the face carries no pressure: else it would tie the corner to p = 0."""
        rows = np.flatnonzero((particles.body == TANK) & (particles.position[:, 0] < self.near))
        rows = rows[np.isin(particles.gid[rows], self.bed, kind="sort")]
        behind = particles.position[rows, 0] < face - self.margin
        particles.role[rows] = np.where(behind, FILLER, FACE)
        particles.pressure[rows[behind]] = 0.0
