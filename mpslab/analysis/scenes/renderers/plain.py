"""Draws with numpy alone: each pixel shows what is nearest to the eye.

Spheres and triangles become fragments, each a pixel, a depth and a colour, and a pixel takes the
nearest. The picture is drawn twice as large and made smaller, which smooths its edges.
"""

from dataclasses import replace

import numpy as np

from mpslab.analysis.scenes.light import lit

FINE = 2  # pixels drawn for each pixel returned, along each side
FINEST = 24  # points along a side of a triangle


def render(scene):
    """Draw a scene; see `mpslab.analysis.scenes.renderers`."""
    width, height = scene.view.size
    view = replace(scene.view, size=(FINE * width, FINE * height))
    canvas = _Canvas(view)
    for corners, colour in scene.quads:
        canvas.quad(corners, colour)
    canvas.surface(scene.points, scene.triangles, scene.point_colours)
    canvas.spheres(scene.spheres, scene.radius, scene.sphere_colours, scene.gloss)
    image = canvas.colour.reshape(height, FINE, width, FINE, 3).mean(axis=(1, 3))
    return np.round(255.0 * image).astype(np.uint8)


class _Canvas:
    """Colours and depths of the pixels.

    Attributes
    ----------
    colour : (h w, 3) float32 [0 to 1]
    depth : (h w,) float64 [m]
    """

    def __init__(self, view):
        self.view = view
        self.width, self.height = view.size
        self.colour = np.ones((self.width * self.height, 3), np.float32)
        self.depth = np.full(self.width * self.height, np.inf)

    def quad(self, corners, colour):
        """A flat quadrangle, convex, seen from the side on which it turns counter-clockwise."""
        place = self.view.project(corners)
        if not np.isfinite(place).all():
            return
        low = np.clip(np.floor(place.min(axis=0)), 0, self.view.size).astype(int)
        high = np.clip(np.ceil(place.max(axis=0)), 0, self.view.size).astype(int)
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        inside = np.ones(x.shape, bool)
        for (ax, ay), (bx, by) in zip(place, np.roll(place, -1, axis=0), strict=True):
            inside &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) <= 0.0
        x, y = x[inside], y[inside]
        normal = np.cross(corners[2] - corners[0], corners[3] - corners[1])
        start, way = self.view.rays(x, y)
        depth = (corners[0] - start) @ normal / (way @ normal)
        index = y.astype(int) * self.width + x.astype(int)
        nearer = depth < self.depth[index]
        self.depth[index[nearer]] = depth[nearer]
        self.colour[index[nearer]] = colour

    def surface(self, points, triangles, colours):
        """Triangles, each drawn as points so close together that they leave no gap."""
        if not len(triangles):
            return
        place = self.view.project(points)
        a, b, c = (place[triangles[:, k]] for k in range(3))
        turn = np.cross(np.insert(b - a, 2, 0.0, axis=1), np.insert(c - a, 2, 0.0, axis=1))[:, 2]
        triangles = triangles[turn < 0.0]  # those that face the eye: y counts down in the picture
        a, b, c = (place[triangles[:, k]] for k in range(3))
        sides = [np.abs(b - a).max(axis=1), np.abs(c - a).max(axis=1), np.abs(c - b).max(axis=1)]
        wanted = np.clip(np.ceil(np.max(sides, axis=0) * 1.2).astype(int), 1, FINEST)
        depth = self.view.depth(points)
        for number in np.unique(wanted):
            self._sampled(triangles[wanted == number], number, place, depth, colours)

    def _sampled(self, triangles, number, place, depth, colours):
        """Triangles as points at so many intervals along each side."""
        for i in range(number + 1):
            for j in range(number + 1 - i):
                shares = np.array([number - i - j, i, j]) / number
                at, far, colour = (
                    np.tensordot(shares, values[triangles], (0, 1))
                    for values in (place, depth, colours)
                )
                self._put(at, far, colour)

    def _put(self, place, depth, colour):
        """Fragments at places [pixels]."""
        x, y = np.floor(place).astype(int).T
        held = (x >= 0) & (x < self.width) & (y >= 0) & (y < self.height)
        index = y[held] * self.width + x[held]
        depth, colour = depth[held], colour[held]
        np.minimum.at(self.depth, index, depth)
        nearest = self.depth[index] == depth
        self.colour[index[nearest]] = colour[nearest]

    def spheres(self, centres, radius, colours, gloss):
        """Spheres, lit; far ones first, so that the nearest one in a pixel comes last."""
        order = np.argsort(-self.view.depth(centres))
        centres, colours = centres[order], colours[order]
        place, depth = self.view.project(centres), self.view.depth(centres)
        size = radius * self.view.pixels_per_metre(centres)
        owner = np.full(len(self.depth), -1)
        corner = np.floor(place).astype(int)
        reach = int(np.ceil(size.max(initial=0.0))) + 1
        for down in range(-reach, reach + 1):
            for right in range(-reach, reach + 1):
                self._spot(corner + np.array([right, down]), place, size, depth, radius, owner)
        seen = np.flatnonzero(owner >= 0)
        which = owner[seen]
        offset = np.column_stack([seen % self.width, seen // self.width]) + 0.5 - place[which]
        across = offset / size[which, None] * [1.0, -1.0]
        ahead = np.sqrt(np.maximum(1.0 - np.sum(across**2, axis=1), 0.0))
        self.colour[seen] = lit(colours[which], np.column_stack([across, ahead]), gloss)

    def _spot(self, pixel, place, size, depth, radius, owner):
        """One pixel of all spheres, where it lies within them."""
        offset = (pixel + 0.5 - place) / size[:, None]
        across = offset[:, 0] ** 2 + offset[:, 1] ** 2
        held = (across < 1.0) & (pixel >= 0).all(axis=1)
        held = np.flatnonzero(held & (pixel[:, 0] < self.width) & (pixel[:, 1] < self.height))
        index = pixel[held, 1] * self.width + pixel[held, 0]
        front = depth[held] - radius * np.sqrt(1.0 - across[held])
        nearer = front < self.depth[index]
        index, held, front = index[nearer], held[nearer], front[nearer]
        order = np.argsort(-front, kind="stable")
        self.depth[index[order]] = front[order]
        owner[index[order]] = held[order]
