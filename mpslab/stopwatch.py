"""Where the time of a step goes."""

import time
from collections import defaultdict
from contextlib import contextmanager


class Stopwatch:
    """Seconds spent in each named phase, summed over the run."""

    def __init__(self):
        self.seconds = defaultdict(float)

    @contextmanager
    def phase(self, name):
        """Add the time of a ``with`` block to the phase."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] += time.perf_counter() - start
