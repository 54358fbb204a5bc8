"""A solid from a mesh of triangles, and layers of particles evenly along it.

Of each layer the particles are those of a lattice that lie in it, a spacing deep, moved onto its
middle; then they push one another along it until they stand evenly.  So each stands for a spacing
cubed of the layer.  Those on sharp edges stay where they are (`mpslab.solids.edges`).
"""

from functools import cached_property

import numpy as np

from mpslab.later import scipy
from mpslab.solids.edges import SHARP, Edges, normals_of, not_double
from mpslab.solids.shapes import turned
from mpslab.solids.surfaces import igl, volume, winding

REACH = 4.5  # spacings up to which distances are exact, if layers do not need more
PASSES, PUSH, ROUND = 32, 0.3, 2.1  # of the particles: how often, how far, from how near [spacings]
OFF = 0.05  # spacings that a particle may be off the middle of its layer
LEAST = 0.6  # spacings between particles of a layer
RAYS, STEP, FARTHEST = 1000, 0.25, 20.0  # through the solid; how they go [spacings]
SKEW = turned((20.0, 35.0, 50.0))  # of the lattice that layers begin with
FACING = -0.85  # cosine between normals of faces that look away from each other
THIN = 0.01  # share of the rays that may find it thinner


class Mesh:
    """A closed surface of triangles; see `mpslab.solids.shapes`.

    Distances are exact up to `reach`; what is farther has that distance, or more.

    Parameters
    ----------
    vertices : (n, 3) float64 [m]
    faces : (m, 3) int64
    spacing : float [m]
    layers : int
        Of particles, that there may be.
    window : (2, 3) float64 [m]
        Corners of the box out of which no particles are needed.
    """

    def __init__(self, vertices, faces, spacing, layers, window):
        self.vertices, self.faces = np.ascontiguousarray(vertices), np.ascontiguousarray(faces)
        self.spacing, self.window = spacing, np.asarray(window, float)
        self.reach = max(REACH, layers + 1.0) * spacing
        self.low, self.high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        self.volume = volume(self.vertices, self.faces)

    @cached_property
    def _tree(self):
        tree = igl.AABB()
        tree.init(self.vertices, self.faces)
        return tree

    @cached_property
    def _edges(self):
        return Edges(self.vertices, self.faces)

    @cached_property
    def _dots(self):
        """Points of the surface at most `self._fine` from any other of its points."""
        return scipy.spatial.cKDTree(_dotted(self.vertices, self.faces, self._fine))

    @property
    def _fine(self):
        return max(self.spacing, 0.005 * (self.high - self.low).max())

    def distance(self, points):
        points = np.ascontiguousarray(points, float)
        beyond = np.maximum(self.low - points, points - self.high).max(axis=1)
        out = np.maximum(beyond, self.reach)
        some = np.flatnonzero(beyond < self.reach)
        if not len(some):
            return out
        far = self._dots.query(points[some], distance_upper_bound=self.reach + self._fine)[0]
        near = some[np.isfinite(far)]
        if len(near):
            square = self._tree.squared_distance(self.vertices, self.faces, points[near])[0]
            out[near] = np.minimum(np.sqrt(square), self.reach)
        within = some[beyond[some] < 0.0]
        inside = winding(self.vertices, self.faces, points[within]) > 0.5
        out[within[inside]] *= -1.0
        return out

    @cached_property
    def thinnest(self):
        """Least distance between faces that look away from each other [m]; inf if there is more.

        Followed from points all over the surface straight in; the hundredth that finds least does
        not count, for a few triangles may be odd.
        """
        area = _areas(self.vertices, self.faces)
        share = (np.arange(RAYS) + 0.5) / RAYS
        face = np.searchsorted(np.cumsum(area) / area.sum(), share).clip(max=len(area) - 1)
        start = _inner_points(self.vertices, self.faces, face)
        inward = -self._normals[face]
        along = np.arange(0.5 * STEP, FARTHEST, STEP) * self.spacing
        places = (start[:, None] + along[:, None] * inward[:, None]).reshape(-1, 3)
        out = (winding(self.vertices, self.faces, places) < 0.5).reshape(RAYS, -1)
        first, left = out.argmax(axis=1), np.flatnonzero(out.any(axis=1))
        last = places.reshape(RAYS, -1, 3)[left, first[left]]
        end = self._tree.squared_distance(self.vertices, self.faces, last)[1]
        facing = left[-np.einsum("ij,ij->i", inward[left], self._normals[end]) < FACING]
        least = np.full(RAYS, np.inf)
        least[facing] = along[first[facing]] - 0.5 * STEP * self.spacing
        return float(np.quantile(least, THIN, method="lower"))

    @cached_property
    def _normals(self):
        return normals_of(self.vertices, self.faces)

    def layers(self, spacing, count):
        lattice = self._lattice(spacing, count)
        depth = -self.distance(lattice)
        places, layers, fixed = [np.zeros((0, 3))], [np.zeros(0, int)], [np.zeros(0, bool)]
        for k in range(count):
            free = lattice[(depth >= k * spacing) & (depth < (k + 1) * spacing)]
            middle = (k + 0.5) * spacing
            edge = self._edges.at_depth(middle, spacing, lambda points: -self.distance(points))
            free = _without_nearest(self._onto(free, np.full(len(free), middle), 4), edge)
            places += [edge, free]
            layers += [np.full(len(edge) + len(free), k)]
            fixed += [np.ones(len(edge), bool), np.zeros(len(free), bool)]
        place, layer = np.vstack(places), np.concatenate(layers)
        return self._evened(place, layer, np.concatenate(fixed), spacing)

    def _lattice(self, spacing, count):
        """Sites of a lattice in the window that may be in one of the layers, (n, 3) [m].

        It is turned, so that no face lies along it and no symmetry makes it hold too much.
        """
        low = np.maximum(self.low, self.window[0] - spacing)
        high = np.minimum(self.high, self.window[1] + spacing)
        middle, half = 0.5 * (low + high), 0.5 * np.linalg.norm(high - low)
        along = np.arange(-half, half + spacing, spacing)
        y, z = (a.ravel() for a in np.meshgrid(along, along, indexing="ij"))
        found = [np.zeros((0, 3))]
        for x in along:
            sheet = middle + np.column_stack([np.full(len(y), x), y, z]) @ SKEW.T
            sheet = sheet[np.all((sheet > low) & (sheet < high), axis=1)]
            off = self._dots.query(sheet, distance_upper_bound=count * spacing + self._fine)[0]
            found.append(sheet[np.isfinite(off)])
        return np.vstack(found)

    def _onto(self, points, depth, passes):
        """Places inside, moved to a depth (n,) [m] along the line to the nearest face."""
        for _ in range(passes if len(points) else 0):
            nearest = self._tree.squared_distance(self.vertices, self.faces, points)[2]
            inward = points - nearest
            off = np.maximum(np.linalg.norm(inward, axis=1), 1e-12)
            points = np.ascontiguousarray(nearest + inward * (depth / off)[:, None])
        return points

    def _evened(self, place, layer, fixed, spacing):
        """Particles, layers and normals, after they have pushed one another along their layers."""
        depth, apart = (layer + 0.5) * spacing, 10.0 * np.ptp(self.vertices, axis=0).max()
        free = np.flatnonzero(~fixed)
        for _ in range(PASSES):
            apart_by_layer = np.column_stack([place, layer * apart])
            pairs = scipy.spatial.cKDTree(apart_by_layer).query_pairs(
                ROUND * spacing, output_type="ndarray"
            )
            i, j = pairs.T
            offset = place[i] - place[j]
            far = np.maximum(np.linalg.norm(offset, axis=1), 1e-6 * spacing)
            push = offset * (np.square(1.0 - far / (ROUND * spacing)) / far)[:, None]
            step = np.stack([
                np.bincount(i, push[:, k], len(place)) - np.bincount(j, push[:, k], len(place))
                for k in range(3)
            ], axis=1)  # fmt: skip
            place[free] += PUSH * spacing * step[free]
            place[free] = self._onto(place[free], depth[free], 1)
        off = np.abs(-self.distance(place) - depth)
        keep = off < OFF * spacing
        keep[keep] = not_double(np.column_stack([place, layer * apart])[keep], LEAST * spacing)
        place, layer = place[keep], layer[keep]
        nearest = self._tree.squared_distance(self.vertices, self.faces, place)[2]
        out = nearest - place
        out /= np.linalg.norm(out, axis=1)[:, None]
        bend = _bend(place, out, np.column_stack([place, layer * apart]), ROUND * spacing)
        place = place + (np.clip(bend * spacing, -1.0, 1.0) * spacing / 12.0)[:, None] * out
        return place, out, layer


def _bend(place, normal, apart_by_layer, reach):
    """Sum of the two curvatures [1/m] of a layer at its particles, 0 on flat faces.

    In the middle of its volume, a layer a spacing thick is a twelfth of this times the square of
    the spacing farther out than half a spacing.  Particles beyond an edge do not count.
    """
    pairs = scipy.spatial.cKDTree(apart_by_layer).query_pairs(reach, output_type="ndarray")
    i, j = pairs[np.einsum("ij,ij->i", normal[pairs[:, 0]], normal[pairs[:, 1]]) > SHARP].T
    offset = place[i] - place[j]
    along = np.einsum("ij,ij->i", normal[i] - normal[j], offset)
    along /= np.einsum("ij,ij->i", offset, offset)
    total = np.bincount(i, along, len(place)) + np.bincount(j, along, len(place))
    count = np.bincount(i, minlength=len(place)) + np.bincount(j, minlength=len(place))
    return 2.0 * total / np.maximum(count, 1)


def _areas(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def _inner_points(vertices, faces, face):
    """A point in each of these triangles, in turn at different places."""
    golden = 0.5 * (np.sqrt(5.0) - 1.0)
    number = np.arange(len(face))
    u, v = (golden * number) % 1.0, (golden**2 * 1.7 * number) % 1.0
    u, v = np.where(u + v > 1.0, 1.0 - u, u), np.where(u + v > 1.0, 1.0 - v, v)
    u, v = 0.02 + 0.94 * u, 0.02 + 0.94 * v
    a, b, c = (vertices[faces[face, k]] for k in range(3))
    return a + u[:, None] * (b - a) + v[:, None] * (c - a)


def _dotted(vertices, faces, fine):
    """Points of triangles, no point of them farther from one than that."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    longest = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    parts = np.ceil(longest / fine).astype(int)
    found = [vertices[np.unique(faces)]]
    for n in np.unique(parts):
        i, j = np.indices((n + 1, n + 1)).reshape(2, -1)
        u, v = i[i + j <= n] / n, j[i + j <= n] / n
        rows = parts == n
        points = (a[rows, None] + u[:, None] * (b - a)[rows, None] + v[:, None]
                  * (c - a)[rows, None])  # fmt: skip
        found.append(points.reshape(-1, 3))
    return np.vstack(found)


def _without_nearest(points, others):
    """Points without the nearest one to each of some others."""
    if not len(points) or not len(others):
        return points
    number = min(len(others), len(points))
    keep = np.ones(len(points), bool)
    _, order = scipy.spatial.cKDTree(points).query(others, k=min(8, len(points)))
    for near in order.reshape(len(others), -1)[:number]:
        there = near[keep[near]]
        keep[there[:1]] = False
    return points[keep]
