"""Pictures of the particles: the tank at some times, and the breaker from near by."""

from dataclasses import dataclass

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from mpslab import vtkhdf
from mpslab.overturning import find_crest
from mpslab.particles import DUMMY, FLUID, GATE, GATE_DUMMY, PISTON, PISTON_DUMMY, WALL

GREYS = {
    DUMMY: "0.80", WALL: "0.55", PISTON_DUMMY: "0.55", PISTON: "0.20", GATE_DUMMY: "0.55",
    GATE: "0.20",
}  # fmt: skip
SPEED_MAP = "viridis"
WATER = "#3b7dbf"  # where the frames hold no velocity
PAGE_WIDTH = 10.0  # [inch]
PICTURES = 6
BREAKER_FRAMES = 4
# A surface that is nowhere steeper than this has no breaker to look at.
STEEP = 0.3


@dataclass(frozen=True)
class Slice:
    """Particles of a vertical slice x-z at one time, one spacing thick.

    Attributes
    ----------
    time : float [s]
    kind : (n,) int8
    x, z : (n,) float32 [m]
    speed : (n,) float32 [m/s], or None
    """

    time: float
    kind: np.ndarray
    x: np.ndarray
    z: np.ndarray
    speed: np.ndarray | None

    @property
    def fluid(self):
        """Mask of the fluid particles, (n,) bool."""
        return self.kind == FLUID


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
        # Neither half-way between layers nor on one, be their number even or odd.
        seen = np.abs(frame["position"][:, 1] - 0.5 * width + 0.25 * spacing) < 0.5 * spacing
    velocity = frame.get("velocity")
    speed = None if velocity is None else np.linalg.norm(velocity[seen], axis=1)
    x, _, z = frame["position"][seen].T
    return Slice(time, frame["kind"][seen], x, z, speed)


def _slices(path, case, indices):
    """Slices of some frames of the series."""
    times = vtkhdf.read_times(path)
    spacing, width = case["particles"]["spacing"], case["tank"]["width"]
    for index in indices:
        yield middle_slice(times[index], vtkhdf.read_frame(path, index), spacing, width)


def draw_tank(path, case):
    """The whole tank, one panel for each time of ``output.pictures``, or for six of the run.

    Parameters
    ----------
    path : Path
        The particle series.
    case : dict
        The case as its TOML file holds it.

    Returns
    -------
    matplotlib Figure
    """
    times = vtkhdf.read_times(path)
    wanted = case["output"]["pictures"] or np.linspace(times[0], times[-1], PICTURES)
    indices = np.unique([np.argmin(np.abs(times - time)) for time in wanted])
    slices = list(_slices(path, case, indices))
    box = _box(slices, case["particles"]["spacing"])
    return _draw_panels(slices, case, box, "Particles coloured by speed")


def draw_breaker(path, case):
    """The wave from near by: frames about its first overturning, or where it is steep and fast.

    Parameters
    ----------
    path, case
        As for `draw_tank`.

    Returns
    -------
    matplotlib Figure, or None if the surface stays gentle
    """
    crests = [_crest(piece, case) for piece in _slices(path, case, _all_frames(path))]
    index = _moment(crests)
    if index is None:
        return None
    first = max(min(index - 1, len(crests) - BREAKER_FRAMES), 0)
    near = range(first, min(first + BREAKER_FRAMES, len(crests)))
    slices = list(_slices(path, case, near))
    box = _window(crests[index], slices, case)
    what = "overturns" if crests[index].overturns else "is steep and fast"
    return _draw_panels(slices, case, box, f"Where the wave {what}: particles coloured by speed")


def _all_frames(path):
    return range(len(vtkhdf.read_times(path)))


def _crest(piece, case):
    """The crest of a slice; where the frames hold no velocity, slope alone decides."""
    water = piece.fluid
    speed = np.ones_like(piece.x) if piece.speed is None else piece.speed
    return find_crest(piece.x[water], piece.z[water], speed[water], case["particles"]["spacing"])


def _moment(crests):
    """Number of the first frame with a jet, or else of a steep and fast one after the start."""
    jets = [k for k, crest in enumerate(crests) if crest.overturns]
    if jets:
        return jets[0]
    steep = [k for k, crest in enumerate(crests) if k > 0 and crest.steepness > STEEP]
    return max(steep, key=lambda k: crests[k].steepness * crests[k].speed, default=None)


def _box(slices, spacing):
    """Limits ((x, x), (z, z)) that hold the walls along x and the water in z, high spray apart."""
    x = np.concatenate([piece.x for piece in slices])
    bottom = min(piece.z.min() for piece in slices)
    top = max(np.quantile(piece.z[piece.fluid], 0.999) for piece in slices)
    return (x.min() - spacing, x.max() + spacing), (bottom - spacing, top + 4 * spacing)


def _window(crest, slices, case):
    """Limits around a crest, two water depths to either side."""
    spacing, margin = case["particles"]["spacing"], 2.0 * case["tank"]["depth"]
    (x_min, x_max), _ = _box(slices, spacing)
    left, right = max(crest.x - margin, x_min), min(crest.x + margin, x_max)
    water = [p.z[p.fluid & (p.x > left) & (p.x < right)] for p in slices]
    water = np.concatenate(water)
    bottom, top = water.min() - 3 * spacing, np.quantile(water, 0.999) + 4 * spacing
    return (left, right), (bottom, top)


def _draw_panels(slices, case, box, title):
    """One panel for each slice, the same limits and colours in all."""
    (left, right), (bottom, top) = box
    aspect = (top - bottom) / (right - left)
    columns = 1 if aspect < 0.2 or len(slices) == 1 else 2
    rows = -(-len(slices) // columns)
    height = rows * (0.9 * PAGE_WIDTH / columns * aspect + 0.45) + 1.6
    figure = Figure(figsize=(PAGE_WIDTH, height), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    scale = _speed_scale(slices)
    for ax, piece in zip(axes, slices, strict=False):
        water = _draw_slice(ax, piece, case["particles"]["spacing"], scale)
        _draw_still_water(ax, case)
        ax.set(xlim=box[0], ylim=box[1], aspect="equal", xlabel="x [m]", ylabel="z [m]")
        ax.set_title(f"t = {piece.time:.3f} s", loc="left")
        ax.label_outer()
    for ax in axes[len(slices) :]:
        ax.set_axis_off()
    if scale:
        figure.colorbar(
            water,
            ax=axes.tolist(),
            location="bottom",
            label="speed [m/s]",
            extend="max",
            shrink=0.6,
            aspect=50,
            pad=0.02,
        )
    figure.suptitle(_heading(case, title))
    return figure


def _heading(case, text):
    still_water = "" if case.get("water") else "; broken line: still water"
    return f"{case.get('title') or case['name']}\n{text}{still_water}"


def _speed_scale(slices):
    """Colour scale common to the panels; the few fastest particles lie above it."""
    if slices[0].speed is None:
        return None
    speed = np.concatenate([piece.speed[piece.fluid] for piece in slices])
    return Normalize(0.0, max(float(np.quantile(speed, 0.998)), 1e-6))


def _draw_slice(ax, piece, spacing, scale):
    """Particles as touching discs; returns those of the water."""
    for kind, grey in GREYS.items():
        _draw_discs(ax, piece, piece.kind == kind, spacing, facecolor=grey)
    if scale is None:
        return _draw_discs(ax, piece, piece.fluid, spacing, facecolor=WATER)
    return _draw_discs(
        ax, piece, piece.fluid, spacing, array=piece.speed[piece.fluid], cmap=SPEED_MAP, norm=scale
    )


def _draw_discs(ax, piece, mask, spacing, **colour):
    """Discs as wide as the particle spacing, in the units of the axes."""
    size = np.full(np.count_nonzero(mask), spacing)
    discs = EllipseCollection(
        size,
        size,
        np.zeros_like(size),
        units="xy",
        offsets=np.column_stack([piece.x[mask], piece.z[mask]]),
        offset_transform=ax.transData,
        linewidth=0,
        **colour,
    )
    return ax.add_collection(discs)


def _draw_still_water(ax, case):
    """The still-water line up to the shore, where the tank was filled to its still depth."""
    if case.get("water"):
        return
    depth = case["tank"]["depth"]
    bed = np.array(case["tank"]["bed"] or [[0.0, 0.0], [case["tank"]["length"], 0.0]])
    along = np.linspace(0.0, case["tank"]["length"], 1000)
    wet = np.interp(along, *bed.T) < depth
    level = np.where(wet, depth, np.nan)
    ax.plot(along, level, color="#d55e00", linewidth=0.9, linestyle=(0, (6, 4)))
