"""Obstacles: solid boxes that stand in the tank, and the room they leave for the water.

A box is rounded to whole spacings.  Its particles stand on the lattice, half a spacing inside its
faces; boxes that touch or overlap make one body.
"""

from functools import lru_cache
from itertools import product
from math import ceil

import numpy as np

from mpslab.core import bed as beds
from mpslab.core import lattice
from mpslab.core.particles import FACE, FILLER, FIRST_SOLID, PISTON
from mpslab.later import scipy
from mpslab.solids.solid import Solid

NEAR = 2.0  # spacings: water that is as near as this presses on a wall at t = 0


def blocks(case):
    """Low and high corners of the obstacles in whole spacings, (k, 2, 3) float64 [spacings].

    A coordinate is infinite where a box stands against the bed or a wall, because there is no water
    beyond; in 2-D y is infinite too.
    """
    return _blocks(case.obstacle, case.tank, case.particles.spacing)


@lru_cache(maxsize=4)
def _blocks(boxes, tank, spacing):
    found = np.array([_block(tank, spacing, box) for box in boxes]).reshape(-1, 2, 3)
    found.flags.writeable = False
    return found


def least_thickness(case):
    """Least distance of two faces that both meet water [spacings].

    At this distance no particle reaches the water on both sides. Water may come right up to a face;
    a particle k layers below the face is k + 1/2 spacings from there.
    """
    return 2 * ceil(case.scheme.reach - 0.5)


def around(case, start, end):
    """What the obstacles leave of a box of water: smaller boxes, as pairs of corners [m]."""
    boxes, spacing = [(start, end)], case.particles.spacing
    for low, high in blocks(case) * spacing:
        boxes = [piece for box in boxes for piece in cut(*box, low, high)]
    return boxes


class Obstacle(Solid):
    """A box of the case; where boxes overlap, the particles belong to the later one.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    number : int
        Which of ``case.obstacle`` it is.
    tank : mpslab.solids.tank.Tank
    """

    def __init__(self, case, number, tank):
        super().__init__(case.obstacle[number].name)
        self.case, self.number, self.tank = case, number, tank

    def particles(self, case):
        """Particles on the lattice: the outermost are faces, all inside are fillers."""
        place = _cells(case, *blocks(case)[self.number]) + 0.5
        if case.dim == 2:
            place[:, 1] = 0.0
        place = place[_holder(case, place) == self.number]
        position = place * case.particles.spacing
        free = position[:, 2] > beds.elevation(case.tank.bed, position[:, 0])
        free &= lattice.clear(case, position[:, [0, 2]], self.tank.floor[0])
        return position[free], np.where(_meets_water(case, place[free]), FACE, FILLER)

    def holds(self, points):
        return _holder(self.case, points / self.case.particles.spacing) == self.number


def make(case, tank):
    """The obstacles of a case, in their order."""
    return [Obstacle(case, number, tank) for number in range(len(case.obstacle))]


def cover(case, position, role):
    """Make fillers of the faces of the tank that obstacles stand against, in place.

    Parameters
    ----------
    position, role : (n, 3) float64 [m], (n,) int8
        Of the tank.
    """
    if case.obstacle:
        place = position / case.particles.spacing
        rows = np.flatnonzero((role == FACE) & _inside(case, place))
        role[rows[~_meets_water(case, place[rows])]] = FILLER


def press(case, particles):
    """Give faces of obstacles and gates the hydrostatic pressure of water near them, in place."""
    spacing, fluid = case.particles.spacing, np.flatnonzero(particles.fluid)
    wall = (particles.body != PISTON) & _inside(case, particles.position / spacing)
    gate = particles.body >= FIRST_SOLID + len(case.obstacle)
    rows = np.flatnonzero((particles.role == FACE) & (wall | gate))
    position = particles.position
    off, near = scipy.spatial.cKDTree(position[fluid]).query(position[rows])
    near = fluid[near]
    rise = position[near, 2] - position[rows, 2]
    weight = case.fluid.density * case.fluid.gravity
    pressure = np.maximum(particles.pressure[near] + weight * rise, 0.0)
    particles.pressure[rows] = np.where(off < NEAR * spacing, pressure, 0.0)


def holds(case, position):
    """Whether places (n, 3) [m] are inside an obstacle, (n,) bool."""
    return _inside(case, position / case.particles.spacing)


def deep_inside(case, position):
    """Number of the obstacle that holds a place more than a spacing below its faces; -1 for none.

    position : (n, 3) float64 [m]; returns (n,) int
    """
    if not case.obstacle:
        return np.full(len(position), -1)
    return _holder(case, position / case.particles.spacing, margin=1.0)


def _block(tank, spacing, box):
    low, high = (np.round(np.array(corner) / spacing) for corner in (box.start, box.end))
    length, width = lattice.size(tank, spacing)
    flat = tank.width == 0.0
    whole_width = low[1] <= 0.0 and high[1] >= width
    if low[0] <= 0.0:
        low[0] = -np.inf
    if high[0] >= length:
        high[0] = np.inf
    if flat or whole_width or (low[1] <= 0.0 and not tank.periodic):
        low[1] = -np.inf
    if flat or whole_width or (high[1] >= width and not tank.periodic):
        high[1] = np.inf
    if box.start[2] < beds.lowest(tank.bed, box.start[0], box.end[0]) + 0.5 * spacing:
        low[2] = -np.inf
    return low, high


def cut(start, end, low, high):
    """What a block leaves of a box: boxes, as pairs of corners, cut off along x, then y, then z."""
    if any(end[k] <= low[k] or start[k] >= high[k] for k in range(3)):
        return [(start, end)]
    pieces = []
    for k in range(3):
        if start[k] < low[k]:
            pieces.append((start, (*end[:k], low[k], *end[k + 1 :])))
            start = (*start[:k], low[k], *start[k + 1 :])
        if end[k] > high[k]:
            pieces.append(((*start[:k], high[k], *start[k + 1 :]), end))
            end = (*end[:k], high[k], *end[k + 1 :])
    return pieces


def _cells(case, low, high):
    """Lattice cells of a block inside the tank, (n, 3) int."""
    length, width = lattice.size(case.tank, case.particles.spacing)
    ends = np.clip([low[0], high[0]], 0, length) * case.particles.spacing
    ground = np.floor(beds.lowest(case.tank.bed, *ends) / case.particles.spacing)
    least, most = (0, 0, ground), (length, width, np.inf)
    ranges = [np.arange(max(a, c), min(b, d)) for a, b, c, d in
              zip(low, high, least, most, strict=True)]  # fmt: skip
    return np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, 3)


def _meets_water(case, place):
    """Whether one of the lattice sites around a place has room for water, (n,) bool."""
    sites = product((-1, 0, 1), (-1, 0, 1) if case.dim == 3 else (0,), (-1, 0, 1))
    return np.any([_open(case, place + site) for site in sites], axis=0)


def _open(case, place):
    """Whether places (n, 3) [spacings] are in the tank and in no obstacle, (n,) bool."""
    length, width = lattice.size(case.tank, case.particles.spacing)
    spacing, x, y = case.particles.spacing, place[:, 0], place[:, 1]
    if case.tank.periodic:
        place = np.column_stack([x, y % width, place[:, 2]])
    in_tank = (x > 0.0) & (x < length)
    in_tank &= place[:, 2] * spacing > beds.elevation(case.tank.bed, x * spacing)
    if case.dim == 3 and not case.tank.periodic:
        in_tank &= (y > 0.0) & (y < width)
    return in_tank & ~_inside(case, place)


def _inside(case, place):
    """Whether places [spacings] are in an obstacle, or in the bed or wall behind it, (n,) bool."""
    return _holder(case, place) >= 0


def _holder(case, place, margin=0.0):
    found = np.full(len(place), -1)
    for number, (low, high) in enumerate(blocks(case)):
        found[np.all((place > low + margin) & (place < high - margin), axis=1)] = number
    return found
