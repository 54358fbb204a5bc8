"""What a run shows while it goes on: a bar on a terminal, plain lines in a log."""

import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

LINE_EVERY = 10.0  # seconds between the lines of a log
SEEN = 3600.0  # seconds over which a bar takes the mean speed, for the time left


def make_progress(until, started, console=None):
    """Progress display as a context manager that is called with the simulation each step.

    Parameters
    ----------
    until : float [s]
        Physical time at which the run ends.
    started : float [s]
        Physical time at which it starts.
    """
    console = console or Console()
    return Bar(until, started, console) if console.is_terminal else Lines(until, started)


def make_bar(console, **remaining):
    """Bar with percentage, description and times; keywords go to rich's TimeRemainingColumn."""
    return Progress(
        BarColumn(),
        TextColumn("{task.percentage:3.0f} %"),
        TextColumn("{task.description}"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(**remaining),
        console=console,
        speed_estimate_period=SEEN,
    )


def _figures(simulation):
    row = simulation.last_row
    return (
        f"t = {row['time']:.4f} s  step {row['step']}  dt {row['dt']:.2e} s ({row['dt_limit']})  "
        f"{row['iterations']} iterations"
    )


class Bar:
    """A bar with time left, for a terminal."""

    def __init__(self, until, started, console):
        self.progress = make_bar(console)
        self.task = self.progress.add_task("starting", total=until, completed=started)

    def __enter__(self):
        self.progress.start()
        return self

    def __exit__(self, *error):
        self.progress.stop()

    def __call__(self, simulation):
        self.progress.update(
            self.task, completed=simulation.time, description=_figures(simulation)
        )


class Lines:
    """A line every few seconds, for a log."""

    def __init__(self, until, started):
        self.until, self.started = until, started
        self.began = self.printed = time.monotonic()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return None

    def __call__(self, simulation):
        now = time.monotonic()
        if now - self.printed < LINE_EVERY:
            return
        self.printed = now
        done = (simulation.time - self.started) / (self.until - self.started)
        left = (now - self.began) * (1.0 - done) / done if done > 0.0 else 0.0
        print(f"{_figures(simulation)}  {100 * done:.0f} %, {left:.0f} s left", flush=True)
