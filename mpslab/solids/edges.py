"""Sharp edges of a surface of triangles, and where they lie at a depth inside it.

At a depth the faces beside an edge that points outwards meet on a line of its own; particles that
stand on this line keep the edge sharp.
"""

import numpy as np

from mpslab.later import scipy
from mpslab.solids.surfaces import neighbours

SHARP = np.cos(np.radians(35.0))  # of the angle between the normals
STRAIGHT = np.cos(np.radians(35.0))  # of the angle in which an edge goes on
FINE = 8  # points to a spacing


def normals_of(vertices, faces):
    """Outward unit normals of triangles, (m, 3)."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    out = np.cross(b - a, c - a)
    return out / np.linalg.norm(out, axis=1)[:, None]


class Edges:
    """The sharp edges of a surface that point outwards.

    Parameters
    ----------
    vertices : (n, 3) float64 [m]
    faces : (m, 3) int
    """

    def __init__(self, vertices, faces):
        normal = normals_of(vertices, faces)
        pairs, sides, _ = neighbours(faces)
        one, two = (normal[pairs[:, k]] for k in range(2))
        middle = vertices[faces].mean(axis=1)
        outward = np.einsum("ij,ij->i", one, middle[pairs[:, 1]] - vertices[sides[:, 0]]) < 0.0
        sharp = (np.einsum("ij,ij->i", one, two) < SHARP) & outward
        self.vertices, self.faces, self.normal = vertices, faces, normal
        self.sides, self.beside = sides[sharp], np.stack([one, two], axis=1)[sharp]
        self.chains = list(self._chains())

    def _chains(self):
        """Edges that go on in one another: lists of (number of the side, whether it is turned)."""
        at, left = {}, set(range(len(self.sides)))
        for number, side in enumerate(self.sides):
            for vertex in side:
                at.setdefault(int(vertex), []).append(number)
        step = self.vertices[self.sides[:, 1]] - self.vertices[self.sides[:, 0]]
        step /= np.linalg.norm(step, axis=1)[:, None]

        def through(vertex):
            """Whether an edge goes on there."""
            if len(at[vertex]) != 2:
                return False
            way = [step[k] * (1.0 if self.sides[k, 1] == vertex else -1.0) for k in at[vertex]]
            return -way[0] @ way[1] > STRAIGHT

        ends = [(v, k) for v, numbers in at.items() if not through(v) for k in numbers]
        for vertex, number in [*ends, *((int(side[0]), k) for k, side in enumerate(self.sides))]:
            chain = []
            while number in left:
                left.discard(number)
                turned = self.sides[number, 0] != vertex
                chain.append((number, bool(turned)))
                vertex = int(self.sides[number, 0 if turned else 1])
                if through(vertex):
                    number = next((k for k in at[vertex] if k in left), number)
            if chain:
                yield chain

    def at_depth(self, depth, spacing, depth_of):
        """Particles on the lines of the edges so far inside, and on their corners, (n, 3) [m].

        depth_of : (n, 3) -> (n,) [m]
        """
        found = [np.zeros((0, 3))]
        for chain in self.chains:
            line = self._line(chain, depth, spacing)
            line = line[np.abs(depth_of(line) - depth) < 0.02 * spacing]
            step = np.linalg.norm(np.diff(line, axis=0), axis=1)
            pieces = np.split(line, np.flatnonzero(step > 0.5 * spacing) + 1)
            found += [_spread(piece, spacing) for piece in pieces if len(piece)]
        found = np.vstack(found)
        return found[not_double(found, 0.5 * spacing)]

    def _line(self, chain, depth, spacing):
        """Points of a chain at a depth, close to one another, from corner to corner."""
        ends, points = [], []
        for number, turned in chain:
            a, b = self.vertices[self.sides[number]][:: -1 if turned else 1]
            one, two = self.beside[number]
            inward = -depth * (one + two) / max(1.0 + one @ two, 1e-3)
            count = max(round(FINE * np.linalg.norm(b - a) / spacing), 1)
            share = ((np.arange(count) + 0.5) / count)[:, None]
            points.append(a + share * (b - a) + inward)
            ends += list(self.sides[number][:: -1 if turned else 1])
        first, last = (self._corner(vertex, depth) for vertex in (ends[0], ends[-1]))
        return np.vstack([first, *points, last])

    def _corner(self, vertex, depth):
        """Where the faces around a vertex meet at a depth, (1, 3)."""
        around = self.normal[np.any(self.faces == vertex, axis=1)]
        step = np.linalg.lstsq(around, np.full(len(around), -depth), rcond=0.05)[0]
        return (self.vertices[vertex] + step)[None]


def _spread(line, spacing):
    """Points evenly along a line of close points, both ends among them."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    count = round(along[-1] / spacing)
    where = np.linspace(0.0, along[-1], count + 1) if count else [0.5 * along[-1]]
    return np.column_stack([np.interp(where, along, line[:, k]) for k in range(3)])


def not_double(points, close):
    """Mask of points (n, k) without the later one of two that are closer than that, (n,) bool."""
    keep = np.ones(len(points), bool)
    pairs = scipy.spatial.cKDTree(points).query_pairs(close, output_type="ndarray")
    for i, j in pairs[np.lexsort(pairs.T[::-1])]:
        keep[j] &= not keep[i]
    return keep
