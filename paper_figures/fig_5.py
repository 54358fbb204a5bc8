"""Figure 5: seconds and iterations of each time step, by solver and way to cut."""

import numpy as np
from matplotlib.figure import Figure

from paper_figures.panels import LINES

RUNS = ("iccg", "piccg", "scg", "ddd")
SMOOTH = 21  # steps whose median is drawn: other work on the machine strikes single steps
CAPTION = "Cost of each time step: (a) time, medians over 21 steps; (b) iterations of the solver"


def draw(found):
    """The figure, from the kept results of its runs."""
    figure = Figure(figsize=(10.0, 8.5), layout="constrained")
    seconds, iterations = figure.subplots(2, 1, sharex=True)
    for name in RUNS:
        run, steps = found[name], found[name].steps
        seconds.plot(steps["step"], smooth(steps["seconds"]), label=run.title, **LINES[name])
        iterations.plot(steps["step"], smooth(steps["iterations"]), label=run.title, **LINES[name])
    seconds.set(ylabel="time of a step [s]", ylim=(0, None))
    seconds.set_title("(a)", loc="left")
    iterations.set(xlabel="time step", ylabel="iterations of a step", ylim=(0, None))
    iterations.set_title("(b)", loc="left")
    figure.legend(handles=seconds.lines, loc="outside lower center", ncols=2)
    figure.suptitle(f"{CAPTION}\n{made_on(found[RUNS[0]])}")
    return figure


def smooth(values):
    """Running median, (steps,)."""
    padded = np.pad(np.asarray(values, float), SMOOTH // 2, mode="edge")
    return np.median(np.lib.stride_tricks.sliding_window_view(padded, SMOOTH), axis=1)


def made_on(run):
    """The machine of a run, in words."""
    machine, counts = run.record["machine"], run.record["particles"]
    return f"{sum(counts.values()):,} particles; {machine['cpu']}, {machine['cores']} cores"
