"""A picture of a tank as it is laid out: bed, water, and its solids of any shape."""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from mpslab.analysis.pictures import STYLE
from mpslab.core.lattice import effective_length
from mpslab.solids import shaped

DOT = 4.0  # points^2 of a place on a face
WIDE = 9.0  # inches
TALLEST = 12.0  # inches


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
        axes.scatter(*shaped.faces(case, number)[:, index].T, s=DOT, label=given.name, zorder=3)
    if view == "xz":
        x, z = np.array(case.tank.bed).T
        axes.fill_between(x, z, min(z.min(), 0.0) - 0.03 * extent["z"], color="0.7")
    if down == "z" and not case.water:
        axes.axhline(case.tank.depth, color="C0", lw=0.8, zorder=1)
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
