"""What the suite shows while it runs: a bar on a terminal, plain lines in a log."""

import time

from rich.console import Console

from mpslab.run.progress import LINE_EVERY, make_bar


def make_display(tasks, console=None):
    """Display as a context manager, called now and then while the tasks run.

    Parameters
    ----------
    tasks : list of validation.work.Task
    """
    console = console or Console()
    return Bar(tasks, console) if console.is_terminal else Lines(tasks)


class Lines:
    """A line every few seconds, with what is running and the time left."""

    def __init__(self, tasks):
        self.tasks, self.ended = tasks, set()
        self.total = sum(task.plan.weight for task in tasks) or 1.0
        self.began = self.printed = time.monotonic()
        self.taken_over = None

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return None

    def end(self, task):
        """Count a task as done."""
        self.ended.add(task.folder)

    @property
    def share(self):
        """Share of the work that is done, from 0 to 1."""
        done = (t.plan.weight * (1.0 if t.folder in self.ended else t.done) for t in self.tasks)
        return sum(done) / self.total

    def running(self):
        """The runs in hand, and how far they are."""
        busy = [t for t in self.tasks if t.folder not in self.ended and t.done > 0.0]
        return ", ".join(f"{t.case}/{t.plan.name} {100 * t.done:.0f} %" for t in busy)

    def __call__(self):
        now, share = time.monotonic(), self.share
        if self.taken_over is None:
            self.taken_over = share
        if now - self.printed >= LINE_EVERY:
            self.printed = now
            done = share - self.taken_over
            left = f", {(now - self.began) * (1.0 - share) / done:.0f} s left" if done > 0.0 else ""
            print(f"{100 * share:.0f} %{left}: {self.running()}", flush=True)


class Bar(Lines):
    """A bar with time left, for a terminal."""

    def __init__(self, tasks, console):
        super().__init__(tasks)
        self.progress = make_bar(console, elapsed_when_finished=True)
        self.task = self.progress.add_task("starting", total=1.0)

    def __enter__(self):
        self.progress.start()
        return self

    def __exit__(self, *error):
        self.progress.stop()

    def __call__(self):
        self.progress.update(self.task, completed=self.share, description=self.running())
