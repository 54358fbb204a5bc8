"""Figure 5: seconds and iterations of each time step, by solver and way to cut."""

from matplotlib.figure import Figure

from paper_figures.panels import LINES

RUNS = ("iccg", "piccg", "scg", "ddd", "deflated")
CAPTION = (
    "Cost of each time step: (a) time; (b) iterations of the solver. Steps of each method from the "
    "same states, in turn,\nand lines through their medians"
)


def draw(found):
    """The figure, from the kept results of its methods."""
    figure = Figure(figsize=(10.0, 8.5), layout="constrained")
    seconds, iterations = axes = figure.subplots(2, 1, sharex=True)
    for name in RUNS:
        method = found[name]
        for ax, column in zip(axes, ("seconds", "iterations"), strict=True):
            ax.plot(method.middle("step"), method.middle(column), label=method.title, **LINES[name])
            ax.plot(method.steps["step"], method.steps[column], ".", markersize=3, alpha=0.5,
                    color=LINES[name]["color"])  # fmt: skip
    seconds.set(ylabel="time of a step [s]", ylim=(0, None))
    seconds.set_title("(a)", loc="left")
    iterations.set(xlabel="time step", ylabel="iterations of a step", ylim=(0, None))
    iterations.set_title("(b)", loc="left")
    lines = [line for line in seconds.lines if not line.get_label().startswith("_")]
    figure.legend(handles=lines, loc="outside lower center", ncols=2)
    figure.suptitle(f"{CAPTION}\n{made_on(found[RUNS[0]])}")
    return figure


def made_on(run):
    """The machine of a run, in words."""
    machine, counts = run.record["machine"], run.record["particles"]
    cores = "1 core" if machine["cores"] == 1 else f"{machine['cores']} cores"
    return f"{sum(counts.values()):,} particles; {machine['cpu']}, {cores}"
