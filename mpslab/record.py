"""What a run leaves: series in memory and, with a folder, files."""

import warnings
from contextlib import suppress
from functools import cached_property

import numpy as np

from mpslab import checkpoint, diagnostics, gauges
from mpslab.columns import PROBE_QUANTITIES, STEP_COLUMNS
from mpslab.journal import journal_of
from mpslab.kinds import KIND_NAMES, kinds_of
from mpslab.series import Series

REACH = 3.0  # spacings: no instrument sees further along the tank


class Record:
    """Collects the series of a run and, on rank 0, writes them to its folder.

    All ranks call its methods; an error in writing is raised on each of them.

    Parameters
    ----------
    case : mpslab.parameters.Case
    flow : mpslab.step.Flow
    folder : mpslab.output.RunFolder or None
        None keeps everything in memory.
    """

    def __init__(self, case, flow, folder):
        self.case, self.flow, self.folder = case, flow, folder
        quantities = [quantity.split(" ")[0] for quantity in PROBE_QUANTITIES]
        self.steps = Series(STEP_COLUMNS, words=["dt_limit"])
        self.gauges = Series(["time", *(g.name for g in case.gauge)])
        self.probes = Series(["time", *(f"{p.name} {q}" for p in case.probe for q in quantities)])
        self.last_row, self.counts = {}, {}
        self.frames = None

    def _write(self, act):
        """Call `act` on rank 0, if the run has a folder, which is held from then on."""
        if self.folder:
            self.flow.domain.on_root(lambda: (self.folder.hold(), act()))

    def let_go(self):
        """Let other runs have the folder, until something is written again."""
        if self.folder:
            self.folder.let_go()

    def begin(self, step=None):
        """Open the tables; after a restart, drop what is later than its step and time."""
        self._write(lambda: self._open(step))

    def _open(self, step):
        from mpslab import vtkhdf

        time = None if step is None else self.flow.time
        names = [g.name for g in self.case.gauge], [p.name for p in self.case.probe]
        self.folder.open_tables(*names, last_step=step, last_time=time)
        self.folder.open_decomposition(step, self.flow.domain.size)
        if step is not None:
            self._cut_frames(time)
        self.frames = vtkhdf.ParticleSeries(self.folder.particles, self.case.output.fields)

    def _cut_frames(self, time):
        """Drop the frames after a time; a file, or a journal, that is damaged is set aside."""
        from mpslab import vtkhdf

        path = self.folder.particles
        try:
            vtkhdf.truncate(path, time)
        except (ValueError, KeyError, RuntimeError) as error:
            aside = path.with_suffix(".damaged.vtkhdf")
            for old, new in ((path, aside), (journal_of(path), journal_of(aside))):
                if old.exists():
                    old.rename(new)
            warnings.warn(f"{error}; set aside, the frames begin anew", stacklevel=2)

    def write_case(self, text, files):
        """Write `case.toml`, and keep copies of the case's input files."""
        self._write(lambda: [self.folder.keep_inputs(files), self.folder.write_case(text)])

    def note_resume(self, state, changes, text, files):
        """Note what a run goes on with; `case.toml` is written anew if the case has changed."""
        self._write(lambda: [
            self.folder.keep_inputs(files),
            self.folder.note_resume(state["step"], state["time"], changes),
            self.folder.write_case(text) if changes else None,
        ])  # fmt: skip

    def add_step(self, **entries):
        """Add a row; the keywords are the keys of `mpslab.columns.STEP_COLUMNS`."""
        self.last_row = entries
        self.steps.add(tuple(entries[key] for key in STEP_COLUMNS))
        self._write(lambda: self.folder.add_step(**entries))

    def add_phases(self, step, time, laps):
        """Add a row of where the time went, the mean over the ranks.

        Parameters
        ----------
        step : int
        time : float [s]
        laps : list of dict
            `mpslab.stopwatch.Stopwatch.lap` of each rank since the last row.
        """
        # After a restart the first row counts the steps since then.
        steps = min(len(self.steps), self.case.parallel.rebalance_every)
        places = {at for lap in laps for at in lap}
        spent = {at: sum(lap.get(at, 0.0) for lap in laps) / len(laps) / steps for at in places}
        self._write(lambda: self.folder.add_phases(step, time, spent))

    def add_decomposition(self, **entries):
        """Add a row; the keywords are the keys of `mpslab.columns.DECOMPOSITION_COLUMNS`."""
        self._write(lambda: self.folder.add_decomposition(**entries))

    def read_instruments(self):
        """Read all gauges and probes at the present time; rank 0 tells the others."""
        particles = self.flow.domain.gather(self._near_instruments())
        read = None if particles is None else self._read(particles)
        levels, values = self.flow.domain.from_all(read)[0]
        time = self.flow.time
        self.gauges.add((time, *levels))
        self.probes.add((time, *(v for probe in values for v in probe)))
        self._write(lambda: self._write_instruments(time, levels, values))

    def _near_instruments(self):
        """This rank's particles within the reach of an instrument."""
        particles = self.flow.particles
        near = np.zeros(len(particles), bool)
        for instrument in (*self.case.gauge, *self.case.probe):
            far = np.abs(particles.position[:, 0] - instrument.x)
            near |= far < REACH * self.flow.stencil.spacing
        return particles.take(near)

    def _read(self, p):
        """Water level of each gauge, and pressure and velocity of each probe."""
        spacing, width = self.flow.stencil.spacing, self.flow.stencil.width
        levels = [
            gauges.surface_elevation(p.position, p.role, spacing, g.x, g.y, width)
            for g in self.case.gauge
        ]
        values = [
            gauges.probe(p.position, p.velocity, p.pressure, p.role, spacing,
                         (q.x, q.y, q.z), width).tolist()
            for q in self.case.probe
        ]  # fmt: skip
        return levels, values

    def _write_instruments(self, time, levels, values):
        self.folder.add_gauges(time, levels)
        self.folder.add_probes(time, values)

    def add_frame(self):
        """Write the particles for ParaView."""
        if self.folder:
            particles = self.flow.domain.gather(self.flow.particles)
            self._write(lambda: self._append_frame(particles))

    def _append_frame(self, particles):
        self.frames.append(self.flow.time, particles, kinds_of(self.case, particles))

    def add_lost(self, step, lost):
        """Write down this rank's particles that left the tank, before they are taken out.

        Returns
        -------
        list of str
            The sides by which they left, one entry for each on all ranks.
        """
        p, time = self.flow.particles, self.flow.time
        mine = [(int(p.gid[r]), p.position[r].tolist(), x.reason) for x in lost for r in x.rows]
        found = sorted(one for rank in self.flow.domain.from_all(mine) for one in rank)
        if found:
            self._write(lambda: [self.folder.add_lost(step, time, [gid], [place], reason)
                                 for gid, place, reason in found])  # fmt: skip
        return [reason for _, _, reason in found]

    def write_checkpoint(self, state, name=None):
        """Write the state of the run, to `checkpoint.h5` unless another name is given."""
        if self.folder:
            particles = self.flow.domain.gather(self.flow.particles)
            self._write(lambda: self._write_state(particles, state, name))

    def _write_state(self, particles, state, name):
        self.folder.flush()
        path = self.folder.path / name if name else self.folder.checkpoint
        checkpoint.write(path, particles, state)

    def write_run(self, outcome, reason=None):
        """Write `run.json`."""
        if self.folder:
            kinds = kinds_of(self.case, self.flow.particles)
            kinds = np.bincount(kinds, minlength=len(KIND_NAMES))
            kinds = np.sum(self.flow.domain.from_all(kinds), axis=0)
            self.counts = dict(zip(KIND_NAMES, kinds, strict=True))
            self._write(lambda: self._write_run(outcome, reason))

    def _write_run(self, outcome, reason):
        self.folder.write_run(
            outcome, self.counts, self.flow.stopwatch.seconds, reason, self._preflight
        )

    @cached_property
    def _preflight(self):
        """What `--check` foretells of the case; "refused" and why, where it would not let it run.

        Some milliseconds, whatever the size of the tank. A run that goes on works it out anew.
        """
        from mpslab.preflight import preflight

        try:
            return preflight(self.case).findings
        except ValueError as error:
            return {"refused": str(error)}

    def leave(self, outcome, reason):
        """Write down the rows and how the run ended, as far as one can, when other ranks may not.

        The particles are counted as they were the last time.
        """
        if self.folder and self.flow.domain.rank == 0:
            with suppress(OSError):
                self._write_run(outcome, reason)
            with suppress(OSError):
                self.folder.flush()

    def flush(self):
        """Bring the tables up to date on the disk."""
        self._write(lambda: self.folder.flush())

    def measures(self, before):
        """What the water holds now and what the piston did since `before` [s], for a row."""
        p, stencil, fluid = self.flow.particles, self.flow.stencil, self.case.fluid
        total = self.flow.domain.total
        force = diagnostics.piston_force(p, stencil, total)
        stroke = self.flow.piston.face(self.flow.time) - self.flow.piston.face(before)
        return {
            "max_speed": max(self.flow.domain.from_all(diagnostics.max_speed(p))),
            "kinetic_energy": diagnostics.kinetic_energy(p, stencil, fluid.density, total),
            "potential_energy": diagnostics.potential_energy(
                p, stencil, fluid.density, fluid.gravity, total
            ),
            "volume": diagnostics.volume(p, stencil, total),
            "piston_force": force,
            "piston_work": force * stroke,
        }
