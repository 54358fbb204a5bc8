"""Figure 3: fingers: the surface at the jet and after, and its variance across the tank."""

from matplotlib.figure import Figure

from paper_figures.panels import LINES, add_u_bar, draw_scene, name_of, wave_of

RUNS = ("cmps", "mps", "standard")
SEEN = ("cmps", "standard")
ALONG = 0.30, 0.46  # [m]
TIMES = (1.09, 1.16, 1.2)  # [s]
CAPTION = "Fingers: the surface at the jet and after it, coloured by u, and its variance across"


def draw(found):
    """The figure, from the kept results of its runs."""
    figure = Figure(figsize=(9.6, 11.5), layout="constrained")
    grid = figure.add_gridspec(len(TIMES) + 1, len(SEEN))
    axes = [figure.add_subplot(grid[i, j]) for i in range(len(TIMES)) for j in range(len(SEEN))]
    panels = [(time, name) for time in TIMES for name in SEEN]
    for ax, (time, name) in zip(axes, panels, strict=True):
        colours = draw_scene(ax, found[name], found[name].near(time), ALONG, as_surface=True)
    add_u_bar(figure, axes, colours)
    below = figure.add_subplot(grid[-1, :])
    for name in RUNS:
        series = found[name].series
        below.plot(series["time [s]"], series["share across the tank"], label=name_of(found[name]),
                   **LINES[name])  # fmt: skip
    below.set(xlabel="t [s]", ylabel="variance across\nthe tank / all [-]", ylim=(0, None))
    below.set_title("share of the variance of the surface that is across the tank", loc="left")
    below.legend()
    figure.suptitle(f"{CAPTION}\n{wave_of(found['standard'])}")
    return figure
