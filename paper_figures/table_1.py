"""Table 1: time steps, net time and seconds a step, beside the paper's."""

from dataclasses import dataclass

from matplotlib.figure import Figure

from paper_figures.fig_5 import made_on

METHODS = ("iccg", "piccg", "scg", "ddd", "deflated")
RUNS = (*METHODS, "cmps", "standard")
END = 1.25  # [s] of the paper's runs
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
CAPTION = "Time steps, net time and time a step of the methods, and the paper's"


def rows(found):
    """The rows of the table, texts."""
    costs = {name: cost(found[name], found["cmps"]) for name in METHODS}
    costs["standard"] = cost(found["standard"], found["standard"])
    first = costs["iccg"]
    return [
        (
            found[name].title,
            str(found[name].record["ranks"]),
            f"{END:g}",
            f"{each.steps:,}",
            f"{each.net:,.0f}",
            f"{each.step:.3f}",
            f"{each.step / first.step:.2f}",
            *_papers(name),
        )
        for name, each in costs.items()
    ]


@dataclass(frozen=True)
class Cost:
    """Number of time steps to `END` [s], and their net time [s]."""

    steps: int
    net: float

    @property
    def step(self):
        """Mean time of a step [s]."""
        return self.net / self.steps


def cost(done, run):
    """The cost of a whole run: of a method, between the medians of its samples; of a run, its own.

    Parameters
    ----------
    done : paper_figures.kept.Sampled or Kept
    run : paper_figures.kept.Kept
        The run that was sampled, which has as many steps with each method.
    """
    to_end = run.steps["time [s]"] <= END
    seconds = done.over("seconds", run.steps["step"]) if done is not run else run.steps["seconds"]
    return Cost(int(to_end.sum()), float(seconds[to_end].sum()))


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
