"""Surfaces of triangles, read from STL, OBJ or PLY files, and judged: can this be a solid?

What can be mended without a guess is mended: triangles without area or given twice are left out,
triangles that face another way than their neighbours are turned, and so is a surface inside out;
each hole is closed by a fan of triangles about its middle.  Inside is where the winding number is
above a half, so surfaces may cut themselves and each other.
"""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from mpslab.core.files import is_file, stamp
from mpslab.core.keys import CaseError, require
from mpslab.later import Later, scipy

trimesh, igl = Later("trimesh"), Later("igl")

SUFFIXES = (".stl", ".obj", ".ply")
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}  # [m]
INSTALL = "pip install 'mpslab[stl]'"
BELOW, MOST_BELOW = 0.1, 1000  # sides of triangles, and how many of these are looked under
LOOK = 24  # points along the longest side of a surface, where its winding number is looked at
DOUBTFUL = (0.2, 0.8)  # winding numbers that are neither inside nor outside


@dataclass(frozen=True, eq=False)
class Surface:
    """A closed surface.

    Attributes
    ----------
    vertices : (n, 3) float64
        In the unit of the file.
    faces : (m, 3) int64
        Numbers of the vertices of each triangle, anticlockwise as seen from outside.
    notes : tuple of str
        What was mended, a few words each.
    doubtful : float
        Share of the space around it where the winding number of the open surface is neither near 0
        nor near 1.
    """

    vertices: np.ndarray
    faces: np.ndarray
    notes: tuple
    doubtful: float


def read(path, key):
    """The surface in a file.

    Parameters
    ----------
    path : str
    key : str
        That names the file, for messages.

    Raises
    ------
    CaseError
        If the file cannot be read, or the packages for it are not installed.
    """
    rule = f"a file that exists, {', '.join(SUFFIXES)}"
    fits = Path(path).suffix.lower() in SUFFIXES and is_file(path)
    require(fits, key, path, rule)
    try:
        trimesh.Trimesh, igl.AABB  # noqa: B018
    except ImportError as error:
        raise CaseError(
            f"{key} = {path!r}: must wait until {error.name} is installed: {INSTALL}"
        ) from None
    try:
        return _read(path, stamp(path))
    except (ValueError, OSError, KeyError, IndexError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise CaseError(f"{key} = {path!r}: cannot be read as triangles ({reason})") from error


@lru_cache(maxsize=8)
def _read(path, _):
    mesh = trimesh.load_mesh(path, process=False, skip_materials=True)
    vertices, faces = np.array(mesh.vertices, float), np.array(mesh.faces, np.int64)
    if not len(faces) or not np.isfinite(vertices).all():
        raise ValueError("no triangles, or corners that are no numbers")
    return closed(vertices, faces)


def closed(vertices, faces):
    """The `Surface` of triangles, mended."""
    notes, count = [], len(faces)
    vertices, faces = _joined(vertices, faces)
    if len(faces) < count:
        notes.append(f"{count - len(faces):,} triangles without area, or given twice, left out")
    if not len(faces):
        raise ValueError("no triangles with an area")
    faces, turned = _wound(faces)
    if turned:
        notes.append(f"{turned:,} triangles turned as their neighbours face")
    if volume(vertices, faces) < 0.0:
        faces = faces[:, ::-1].copy()
        notes.append("was inside out")
    doubtful = _doubtful(vertices, faces)
    vertices, faces, holes = _filled(vertices, faces)
    if holes:
        notes.append(f"{holes:,} holes closed" if holes > 1 else "a hole closed")
    return Surface(vertices, faces, tuple(notes), doubtful)


def winding(vertices, faces, points):
    """Winding number about places (n, 3), (n,) float64: 1 inside, 0 outside."""
    if not len(points):
        return np.zeros(0)
    return igl.fast_winding_number(vertices, faces, np.ascontiguousarray(points, float))


def _joined(vertices, faces):
    """One vertex for those in one place; without triangles that have no area, or come twice."""
    size = np.ptp(vertices, axis=0).max() or 1.0
    place = np.round((vertices - vertices.min(axis=0)) / (1e-7 * size)).astype(np.int64)
    _, first, number = np.unique(place, axis=0, return_index=True, return_inverse=True)
    vertices, faces = vertices[first], number.ravel()[faces]
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    faces = faces[area > 1e-14 * size**2]
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    return vertices, np.ascontiguousarray(faces[np.sort(first)])


def neighbours(faces):
    """Pairs of triangles with a side that only these two share.

    Returns
    -------
    pairs : (k, 2) int
    sides : (k, 2) int
        The vertices of the side, in the order that the first triangle has them.
    alike : (k,) bool
        Whether both have them in one order, and so face opposite ways.
    """
    side = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    both = np.sort(side, axis=1)
    order = np.lexsort(both.T)
    same = np.all(both[order[1:]] == both[order[:-1]], axis=1)
    alone = same & ~np.append(same[1:], False) & ~np.append(False, same[:-1])
    one, two = order[:-1][alone], order[1:][alone]
    alike = side[one, 0] == side[two, 0]
    return np.column_stack([one, two]) // 3, side[one], alike


def _wound(faces):
    """The triangles of each piece facing as the most of them do, and how many were turned."""
    pairs, _, alike = neighbours(faces)
    if not alike.any():
        return faces, 0
    graph = scipy.sparse.coo_array((alike + 1.0, pairs.T), (len(faces), len(faces))).tocsr()
    graph = graph + graph.T
    count, piece = scipy.sparse.csgraph.connected_components(graph, directed=False)
    turn = np.zeros(len(faces), bool)
    for root in np.unique(piece, return_index=True)[1]:
        order, parent = scipy.sparse.csgraph.breadth_first_order(graph, root, directed=False)
        for face in order[1:]:
            turn[face] = turn[parent[face]] ^ (graph[parent[face], face] == 2.0)
    most = np.bincount(piece, turn, minlength=count) * 2 > np.bincount(piece, minlength=count)
    turn ^= most[piece]
    faces = faces.copy()
    faces[turn] = faces[turn, ::-1]
    return faces, int(turn.sum())


def volume(vertices, faces):
    """Volume inside a closed surface; what several of its parts hold counts several times."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a - vertices[0], np.cross(b - a, c - a)).sum() / 6.0)


def _doubtful(vertices, faces):
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    step = (high - low).max() / LOOK
    axes = [np.arange(a + 0.5 * step, b, step) if b - a > step else [0.5 * (a + b)]
            for a, b in zip(low, high, strict=True)]  # fmt: skip
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = winding(vertices, faces, grid)
    if not (number >= 0.5).any():  # pieces that are far apart, between the points of the grid
        number = winding(vertices, faces, _just_inside(vertices, faces))
    unsure = (number > DOUBTFUL[0]) & (number < DOUBTFUL[1])
    if not (number >= 0.5).any():
        return 1.0
    return float(unsure.sum() / (number > DOUBTFUL[0]).sum())


def _just_inside(vertices, faces):
    """Places a little below triangles, (k, 3)."""
    some = faces[:: len(faces) // MOST_BELOW + 1]
    a, b, c = (vertices[some[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)  # as long as twice the area
    size = np.sqrt(np.linalg.norm(normal, axis=1, keepdims=True))
    return (a + b + c) / 3.0 - BELOW * normal / size


def _filled(vertices, faces):
    """Holes closed by a fan about the middle of each edge, and how many there were."""
    side = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    n = len(vertices)
    ahead = scipy.sparse.coo_array((np.ones(len(side)), side.T), (n, n)).tocsr()
    open_ = (ahead - ahead.T).tocoo()
    keep = open_.data > 0.0
    start, end = open_.row[keep], open_.col[keep]
    if not len(start):
        return vertices, faces, 0
    graph = scipy.sparse.coo_array((np.ones(len(start)), (start, end)), (n, n))
    _, piece = scipy.sparse.csgraph.connected_components(graph, directed=False)
    holes, hole = np.unique(piece[start], return_inverse=True)
    weight = np.bincount(hole)[:, None]
    middle = np.zeros((len(holes), 3))
    np.add.at(middle, hole, 0.5 * (vertices[start] + vertices[end]))
    fans = np.column_stack([end, start, n + hole])
    return np.vstack([vertices, middle / weight]), np.vstack([faces, fans]), len(holes)
