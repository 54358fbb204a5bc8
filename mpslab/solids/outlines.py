"""Outlines of solids in a plane: how far a place is from them, and rings of particles inside.

An outline has

    distance(points) -> (n,) float64 [m]
        Of places (n, 2) [m], negative inside.
    ring(depth, spacing) -> points (m, 2) [m], normals (m, 2)
        Particles about a spacing apart on the line so far inside, and the directions out of it. In
        a circle they stand in the middle of the area that they stand for, a little farther out.
    low, high : (2,) float64 [m]
        The corners of what it covers.
    area : float [m2]
    thinnest : float [m]
        Least distance across it, between sides that do not meet in a corner; of a triangle the
        diameter of the circle inside it.
"""

from functools import cached_property

import numpy as np

from mpslab.later import scipy

SAME = 0.5  # spacings: nearer than this, two particles of a ring are one
EXACT = 1e-9  # of a length


class Circle:
    """A circle of a radius [m] about a centre (2,) [m]."""

    def __init__(self, center, radius):
        self.center, self.radius = np.asarray(center, float), radius
        self.low, self.high = self.center - radius, self.center + radius
        self.thinnest, self.area = 2.0 * radius, np.pi * radius**2

    def distance(self, points):
        return np.hypot(*(points - self.center).T) - self.radius

    def ring(self, depth, spacing):
        radius = self.radius - depth
        if radius < 0.25 * spacing:
            count = int(radius > -0.25 * spacing)
            return self.center + np.zeros((count, 2)), np.zeros((count, 2))
        # Where the middle of the area of a ring is that is a spacing wide.
        outer, inner = radius + 0.5 * spacing, max(radius - 0.5 * spacing, 0.0)
        radius = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2)
        angle = 2.0 * np.pi * _parts(2.0 * np.pi * radius / spacing)
        out = np.column_stack([np.cos(angle), np.sin(angle)])
        return self.center + radius * out, out


class Polygon:
    """A closed polygon without crossings, of corners (n, 2) [m] in either sense."""

    def __init__(self, corners):
        corners = np.asarray(corners, float)
        self.corners = corners if _area(corners) > 0.0 else corners[::-1]
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.area = abs(_area(corners))

    @cached_property
    def _sides(self):
        """Starts (n, 2), unit vectors (n, 2), lengths (n,) and outward normals of the sides."""
        step = np.roll(self.corners, -1, axis=0) - self.corners
        length = np.hypot(*step.T)
        along = step / length[:, None]
        return self.corners, along, length, np.column_stack([along[:, 1], -along[:, 0]])

    def distance(self, points):
        least, inside = np.full(len(points), np.inf), np.zeros(len(points), bool)
        x, z = np.asarray(points, float).T
        for (x0, z0), (ax, az), length, _ in zip(*self._sides, strict=True):
            t = np.clip((x - x0) * ax + (z - z0) * az, 0.0, length)
            np.minimum(least, np.hypot(x - x0 - t * ax, z - z0 - t * az), out=least)
            z1 = z0 + length * az
            crosses = (z0 > z) != (z1 > z)
            if crosses.any():  # of a ray along x, from the place on
                inside ^= crosses & (x < x0 + ax / (az or 1.0) * (z - z0))
        return np.where(inside, -least, least)

    def ring(self, depth, spacing):
        start, along, length, normal = self._sides
        before = np.roll(along, 1, axis=0)
        turn = np.arctan2(before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0],
                          np.sum(before * along, axis=1))  # fmt: skip
        # A side begins and ends, at this depth, where the lines beside it cut it; at a corner that
        # points inwards it is whole, and an arc goes on to the next.
        cut = depth * np.tan(np.maximum(turn, 0.0) / 2.0)
        points, normals = [np.zeros((0, 2))], [np.zeros((0, 2))]
        for k in range(len(start)):
            first, last = cut[k], length[k] - cut[(k + 1) % len(start)]
            if last < first - EXACT * length[k]:
                continue
            where = first + (last - first) * _parts((last - first) / spacing, ends=True)
            points.append(start[k] - depth * normal[k] + np.outer(where, along[k]))
            normals.append(np.broadcast_to(normal[k], points[-1].shape))
            if turn[k] < 0.0:
                angle = turn[k] * _parts(-turn[k] * depth / spacing, ends=True)[1:-1]
                back = np.arctan2(*normal[k - 1][::-1]) + angle
                out = np.column_stack([np.cos(back), np.sin(back)])
                points.append(start[k] - depth * out)
                normals.append(out)
        points, normals = np.vstack(points), np.vstack(normals)
        there = np.abs(self.distance(points) + depth) < EXACT * np.ptp(self.corners)
        return _merged(points[there], normals[there], SAME * spacing)

    @cached_property
    def thinnest(self):
        """Along the normals of the sides to the next side that does not share a corner [m]."""
        start, along, length, normal = self._sides
        if len(start) == 3:
            return 4.0 * self.area / float(length.sum())
        least = np.inf
        for k in range(len(start)):
            for share in (0.02, 0.25, 0.5, 0.75, 0.98):
                point = start[k] + share * length[k] * along[k]
                for j in range(len(start)):
                    if (j - k) % len(start) in (0, 1, len(start) - 1):
                        continue
                    least = min(least, _reach(point, -normal[k], start[j], along[j], length[j]))
        return least


def _parts(ratio, ends=False):
    """Even shares of 0 to 1 as many as a ratio says: their starts, or with both ends."""
    count = max(round(float(ratio)), 1)
    return np.arange(count + ends) / count


def _area(corners):
    x, z = corners.T
    return 0.5 * float(np.sum(x * np.roll(z, -1) - np.roll(x, -1) * z))


def _reach(point, direction, start, along, length):
    """How far a ray goes until it meets a side [m]; inf if it does not."""
    crossing = direction[0] * along[1] - direction[1] * along[0]
    if abs(crossing) < EXACT:
        return np.inf
    gap = start - point
    far = (gap[0] * along[1] - gap[1] * along[0]) / crossing
    at = (gap[0] * direction[1] - gap[1] * direction[0]) / crossing
    return far if far > 0.0 and 0.0 <= at <= length else np.inf


def _merged(points, normals, close):
    """One particle for those that come closer than that, with the mean of their normals."""
    if not len(points):
        return points, normals
    pairs = scipy.spatial.cKDTree(points).query_pairs(close, output_type="ndarray")
    joined = scipy.sparse.coo_array((np.ones(len(pairs)), pairs.T), (len(points), len(points)))
    count, group = scipy.sparse.csgraph.connected_components(joined, directed=False)
    size = np.bincount(group, minlength=count)[:, None]
    place, out = np.zeros((count, 2)), np.zeros((count, 2))
    np.add.at(place, group, points)
    np.add.at(out, group, normals)
    return place / size, out / np.maximum(np.hypot(*out.T), EXACT)[:, None]
