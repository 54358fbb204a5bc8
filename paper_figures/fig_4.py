"""Figure 4: who owns what, and each rank's share of the particles; three ways to cut."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from paper_figures.keep import CUTS, METHODS, RANKS
from paper_figures.panels import CLOSED, draw_bed, draw_discs

RUNS = ("standard",)
# Neighbours differ in brightness.
RANK_COLOURS = ListedColormap(["#1b4f8a", "#f2c14e"] * (RANKS // 2))
NAMES = {
    "static": "static: equal widths",
    "centroid": "centroid: the paper's DDD",
    "optimal": "optimal: equal work",
}
CAPTION = f"Domain decomposition on {RANKS} ranks, and each rank's share of the particles [%]"


def draw(found):
    """The figure, from the kept results of its runs."""
    run = found[RUNS[0]]
    figure = Figure(figsize=(11.0, 13.0), layout="constrained")
    axes = figure.subplots(len(METHODS) * len(CUTS), 1, sharex=True, sharey=True)
    panels = [(method, time) for method in METHODS for time in CUTS]
    for ax, (method, time) in zip(axes, panels, strict=True):
        _draw_panel(ax, run, time, method)
    axes[-1].set_xlabel("x [m]")
    figure.suptitle(CAPTION)
    return figure


def _draw_panel(ax, run, time, method):
    water = run.tank(time)
    borders, share, work = run.cuts(time, method)
    rank = np.searchsorted(borders[1:-1], water.position[:, 0], side="right")
    draw_discs(ax, water.position[:, [0, 2]], CLOSED * run.spacing, array=rank,
               cmap=RANK_COLOURS, clim=(-0.5, RANKS - 0.5))  # fmt: skip
    draw_bed(ax, run)
    edges = np.clip(borders, -0.04, run.case["tank"]["length"])
    for left, right, part in zip(edges, edges[1:], share, strict=False):
        ax.text(0.5 * (left + right), 0.066, f"{100 * part:.1f}", ha="center", fontsize=10)
    ax.vlines(edges, -0.01, 0.078, color="0.3", linewidth=0.8, linestyle=":")
    ax.set(xlim=(-0.05, 0.81), ylim=(-0.005, 0.08), ylabel="z [m]", aspect="equal")
    uneven = f"particles {RANKS * share.max():.2f}, work {RANKS * work.max():.2f}"
    ax.set_title(f"{NAMES[method]}, t = {time:.2f} s; largest over mean: {uneven}", loc="left")
