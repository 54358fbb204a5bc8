"""What an absorbing piston reads in each step: the water level in front of it."""

import numpy as np

from mpslab.instruments import Instrument
from mpslab.solids.absorption import EXPECTED, LEVEL

EDGE = 1.5  # spacings over which the gauge fades out, on either side of the end of its reach


def make(case):
    """The gauge of a case's piston, None where it does not absorb."""
    return PistonGauge(case) if case.wavemaker.absorption else None


class PistonGauge(Instrument):
    """Level of the water beside the piston's face, by the volume of its particles.

    All the water within the reach of the gauge counts, from bed to surface, so that the disorder of
    single particles at the surface does not show in the level.
    """

    name = "piston"
    columns = ("time [s]", "place [m]", "absorbing [m]", "level [m]", "expected [m]")

    def __init__(self, case):
        self.spacing, self.width = case.particles.spacing, case.tank.width
        self.bed = case.tank.bed[0][1]

    def read(self, flow):
        """A row: where the face is, how much of that is absorption, the level read and expected."""
        paddle, time = flow.solids.piston.paddle, flow.time
        face = flow.solids.face(time)
        level = self.bed + self._depth(flow, face, paddle.window)
        expected = paddle.absorber.expected(time)
        flow.readings |= {LEVEL: level, EXPECTED: expected}
        return [(time, face, paddle.absorber.at(time), level, expected)]

    def _depth(self, flow, face, reach):
        """Mean depth of the water over the reach [m]."""
        particles, spacing = flow.particles, self.spacing
        ahead = (particles.position[:, 0] - face - reach) / spacing
        rows = np.flatnonzero(particles.fluid & (ahead < EDGE))
        share = 1.0 - _step(ahead[rows])
        volume = spacing * spacing * (spacing / self.width if self.width else 1.0)
        return float(flow.domain.totals((rows, share[:, np.newaxis]))[0]) * volume / reach


def _step(s):
    """Integral of a quadratic B-spline up to s [spacings], from 0 to 1, (n,) float64."""
    s = np.clip(s, -EDGE, EDGE)
    outside = np.clip(np.abs(s) - 0.5, 0.0, 1.0)
    inside = np.minimum(np.abs(s), 0.5)
    half = inside * (0.75 - inside * inside / 3.0) + (1.0 - (1.0 - outside) ** 3) / 6.0
    return 0.5 + np.copysign(half, s)
