"""The pictures of a film: the water of one frame, the time, a scale and what the colours mean."""

from dataclasses import dataclass

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from mpslab.analysis.headings import heading
from mpslab.analysis.panels import LABELS, MAPS, disc_size, draw_slice, draw_still_water, make_scale
from mpslab.analysis.scenes import scene
from mpslab.analysis.scenes.view import fitted
from mpslab.analysis.snapshots import middle_slice
from mpslab.core.kinds import FLUID, GATE, GATE_DUMMY, PISTON
from mpslab.core.particles import FIRST_SOLID

UNITS = 960  # of the layout across a picture, however many pixels it has
HEADING, CLOCK, SCALE, BAR = 20, 26, 42, 54  # heights [units]: a line, time, ticks, colour bar
EDGE = 60  # left and right of a 2-D tank [units]
HIGHEST = 0.5  # largest height of the tank in a picture over its width
# The eye of a 3-D film: ahead of the wave, and above it [degrees].
AZIMUTH, ELEVATION = -24.0, 20.0
GROUND = 0.12  # water depths: how thick the bed is drawn
# In 3-D the colours of speed are those of water: deep blue at rest, white as foam where it is fast.
SEA = LinearSegmentedColormap.from_list(
    "sea",
    [(0.0, (0.08, 0.30, 0.55)), (0.4, (0.20, 0.52, 0.78)), (0.75, (0.52, 0.79, 0.93)),
     (1.0, (0.88, 0.95, 0.99))],
)  # fmt: skip
TEXT = {"fontsize": 9.5, "color": "0.15"}
SPRAY = 0.999  # share of the water that has to be in the picture: spray may fly out of it


@dataclass(frozen=True)
class Shot:
    """What a film shows.

    Attributes
    ----------
    case : dict
        The case as its TOML file holds it.
    box : ((float, float), (float, float)) [m]
        Limits of x and z.
    field : str
        What colours the water: "speed", "along", "pressure" or "none".
    width : int [pixels]
        Of the pictures.
    pace : str
        How fast the film plays, in words.
    surface : bool
        For a 3-D run: whether to draw the surface of the water, or its particles.
    """

    case: dict
    box: tuple
    field: str
    width: int
    pace: str
    surface: bool = False

    @property
    def scale(self):
        """The `mpslab.analysis.panels.Scale` of the field, None for water of one colour."""
        return None if self.field == "none" else make_scale(self.case, self.field)

    @property
    def cmap(self):
        """Colours of the field, a name or a matplotlib Colormap; None for water of one colour."""
        if self.field == "speed" and self.case["tank"]["width"]:
            return SEA
        return MAPS.get(self.field)

    def painter(self):
        """The function that draws the frames, (time [s], frame) -> (h, w, 3) uint8."""
        return (_InSpace if self.case["tank"]["width"] else _InPlane)(self)


def box_of(frames, case, window=None):
    """Limits ((x, x), (z, z)) [m] of what a film is to show, from some of its frames.

    Parameters
    ----------
    frames : iterable of dict
        As `mpslab.output.vtkhdf.read_frame` returns them.
    case : dict
    window : (float, float) [m], optional
        Limits of x; by default the whole tank, and the piston as far back as it goes.
    """
    spacing, tank = case["particles"]["spacing"], case["tank"]
    left, right = window or (0.0, tank["length"])
    tops, boxes = [0.0], case.get("obstacle", ())
    for frame in frames:
        place = frame["position"]
        pistons = place[frame["kind"] == PISTON, 0]
        if window is None and len(pistons):
            left = min(left, float(pistons.min()) - 3.0 * spacing)
        water = place[frame["kind"] == FLUID]
        water = water[(water[:, 0] >= left) & (water[:, 0] <= right), 2]
        if len(water):
            tops.append(float(np.quantile(water, SPRAY)))
    bed = np.array(bed_of(case))
    ends = np.interp([left, right], *bed.T)
    ground = [*ends, *bed[(bed[:, 0] > left) & (bed[:, 0] < right), 1]]
    tops += [box["to"][2] for box in boxes if box["to"][0] > left and box["from"][0] < right]
    bottom = min(ground) - ground_of(case)
    return (left, right), (float(bottom), max(*tops, *ground) + 4.0 * spacing)


def bed_of(case):
    """Points (x, z) of the bed [m]."""
    return case["tank"]["bed"] or [[0.0, 0.0], [case["tank"]["length"], 0.0]]


def ground_of(case):
    """How thick the bed is drawn [m]."""
    return max(GROUND * case["tank"]["depth"], 2.0 * case["particles"]["spacing"])


class _Sheet:
    """A picture with its heading, time and colour bar, around a middle of a height [units]."""

    def __init__(self, shot, middle):
        self.shot = shot
        lines = heading(shot.case, "", 125).strip().splitlines()
        top = HEADING * len(lines) + 10
        self.bar = BAR if shot.scale else 0
        unit = shot.width / UNITS
        self.low = self.bar  # lower end of the middle [units]
        height = 2 * round(0.5 * unit * (top + CLOCK + middle + self.bar))
        self.size = shot.width, height
        dots = 100.0 * unit
        self.figure = Figure(figsize=(shot.width / dots, height / dots), dpi=dots)
        self.canvas = FigureCanvasAgg(self.figure)
        self.height = height / unit
        for number, line in enumerate(lines):
            size = {"fontsize": 11.5, "color": "0.0"} if number == 0 else TEXT
            self.text(16, self.height - 8 - HEADING * number, line, va="top", **size)
        under = self.height - top - 0.5 * CLOCK
        self.clock = self.text(16, under, "", va="center", fontsize=12.5, color="0.0")
        self.text(UNITS - 16, under, shot.pace, va="center", ha="right", **TEXT)
        if shot.scale:
            self._draw_bar(shot.scale)

    def text(self, x, y, words, **options):
        """Words at a place [units]."""
        return self.figure.text(x / UNITS, y / self.height, words, **options)

    def axes(self, x, y, width, height):
        """Axes at a place [units]."""
        frame = x / UNITS, y / self.height, width / UNITS, height / self.height
        return self.figure.add_axes(frame)

    def _draw_bar(self, scale):
        ax = self.axes(0.3 * UNITS, 38, 0.4 * UNITS, 9)
        extend = "both" if scale.norm.vmin < 0.0 else "max"
        colours = ScalarMappable(scale.norm, self.shot.cmap)
        bar = self.figure.colorbar(colours, cax=ax, orientation="horizontal", extend=extend)
        bar.outline.set_linewidth(0.5)
        ax.tick_params(labelsize=8.5, length=2.5, pad=2)
        ax.set_xlabel(LABELS[scale.field], labelpad=1, **TEXT)

    def image(self, time):
        """The picture with a time [s], (h, w, 3) uint8."""
        self.clock.set_text(f"t = {time:.3f} s")
        self.canvas.draw()
        width, height = self.size
        return np.asarray(self.canvas.buffer_rgba())[:height, :width, :3].copy()


class _InPlane:
    """Draws the frames of a 2-D run: particles as discs."""

    def __init__(self, shot):
        (left, right), (bottom, top) = shot.box
        across = UNITS - 2 * EDGE
        middle = min(across * (top - bottom) / (right - left), HIGHEST * UNITS)
        self.sheet = sheet = _Sheet(shot, middle + SCALE)
        self.ax = ax = sheet.axes(EDGE, sheet.low + SCALE, across, middle)
        ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        ax.tick_params(labelsize=9)
        ax.yaxis.set_major_locator(MaxNLocator(max(int(middle / 40), 2)))
        ax.set_xlabel("x [m]", labelpad=1, **TEXT)
        ax.set_ylabel("z [m]", **TEXT)
        points = 0.72 * across / (right - left)  # a unit is 0.72 points: the page has 9.6 inches
        self.size = disc_size(shot.case["particles"]["spacing"], points)

    def __call__(self, time, frame):
        shot, spacing = self.sheet.shot, self.sheet.shot.case["particles"]["spacing"]
        (left, right), _ = shot.box
        near = np.abs(frame["position"][:, 0] - 0.5 * (left + right)) < 0.5 * (right - left)
        frame = {name: rows[near] for name, rows in frame.items()}
        for drawn in [*self.ax.collections, *self.ax.lines]:
            drawn.remove()
        piece = middle_slice(time, frame, spacing, 0.0)
        draw_slice(self.ax, piece, shot.case, shot.scale, self.size)
        draw_still_water(self.ax, shot.case, piece)
        return self.sheet.image(time)


class _InSpace:
    """Draws the frames of a 3-D run: a scene seen from ahead and above."""

    def __init__(self, shot):
        self.shot = shot
        tank, self.spacing = shot.case["tank"], shot.case["particles"]["spacing"]
        self.width = max(round(tank["width"] / self.spacing), 1) * self.spacing
        along, up = shot.box
        box = along, (0.0, self.width), up
        self.ground = ground_of(shot.case)
        self.view = fitted(box, shot.width, HIGHEST, azimuth=AZIMUTH, elevation=ELEVATION,
                           seen=self._outline(box))  # fmt: skip
        unit = shot.width / UNITS
        high = self.view.size[1] / unit
        self.sheet = sheet = _Sheet(shot, high + SCALE)
        ax = sheet.axes(0, sheet.low, UNITS, high + SCALE)
        ax.set_axis_off()
        width, height = self.view.size
        blank = np.full((height, width, 3), 255, np.uint8)
        self.image = ax.imshow(blank, extent=(0, width, height, 0), interpolation="nearest",
                               aspect="auto")  # fmt: skip
        ax.set(xlim=(0, width), ylim=(height + SCALE * unit, 0))
        self._draw_ticks(ax, unit)

    def _outline(self, box):
        """The lower edges of the bed, and the upper corners of the box."""
        (left, right), sides, (_, top) = box
        x = np.linspace(left, right, 20)
        low = np.interp(x, *np.transpose(bed_of(self.shot.case))) - self.ground
        edges = [(x, low), ((left, right), (top, top))]
        return tuple((a, y, z) for along, up in edges for a, z in zip(along, up, strict=True)
                     for y in sides)  # fmt: skip

    def _draw_ticks(self, ax, unit):
        """Places along x below the near side of the tank."""
        (left, right), _, _ = self.view.box
        ticks = MaxNLocator(10, steps=[1, 2, 5, 10]).tick_values(left, right)
        ticks = ticks[(ticks >= left) & (ticks <= right)]
        digits = max(int(np.ceil(-np.log10(ticks[1] - ticks[0]) - 1e-9)), 0)
        for x, (across, down) in zip(ticks, self._below(ticks), strict=True):
            ax.plot([across] * 2, [down + 2 * unit, down + 7 * unit], color="0.4", linewidth=0.8)
            ax.text(across, down + 9 * unit, f"{x:.{digits}f}", ha="center", va="top", fontsize=9)
        middle = len(ticks) // 2
        across, down = self._below(ticks[middle - 1 : middle + 1]).mean(axis=0)
        ax.text(across, down + 9 * unit, "x [m]", ha="center", va="top", **TEXT)

    def _below(self, x):
        """Pixels of the lower edge of the bed on the near side."""
        z = np.interp(x, *np.transpose(bed_of(self.shot.case))) - self.ground
        return self.view.project(np.column_stack([x, np.zeros(len(x)), z]))

    def __call__(self, time, frame):
        shot, wet = self.shot, frame["kind"] == FLUID
        scale = shot.scale
        picture = scene.draw(
            frame["position"][wet], self.spacing, self.view,
            values=None if scale is None else values_of(frame, shot.field)[wet],
            cmap=shot.cmap,
            limits=None if scale is None else (scale.norm.vmin, scale.norm.vmax),
            as_surface=shot.surface, bed=bed_of(shot.case), ground=self.ground,
            width=self.width,
            period=self.width if shot.case["tank"].get("periodic") else 0.0,
            paddle_x=_face(frame, self.spacing), blocks=self._blocks(frame),
            solids=self._solids(frame),
        )  # fmt: skip
        self.image.set_data(picture.image)
        return self.sheet.image(time)

    def _blocks(self, frame):
        """Obstacles, and the gate where it is."""
        blocks = []
        for box in self.shot.case.get("obstacle", ()):
            (x0, y0, z0), (x1, y1, z1) = box["from"], box["to"]
            blocks.append(((x0, max(y0, 0.0), z0), (x1, min(y1, self.width), z1)))
        gate = frame["position"][np.isin(frame["kind"], (GATE, GATE_DUMMY))]
        if len(gate):
            half = 0.5 * self.spacing
            blocks.append((gate.min(axis=0) - half, gate.max(axis=0) + half, (0.70, 0.27, 0.49)))
        return blocks

    def _solids(self, frame):
        """Particles of each solid of any shape."""
        case, body = self.shot.case, frame["body"]
        first = FIRST_SOLID + len(case.get("obstacle", ())) + len(case.get("gate", ()))
        return [frame["position"][body == one] for one in range(first, int(body.max()) + 1)]


def values_of(frame, field):
    """A field of the particles of a frame, (n,) float32: "speed", "along" or "pressure"."""
    if field == "pressure":
        return frame["pressure"]
    velocity = frame["velocity"]
    return velocity[:, 0] if field == "along" else np.linalg.norm(velocity, axis=1)


def _face(frame, spacing):
    """x of the face of the piston [m]; None if there is none."""
    piston = frame["position"][frame["kind"] == PISTON, 0]
    return float(piston.max()) + 0.5 * spacing if len(piston) else None
