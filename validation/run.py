"""A finished run, as a case sees it."""

import json
from functools import cached_property
from pathlib import Path

import numpy as np

from mpslab import vtkhdf
from mpslab.kinds import FLUID
from mpslab.pictures import read_case, read_table


class Run:
    """Reads the folder of a run.

    Attributes
    ----------
    folder : Path

    A run that failed before it wrote anything has no steps and an empty record.
    """

    def __init__(self, folder):
        self.folder = Path(folder)

    @cached_property
    def case(self):
        """The resolved case, a dict of tables; ValueError if there is none."""
        return read_case(self.folder)

    @property
    def spacing(self):
        """Particle spacing [m]."""
        return self.case["particles"]["spacing"]

    @property
    def depth(self):
        """Depth of the still water [m]."""
        return self.case["tank"]["depth"]

    @property
    def label(self):
        """Recipe, spacing and seed, as "standard, 3-D, d0 = 2 mm, seed 1"."""
        scheme, seed = self.case["scheme"], self.case["particles"]["seed"]
        recipe = "mps" if scheme["gradient"] == "mps" else scheme["recipe"]
        width = ", 3-D" if self.case["tank"]["width"] else ""
        other = f", seed {seed}" if seed else ""
        return f"{recipe}{width}, d0 = {1e3 * self.spacing:.3g} mm{other}"

    @property
    def gravity(self):
        """Acceleration of gravity [m/s2]."""
        return self.case["fluid"]["gravity"]

    @property
    def density(self):
        """Density of the water [kg/m3]."""
        return self.case["fluid"]["density"]

    @cached_property
    def steps(self):
        """Columns of ``steps.csv`` by their headings."""
        return read_table(self.folder / "steps.csv")

    @cached_property
    def record(self):
        """``run.json``, a dict."""
        path = self.folder / "run.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def gauge(self, name):
        """Time [s] and water level [m] of a gauge, (n,) each."""
        table = read_table(self.folder / "gauges.csv")
        return table["time [s]"], table[f"{name} [m]"]

    def pressure(self, name):
        """Time [s] and pressure [Pa] of a probe, (n,) each."""
        table = read_table(self.folder / "probes.csv")
        return table["time [s]"], table[f"{name} pressure [Pa]"]

    def frames(self):
        """Time [s] and arrays of each frame of particles, one after the other."""
        return vtkhdf.read_frames(self.folder / "particles.vtkhdf")

    def water(self):
        """Time [s], position (n, 3) [m] and velocity (n, 3) [m/s] of the water, frame by frame."""
        for time, frame in self.frames():
            wet = frame["kind"] == FLUID
            yield time, frame["position"][wet].astype(float), frame["velocity"][wet].astype(float)

    def momentum(self):
        """Momentum of the water along x in the first and in the last frame [N s]."""
        times = vtkhdf.read_times(self.folder / "particles.vtkhdf")
        flat = self.case["tank"]["width"] == 0.0
        mass = self.density * self.spacing ** (2 if flat else 3)
        ends = (vtkhdf.read_frame(self.folder / "particles.vtkhdf", k) for k in (0, len(times) - 1))
        return [mass * float(frame["velocity"][frame["kind"] == FLUID, 0].sum(dtype=float))
                for frame in ends]  # fmt: skip

    def frame_at(self, time):
        """The frame next to a time [s]: its time and arrays."""
        times = vtkhdf.read_times(self.folder / "particles.vtkhdf")
        index = int(np.argmin(np.abs(times - time)))
        return times[index], vtkhdf.read_frame(self.folder / "particles.vtkhdf", index)
