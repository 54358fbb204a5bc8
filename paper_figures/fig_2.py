"""Figure 2: the jet touches down and splashes up; MPS, CMPS, standard, and half the spacing."""

from matplotlib.figure import Figure

from paper_figures.panels import add_u_bar, draw_side, wave_of

RUNS = ("mps", "cmps", "standard", "fine")
TOUCH_DOWN, SPLASH_UP = 1.12, 1.2  # [s]
LIMITS = (0.30, 0.48), (0.005, 0.07)  # [m]
CAPTION = "Touch-down of the jet and splash-up: particles coloured by u"


def draw(found):
    """The figure, from the kept results of its runs."""
    figure = Figure(figsize=(11.0, 10.5), layout="constrained")
    axes = figure.subplots(len(RUNS), 2, sharey=True)
    for row, name in zip(axes, RUNS, strict=True):
        for ax, time in zip(row, (TOUCH_DOWN, SPLASH_UP), strict=True):
            discs = draw_side(ax, found[name], found[name].near(time), LIMITS)
    add_u_bar(figure, axes, discs)
    figure.suptitle(f"{CAPTION}\n{wave_of(found['standard'])}")
    return figure
