"""Pictures of the particles: the tank at some times, and the breaker from close up."""

from dataclasses import dataclass

import numpy as np

from mpslab.analysis.overturning import COLUMN, find_front
from mpslab.analysis.panels import draw_panels
from mpslab.core.kinds import FLUID, GATE, GATE_DUMMY
from mpslab.core.particles import FIRST_SOLID

PICTURES = 6
BREAKER_FRAMES = 4


@dataclass(frozen=True)
class Slice:
    """Particles of a vertical slice x-z at one time, one spacing thick.

    Attributes
    ----------
    time : float [s]
    kind : (n,) int8
    x, z : (n,) float32 [m]
    speed, along : (n,) float32 [m/s], or None
        Speed, and velocity along x.
    pressure : (n,) float32 [Pa], or None
    body : (n,) int8, or None
    """

    time: float
    kind: np.ndarray
    x: np.ndarray
    z: np.ndarray
    speed: np.ndarray | None
    along: np.ndarray | None = None
    pressure: np.ndarray | None = None
    body: np.ndarray | None = None

    @property
    def fluid(self):
        """Mask of the fluid particles, (n,) bool."""
        return self.kind == FLUID

    @property
    def of_bodies(self):
        """Mask of the particles of solids other than tank, piston and gates, (n,) bool."""
        if self.body is None:
            return np.zeros(len(self.x), bool)
        return (self.body >= FIRST_SOLID) & ~np.isin(self.kind, (GATE, GATE_DUMMY))

    def inside(self, along, level, spacing):
        """Whether places x (m,) [m] at a level [m] are in a solid of `of_bodies`, (m,) bool.

        A solid is taken to be whole from its first to its last particle near the level.
        """
        held = np.zeros(len(along), bool)
        near = self.of_bodies & (np.abs(self.z - level) < spacing)
        for body in np.unique(self.body[near]) if near.any() else ():
            x = self.x[near & (self.body == body)]
            held |= (along > x.min() - 0.5 * spacing) & (along < x.max() + 0.5 * spacing)
        return held

    def apart(self, spacing):
        """Fluid that is neither above nor below a solid other than tank and piston, (n,) bool.

        There an upright face of water, or a gap in it, tells nothing of waves.
        """
        if self.body is None or not (self.body >= FIRST_SOLID).any():
            return self.fluid
        column = np.floor(self.x / (COLUMN * spacing)).astype(int)
        beside = np.unique(column[self.body >= FIRST_SOLID])
        return self.fluid & ~np.isin(column, beside)


def middle_slice(time, frame, spacing, width):
    """The slice next to the middle of the tank; in 2-D, all particles.

    Parameters
    ----------
    time : float [s]
    frame : dict of str to ndarray
        A frame of a particle series.
    spacing, width : float
        Particle spacing and tank width [m], width 0 in 2-D.
    """
    seen = np.ones(len(frame["kind"]), bool)
    if width:
        # Neither half-way between two layers nor on a layer, whether their number is even or odd.
        seen = np.abs(frame["position"][:, 1] - 0.5 * width + 0.25 * spacing) < 0.5 * spacing
    velocity, pressure = (frame[name][seen] if name in frame else None
                          for name in ("velocity", "pressure"))  # fmt: skip
    speed = None if velocity is None else np.linalg.norm(velocity, axis=1)
    along = None if velocity is None else velocity[:, 0]
    x, _, z = frame["position"][seen].T
    body = frame["body"][seen] if "body" in frame else None
    return Slice(time, frame["kind"][seen], x, z, speed, along, pressure, body)


def _slices(frames, case):
    """Slices of frames."""
    spacing, width = case["particles"]["spacing"], case["tank"]["width"]
    for frame in frames:
        yield middle_slice(frame.time, frame, spacing, width)


def draw_tank(frames, case, field="speed"):
    """The whole tank, one panel for each time of ``output.pictures``, or for six of the run.

    Parameters
    ----------
    frames : mpslab.analysis.results.Frames
    case : dict
        The case as its TOML file holds it.
    field : str
        What colours the water, "speed" or "pressure".

    Returns
    -------
    matplotlib Figure
    """
    times = frames.required().times
    wanted = case["output"]["pictures"] or np.linspace(times[0], times[-1], PICTURES)
    indices = np.unique([np.argmin(np.abs(times - time)) for time in wanted])
    slices = list(_slices((frames[index] for index in indices), case))
    box = _box(slices, case)
    return draw_panels(slices, case, box, "The tank", field)


def draw_breaker(frames, case):
    """The wave from close up: frames around the first in which it overturns.

    If no wave throws a jet, frames around the first in which a front stands upright.

    Parameters
    ----------
    frames, case
        As for `draw_tank`.

    Returns
    -------
    matplotlib Figure, or None if there is no such front, or the frames hold no velocity
    """
    spacing = case["particles"]["spacing"]
    found = _moment(_front(piece, spacing) for piece in _slices(frames, case))
    if found is None:
        return None
    index, front = found
    first = max(min(index - 1, len(frames) - BREAKER_FRAMES), 0)
    slices = list(_slices(frames[first : first + BREAKER_FRAMES], case))
    what = "Where a wave overturns" if front.overturns else "Where the front of a wave is upright"
    return draw_panels(slices, case, _window(front, slices, case), what, "speed")


def _front(piece, spacing):
    """The breaking front of a slice; None if there is none."""
    if piece.along is None:
        return None
    water = piece.apart(spacing)
    return find_front(piece.x[water], piece.z[water], piece.along[water], spacing)


def _moment(fronts):
    """Number and front of the first frame with a jet; if none has one, with an upright front."""
    upright = None
    for number, front in enumerate(fronts):
        if front and front.overturns:
            return number, front
        if front and upright is None:
            upright = number, front
    return upright


def _box(slices, case):
    """Limits ((x, x), (z, z)) that hold the walls in x, and obstacles, bodies and water in z.

    High spray does not count, and a gate is cut off when it is lifted.
    """
    spacing = case["particles"]["spacing"]
    x = np.concatenate([piece.x for piece in slices])
    bottom = min(piece.z.min() for piece in slices)
    water = [np.quantile(piece.z[piece.fluid], 0.999) for piece in slices]
    bodies = [piece.z[piece.of_bodies].max(initial=bottom) for piece in slices]
    top = max([*water, *bodies, *(box["to"][2] for box in case.get("obstacle", ()))])
    return (x.min() - spacing, x.max() + spacing), (bottom - spacing, top + 4 * spacing)


def _window(front, slices, case):
    """Limits around a front, two water depths to either side."""
    spacing, margin = case["particles"]["spacing"], 2.0 * case["tank"]["depth"]
    (x_min, x_max), _ = _box(slices, case)
    left, right = max(front.x - margin, x_min), min(front.x + margin, x_max)
    water = [p.z[p.fluid & (p.x > left) & (p.x < right)] for p in slices]
    water = np.concatenate(water)
    bottom, top = water.min() - 3 * spacing, np.quantile(water, 0.999) + 4 * spacing
    return (left, right), (bottom, top)
