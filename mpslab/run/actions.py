"""What a user has done every so often while a run goes on."""

from mpslab.core.keys import require
from mpslab.core.schedule import check_interval, due


class Actions:
    """Things to do, each at intervals of its own."""

    def __init__(self):
        self._actions = []

    def add(self, interval, action):
        """Have something done every so often.

        Parameters
        ----------
        interval : float
            Time between [s]; 0 for after every step.
        action : callable
            Gets the simulation, on all ranks.

        Raises
        ------
        ValueError
            If the interval is no such number, or the action cannot be called.
        """
        check_interval("interval", interval)
        require(callable(action), "action", action, "a function of the simulation")
        self._actions.append((interval, action))

    def do(self, simulation, before):
        """Do what falls due in the step since `before` [s]."""
        for interval, action in self._actions:
            if due(interval, before, simulation.time):
                action(simulation)
