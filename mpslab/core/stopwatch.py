"""Where the time of a step goes: into which phase, and how much of it to other ranks."""

from collections import defaultdict
from time import perf_counter

PHASES = ("ghosts", "neighbours", "operators", "assembly", "solve", "record", "rest")
WORK, COMMUNICATION, WAITING = KINDS = ("work", "communication", "waiting")


class Stopwatch:
    """Wall time by phase and kind, summed over the run.

    Both are opened by ``with``, one inside another; time counts for the innermost alone, and
    outside of all phases not at all.  Communication is what a rank does to pack, send, receive and
    unpack.  Waiting is the time until another rank, or its message, is there; for how much of it
    the message was under way cannot be known.

    Attributes
    ----------
    spent : dict of (phase, kind) to float [s]
    """

    def __init__(self):
        self.spent = defaultdict(float)
        self._open, self._since = (None, WORK), perf_counter()
        self._at_lap = {}

    def phase(self, name):
        """Count the time of a ``with`` block for a phase, as work."""
        return _Turn(self, (name, WORK))

    def kind(self, name):
        """Count the time of a ``with`` block as another kind, in the phase that is open."""
        return _Turn(self, (self._open[0], name))

    def turn(self, to):
        """Count for another (phase, kind) from now on; returns the one before."""
        now, before = perf_counter(), self._open
        if before[0] is not None:
            self.spent[before] += now - self._since
        self._open, self._since = to, now
        return before

    @property
    def seconds(self):
        """Seconds of each phase, whatever the kind."""
        total = defaultdict(float)
        for (phase, _), seconds in self.spent.items():
            total[phase] += seconds
        return dict(total)

    def lap(self):
        """Seconds by (phase, kind) since the last lap, up to now."""
        self.turn(self._open)
        spent = {at: s - self._at_lap.get(at, 0.0) for at, s in self.spent.items()}
        self._at_lap = dict(self.spent)
        return spent


class _Turn:
    """A ``with`` block of a stopwatch; as a class it is quick enough for the iterations of a
    solver.
    """

    __slots__ = ("back", "to", "watch")

    def __init__(self, watch, to):
        self.watch, self.to = watch, to

    def __enter__(self):
        self.back = self.watch.turn(self.to)

    def __exit__(self, *error):
        self.watch.turn(self.back)
