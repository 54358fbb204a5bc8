"""What the figures share: names, colours, and the water of a slice seen from the side."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize

from mpslab.analysis.scenes import scene
from mpslab.analysis.scenes.view import fitted

# As bright in grey as in colour, and even to the eye.
COLOURS = "viridis"
U = Normalize(0.0, 1.0)  # [m/s]: water in a jet is a little faster than sqrt(g h) = 0.63 m/s
U_LABEL = "velocity along the tank, u [m/s]"
BED = "0.75"
HIGHEST = 0.065  # [m] of a scene
PIXELS = 1100  # across a scene
TICK = 0.04  # [m]
CLOSED = 1.4  # times the spacing: discs as wide leave no gaps between particles
# Lines of runs: dark to light as well as in hue, and dashes.
LINES = {
    "iccg": {"color": "black", "linestyle": "-"},
    "piccg": {"color": "#d55e00", "linestyle": "-"},
    "scg": {"color": "#0072b2", "linestyle": "--"},
    "ddd": {"color": "#009e73", "linestyle": (0, (4, 2))},
    "deflated": {"color": "#56b4e9", "linestyle": ":"},
    "cmps": {"color": "#d55e00", "linestyle": "--"},
    "mps": {"color": "#cc79a7", "linestyle": "-."},
    "standard": {"color": "#0072b2", "linestyle": "-"},
    "fine": {"color": "#56b4e9", "linestyle": ":"},
}


def name_of(run):
    """How a panel is headed: gradient or recipe, particle spacing, and 2-D where it is."""
    scheme = run.case["scheme"]
    names = {"mps": "MPS", "cmps": "CMPS", "cmps_soft": "CMPS"}
    recipe = names.get(scheme["gradient"], scheme["recipe"])
    return f"{recipe}, $d_0$ = {1e3 * run.spacing:g} mm{'' if run.width else ', 2-D'}"


def layer(water, run):
    """The water of the layer next to the middle of the tank, one spacing thick."""
    middle = 0.5 * run.width - 0.25 * run.spacing
    return np.abs(water.position[:, 1] - middle) < 0.5 * run.spacing


def draw_side(ax, run, water, limits):
    """The middle layer of the water from the side, coloured by u; returns the discs.

    Parameters
    ----------
    ax : matplotlib Axes
    run : paper_figures.kept.Kept
    water : paper_figures.kept.Water
    limits : ((float, float), (float, float)) [m]
        Of x, where the wave is not late, and of z.
    """
    seen = layer(water, run)
    place, size = water.position[seen][:, [0, 2]], CLOSED * run.spacing
    discs = draw_discs(ax, place, size, array=water.u[seen], cmap=COLOURS, norm=U)
    draw_bed(ax, run)
    ax.set(xlim=run.moved(limits[0]), ylim=limits[1], aspect="equal")
    ax.set(xlabel="x [m]", ylabel="z [m]")
    ax.set_title(f"{name_of(run)}, t = {water.time:.2f} s", loc="left")
    return discs


def draw_scene(ax, run, water, along, as_surface=False):
    """The water near the wave in perspective, from ahead of it, coloured by u.

    Parameters
    ----------
    ax, run, water
        As for `draw_side`.
    along : (float, float) [m]
        What is seen of the tank, where the wave is not late.
    as_surface : bool
        Its surface, in place of particles.

    Returns
    -------
    matplotlib ScalarMappable, of u
    """
    along = run.moved(along)
    box = along, (0.0, run.width), (np.interp(along[0], *_bed(run)), HIGHEST)
    seen = fitted(box, PIXELS, azimuth=-40.0, elevation=24.0)
    picture = scene.draw(water.position, run.spacing, seen, water.u, COLOURS, (U.vmin, U.vmax),
                         as_surface, bed=run.case["tank"]["bed"], ground=run.spacing,
                         width=run.width, period=run.width)  # fmt: skip
    height, width, _ = picture.image.shape
    ax.imshow(picture.image, extent=(0, width, height, 0))
    _draw_scale(ax, picture.project, run, along)
    ax.set_axis_off()
    ax.set_title(f"{name_of(run)}, t = {water.time:.2f} s", loc="left")
    return ScalarMappable(U, COLOURS)


def _draw_scale(ax, project, run, along):
    """Ticks of x [m] along the lower edge in front, and the width of the tank."""

    def at(x, y):
        return project(np.array([x, y, np.interp(x, *_bed(run)) - 2 * run.spacing]))

    for x in np.arange(np.ceil(along[0] / TICK), along[1] / TICK) * TICK:
        place = at(x, 0.0)
        ax.plot(*place, marker="|", markersize=6, color="0.2")
        ax.annotate(f"{x:.2f}", place, (0, -7), textcoords="offset points", ha="center", va="top",
                    fontsize=9)  # fmt: skip
    ax.annotate("x [m]", at(0.5 * sum(along), 0.0), (0, -20), textcoords="offset points",
                ha="center", va="top", fontsize=9)  # fmt: skip
    ax.annotate(f"y: 0 to {run.width:g} m", at(along[1], 0.5 * run.width), (6, -6),
                textcoords="offset points", va="top", fontsize=9)  # fmt: skip


def draw_discs(ax, place, size, **colour):
    """Particles as discs of a size [m], at places (n, 2) [m]."""
    size = np.full(len(place), size)
    return ax.add_collection(
        EllipseCollection(size, size, np.zeros(len(place)), units="xy", offsets=place,
                          offset_transform=ax.transData, linewidth=0, **colour)
    )  # fmt: skip


def draw_bed(ax, run):
    """The ground below the bed of the tank."""
    x, z = _bed(run)
    ax.fill_between([-1.0, *x], [z[0], *z], -1.0, color=BED, linewidth=0)


def _bed(run):
    """x and z of the points of the bed, (2, k) [m]."""
    return np.transpose(run.case["tank"]["bed"])


def add_u_bar(figure, axes, discs):
    """The colour bar of u, below the panels."""
    figure.colorbar(discs, ax=axes, location="bottom", extend="both", shrink=0.5, aspect=50,
                    pad=0.02, label=U_LABEL)  # fmt: skip


def wave_of(run):
    """Wave and tank in a line, and the size of this run, for the heading of a figure."""
    maker, particles = run.case["wavemaker"], run.record["particles"]
    return (
        f"wave H = {1e3 * maker['height']:.3g} mm, T = {maker['period']:g} s in "
        f"{1e3 * run.case['tank']['depth']:.3g} mm of water; {run.title}: "
        f"{sum(particles.values()):,} particles"
    )
