"""Panels of particles under one heading, with a colour bar and a legend."""

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D

from mpslab.analysis import sheet
from mpslab.analysis.headings import heading
from mpslab.analysis.still import still_level
from mpslab.core.kinds import DUMMY, GATE, GATE_DUMMY, PISTON, PISTON_DUMMY, WALL

# Colours of solids: that of their faces, and that of the particles behind them.
SOLIDS = {
    "wall": ("0.55", "0.80"),
    "obstacle": ("#8a6642", "#c9b497"),
    "piston": ("0.15", "0.45"),
    "gate": ("#b2457c", "#dda6c4"),
}
FACES = {WALL: "wall", PISTON: "piston", GATE: "gate"}
FILLERS = {DUMMY: "wall", PISTON_DUMMY: "piston", GATE_DUMMY: "gate"}
STILL_WATER = {"color": "#d55e00", "linewidth": 1.0, "linestyle": (0, (6, 4))}
WATER = "#3b7dbf"  # if the frames do not hold the field that would colour it
MAPS = {"speed": "viridis", "along": "cividis", "pressure": "plasma"}  # perceptually uniform
LABELS = {"speed": "speed [m/s]", "along": "velocity along the tank [m/s]",
          "pressure": "pressure [Pa]"}  # fmt: skip
BACKWARD = 0.5  # the colours of velocity along the tank begin at this share of their end, negative
# The colours of speed end at sqrt(g h) times the one of ENDS that is nearest to the speed expected.
# That is CREST times the speed that linear theory of long waves has below a crest (it may break),
# COLLAPSE times sqrt(g h) for a column that collapses, and STILL times that for still water.
ENDS = tuple(step * 10.0**power for power in range(-6, 7) for step in (1, 2, 5))
CREST, COLLAPSE, STILL = 3.0, 2.0, 0.05
HIGHEST = 1.2  # the colours of pressure end at the pressure on the bed under still water times this
LEGEND, BAR = 0.4, 1.3  # height of the legend, and of the colour bar with its numbers [inch]
# Discs as wide as the spacing touch. If they are smaller than SMALL, only a pattern is seen: they
# are drawn CLOSED times as wide, which closes the gaps.
SMALL, CLOSED = 2.5, 1.4  # [points of 1/72 inch], [-]


@dataclass(frozen=True)
class Scale:
    """Colours of the water: the field they show, its value where they end, and the tank's unit.

    Attributes
    ----------
    field : str
        "speed", "along" or "pressure".
    end : float
        Where the colours end, in units of the tank.
    unit : float [m/s] or [Pa]
        sqrt(g h), or rho g h; 1 where there is no gravity.
    name : str
        The unit in letters; empty where there is no gravity.
    """

    field: str
    end: float
    unit: float
    name: str

    @property
    def norm(self):
        """Of matplotlib, over values in SI units."""
        end = self.end * self.unit
        return Normalize(-BACKWARD * end if self.field == "along" else 0.0, end)


def make_scale(case, field):
    """The `Scale` of a field: it follows from the case alone, so all pictures of a run have it.

    Parameters
    ----------
    case : dict
        The case as its TOML file holds it.
    field : str
        "speed", "along" or "pressure".

    Returns
    -------
    Scale, or None if the case has nothing to measure the field by
    """
    depth, gravity, density = (
        case["tank"]["depth"], case["fluid"]["gravity"], case["fluid"]["density"]
    )  # fmt: skip
    if field == "pressure":
        unit = density * gravity * depth
        return Scale(field, HIGHEST, unit, r"\rho g h") if unit else None
    unit, name = (math.sqrt(gravity * depth), r"\sqrt{g h}") if gravity else (1.0, "")
    speed = _expected_speed(case, unit) / unit
    return Scale(field, min(ENDS, key=lambda end: abs(math.log(end / speed))), unit, name)


def _expected_speed(case, fast):
    """A speed that little of the water will exceed [m/s]; `fast` is sqrt(g h)."""
    initial, maker, boxes = case["initial"], case["wavemaker"], case.get("water", ())
    if initial["type"] == "stream":
        return abs(initial["speed"]) or fast
    if initial["type"] in ("strain", "rotation"):
        right = max((box["to"][0] for box in boxes), default=case["tank"]["length"])
        left = min((box["from"][0] for box in boxes), default=0.0)
        return 0.5 * abs(initial["rate"]) * (right - left) or fast
    if still_level(case) is None:
        return COLLAPSE * fast
    if initial["type"] == "standing_wave":
        amplitude = initial["amplitude"]
    elif maker["type"] in ("none", "still"):
        return STILL * fast
    else:
        amplitude = maker["height"] * (1.0 if maker["type"] == "solitary" else 0.5)
    return CREST * amplitude / case["tank"]["depth"] * fast or fast


def draw_panels(slices, case, box, title, field):
    """One panel for each slice, with the same limits and colours in all.

    Parameters
    ----------
    slices : list of mpslab.analysis.snapshots.Slice
    case : dict
        The case as its TOML file holds it.
    box : ((float, float), (float, float)) [m]
        Limits of x and of z.
    title : str
        What the picture shows.
    field : str
        What colours the water, "speed" or "pressure"; one colour if the frames do not hold it.

    Returns
    -------
    matplotlib Figure
    """
    scale = None if getattr(slices[0], field) is None else make_scale(case, field)
    (left, right), (bottom, top) = box
    aspect = (top - bottom) / (right - left)
    columns = 1 if aspect < 0.2 or len(slices) == 1 else 2
    size = disc_size(case["particles"]["spacing"], 72 * sheet.WIDTH / columns / (right - left))
    handles = _handles(slices, case, box, scale)
    legend = LEGEND if handles else 0.0
    text = f"{title}: water coloured by {scale.field}" if scale else title
    figure, axes = sheet.make(
        -(-len(slices) // columns), columns, lambda width: aspect * width, heading(case, text),
        legend + (BAR if scale else 0.0), sharex=True, sharey=True,
    )  # fmt: skip
    axes = axes.ravel()
    for ax, piece in zip(axes, slices, strict=False):
        water = draw_slice(ax, piece, case, scale, size)
        draw_still_water(ax, case, piece)
        ax.set(xlim=box[0], ylim=box[1], aspect="equal", xlabel="x [m]", ylabel="z [m]")
        ax.set_title(f"t = {piece.time:.3f} s", loc="left")
        ax.label_outer()
    for ax in axes[len(slices) :]:
        ax.set_axis_off()
    if scale:
        _draw_colour_bar(figure, water, scale, legend)
    if handles:
        figure.legend(handles=handles, loc="lower center", ncols=len(handles))
    return figure


def _draw_colour_bar(figure, water, scale, legend):
    """The colour bar above the legend, below in SI units and above in those of the tank."""
    long = 0.6 * sheet.WIDTH
    where = sheet.place(figure, 0.5 * (sheet.WIDTH - long), legend + 0.55, long, 0.12)
    bar = figure.colorbar(
        water, cax=figure.add_axes(where), orientation="horizontal", extend="max",
        label=LABELS[scale.field],
    )  # fmt: skip
    if scale.name:
        above = bar.ax.secondary_xaxis(
            "top", functions=(lambda value: value / scale.unit, lambda value: value * scale.unit)
        )
        above.set_xlabel(f"{scale.field} / ${scale.name}$")


def _handles(slices, case, box, scale):
    """What the colour bar does not tell: solids, still water, and water of one colour."""
    (left, right), (bottom, top) = box
    seen = set()
    for piece in slices:
        inside = (piece.x > left) & (piece.x < right) & (piece.z > bottom) & (piece.z < top)
        seen |= {name for name in SOLIDS if (_solid(piece, case, name) & inside).any()}
    handles = [_disc(SOLIDS[name][0], name) for name in SOLIDS if name in seen]
    if not scale:
        handles.insert(0, _disc(WATER, "water"))
    if not case.get("water"):
        handles.append(Line2D([], [], label="still water level", **STILL_WATER))
    return handles


def _disc(colour, label):
    return Line2D([], [], linestyle="", marker="o", markersize=8, color=colour, label=label)


def _solid(piece, case, name):
    """Mask of the particles of a solid, (n,) bool."""
    kinds = [kind for kind, solid in (FACES | FILLERS).items() if solid == name]
    if name not in ("wall", "obstacle"):
        return np.isin(piece.kind, kinds)
    inside, margin = np.zeros(len(piece.x), bool), 0.5 * case["particles"]["spacing"]
    for box in case.get("obstacle", ()):
        (x0, _, z0), (x1, _, z1) = box["from"], box["to"]
        inside |= (np.abs(piece.x - 0.5 * (x0 + x1)) < 0.5 * (x1 - x0) + margin) & (
            np.abs(piece.z - 0.5 * (z0 + z1)) < 0.5 * (z1 - z0) + margin
        )
    return np.isin(piece.kind, (WALL, DUMMY)) & (inside if name == "obstacle" else ~inside)


def disc_size(spacing, scale):
    """Diameter of the discs [m] for particles of a spacing [m], at a scale [points/m]."""
    return spacing if spacing * scale >= SMALL else CLOSED * spacing


def draw_slice(ax, piece, case, scale, size):
    """Particles as discs.

    Parameters
    ----------
    ax : matplotlib Axes
    piece : mpslab.analysis.snapshots.Slice
    case : dict
        The case as its TOML file holds it.
    scale : Scale, or None
        Colours of the water; None for one colour.
    size : float [m]
        Diameter of the discs.

    Returns
    -------
    matplotlib EllipseCollection
        The discs of the water.
    """
    is_face = np.isin(piece.kind, list(FACES))
    for name, colours in SOLIDS.items():
        solid = _solid(piece, case, name)
        for part, colour in zip((solid & is_face, solid & ~is_face), colours, strict=True):
            _draw_discs(ax, piece, part, size, facecolor=colour)
    if scale is None:
        return _draw_discs(ax, piece, piece.fluid, size, facecolor=WATER)
    values = getattr(piece, scale.field)[piece.fluid]
    return _draw_discs(
        ax, piece, piece.fluid, size, array=values, cmap=MAPS[scale.field], norm=scale.norm
    )


def _draw_discs(ax, piece, mask, size, **colour):
    """Discs with a diameter `size` in the units of the axes."""
    size = np.full(np.count_nonzero(mask), size)
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


def draw_still_water(ax, case, piece):
    """The still-water line up to the shore, where the tank was filled to its still depth.

    It leaves out the bodies of a slice, `mpslab.analysis.snapshots.Slice`, that stand in it.
    """
    depth = still_level(case)
    if depth is None:
        return
    bed = np.array(case["tank"]["bed"] or [[0.0, 0.0], [case["tank"]["length"], 0.0]])
    along = np.linspace(0.0, case["tank"]["length"], 1000)
    wet = np.interp(along, *bed.T) < depth
    boxes = case.get("water", ())
    if boxes:
        ends = [(box["from"][0], box["to"][0]) for box in boxes]
        wet &= np.any([(low <= along) & (along <= high) for low, high in ends], axis=0)
    wet &= ~piece.inside(along, depth, case["particles"]["spacing"])
    level = np.where(wet, depth, np.nan)
    ax.plot(along, level, **STILL_WATER)
