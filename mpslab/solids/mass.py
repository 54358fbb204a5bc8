"""Volume, centre and moments of inertia of shapes, by formula where there is one."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mpslab.solids.outlines import Circle, Polygon
from mpslab.solids.shapes import Prism, Sphere, samples

SAMPLES = {2: 400, 3: 100}  # along an axis, of a shape without a formula


@dataclass(frozen=True)
class Bulk:
    """A shape as a body of density 1.

    Attributes
    ----------
    volume : float [m3]
        In 2-D of a slice 1 m wide.
    center : (3,) float64 [m]
    inertia : (3, 3) float64 [m5]
        About the centre; in 2-D its entry (1, 1) is all that counts.
    """

    volume: float
    center: np.ndarray
    inertia: np.ndarray


@lru_cache(maxsize=8)
def bulk(shape, dim):
    """The `Bulk` of a shape (`mpslab.solids.shapes`) in so many dimensions."""
    if isinstance(shape, Sphere):
        return _sphere(shape)
    if isinstance(shape, Prism) and isinstance(shape.outline, Circle | Polygon):
        return _prism(shape, dim)
    return _sampled(shape, dim)


def _sphere(shape):
    moment = 0.4 * shape.volume * shape.radius**2
    return Bulk(shape.volume, shape.center, moment * np.eye(3))


def _prism(shape, dim):
    area, center, second = _plane(shape.outline)
    length, middle = 1.0, 0.0
    if dim == 3:
        length, middle = shape.ends[1] - shape.ends[0], 0.5 * (shape.ends[0] + shape.ends[1])
    moments = np.zeros((3, 3))
    moments[np.ix_(shape.plane, shape.plane)] = length * second
    moments[shape.along, shape.along] = area * length**3 / 12.0
    place = np.full(3, middle)
    place[list(shape.plane)] = center
    return Bulk(area * length, place, _inertia(moments))


def _inertia(moments):
    """Inertia (3, 3) of second moments of mass, the integrals of x_i x_j."""
    return np.trace(moments) * np.eye(3) - moments


def _plane(outline):
    """Area, centre (2,) and second moments (2, 2) about it of an outline."""
    if isinstance(outline, Circle):
        second = 0.25 * outline.area * outline.radius**2
        return outline.area, outline.center, second * np.eye(2)
    return _polygon(outline.corners)


def _polygon(corners):
    """As `_plane`, by Green's theorem: sums over the triangles of the sides with a corner."""
    origin = corners[0]
    a = corners - origin
    b = np.roll(a, -1, axis=0)
    twice = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    area = 0.5 * np.sum(twice)
    center = np.sum(twice[:, None] * (a + b), axis=0) / (6.0 * area)
    outer = [p[:, :, None] * q[:, None, :] for p, q in ((a, a), (a, b), (b, a), (b, b))]
    pairs = twice[:, None, None] * (2.0 * outer[0] + outer[1] + outer[2] + 2.0 * outer[3])
    second = np.sum(pairs, axis=0) / 24.0 - area * np.outer(center, center)
    return area, center + origin, second


def _sampled(shape, dim):
    """By the places of a fine grid that are inside, which `shape.distance` tells."""
    axes = [0, 1, 2] if dim == 3 else [0, 2]
    sides = np.zeros(3)
    sides[axes] = (shape.high - shape.low)[axes]
    places = samples(shape.low, shape.high, axes, SAMPLES[dim])
    places = places[shape.distance(places) < 0.0]
    cell = float(np.prod(sides[axes] / SAMPLES[dim]))
    center = places.mean(axis=0)
    arm = places - center
    moments = cell * np.array([[np.sum(arm[:, i] * arm[:, j]) for j in range(3)] for i in range(3)])
    moments[np.diag_indices(3)] += cell * len(places) * (sides / SAMPLES[dim]) ** 2 / 12.0
    return Bulk(cell * len(places), center, _inertia(moments))
