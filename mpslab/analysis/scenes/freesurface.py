"""The surface of the water of a frame, as a closed mesh of triangles.

The particles are smoothed onto a grid: the colour function c, the share of water around a node, is
1 deep in the water, 0 in the air and 1/2 half a spacing off the outermost particles, where the
water ends. The level surface c = 1/2 is found cell by cell: there is a vertex in each cell that it
passes, at the mean of the points where it cuts the cell's edges, and a quadrangle around each edge
that it cuts.

A sheet one particle thick has a surface. Lone drops and threads have none (c stays below 1/2):
they count as spray, and are drawn as particles.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

LEVEL = 0.5
NODES = 2  # of the grid, for each spacing
# Standard deviation of the kernel [spacings], which is a Gaussian up to REACH: narrower ones show
# the particles, wider ones lose thin sheets (c = 0.66 within one).
SMOOTHING, REACH = 0.6, 2.0
AHEAD = (1.5, 3.0, 4.5, 6.0)  # spacings in front of a point, where water is looked for
CORNERS = np.array(list(product((0, 1), repeat=3)))
EDGES = [(a, b) for a, b in product(range(8), repeat=2) if np.sum(CORNERS[b] - CORNERS[a]) == 1
         and np.abs(CORNERS[b] - CORNERS[a]).sum() == 1]  # fmt: skip


@dataclass(frozen=True)
class FreeSurface:
    """A closed surface; seen from outside, its triangles turn counter-clockwise.

    Attributes
    ----------
    points : (n, 3) float64 [m]
    triangles : (m, 3) int64
        Numbers of the corners.
    normals : (n, 3) float64 [-]
        Unit normals at the points, out of the water.
    values : (n,) float64, or None
        At the points, from the particles around.
    openness : (n,) float64 [-]
        1 where nothing lies in front of a point; the more water does, as below a jet, the nearer to
        0.
    spray : (n_particles,) bool
        Particles that the surface does not hold.
    """

    points: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    values: np.ndarray | None
    openness: np.ndarray
    spray: np.ndarray

    @property
    def area(self):
        """Area of the surface [m2]."""
        a, b, c = self._corners()
        return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())

    @property
    def volume(self):
        """Volume that the surface encloses [m3]."""
        a, b, c = self._corners()
        return float(np.sum(a * np.cross(b, c))) / 6.0

    def _corners(self):
        return (self.points[self.triangles[:, k]] for k in range(3))


def find_surface(position, spacing, values=None, period=0.0, window=None, bed=None):
    """The free surface of water particles.

    Parameters
    ----------
    position : (n, 3) array_like [m]
        Water particles of a frame in 3-D.
    spacing : float [m]
    values : (n,) array_like, optional
        A field of the particles, to be carried over to the surface.
    period : float [m]
        Period across the tank (y): the water is cut open at y = 0 and there; 0 with side walls.
    window : (float, float) [m], optional
        Water farther left or right is cut off.
    bed : sequence of (x, z) [m], optional
        x ascending; the water reaches right down to it.

    Returns
    -------
    FreeSurface
        With no points if there is no water in the window.

    Raises
    ------
    ValueError
        If positions or values have another shape, or spacing or window is not above 0.
    """
    position = np.asarray(position, float)
    _check(position, spacing, values, window)
    grid = _Grid(position, spacing, period, window)
    near = grid.sees(position)
    held, source = _mirrored(position[near], spacing, bed)
    share = grid.smooth(held, np.full(len(held), spacing**3))
    spray = np.ones(len(position), bool)
    spray[near] = grid.at(share, position[near]) < LEVEL
    closed = grid.closed(share)
    points, triangles, normals = _net(closed, grid.cut)
    carried = None
    if values is not None:
        weights = spacing**3 * np.asarray(values, float)[near][source]
        carried = _at(grid.smooth(held, weights), points - 1)
        carried /= np.maximum(_at(share, points - 1), 1e-3)
    before = [_at(closed, points + NODES * ahead * normals, "constant") for ahead in AHEAD]
    openness = np.clip(1.0 - np.mean(before, axis=0), 0.0, 1.0)
    place = grid.low + (points - 1) * grid.step
    if bed is not None:
        place[:, 2] = np.maximum(place[:, 2], np.interp(place[:, 0], *np.transpose(bed)))
    return FreeSurface(place, triangles, normals, carried, openness, spray)


def _check(position, spacing, values, window):
    if position.ndim != 2 or position.shape[1] != 3:
        raise ValueError(f"position: shape {position.shape}; must be (n, 3)")
    if not spacing > 0.0:
        raise ValueError(f"spacing = {spacing:g} m: must be > 0")
    if values is not None and np.shape(values) != (len(position),):
        raise ValueError(f"values: shape {np.shape(values)}; must be ({len(position)},)")
    if window is not None and not window[0] < window[1]:
        raise ValueError(f"window = {window[0]:g} to {window[1]:g} m: must have a width above 0")


def _mirrored(position, spacing, bed):
    """Water and its image in the bed, as if it went on below; and whose image each particle is."""
    every = np.arange(len(position))
    if bed is None:
        return position, every
    above = position[:, 2] - np.interp(position[:, 0], *np.transpose(bed))
    low = np.flatnonzero(above < REACH * spacing)
    image = position[low] - np.outer(2.0 * above[low], [0.0, 0.0, 1.0])
    return np.concatenate([position, image]), np.concatenate([every, low])


class _Grid:
    """Nodes of the grid; where the water is cut, the cut lies half-way behind the last ones.

    Attributes
    ----------
    low : (3,) float64 [m]
        The first node.
    step : (3,) float64 [m]
    count : (3,) int64
    cut : (3,) bool
        Along which axes the water is cut at both ends.
    """

    def __init__(self, position, spacing, period, window):
        step, reach = spacing / NODES, REACH * spacing
        ends = [(window or (-np.inf, np.inf)), (0.0, period or np.inf), (-np.inf, np.inf)]
        self.spacing, self.period = spacing, period
        self.cut = np.array([window is not None, period > 0.0, False])
        low, high = [], []
        for axis, cut in enumerate(self.cut):
            if not cut:
                held = position[:, axis] if len(position) else np.zeros(1)
                below = 2.0 * reach if axis == 2 else reach  # room for the image in the bed
                ends[axis] = held.min() - below, held.max() + reach
            low.append(ends[axis][0])
            high.append(ends[axis][1])
        low, high = np.array(low), np.array(high)
        self.count = np.maximum(np.round((high - low) / step), 1).astype(int)
        self.step = (high - low) / self.count
        self.low = low + 0.5 * self.step
        # Water beyond the cuts along x counts as well; beyond those along y the water repeats.
        self.margin = int(np.ceil(reach / step)) if window else 0

    def sees(self, position):
        """Mask of the particles that reach the grid."""
        if not self.cut[0]:
            return np.ones(len(position), bool)
        reach = (self.margin - 1) * self.step[0]
        left, right = self.low[0] - reach, self.low[0] + (self.count[0] - 1) * self.step[0] + reach
        return (position[:, 0] > left) & (position[:, 0] < right)

    def smooth(self, position, weights):
        """Sum of the kernel-weighted weights over a volume, at the nodes, float64."""
        from scipy.ndimage import convolve1d

        shape = self.count + np.array([2 * self.margin, 0, 0])
        place = (position - self.low) / self.step + [self.margin, 0, 0]
        field = _dealt_out(place, weights, shape, self.period > 0.0) / np.prod(self.step)
        for axis in range(3):
            # Dealing out between two nodes spreads a particle by step^2/6 already.
            width = np.sqrt((SMOOTHING * self.spacing / self.step[axis]) ** 2 - 1.0 / 6.0)
            reach = int(REACH * self.spacing / self.step[axis])
            kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / width) ** 2)
            mode = "wrap" if axis == 1 and self.period else "constant"
            field = convolve1d(field, kernel / kernel.sum(), axis, mode=mode)
        return field[self.margin : self.margin + self.count[0]]

    def at(self, field, position):
        """A field at places [m], (n,)."""
        return _at(field, (position - self.low) / self.step)

    def closed(self, share):
        """The colour function with one more node at each end, outside of the water.

        Their values put the surface exactly into the cut.
        """
        closed = np.pad(share, 1)
        for axis in np.flatnonzero(self.cut):
            rows = np.moveaxis(closed, axis, 0)
            for outer, inner in ((0, 1), (-1, -2)):
                rows[outer] = np.where(rows[inner] > LEVEL, 2.0 * LEVEL - rows[inner], 0.0)
        return closed


def _dealt_out(place, weights, shape, around):
    """Weights dealt out to the eight nodes around each place [nodes]; periodic along y."""
    base = np.floor(place).astype(int)
    share = place - base
    total = np.zeros(np.prod(shape))
    for corner in CORNERS:
        node = base + corner
        if around:
            node[:, 1] %= shape[1]
        held = ((node >= 0) & (node < shape)).all(axis=1)
        part = weights * np.prod(np.where(corner, share, 1.0 - share), axis=1)
        index = np.ravel_multi_index(node[held].T, shape)
        total += np.bincount(index, part[held], len(total))
    return total.reshape(shape)


def _at(field, place, beyond="nearest"):
    """A field between its nodes, linearly; beyond them as at the last one, or 0 ("constant")."""
    from scipy.ndimage import map_coordinates

    return map_coordinates(field, place.T, order=1, mode=beyond)


def _net(field, cut):
    """The level surface of a field that is below the level at its ends.

    Parameters
    ----------
    field : (l, m, n) float64
    cut : (3,) bool
        Along which axes the ends are cuts: the surface is flat there, with sharp edges.

    Returns
    -------
    points : (k, 3) float64 [nodes]
    triangles : (t, 3) int64
    normals : (k, 3) float64 [-]
    """
    inside = field > LEVEL
    count = sum(inside[_window(corner, inside.shape)].astype(np.int8) for corner in CORNERS)
    cells = np.argwhere((count > 0) & (count < 8))
    number = np.full(count.shape, -1)
    number[tuple(cells.T)] = np.arange(len(cells))
    first, last = cut & (cells == 0), cut & (cells == np.array(count.shape) - 1)
    place = _meeting(field, cells, first | last)
    points = cells + np.where(first | last, 0.5, place)
    normals = _normals(field, points)
    for axis in range(3):
        for end, way in ((first, -1.0), (last, 1.0)):
            normals[end[:, axis]] = way * np.eye(3)[axis]
    return points, _triangles(inside, number), normals


def _meeting(field, cells, at_end):
    """Mean of the points where the surface meets a cell's edges, (k, 3) [nodes from low corner].

    At a cut, edges that lead through it count only if the surface meets no other, so that the cut
    ends at the surface and not at a node.
    """
    around = np.stack([field[tuple((cells + corner).T)] for corner in CORNERS], axis=-1)
    total, met = np.zeros((2, len(cells), 3)), np.zeros((2, len(cells), 1))
    for a, b in EDGES:
        start, end = around[:, a], around[:, b]
        way = CORNERS[b] - CORNERS[a]
        meets = (start > LEVEL) != (end > LEVEL)
        along = np.divide(LEVEL - start, end - start, out=np.zeros(len(cells)), where=meets)
        through = at_end[:, np.argmax(way)]
        for kind, counts in enumerate((meets & ~through, meets & through)):
            total[kind] += counts[:, None] * (CORNERS[a] + along[:, None] * way)
            met[kind, :, 0] += counts
    mean = total / np.maximum(met, 1)
    return np.where(met[0] > 0, mean[0], mean[1])


def _window(corner, shape):
    """The nodes at one corner of all cells."""
    return tuple(slice(c, n - 1 + c) for c, n in zip(corner, shape, strict=True))


def _triangles(inside, number):
    """Two triangles for each edge that is cut, between the points of the four cells around it."""
    found = []
    for axis in range(3):
        second, third = (axis + 1) % 3, (axis + 2) % 3
        first = np.moveaxis(inside, axis, 0)
        edges = np.argwhere(np.moveaxis(first[:-1] != first[1:], 0, axis))
        step = np.eye(3, dtype=int)
        ring = [edges - step[second] - step[third], edges - step[third], edges,
                edges - step[second]]  # fmt: skip
        quads = np.stack([number[tuple(cell.T)] for cell in ring], axis=1)
        outward = inside[tuple(edges.T)]  # the water ends along the axis
        quads[~outward] = quads[~outward][:, ::-1]
        found += [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
    return np.concatenate(found)


def _normals(field, points):
    """Unit normals, against the gradient of the colour function."""
    gradient = np.zeros_like(points)
    for axis, step in enumerate(0.75 * np.eye(3)):
        gradient[:, axis] = _at(field, points + step) - _at(field, points - step)
    length = np.linalg.norm(gradient, axis=1, keepdims=True)
    return -gradient / np.maximum(length, 1e-12)
