"""Overtopping, ``[[overtopping]]``: the water that passes a plane, particle by particle."""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core.diagnostics import particle_volume
from mpslab.core.keys import require
from mpslab.core.lattice import effective_length, rows_across
from mpslab.core.runup import spline
from mpslab.core.schedule import due
from mpslab.instruments import Instrument, check_names
from mpslab.instruments._near import within
from mpslab.solids import filling, obstacles

REACH = 3.0  # spacings: no particle goes so far in a step
BEFORE = 2.0  # spacings in front of the plane, where the layer is read: behind it water may drain


def make(case):
    """The planes of a case; none without ``[[overtopping]]``."""
    return Overtopping(case) if case.overtopping else None


def check(case):
    """Raise CaseError if a plane stands where nothing can pass it."""
    check_names("overtopping", case.overtopping)
    least = BEFORE * case.particles.spacing
    most = effective_length(case) - case.particles.spacing
    for i, one in enumerate(case.overtopping):
        rule = f"from {least:g} to {most:g} m, inside the tank"
        require(least <= one.x <= most * (1.0 + 1e-9), f"overtopping.{i}.x", one.x, rule)
        if one.drain:
            rule = "behind all water of the start, for it takes out what is beyond"
            require(one.x >= _furthest(case), f"overtopping.{i}.x", one.x, rule)


def _furthest(case):
    """x of the foremost water at the start, to half a spacing [m]."""
    boxes = [(box.start, box.end) for box in case.water] or [filling.filled(case)]
    found = [0.0]
    for box in boxes:
        for low, high in obstacles.around(case, *box):
            x = np.array(filling.columns(case, low, high))
            found.append(x[beds.elevation(case.tank.bed, x) < high[2]].max(initial=0.0))
    return max(found)


class Overtopping(Instrument):
    """Volume that has passed each plane since the start, onwards and back, and the layer there.

    Particles are counted in each step, each by its gid, so that volumes are right to a particle:
    onwards less back is what is missing in front of the plane.

    Attributes
    ----------
    counts : (planes, 2) int64
        Particles that have passed, onwards and back.
    """

    name = "overtopping"

    def __init__(self, case):
        self.planes, spacing = case.overtopping, case.particles.spacing
        each = "m3/m" if case.dim == 2 else "m3"
        self.columns = ("time [s]", *(
            f"{one.name} {what} [{unit}]" for one in self.planes
            for what, unit in (("onwards", each), ("back", each), ("layer", "m"), ("speed", "m/s"))
        ))  # fmt: skip
        self.every = case.output.gauge_interval
        self.width = rows_across(case) * spacing if case.dim == 3 else 1.0
        self.counts = np.zeros((len(self.planes), 2), np.int64)

    def begin(self, flow):
        """Note which water is near a plane, and on which side."""
        self.seen = self._near(flow)

    def read(self, flow):
        """Count what has passed in the last step; a row when one is due."""
        if flow.done:
            self._count(flow)
            if not due(self.every, flow.done["before"], flow.time):
                return []
        volume = particle_volume(flow.stencil)
        return [(flow.time, *(
            number for plane, count in zip(self.planes, self.counts, strict=True)
            for number in (*(volume * count).tolist(), *self._layer(flow, plane.x))
        ))]  # fmt: skip

    def _count(self, flow):
        now = self._near(flow)
        gone = flow.done["gone"]
        gid = np.append(now[0], [row[2] for row in gone]).astype(np.int64)
        x = np.append(now[1], [row[3] for row in gone])
        _, first, last = np.intersect1d(self.seen[0], gid, True, return_indices=True)
        before, after = self.seen[1][first], x[last]
        for count, plane in zip(self.counts, self.planes, strict=True):
            count[0] += np.count_nonzero((before <= plane.x) & (after > plane.x))
            count[1] += np.count_nonzero((before > plane.x) & (after <= plane.x))
        self.seen = now

    def _near(self, flow):
        """gid and x [m] of the water particles near a plane, from all ranks."""
        p, reach = flow.particles, REACH * flow.stencil.spacing
        rows = within(p, [plane.x for plane in self.planes], reach)
        rows = rows[p.fluid[rows]]
        found = flow.domain.from_all((p.gid[rows], p.position[rows, 0]))
        return [np.concatenate(parts) for parts in zip(*found, strict=True)]

    def _layer(self, flow, x):
        """Thickness [m] of the water just in front of a plane, by volume, and its speed [m/s]."""
        p, spacing = flow.particles, flow.stencil.spacing
        off = (p.position[:, 0] - x) / spacing + BEFORE
        weight = np.where(p.fluid, spline(off), 0.0)
        total = flow.domain.total(weight)
        if total == 0.0:
            return 0.0, np.nan
        speed = flow.domain.total(weight * p.velocity[:, 0]) / total
        return particle_volume(flow.stencil) / spacing / self.width * total, speed

    def state(self):
        """How many particles have passed."""
        return {"counts": self.counts}

    def restore(self, state):
        """Go on counting."""
        self.counts = np.array(state["counts"])
