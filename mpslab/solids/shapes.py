"""Shapes of solids in space: how far a place is from them, and layers of particles inside.

A shape has

    distance(points) -> (n,) float64 [m]
        Of places (n, 3) [m], negative inside.
    layers(spacing, count) -> position (m, 3) [m], normal (m, 3), layer (m,) int
        Particles about a spacing apart, layer k lying (k + 1/2) spacings inside; and the direction
        out of the shape. In a sphere, as in a circle, a layer lies where the middle of its volume
        is, a little farther out.
    low, high : (3,) float64 [m]
        The corners of what it covers; infinite along an axis on which it has no end.
    thinnest : float [m]
        As of an outline (`mpslab.solids.outlines`).
    volume : float [m3]
        Of all of it, in the tank or not; of a prism in 2-D the area [m2].
"""

import numpy as np

GOLDEN = np.pi * (3.0 - np.sqrt(5.0))  # angle from particle to particle of a spiral on a sphere
PLANE = {"y": (0, 2), "z": (0, 1)}  # axes across the axis of a prism
INDEX = {"y": 1, "z": 2}


def samples(low, high, axes, number):
    """Middles of number^k equal cells of a box between corners (3,) [m], (number^k, 3) [m].

    axes : the k axes along which it reaches; along the others the places are at 0
    """
    share = (np.arange(number) + 0.5) / number
    grid = np.meshgrid(*(share for _ in axes), indexing="ij")
    places = np.zeros((number ** len(axes), 3))
    cells = np.column_stack([one.ravel() for one in grid])
    places[:, axes] = low[axes] + cells * (high - low)[axes]
    return places


def turned(angles):
    """Matrix (3, 3) that turns about x, then y, then z by angles [deg], each right-handed."""
    (a, b, c), (s, t, u) = np.cos(np.radians(angles)), np.sin(np.radians(angles))
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, a, -s], [0.0, s, a]])
    about_y = np.array([[b, 0.0, t], [0.0, 1.0, 0.0], [-t, 0.0, b]])
    about_z = np.array([[c, -u, 0.0], [u, c, 0.0], [0.0, 0.0, 1.0]])
    return about_z @ about_y @ about_x


class Prism:
    """An outline, drawn out along an axis.

    Parameters
    ----------
    outline : see `mpslab.solids.outlines`
        In x and z for axis "y", in x and y for axis "z".
    axis : str
    ends : (float, float) [m]
        Where it ends; infinite for where it goes on into a wall or the bed.
    rows : (n,) float64 [m]
        Where along the axis its particles are to be.
    """

    def __init__(self, outline, axis, ends, rows):
        self.outline, self.ends, self.rows = outline, np.asarray(ends, float), rows
        self.plane, self.along = PLANE[axis], INDEX[axis]
        self.low, self.high = np.full(3, ends[0]), np.full(3, ends[1])
        self.low[list(self.plane)], self.high[list(self.plane)] = outline.low, outline.high

    @property
    def thinnest(self):
        return min(self.outline.thinnest, self.ends[1] - self.ends[0])

    @property
    def volume(self):
        low, high = self.ends
        pitch = self.rows[1] - self.rows[0] if len(self.rows) > 1 else 1.0
        low = low if np.isfinite(low) else self.rows[0] - 0.5 * pitch
        high = high if np.isfinite(high) else self.rows[-1] + 0.5 * pitch
        return self.outline.area * (high - low)

    def distance(self, points):
        across = self.outline.distance(points[:, self.plane])
        beyond = np.maximum(self.ends[0] - points[:, self.along],
                            points[:, self.along] - self.ends[1])  # fmt: skip
        outside = np.hypot(np.maximum(across, 0.0), np.maximum(beyond, 0.0))
        return np.where(outside > 0.0, outside, np.maximum(across, beyond))

    def layers(self, spacing, count):
        whole = int(np.ceil(0.5 * (self.outline.high - self.outline.low).min() / spacing)) + 1
        rings = [self.outline.ring((k + 0.5) * spacing, spacing) for k in range(max(whole, count))]
        found = []
        for place in self.rows:
            off = min(place - self.ends[0], self.ends[1] - place)
            row = int(off / spacing) if np.isfinite(off) else count
            up = np.zeros(3)
            up[self.along] = 1.0 if place - self.ends[0] > self.ends[1] - place else -1.0
            for k, (points, normals) in enumerate(rings[: whole if row < count else count]):
                position, normal = np.full((len(points), 3), place), np.zeros((len(points), 3))
                position[:, self.plane], normal[:, self.plane] = points, normals
                if row < k:
                    normal[:] = up
                elif row == k:
                    normal = (normal + up) / np.sqrt(2.0)
                found.append((position, normal, np.full(len(points), min(k, row))))
        return _stacked(found)


class Box:
    """A box of a size (3,) [m] about a centre (3,) [m], turned by a matrix (3, 3)."""

    def __init__(self, center, size, turn):
        self.center, self.turn = np.asarray(center, float), turn
        self.half = 0.5 * np.asarray(size, float)
        reach = np.abs(turn) @ self.half
        self.low, self.high = self.center - reach, self.center + reach
        self.thinnest, self.volume = float(min(size)), float(np.prod(size))

    def distance(self, points):
        beyond = np.abs((points - self.center) @ self.turn) - self.half
        outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
        return np.where(outside > 0.0, outside, beyond.max(axis=1))

    def layers(self, spacing, count):
        found = []
        for k in range(count):
            half = self.half - (k + 0.5) * spacing
            if half.min() < -0.25 * spacing:
                break
            parts = np.maximum(np.round(2.0 * half / spacing), 1.0) * (half > 0.25 * spacing)
            number = np.indices(parts.astype(int) + 1).reshape(3, -1).T
            first, last = number == 0, number == parts
            shell = np.any(first | last, axis=1)
            out = (last.astype(float) - first)[shell]
            share = 2.0 * number[shell] / np.maximum(parts, 1) - (parts > 0)
            place = share * np.maximum(half, 0.0)
            out /= np.maximum(np.linalg.norm(out, axis=1), 1.0)[:, None]
            found.append((self.center + place @ self.turn.T, out @ self.turn.T,
                          np.full(len(place), k)))  # fmt: skip
        return _stacked(found)


class Sphere:
    """A sphere of a radius [m] about a centre (3,) [m]."""

    def __init__(self, center, radius):
        self.center, self.radius = np.asarray(center, float), radius
        self.low, self.high = self.center - radius, self.center + radius
        self.thinnest, self.volume = 2.0 * radius, 4.0 / 3.0 * np.pi * radius**3

    def distance(self, points):
        return np.linalg.norm(points - self.center, axis=1) - self.radius

    def layers(self, spacing, count):
        found = []
        for k in range(count):
            outer = self.radius - k * spacing
            if outer < 0.25 * spacing:
                break
            inner = max(outer - spacing, 0.0)
            number = max(round(4.0 / 3.0 * np.pi * (outer**3 - inner**3) / spacing**3), 1)
            radius = 0.75 * (outer**4 - inner**4) / (outer**3 - inner**3) if number > 1 else 0.0
            turn, up = GOLDEN * np.arange(number), 1.0 - (2.0 * np.arange(number) + 1.0) / number
            flat = np.sqrt(1.0 - up**2)
            out = np.column_stack([flat * np.cos(turn), flat * np.sin(turn), up])
            position = self.center + radius * out
            found.append((position, out, np.full(number, k)))
        return _stacked(found)


def _stacked(found):
    positions, normals, layers = zip(*found, strict=True)
    return np.vstack(positions), np.vstack(normals), np.concatenate(layers)
