"""A picture of a tank as it is laid out: bed, water, and its solids of any shape."""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from mpslab.analysis.pictures import STYLE
from mpslab.core.lattice import effective_length
from mpslab.solids import obstacles, shaped

DOT = 4.0  # points^2 of a place on a face
WIDE = 9.0  # inches
TALLEST = 12.0  # inches
FINE, COARSE = 600, 60  # places where the still water is looked at, along the view and into it


def draw(case, path):
    """Draw the tank from the side, and one with width from above and from the end as well.

    A solid is drawn by places on its faces, a spacing apart, as its first layer of particles has
    them: what lies outside of the tank or in the bed is cut off only when it is laid out.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    path : str or Path
        File to write, such as tank.png.
    """
    views = ["xz", "xy", "yz"] if case.dim == 3 else ["xz"]
    extent = {"x": effective_length(case), "y": case.tank.width, "z": case.tank.height}
    heights = [extent[down] / extent[along] for along, down in views]
    with matplotlib.rc_context(STYLE):
        tall = min(WIDE * sum(heights) + len(views), TALLEST)
        figure = Figure(figsize=(WIDE, tall), layout="constrained")
        for view, axes in zip(views, figure.subplots(len(views), squeeze=False)[:, 0], strict=True):
            _view(case, axes, view, extent)
        figure.axes[0].set_title(case.name)
        if case.solid:
            figure.legend(loc="outside lower center", ncols=4, markerscale=3.0)
        figure.savefig(Path(path))


def _view(case, axes, view, extent):
    along, down = view
    index = ["xyz".index(axis) for axis in view]
    for number, given in enumerate(case.solid):
        label = given.name if view == "xz" else None
        axes.scatter(*shaped.faces(case, number)[:, index].T, s=DOT, label=label, zorder=3)
    if view == "xz":
        x, z = np.array(case.tank.bed).T
        axes.fill_between(x, z, min(z.min(), 0.0) - 0.03 * extent["z"], color="0.7")
    if down == "z" and not case.water:
        at, wet = _surface(case, index[0], extent)
        level = np.where(wet, case.tank.depth, np.nan)
        axes.plot(at, level, color="C0", lw=0.8, zorder=1)
    for box in case.water:
        low, high = (np.array(corner)[index] for corner in (box.start, box.end))
        axes.add_patch(matplotlib.patches.Rectangle(low, *(high - low), color="C0", alpha=0.2))
    for edge in (0.0, extent[along]):
        axes.axvline(edge, color="k", lw=0.8)
        axes.set_xlim(-0.03 * extent[along], 1.03 * extent[along])
    if down == "y":
        axes.axhline(0.0, color="k", lw=0.8)
        axes.axhline(extent["y"], color="k", lw=0.8)
    axes.set(xlabel=f"{along} [m]", ylabel=f"{down} [m]", aspect="equal")


def _surface(case, axis, extent):
    """Places along an axis, and where nothing hides the still water that is seen there, (n,) each.

    Seen from the side, that is where none of it is in a solid.
    """
    count = [FINE, COARSE if case.dim == 3 else 1] if axis == 0 else [COARSE, FINE]
    x, y = (np.linspace(0.0, extent[name], n) for name, n in zip("xy", count, strict=True))
    places = np.stack(np.meshgrid(x, y, [case.tank.depth], indexing="ij"), axis=-1)[:, :, 0]
    flat = places.reshape(-1, 3)
    hidden = shaped.holds(case, flat) | obstacles.holds(case, flat)
    wet = case.tank.bed_height(flat[:, 0]) < case.tank.depth
    other = 1 - axis
    hidden, wet = (mask.reshape(places.shape[:2]) for mask in (hidden, wet))
    return (x, y)[axis], wet.any(axis=other) & ~hidden.any(axis=other)
