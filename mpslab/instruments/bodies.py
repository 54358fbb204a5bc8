"""Free bodies: places, angles and velocities, and the pull of their moorings."""

import numpy as np

from mpslab.core import rotation
from mpslab.instruments import Instrument

AXES = {"x": 0, "y": 1, "z": 2}
SPEEDS = {"u": 0, "v": 1, "w": 2}
# Of the turns about y, x and z: roll, which turns x towards z, is about the axis -y.
TURNS = {"roll": (4, -1.0), "pitch": (3, 1.0), "yaw": (5, 1.0)}
FLAT = ("x", "z", "u", "w", "roll")


def make(case):
    """The bodies of a case; none where nothing is free."""
    return Bodies(case) if any(given.motion == "free" for given in case.solid) else None


class Bodies(Instrument):
    """Place of the centre of mass, angles and velocities of each free body; tensions of lines."""

    name = "bodies"

    def __init__(self, case):
        flat = case.dim == 2
        self.axes, self.speeds, self.turns = (
            [name for name in names if not flat or name in FLAT] for names in (AXES, SPEEDS, TURNS)
        )
        tension = "N/m" if flat else "N"
        self.columns = ("time [s]", *(
            f"{given.name} {what}" for given in case.solid if given.motion == "free"
            for what in (*(f"{name} [m]" for name in self.axes),
                         *(f"{name} [deg]" for name in self.turns),
                         *(f"{name} [m/s]" for name in self.speeds),
                         *(f"{name} rate [deg/s]" for name in self.turns))
        ), *(f"{line.name} tension [{tension}]" for line in case.mooring))  # fmt: skip
        self.interval = case.output.gauge_interval

    def read(self, flow):
        """A row."""
        fleet, row = flow.coupling.fleet, [flow.time]
        for body in fleet.bodies:
            turned = dict(zip(TURNS, rotation.angles(rotation.matrix(body.turn)), strict=True))
            row += [body.center[AXES[name]] for name in self.axes]
            row += [np.degrees(turned[name]) for name in self.turns]
            row += [body.velocity[SPEEDS[name]] for name in self.speeds]
            row += [np.degrees(sign * body.velocity[k])
                    for k, sign in (TURNS[name] for name in self.turns)]  # fmt: skip
        row += [line.tension for line in fleet.lines]
        return [tuple(map(float, row))]
