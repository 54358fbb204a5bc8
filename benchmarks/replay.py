"""A clock for pytest-benchmark that lets the time steps of a finished run pass again."""


class Replay:
    """Callable as a timer [s]; each `step` takes as long as the next of `seconds`."""

    def __init__(self):
        self.now, self.seconds = 0.0, iter(())

    def __call__(self):
        return self.now

    def step(self):
        """Let the next time step pass."""
        self.now += next(self.seconds)


REPLAY = Replay()
