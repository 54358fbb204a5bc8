"""What a run leaves: series in memory and, with a folder, files."""

import warnings

import numpy as np

from mpslab import checkpoint, diagnostics, gauges, vtkhdf
from mpslab.output import PROBE_QUANTITIES, STEP_COLUMNS
from mpslab.particles import KIND_NAMES


class Record:
    """Collects the series of a run and writes them to its folder.

    Parameters
    ----------
    case : mpslab.parameters.Case
    flow : mpslab.step.Flow
    folder : mpslab.output.RunFolder or None
        None keeps everything in memory.
    """

    def __init__(self, case, flow, folder):
        self.case, self.flow, self.folder = case, flow, folder
        self.steps, self.gauges, self.probes = [], [], []
        self.last_row = {}
        self.frames = None

    def begin(self, step=None):
        """Open the tables; after a restart, drop what is later than its step and time."""
        if self.folder is None:
            return
        time = None if step is None else self.flow.time
        names = [g.name for g in self.case.gauge], [p.name for p in self.case.probe]
        self.folder.open_tables(*names, last_step=step, last_time=time)
        if step is not None:
            self._cut_frames(time)
        self.frames = vtkhdf.ParticleSeries(self.folder.particles, self.case.output.fields)

    def _cut_frames(self, time):
        """Drop the frames after a time; a file that a kill damaged is set aside."""
        path = self.folder.particles
        try:
            vtkhdf.truncate(path, time)
        except ValueError as error:
            path.rename(path.with_suffix(".damaged.vtkhdf"))
            warnings.warn(f"{error}; set aside, the frames begin anew", stacklevel=2)

    def add_step(self, **entries):
        """Add a row; the keywords are the keys of `mpslab.output.STEP_COLUMNS`."""
        self.last_row = entries
        self.steps.append(tuple(entries[key] for key in STEP_COLUMNS))
        if self.folder:
            self.folder.add_step(**entries)

    def read_instruments(self):
        """Read all gauges and probes at the present time."""
        p, stencil = self.flow.particles, self.flow.stencil
        spacing, width = stencil.spacing, stencil.width
        levels = [
            gauges.surface_elevation(p.position, p.kind, spacing, g.x, g.y, width)
            for g in self.case.gauge
        ]
        values = [
            gauges.probe(p.position, p.velocity, p.pressure, p.kind, spacing,
                         (q.x, q.y, q.z), width)
            for q in self.case.probe
        ]  # fmt: skip
        self.gauges.append((self.flow.time, *levels))
        self.probes.append((self.flow.time, *(v for probe in values for v in probe)))
        if self.folder:
            self.folder.add_gauges(self.flow.time, levels)
            self.folder.add_probes(self.flow.time, values)

    def add_frame(self):
        """Write the particles for ParaView."""
        if self.folder:
            self.frames.append(self.flow.time, self.flow.particles)

    def add_lost(self, step, lost):
        """Write down particles that left the tank, before they are taken out."""
        if self.folder:
            p = self.flow.particles
            self.folder.add_lost(step, self.flow.time, p.gid[lost.rows], p.position[lost.rows],
                                 lost.reason)  # fmt: skip

    def write_checkpoint(self, state, path=None):
        """Write the state of the run; to `checkpoint.h5` unless another path is given."""
        if self.folder:
            self.folder.flush()
            checkpoint.write(path or self.folder.checkpoint, self.flow.particles, state)
            self.write_run("running")

    def write_run(self, outcome, reason=None):
        """Write `run.json`."""
        if self.folder:
            kinds = np.bincount(self.flow.particles.kind, minlength=len(KIND_NAMES))
            counts = dict(zip(KIND_NAMES, kinds, strict=True))
            self.folder.write_run(outcome, counts, self.flow.stopwatch.seconds, reason)

    def series(self, which):
        """A table as a structured array: "steps", "gauges" or "probes"."""
        if which == "steps":
            rows, names = self.steps, list(STEP_COLUMNS)
        elif which == "gauges":
            rows, names = self.gauges, ["time", *(g.name for g in self.case.gauge)]
        else:
            quantities = [q.split(" ")[0] for q in PROBE_QUANTITIES]
            names = ["time", *(f"{p.name} {q}" for p in self.case.probe for q in quantities)]
            rows = self.probes
        kinds = ["U16" if name == "dt_limit" else float for name in names]
        return np.array(rows, dtype=list(zip(names, kinds, strict=True)))

    def measures(self, before):
        """What the water holds now and what the piston did since `before` [s], for a row."""
        p, stencil, fluid = self.flow.particles, self.flow.stencil, self.case.fluid
        force = diagnostics.piston_force(p, stencil)
        stroke = self.flow.piston.face(self.flow.time) - self.flow.piston.face(before)
        return {
            "max_speed": diagnostics.max_speed(p),
            "kinetic_energy": diagnostics.kinetic_energy(p, stencil, fluid.density),
            "potential_energy": diagnostics.potential_energy(
                p, stencil, fluid.density, fluid.gravity
            ),
            "volume": diagnostics.volume(p, stencil),
            "piston_force": force,
            "piston_work": force * stroke,
        }
