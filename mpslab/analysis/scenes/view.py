"""From where a scene is seen, and where its points lie in the picture."""

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

MARGIN = 1.02  # size of what is seen over size of what must be seen
ANGLE = 20.0  # [degrees] across the larger side of a picture in perspective


@dataclass(frozen=True)
class View:
    """A box of the tank, seen so that it just fills the picture.

    Attributes
    ----------
    box : ((float, float), (float, float), (float, float)) [m]
        Limits of x, y and z of what is to be seen; solids and water are cut off at those of x.
    azimuth : float [degrees]
        0 looks straight across the tank (along y); above 0 from farther left (smaller x), so that
        the fronts of waves that run to the right are seen from behind, below 0 from ahead.
    elevation : float [degrees]
        Of the eye above the water; between -90 and 90.
    parallel : bool
        Without perspective: equal lengths look equal near and far.
    size : (int, int) [pixels]
        Width and height of the picture.
    seen : sequence of (x, y, z) [m]
        What must be seen, if that is less than the box; by default the corners of the box.
    angle : float [degrees]
        Of view in perspective, across the larger side of the picture.

    Raises
    ------
    ValueError
        If a limit, angle or size makes no sense.
    """

    box: tuple
    azimuth: float = 0.0
    elevation: float = 0.0
    parallel: bool = False
    size: tuple = (1280, 480)
    angle: float = ANGLE
    seen: tuple = ()

    def __post_init__(self):
        if np.shape(self.box) != (3, 2) or not all(low < high for low, high in self.box):
            raise ValueError(f"box = {self.box}: must be three pairs (low, high), low < high")
        if not -90.0 < self.elevation < 90.0:
            raise ValueError(f"elevation = {self.elevation:g}: must be between -90 and 90 degrees")
        if not 1.0 <= self.angle <= 120.0:
            raise ValueError(f"angle = {self.angle:g}: must be from 1 to 120 degrees")
        if len(self.size) != 2 or min(self.size) < 16:
            raise ValueError(f"size = {self.size}: must be two numbers of pixels >= 16")

    @cached_property
    def axes(self):
        """Unit vectors to the right, up and ahead, (3, 3) float64."""
        turn, rise = np.radians([self.azimuth, self.elevation])
        right = np.array([np.cos(turn), -np.sin(turn), 0.0])
        level = np.array([np.sin(turn), np.cos(turn), 0.0])
        ahead = np.cos(rise) * level - np.sin(rise) * np.array([0.0, 0.0, 1.0])
        return np.array([right, np.cross(right, ahead), ahead])

    @cached_property
    def _corners(self):
        """The points that must be seen, to the right, up and ahead [m]."""
        return np.array(self.seen or list(product(*self.box)), float) @ self.axes.T

    @cached_property
    def slopes(self):
        """Tangents of half the angle of view, across and up, (2,) float64."""
        size = np.array(self.size, float)
        return np.tan(np.radians(0.5 * self.angle)) * size / size.max()

    @cached_property
    def eye(self):
        """Where the eye is [m], (3,) float64; in parallel, in front of the box."""
        corners = self._corners
        low, high = corners.min(axis=0), corners.max(axis=0)
        if self.parallel:
            return np.append(0.5 * (low + high)[:2], low[2] - np.ptp(corners)) @ self.axes
        # Seen from one side, the box lies between two planes through the eye that just touch it.
        slopes = self.slopes / MARGIN
        upper = (corners[:, :2] - slopes * corners[:, 2:]).max(axis=0)
        lower = (-corners[:, :2] - slopes * corners[:, 2:]).max(axis=0)
        depth = np.min(-0.5 * (upper + lower) / slopes)
        return np.append(0.5 * (upper - lower), depth) @ self.axes

    @cached_property
    def height(self):
        """Height of what a picture without perspective shows [m]."""
        across, up = np.ptp(self._corners[:, :2], axis=0)
        return MARGIN * max(up, across * self.size[1] / self.size[0])

    def depth(self, points):
        """How far ahead of the eye places [m] lie, (n,) float64 [m]."""
        return (np.asarray(points, float) - self.eye) @ self.axes[2]

    def pixels_per_metre(self, points):
        """Pixels of a metre across the line of sight, at places [m], (n,) float64 [1/m]."""
        half = 0.5 * self.size[1]
        if self.parallel:
            return np.full(len(points), 2.0 * half / self.height)
        return half / (self.slopes[1] * self.depth(points))

    def project(self, points):
        """Where places lie in the picture.

        Parameters
        ----------
        points : (n, 3) or (3,) array_like [m]

        Returns
        -------
        (n, 2) or (2,) float64 [pixels]
            To the right and down from the upper left corner of the picture; the middle of its first
            pixel is (0.5, 0.5). NaN for what lies behind the eye.
        """
        points = np.asarray(points, float)
        seen = np.atleast_2d(points)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = self.pixels_per_metre(seen)
            scale = np.where(scale > 0.0, scale, np.nan)[:, None]
            place = (seen - self.eye) @ self.axes[:2].T * scale * [1.0, -1.0]
        return (place + 0.5 * np.array(self.size)).reshape(*points.shape[:-1], 2)

    def rays(self, x, y):
        """Lines of sight through places in the picture.

        Parameters
        ----------
        x, y : (n,) float64 [pixels]
            As `project` returns them.

        Returns
        -------
        start, way : (n, 3) float64
            A place [m] and a direction; along it the depth grows by 1 for each length of `way`.
        """
        width, height = self.size
        right, up = (x - 0.5 * width)[:, None], (0.5 * height - y)[:, None]
        if self.parallel:
            scale = self.height / height
            start = self.eye + scale * (right * self.axes[0] + up * self.axes[1])
            return start, np.broadcast_to(self.axes[2], start.shape)
        scale = 2.0 * self.slopes[1] / height
        way = self.axes[2] + scale * (right * self.axes[0] + up * self.axes[1])
        return np.broadcast_to(self.eye, way.shape), way


def fitted(box, width, highest=1.0, **options):
    """A view of a given width, as high as is needed to show what must be seen.

    Parameters
    ----------
    box, **options
        As `View` takes them.
    width : int [pixels]
    highest : float
        Largest height over width; a box that needs more is seen from farther away.

    Returns
    -------
    View
        With an even height.
    """
    square = View(box, size=(width, width), **options)
    place = square.project(square.seen or list(product(*box)))
    height = MARGIN * np.ptp(place[:, 1]) + 2.0
    height = 2 * int(np.ceil(0.5 * min(max(height, 16.0), highest * width)))
    return View(box, size=(width, height), **options)
