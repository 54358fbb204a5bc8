"""Pressure of a stream that turns up a wall, against the exact solution."""

import numpy as np
from scipy.optimize import brentq

from mpslab.core.kinds import FLUID
from validation.comparison import Comparison, rms

STEADY = 0.20, 0.45  # [s] between which the flow at the wall is steady
FASTEST = 1.0 - 1e-12  # on the wall, over the speed of the stream
SEEN = 4.0  # depths up the wall that are drawn


def compare(runs):
    """Force, pressure along the height, and noise, of the finest run of `standard`."""
    result = Comparison()
    streams = {name: _Stream(run) for name, run in runs.items()}
    standard = [s for name, s in streams.items() if name not in ("mps", "paper")]
    finest = min(standard, key=lambda stream: stream.run.spacing)
    result.measure("force", finest.force)
    result.measure("profile", finest.miss)
    result.measure("noise", finest.noise.mean())
    if len(standard) > 1:
        spacings = [stream.run.spacing for stream in standard]
        result.converge("Pressure along the wall [of stagnation]", spacings,
                        [stream.miss for stream in standard])  # fmt: skip
    _draw(result, streams.values(), finest)
    columns = ["run", "force / (rho U^2 h)", "rms difference", "deviation in time"]
    rows = [[s.run.label, s.force, s.miss, s.noise.mean()] for s in streams.values()]
    result.table("Pressure at the wall, over that of stagnation", columns, rows)
    return result


class _Stream:
    """The wall of a run while the flow is steady.

    Attributes
    ----------
    run : validation.run.Run
    height : (n,) float64
        Of the probes, over the depth of the stream.
    pressure, noise : (n,) float64
        There, over that of stagnation: mean, and standard deviation in time.
    miss : float
        Rms difference of the mean from theory.
    force : float
        On the wall, over rho U^2 h.

    NaN where the run ended before.
    """

    def __init__(self, run):
        self.run = run
        probes = run.case.probe
        self.height = np.array([probe.z for probe in probes]) / run.depth
        records = [run.pressure(probe.name) for probe in probes]
        steady = [p[(t > STEADY[0]) & (t < STEADY[1])] / self.stagnation for t, p in records]
        self.pressure = np.array([p.mean() if len(p) else np.nan for p in steady])
        self.noise = np.array([p.std() if len(p) else np.nan for p in steady])
        self.miss = rms(self.pressure - theory(self.height))
        self.force = self._force()

    @property
    def stagnation(self):
        """Pressure of stagnation [Pa]."""
        return 0.5 * self.run.density * self.run.case.initial.speed**2

    def _force(self):
        """Pressure of the wall's first layer, added up, mean of the frames."""
        wall, sums = self.run.case.tank.length, []
        for frame in self.run.frames:
            x = frame["position"].astype(float)
            behind = x[:, 0] - wall
            first = (frame["kind"] != FLUID) & (behind > 0.0) & (behind < self.run.spacing)
            if STEADY[0] < frame.time < STEADY[1]:
                sums.append(frame["pressure"][first & (x[:, 2] > 0.0)].sum(dtype=float))
        whole = 2.0 * self.stagnation * self.run.depth
        return np.mean(sums) * self.run.spacing / whole if sums else np.nan


def theory(height):
    """Pressure over that of stagnation at heights over the depth of the stream, (n,)."""

    def above(q, z):
        return 4.0 / np.pi * (np.arctan(q) + np.arctanh(q)) - z

    return np.array([1.0 - brentq(above, 0.0, FASTEST, args=(z,)) ** 2 for z in height])


def _draw(result, streams, finest):
    figure = result.figure("Mean pressure along the wall", "z / h", "p / (rho U^2 / 2)")
    for stream in streams:
        figure.line(stream.run.label, stream.height, stream.pressure)
    place = np.linspace(0.0, SEEN, 200)
    figure.dashed("theory", place, theory(place))
    record = result.figure("Pressure at the foot of the wall", "time [s]", "p / (rho U^2 / 2)")
    for name in ("0 h", "2 h"):
        time, pressure = finest.run.pressure(name)
        record.line(f"{finest.run.label}, z = {name}", time, pressure / finest.stagnation)
    frame = finest.run.frames.at(STEADY[1])
    x, _, z = frame["position"][frame["kind"] == FLUID].astype(float).T
    near = (x > finest.run.case.tank.length - 5.0 * finest.run.depth) & (z < 5.0 * finest.run.depth)
    shape = result.figure(f"Water at t = {STEADY[1]:g} s", "x [m]", "z [m]", equal=True)
    shape.points("water", x[near], z[near])
