"""When something falls due that is done every so often."""

import math
from numbers import Real

from mpslab.core.keys import require


def due(interval, before, time):
    """Whether an interval [s] ends in the step from one time to another [s]; each step, with 0.

    No state is kept, so a run that goes on from a checkpoint does the same things at the same
    times.
    """
    return interval == 0.0 or int(time / interval) > int(before / interval)


def check_interval(key, interval):
    """Raise CaseError unless an interval is a number of seconds, 0 for every step."""
    fits = isinstance(interval, Real) and not isinstance(interval, bool)
    require(fits and 0.0 <= interval < math.inf, key, interval, "a number of seconds >= 0")
