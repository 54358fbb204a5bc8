"""Run-up, ``[[runup]]``: how far the water comes up the slope."""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core import runup
from mpslab.core.keys import require
from mpslab.instruments import Instrument, check_names
from mpslab.instruments._near import read_of
from mpslab.solids.layout import period


def make(case):
    """The run-ups of a case; none without ``[[runup]]``."""
    return Runup(case) if case.runup else None


def check(case):
    """Raise CaseError if the water has no slope to run up, or a run-up cannot be read."""
    check_names("runup", case.runup)
    spacing, tank = case.particles.spacing, case.tank
    require(
        not case.runup or beds.shore(tank.bed, tank.depth) is not None,
        "tank.bed",
        tank.bed,
        f"one that rises from below the still water, {tank.depth:g} m, to above it, for a runup",
    )
    for i, one in enumerate(case.runup):
        where, least = f"runup.{i}", spacing * (1.0 - 1e-9)
        rule = f"0, or >= {spacing:g} m, a spacing"
        require(one.thickness >= least, f"{where}.thickness", one.thickness, rule)
        rule = f"from 0 to tank.width = {tank.width:g} m"
        require(one.y <= tank.width * (1.0 + 1e-9), f"{where}.y", one.y, rule)


class Runup(Instrument):
    """Level and place of the water's edge for each thickness [m]."""

    name = "runup"

    def __init__(self, case):
        self.wanted, self.bed, self.flat = case.runup, case.tank.bed, case.dim == 2
        self.columns = ("time [s]", *(
            f"{one.name} {what} [m]" for one in case.runup for what in ("level", "x")
        ))  # fmt: skip
        self.interval = case.output.gauge_interval
        self.spacing, self.width = case.particles.spacing, period(case)
        self.x = runup.stations(*beds.shore(self.bed, case.tank.depth), self.spacing)

    def read(self, flow):
        """A row of levels and places."""
        tips = read_of(flow, self._near(flow.particles), self._tips)
        return [(flow.time, *(number for tip in tips for number in tip))]

    def _near(self, particles):
        """Mask of the water that lies on the slope."""
        near, x = particles.fluid, particles.position[:, 0]
        reach = runup.WIDE * self.spacing
        near &= (x > self.x[0] - reach) & (x < self.x[-1] + reach)
        rows = np.flatnonzero(near)
        deepest = runup.LOOKED_AT * max(one.thickness for one in self.wanted)
        near[rows] = runup.above(self.bed, particles.position.take(rows, 0)) < deepest
        return near

    def _tips(self, particles):
        return [
            runup.tip(self.bed, self.x, self._thickness(particles.position, one), one.thickness)
            for one in self.wanted
        ]

    def _thickness(self, position, one):
        y = None if self.flat else one.y
        return runup.thickness(
            position, self.bed, self.x, self.spacing, one.thickness, y, self.width
        )
