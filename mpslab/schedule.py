"""When something falls due that is done every so often."""


def due(interval, before, time):
    """Whether an interval [s] ends in the step from one time to another [s]; each step, with 0.

    No state is kept, so a run that goes on from a checkpoint does the same things at the same
    times.
    """
    return interval == 0.0 or int(time / interval) > int(before / interval)
