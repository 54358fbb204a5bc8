"""Forces on solids, ``[[force]]``, and the balance of the water's momentum."""

import numpy as np

from mpslab.core.keys import CaseError, require, require_choice
from mpslab.core.plugins import load
from mpslab.instruments import Instrument, check_names
from mpslab.models.reaction import Reaction
from mpslab.solids import parts

MOST = 100  # entries in a case
BALANCE = "water"  # what the columns of the balance begin with


def make(case):
    """The forces of a case; none without ``[[force]]``."""
    return Forces(case) if case.force else None


def check(case):
    """Raise CaseError if the run cannot tell a force that the case asks for."""
    if len(case.force) > MOST:
        raise CaseError(f"force has {len(case.force):,} entries: must have at most {MOST:,}")
    check_names("force", case.force)
    for i, force in enumerate(case.force):
        rule = f"another word than {BALANCE!r}, which the columns of the balance begin with"
        require(force.name.split()[0] != BALANCE, f"force.{i}.name", force.name, rule)
        require_choice(f"force.{i}.on", force.on, parts.names(case))
    gradient = case.scheme.gradient
    require(
        not case.force or load("gradients", gradient).CONSERVES_MOMENTUM,
        "scheme.gradient",
        gradient,
        "one whose pair forces are equal and opposite, where there is a force: what solids get is "
        "what the water gets from them",
    )


class Forces(Instrument):
    """Mean force and moment on each solid over the time since the last row, and the balance.

    The momentum that the water loses in this time, divided by the time, plus the weight of the
    water is the force on all solids, to rounding.
    """

    name = "forces"

    def __init__(self, case):
        flat = case.dim == 2
        force, moment = ("N/m", "N m/m") if flat else ("N", "N m")
        self.columns = ("time [s]", *(
            f"{one.name} {what}{axis} [{unit}]" for one in case.force
            for what, unit in (("f", force), ("m", moment)) for axis in "xyz"
        ), *(f"{BALANCE} {what} {axis} [{force}]"
             for what in ("-dP/dt", "weight", "on solids") for axis in "xyz"))  # fmt: skip
        self.interval = case.output.gauge_interval
        points = [np.array(one.about) * ([1.0, 0.0, 1.0] if flat else 1.0) for one in case.force]
        self.reaction = Reaction(
            case, [(one.on, about) for one, about in zip(case.force, points, strict=True)]
        )

    def begin(self, flow):
        """Have the steps note what the solids give to the water."""
        flow.reaction = self.reaction

    def read(self, flow):
        """The means since the last row; no row before the first step."""
        found = self.reaction
        if found.span == 0.0:
            return []
        impulses = [*found.on.ravel(), *-found.gained, *found.pushed, *-found.given]
        row = (flow.time, *(float(impulse / found.span) for impulse in impulses))
        found.clear()
        return [row]

    def state(self):
        """What has been added up since the last row."""
        return {"span": self.reaction.span, "sums": self.reaction.sums}

    def restore(self, state):
        """Go on adding up."""
        self.reaction.take(state["span"], state["sums"])
