"""Probes, ``[[probe]]``: pressure and velocity at a point."""

from mpslab.core.columns import PROBE_QUANTITIES
from mpslab.core.gauges import probe
from mpslab.instruments import Instrument
from mpslab.instruments._near import read_near

REACH = 3.0  # spacings


def make(case):
    """The probes of a case."""
    return Probes(case)


class Probes(Instrument):
    """Pressure [Pa] and velocity u, v, w [m/s] at each probe; NaN where there is none."""

    name = "probes"

    def __init__(self, case):
        self.places = case.probe
        headings = [f"{probe.name} {what}" for probe in case.probe for what in PROBE_QUANTITIES]
        self.columns = ("time [s]", *headings)
        self.interval = case.output.gauge_interval

    def read(self, flow):
        """A row of four readings for each probe."""
        reach = [REACH * flow.stencil.spacing] * 3
        points = [(probe.x, probe.y, probe.z) for probe in self.places]
        values = read_near(flow, points, reach, lambda p: self._values(flow, p))
        return [(flow.time, *(value for probe in values for value in probe))]

    def _values(self, flow, p):
        spacing, width = flow.stencil.spacing, flow.stencil.width
        return [
            probe(p.position, p.velocity, p.pressure, p.role, spacing, (q.x, q.y, q.z),
                  width).tolist()
            for q in self.places
        ]  # fmt: skip
