"""Wave gauges, ``[[gauge]]``: the water level over a place."""

import numpy as np

from mpslab.core.gauges import surface_elevation
from mpslab.instruments import Instrument
from mpslab.instruments._near import read_near

REACH = 3.0  # spacings, to either side


def make(case):
    """The gauges of a case."""
    return Gauges(case)


class Gauges(Instrument):
    """z of the water surface at each gauge [m]; NaN where it is dry."""

    name = "gauges"

    def __init__(self, case):
        self.places = case.gauge
        self.columns = ("time [s]", *(f"{gauge.name} [m]" for gauge in case.gauge))
        self.interval = case.output.gauge_interval

    def read(self, flow):
        """A row of water levels."""
        aside = REACH * flow.stencil.spacing
        reach = aside, aside if flow.stencil.dim == 3 else np.inf, np.inf
        points = [(gauge.x, gauge.y, 0.0) for gauge in self.places]
        levels = read_near(flow, points, reach, lambda p: self._levels(flow, p))
        flow.readings.update((g.name, z) for g, z in zip(self.places, levels, strict=True))
        return [(flow.time, *levels)]

    def _levels(self, flow, p):
        spacing, width = flow.stencil.spacing, flow.stencil.width
        return [
            surface_elevation(p.position, p.role, spacing, gauge.x, gauge.y, width)
            for gauge in self.places
        ]
