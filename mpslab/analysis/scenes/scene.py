"""One frame of a 3-D run as a picture with light and depth."""

from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from itertools import pairwise

import numpy as np

from mpslab.analysis.scenes.freesurface import find_surface
from mpslab.analysis.scenes.light import GLOSS, lit
from mpslab.analysis.scenes.view import View

WATER = (0.23, 0.53, 0.78)  # where no field colours it
BED, PADDLE, BLOCK = (0.80, 0.76, 0.69), (0.32, 0.33, 0.35), (0.58, 0.45, 0.33)
PADDLE_WIDTH = 2.0  # spacings
DARKEST = 0.45  # brightness at the end of a closed hollow, over that in the open
BACKENDS = ("pyvista", "plain")


@dataclass(frozen=True)
class Picture:
    """A picture, and where the points of the tank lie in it.

    Attributes
    ----------
    image : (h, w, 3) uint8
        Its first row is the upper one.
    project : function ((n, 3) or (3,) [m]) -> (n, 2) or (2,) float64 [pixels]
        As `mpslab.analysis.scenes.view.View.project`: from the upper left corner, so that with
        ``ax.imshow(image, extent=(0, w, h, 0))`` they are the coordinates of the axes.
    """

    image: np.ndarray
    project: Callable


@dataclass
class Scene:
    """What a renderer draws; all but the spheres is lit already.

    Attributes
    ----------
    view : View
    quads : list of (corners (4, 3) float64 [m], colour (3,) float64 [0 to 1])
        Flat sides of solids.
    spheres : (n, 3) float64 [m]
    sphere_colours : (n, 3) float64 [0 to 1]
        Not yet lit: see `mpslab.analysis.scenes.light`.
    radius : float [m]
    points : (k, 3) float64 [m]
        Of a surface.
    point_colours : (k, 3) float64 [0 to 1]
    triangles : (m, 3) int64
    gloss : float
        Of the spheres.
    """

    view: View
    radius: float
    quads: list = field(default_factory=list)
    spheres: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    sphere_colours: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    points: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    point_colours: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    triangles: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), int))
    gloss: float = 0.5 * GLOSS


def draw(
    water, spacing, view, values=None, cmap="viridis", limits=None, as_surface=False, bed=None,
    ground=None, width=None, period=0.0, paddle_x=None, blocks=(), solids=(), colour=WATER,
    backend=None,
):  # fmt: skip
    """Draw the water of a frame, with bed, paddle and solids, on white.

    Parameters
    ----------
    water : (n, 3) array_like [m]
        Water particles; those outside the limits of x of the view are cut off.
    spacing : float [m]
    view : mpslab.analysis.scenes.view.View
    values : (n,) array_like, optional
        What colours the water; without it, `colour` does.
    cmap : str or matplotlib Colormap
    limits : (float, float), optional
        Values at the ends of the colours; those of the water by default.
    as_surface : bool
        Draw the surface of the water (`mpslab.analysis.scenes.freesurface`), with spray as spheres;
        else all particles as spheres.
    bed : sequence of (x, z) [m], optional
        x ascending; level to the left of the first point.
    ground : float [m], optional
        How thick the bed is drawn; down to the lower limit of the view by default.
    width : float [m], optional
        Of the tank; the upper limit of y of the view by default.
    period : float [m]
        Equal to the width if the tank is periodic; 0 if it has side walls.
    paddle_x : float [m], optional
        Face of the piston, which reaches up to the upper limit of the view.
    blocks : sequence of ((x, y, z), (x, y, z)) or ((x, y, z), (x, y, z), colour)
        Solid boxes, from one corner to the other [m].
    solids : sequence of (k, 3) array_like [m]
        Particles of each solid of any shape.
    colour : (float, float, float) [0 to 1]
        Of water and spray without values.
    backend : str, optional
        "pyvista", or "plain", which needs only numpy; by default pyvista if it is installed.

    Returns
    -------
    Picture

    Raises
    ------
    ValueError
        If an array has another shape, or the backend is unknown or not installed.
    """
    renderer = _renderer(backend)
    water = np.asarray(water, float)
    if water.ndim != 2 or water.shape[1] != 3:
        raise ValueError(f"water: shape {water.shape}; must be (n, 3)")
    if values is not None:
        values = np.asarray(values, float)
        if values.shape != (len(water),):
            raise ValueError(f"values: shape {values.shape}; must be ({len(water)},)")
    paint = _Paint(values, cmap, limits, colour)
    scene = Scene(view, 0.5 * spacing)
    width = view.box[1][1] if width is None else width
    _add_flat_sides(scene, spacing, bed, ground, width, paddle_x, blocks)
    for particles in solids:
        surface = find_surface(particles, spacing, window=view.box[0])
        _add_mesh(scene, surface, np.tile(BLOCK, (len(surface.points), 1)), 0.0)
    if as_surface:
        _add_surface(scene, water, spacing, values, paint, period, bed)
    else:
        (left, right), _, _ = view.box
        seen = (water[:, 0] >= left) & (water[:, 0] <= right)
        scene.spheres, scene.sphere_colours = water[seen], paint(values, seen)
    return Picture(renderer(scene), view.project)


def available():
    """The renderer that `draw` takes by default, "pyvista" or "plain"."""
    return "pyvista" if find_spec("pyvista") else "plain"


def _renderer(backend):
    """The function that draws a scene."""
    name = backend or available()
    if name not in BACKENDS:
        raise ValueError(f"backend = {name!r}: must be out of {', '.join(BACKENDS)}")
    if name == "pyvista" and available() != name:
        raise ValueError("backend = 'pyvista': is not installed; pip install 'mpslab[viz]'")
    return import_module(f"mpslab.analysis.scenes.renderers.{name}").render


class _Paint:
    """Colours of values, the same for particles and surface."""

    def __init__(self, values, cmap, limits, colour):
        from matplotlib import colormaps
        from matplotlib.colors import Normalize

        self.plain = np.asarray(colour, float)
        self.map = colormaps[cmap] if isinstance(cmap, str) else cmap
        if limits is None and values is not None and len(values):
            limits = values.min(), values.max()
        self.norm = Normalize(*(limits or (0.0, 1.0)))

    def __call__(self, values, seen):
        """Colours of the values that a mask or slice `seen` picks, (n, 3) float64."""
        if values is None:
            return np.tile(self.plain, (np.count_nonzero(seen), 1))
        return self.map(self.norm(values[seen]))[:, :3]


def _add_surface(scene, water, spacing, values, paint, period, bed):
    """The surface, and spray as spheres."""
    view = scene.view
    surface = find_surface(water, spacing, values, period, view.box[0], bed)
    _add_mesh(scene, surface, paint(surface.values, np.ones(len(surface.points), bool)), GLOSS)
    (left, right), _, _ = view.box
    drops = surface.spray & (water[:, 0] >= left) & (water[:, 0] <= right)
    scene.spheres, scene.sphere_colours = water[drops], paint(values, drops)


def _add_mesh(scene, surface, colours, gloss):
    """A surface in colours (n, 3), lit."""
    facing = surface.normals @ (scene.view.axes * [[1.0], [1.0], [-1.0]]).T
    openness = DARKEST + (1.0 - DARKEST) * surface.openness
    triangles = surface.triangles + len(scene.points)
    scene.points = np.concatenate([scene.points, surface.points])
    scene.triangles = np.concatenate([scene.triangles, triangles])
    shades = lit(colours, facing, gloss, openness)
    scene.point_colours = np.concatenate([scene.point_colours, shades])


def _add_flat_sides(scene, spacing, bed, ground, width, paddle_x, blocks):
    """Bed, paddle and blocks as flat sides."""
    (left, right), _, (bottom, top) = scene.view.box
    if bed is not None:
        for one, other in _pieces(np.asarray(bed, float), left, right):
            tops = one[1], other[1]
            feet = (bottom, bottom) if ground is None else (one[1] - ground, other[1] - ground)
            _add_box(scene, (one[0], 0.0), (other[0], width), BED, feet, tops)
    if paddle_x is not None and left < paddle_x < right + PADDLE_WIDTH * spacing:
        base = bottom if bed is None else np.interp(paddle_x, *np.transpose(bed))
        back = max(paddle_x - PADDLE_WIDTH * spacing, left)
        _add_box(scene, (back, 0.0), (min(paddle_x, right), width), PADDLE, base, top)
    for low, high, *colour in blocks:
        low, high = np.array(low, float), np.array(high, float)
        low[0], high[0] = max(low[0], left), min(high[0], right)
        if low[0] < high[0]:
            _add_box(scene, low[:2], high[:2], *(colour or [BLOCK]), low[2], high[2])


def _pieces(bed, left, right):
    """Straight pieces of a bed between two places, as pairs of (x, z)."""
    if left < bed[0, 0]:
        bed = np.vstack([[left, bed[0, 1]], bed])
    right = min(right, bed[-1, 0])
    x = np.unique(np.clip(np.append(bed[:, 0], [left, right]), left, right))
    points = np.column_stack([x, np.interp(x, *bed.T)])
    return pairwise(points)


def _add_box(scene, low, high, colour, bottom, top):
    """The sides of a box that look towards the eye.

    `low` and `high` are (x, y); bottom and top are a level [m], or two: on the left and the right.
    """
    (x0, y0), (x1, y1) = low, high
    (z0, z1), (a, b) = np.broadcast_to(bottom, 2), np.broadcast_to(top, 2)
    corners = np.array([[x0, y0, z0], [x1, y0, z1], [x1, y0, b], [x0, y0, a],
                        [x0, y1, z0], [x1, y1, z1], [x1, y1, b], [x0, y1, a]])  # fmt: skip
    # Counter-clockwise, if seen from outside: front, back, left, right, top, bottom.
    for side in ("0123", "5476", "4037", "1562", "3267", "4510"):
        quad = corners[[int(number) for number in side]]
        normal = np.cross(quad[2] - quad[0], quad[3] - quad[1])
        normal = normal / max(np.linalg.norm(normal), 1e-30)
        view = scene.view
        way = view.axes[2] if view.parallel else quad.mean(axis=0) - view.eye
        if normal @ way < 0.0:
            facing = normal @ (view.axes * [[1.0], [1.0], [-1.0]]).T
            scene.quads.append((quad, lit(np.array([colour]), facing[None])[0]))
