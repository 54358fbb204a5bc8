"""Figure 1: the plunging jet, MPS beside CMPS and the standard recipe."""

from matplotlib.figure import Figure

from paper_figures.panels import add_u_bar, draw_scene, draw_side, wave_of

RUNS = ("mps", "cmps", "standard")
BEFORE, JET = 1.0, 1.04  # [s]
LIMITS = (0.24, 0.36), (0.0, 0.065)  # [m]
CAPTION = (
    "Development of the plunging jet: particles coloured by u, just before it and at its moment"
)


def draw(found):
    """The figure, from the kept results of its runs."""
    figure = Figure(figsize=(15.0, 10.0), layout="constrained")
    grid = figure.add_gridspec(len(RUNS), 3, width_ratios=(1.0, 1.0, 1.25))
    for k, name in enumerate(RUNS):
        run = found[name]
        for j, time in enumerate((BEFORE, JET)):
            ax = figure.add_subplot(grid[k, j])
            draw_side(ax, run, run.near(time), LIMITS)
        colours = draw_scene(figure.add_subplot(grid[k, 2]), run, run.near(JET), LIMITS[0])
    add_u_bar(figure, figure.axes, colours)
    figure.suptitle(f"{CAPTION}\n{wave_of(found['standard'])}")
    return figure
