"""Solids of any shape, ``[[solid]]``: layers of particles along smooth faces at any angle."""

from functools import lru_cache
from itertools import product

import numpy as np

from mpslab.core import bed as beds
from mpslab.core import lattice, motion_file
from mpslab.core.motion import oscillation
from mpslab.core.particles import FACE, FILLER
from mpslab.solids import obstacles, surfaces
from mpslab.solids.meshes import Mesh
from mpslab.solids.outlines import Circle, Polygon
from mpslab.solids.shapes import Box, Prism, Sphere, samples, turned
from mpslab.solids.solid import Solid

CLEAR = 0.5  # spacings from the water, as it is laid, to a face at the least
SAMPLES = {2: 300, 3: 60}  # along an axis, of the box around a solid
# The key that says where a solid is, if it is not its center.
PLACE = {"polygon": "points", "mesh": "file"}


def shapes(case):
    """The shapes of the solids of a case, a tuple."""
    return _shapes(case.solid, case.tank, case.particles)


@lru_cache(maxsize=4)
def _shapes(solids, tank, particles):
    return tuple(_shape(given, tank, particles, number) for number, given in enumerate(solids))


def _shape(given, tank, particles, number):
    spacing = particles.spacing
    if given.shape == "sphere":
        return Sphere(given.center, given.radius)
    if given.shape == "mesh":
        surface = surfaces.read(given.file, f"solid.{number}.file")
        return Mesh(*placed(given, surface), spacing, particles.layers, _window(tank, spacing))
    if given.shape == "box" and tank.width > 0.0:
        return Box(given.center, given.size, turned(given.rotation))
    if given.axis == "z":
        first, last = lowest(tank) - spacing, tank.height
    elif tank.width > 0.0:
        first, last = 0.0, lattice.size(tank, spacing)[1] * spacing
    else:
        return Prism(_outline(given), "y", (-np.inf, np.inf), np.zeros(1))
    low, high = (round(end / spacing) * spacing for end in given.ends or (first, last))
    rows = np.arange(round(max(low, first) / spacing), round(min(high, last) / spacing)) + 0.5
    slack = 0.5 * spacing
    ends = low if low > first + slack else -np.inf, high if high < last - slack else np.inf
    return Prism(_outline(given), given.axis, ends, rows * spacing)


def place_of(given):
    """The key of a table ``solid.NUMBER`` that says where the solid is."""
    if given.shape == "mesh" and given.center is not None:
        return "center"  # which a mesh may have
    return PLACE.get(given.shape, "center")


def lowest(tank):
    """Lowest point of the bed [m]."""
    return min(z for _, z in tank.bed)


def placed(given, surface):
    """Vertices [m] and faces of the surface of a mesh, where it is to be in the tank."""
    size = given.scale * surfaces.UNITS[given.unit]
    vertices = size * surface.vertices @ turned(given.rotation).T
    return vertices + np.array(given.center or (0.0, 0.0, 0.0)), surface.faces


def _window(tank, spacing):
    """Corners of the tank and a spacing around it, (2, 3) [m]."""
    return np.array([[-spacing, -spacing, lowest(tank) - spacing],
                     [tank.length + spacing, tank.width + spacing, tank.height]])  # fmt: skip


def _outline(given):
    if given.shape == "polygon":
        return Polygon(given.points)
    if given.shape == "box":
        sides = 0.5 * np.array(given.size) * [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
        return Polygon((given.center + sides @ turned(given.rotation).T)[:, [0, 2]])
    plane = (0, 2) if given.axis == "y" else (0, 1)
    return Circle([given.center[k] for k in plane], given.radius)


class Shaped(Solid):
    """A solid of the case; of two that overlap, the earlier one has the particles.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    number : int
        Which of ``case.solid`` it is.
    tank : mpslab.solids.tank.Tank
    """

    def __init__(self, case, number, tank):
        given = case.solid[number]
        super().__init__(given.name)
        self.case, self.number, self.tank = case, number, tank
        self.shape = shapes(case)[number]
        self.motion = motion_of(given, number)

    def particles(self, case):
        spacing = case.particles.spacing
        position, normal, layer = self.shape.layers(spacing, case.particles.layers)
        keep = _room(case, position)
        keep &= lattice.clear(case, position[:, [0, 2]], self.tank.floor[0])
        for other in shapes(case)[: self.number]:
            keep &= other.distance(position) > 0.0
        position, normal, layer = position[keep], normal[keep], layer[keep]
        face = (layer == 0) & _open(case, position + spacing * normal)
        return position, np.where(face, FACE, FILLER)

    def holds(self, points):
        return self.shape.distance(points) < 0.0


def motion_of(given, number):
    """The prescribed motion of a table ``solid.NUMBER``, None for one that has none."""
    if given.motion in ("none", "free"):
        return None
    if given.motion == "file":
        return motion_file.read(given.motion_file, f"solid.{number}.motion_file", given.about)
    return oscillation(given.motion, given.amplitude, given.period, given.start, given.about)


def holds(case, position):
    """Whether places (n, 3) [m] are inside a solid, (n,) bool."""
    found = np.zeros(len(position), bool)
    for shape in shapes(case):
        found |= shape.distance(position) < 0.0
    return found


def deep_inside(case, position):
    """Whether places (n, 3) [m] are more than a spacing inside a solid at rest, (n,) bool.

    Most are nowhere near one: a raster says so, and only of the others the distance is taken.
    """
    found = np.zeros(len(position), bool)
    for shape, given, raster in zip(shapes(case), case.solid, _rasters(case), strict=True):
        if given.motion == "none":
            rows = np.flatnonzero(raster.near(position))
            found[rows] |= shape.distance(position[rows]) < -case.particles.spacing
    return found


class Raster:
    """Cells of a shape [m] that are more than a spacing inside it, or may be.

    Parameters
    ----------
    shape : see `mpslab.solids.shapes`
    box : (2, 3) float64 [m]
        What of space is asked for.
    spacing : float [m]
    """

    def __init__(self, shape, box, spacing):
        self.low = np.maximum(shape.low, box[0])
        self.cell = 2.0 * spacing
        high = np.minimum(shape.high, box[1])
        self.size = np.maximum(np.ceil((high - self.low) / self.cell).astype(int), 1)
        grid = np.meshgrid(*(np.arange(n) + 0.5 for n in self.size), indexing="ij")
        centre = self.low + self.cell * np.stack(grid, axis=-1).reshape(-1, 3)
        half = 0.5 * np.sqrt(3.0) * self.cell
        self.inside = shape.distance(centre) < half - spacing

    def near(self, position):
        """Whether places (n, 3) [m] are in such a cell, (n,) bool."""
        index = np.floor((position - self.low) / self.cell).astype(int)
        there = np.flatnonzero(np.all((index >= 0) & (index < self.size), axis=1))
        found = np.zeros(len(position), bool)
        found[there] = self.inside[np.ravel_multi_index(index[there].T, self.size)]
        return found


def _rasters(case):
    return _made_rasters(case.solid, case.tank, case.particles)


@lru_cache(maxsize=4)
def _made_rasters(solids, tank, particles):
    box = _window(tank, particles.spacing)
    return tuple(Raster(shape, box, particles.spacing)
                 for shape in _shapes(solids, tank, particles))  # fmt: skip


@lru_cache(maxsize=8)
def _faces(shape, spacing):
    position, normal, layer = shape.layers(spacing, 1)
    position, normal = position[layer == 0], normal[layer == 0]
    return position - shape.distance(position)[:, np.newaxis] * normal


def faces(case, number):
    """Points of the face of a solid, about a spacing apart: (n, 3) [m], in the tank or not."""
    return _faces(shapes(case)[number], case.particles.spacing)


def give_way(case, water):
    """Water (n, 3) [m] outside of the solids: what is nearer than half a spacing is moved off."""
    step = 1e-3 * case.particles.spacing
    for shape in shapes(case):
        distance = shape.distance(water)
        water, distance = water[distance >= 0.0], distance[distance >= 0.0]
        near = np.flatnonzero(distance < CLEAR * case.particles.spacing)
        slope = np.column_stack([
            shape.distance(water[near] + step * axis) - distance[near] for axis in np.eye(3)
        ])  # fmt: skip
        slope[:, 1] *= case.dim == 3
        slope /= np.maximum(np.linalg.norm(slope, axis=1), 1e-9 * step)[:, None]
        far = CLEAR * case.particles.spacing - distance[near]
        water[near] += far[:, None] * slope
    return water


def cover(case, position, role):
    """Make fillers of the faces of the tank that solids at rest stand against, in place.

    position, role : (n, 3) float64 [m], (n,) int8, of the tank
    """
    still = [shape for shape, given in zip(shapes(case), case.solid, strict=True)
             if given.motion == "none"]  # fmt: skip
    spacing = case.particles.spacing
    near = np.zeros(len(position), bool)
    for shape in still:
        near |= shape.distance(position) < spacing
    rows = np.flatnonzero((role == FACE) & near)
    if len(rows):
        sites = product((-1, 0, 1), (-1, 0, 1) if case.dim == 3 else (0,), (-1, 0, 1))
        open_ = np.any(
            [_open(case, position[rows] + spacing * np.array(site)) for site in sites], axis=0
        )
        role[rows[~open_]] = FILLER


def taken(case, start, end):
    """Volume [m3], in 2-D area [m2], that the solids take of a box [m] above the bed, roughly."""
    return sum(_shares(case, shape, start, end, [0.0])[0] for shape in shapes(case))


def count(case):
    """Faces and fillers of the solids in the tank, (2,) float64, roughly."""
    spacing, layers = case.particles.spacing, case.particles.layers
    everywhere = np.full(3, -np.inf), np.full(3, np.inf)
    total = np.zeros(2)
    for shape in shapes(case):
        depths = [0.0, spacing, layers * spacing]
        whole, within, core = _shares(case, shape, *everywhere, depths)
        total += np.array([whole - within, within - core]) / spacing**case.dim
    return total


def _shares(case, shape, start, end, depths):
    """Volume of what of a shape is so far inside it [m], for each depth, in a box of the tank."""
    tank, length = case.tank, lattice.effective_length(case)
    low = np.maximum.reduce([shape.low, start, (0.0, 0.0, lowest(tank))])
    high = np.minimum.reduce([shape.high, end, (length, tank.width, tank.height)])
    axes = [0, 1, 2] if case.dim == 3 else [0, 2]
    sides = (high - low)[axes]
    if not np.all(sides > 0.0):
        return [0.0] * len(depths)
    number = SAMPLES[case.dim]
    places = samples(low, high, axes, number)
    places = places[places[:, 2] > beds.elevation(case.tank.bed, places[:, 0])]
    distance, each = shape.distance(places), np.prod(sides) / number**case.dim
    return [float(np.count_nonzero(distance < -depth) * each) for depth in depths]


def _open(case, place):
    """Whether places (n, 3) [m] are in the tank and in no obstacle or solid at rest, (n,) bool."""
    found = _room(case, place)
    for shape, given in zip(shapes(case), case.solid, strict=True):
        if given.motion == "none":
            found &= shape.distance(place) > 0.0
    return found


def _room(case, place):
    """Whether places (n, 3) [m] are between walls, above the bed and in no obstacle, (n,) bool."""
    x, y, z = place.T
    found = (x > 0.0) & (x < lattice.effective_length(case))
    if case.dim == 3 and not case.tank.periodic:
        found &= (y > 0.0) & (y < lattice.rows_across(case) * case.particles.spacing)
    return found & (z > beds.elevation(case.tank.bed, x)) & ~obstacles.holds(case, place)
