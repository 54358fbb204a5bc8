"""Table 1: time steps, net time and seconds a step, beside the paper's."""

from matplotlib.figure import Figure

from paper_figures.fig_5 import made_on

RUNS = ("iccg", "piccg", "scg", "ddd", "standard")
# The paper's Table 1: time steps to 1.25 s, net running time [s].
PAPER = {
    "iccg": (4269, 250481.30),
    "piccg": (4291, 90010.32),
    "scg": (4290, 90214.78),
    "ddd": (4170, 79271.70),
}
COST = ("time\nsteps", "net time\n[s]", "time a step\n[s]", "over\nICCG")
OURS = ("ranks", "to t\n[s]", *COST)
PAPERS = ("paper: time\nsteps", *COST[1:])
HEADER = ("method", *OURS, *PAPERS)
CAPTION = "Time steps, net time and time a step of the runs, and the paper's"


def rows(found):
    """The rows of the table, texts."""
    whole = each(found["iccg"])
    return [
        (
            found[name].title,
            str(found[name].record["ranks"]),
            f"{found[name].end:g}",
            f"{len(found[name].steps['step']):,}",
            f"{total(found[name]):,.0f}",
            f"{each(found[name]):.3f}",
            f"{each(found[name]) / whole:.2f}",
            *_papers(name),
        )
        for name in RUNS
    ]


def total(run):
    """Net time of all steps [s]."""
    return float(run.steps["seconds"].sum())


def each(run):
    """Mean time of a step [s]."""
    return float(run.steps["seconds"].mean())


def _papers(name):
    if name not in PAPER:
        return ("", "", "", "")
    steps, seconds = PAPER[name]
    whole, every = PAPER["iccg"], seconds / steps
    return f"{steps:,}", f"{seconds:,.0f}", f"{every:.2f}", f"{every * whole[0] / whole[1]:.2f}"


def draw(found):
    """The table as a figure, from the kept results of its runs."""
    body = rows(found)
    figure = Figure(figsize=(12.0, 1.0 + 0.42 * (len(body) + 1)), layout="constrained")
    ax = figure.subplots()
    ax.set_axis_off()
    widths = [0.30] + [0.7 / (len(HEADER) - 1)] * (len(HEADER) - 1)
    table = ax.table(body, colLabels=HEADER, colWidths=widths, loc="center", cellLoc="right",
                     edges="horizontal")  # fmt: skip
    table.auto_set_font_size(False)
    table.set_fontsize(11)
    table.scale(1.0, 1.7)
    for (row, column), cell in table.get_celld().items():
        if row == 0:
            cell.set_height(1.6 * cell.get_height())
        if column == 0:
            cell.set_text_props(ha="left")
    figure.suptitle(f"{CAPTION}\n{made_on(found[RUNS[0]])}")
    return figure
