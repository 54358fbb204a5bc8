"""What a run leaves: series in memory and, with a folder, files."""

import warnings
from contextlib import suppress
from functools import cached_property

import numpy as np

from mpslab.core.columns import PHASE_COLUMNS, name_of
from mpslab.core.keys import shown
from mpslab.core.kinds import KIND_NAMES, kinds_of
from mpslab.core.schedule import due
from mpslab.output import checkpoint
from mpslab.output.journal import journal_of
from mpslab.output.series import Series


class Record:
    """Collects the series of a run and, on rank 0, writes them to its folder.

    All ranks call its methods; an error in writing is raised on each of them.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    flow : mpslab.run.flow.Flow
    folder : mpslab.output.run_folder.RunFolder or None
        None keeps everything in memory.
    instruments : dict of str to mpslab.instruments.Instrument

    Attributes
    ----------
    series : dict of str to Series
        What each instrument has read since the start or the restart.
    """

    def __init__(self, case, flow, folder, instruments):
        self.case, self.flow, self.folder = case, flow, folder
        self.instruments = instruments
        self.series = {
            name: Series([name_of(heading) for heading in one.columns],
                         {name_of(heading): most for heading, most in one.words.items()})
            for name, one in instruments.items()
        }  # fmt: skip
        self.counts, self.frames = {}, None

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
        for one in self.instruments.values():
            one.begin(self.flow)
        self._write(lambda: self._open(step))

    def _open(self, step):
        from mpslab.output import vtkhdf

        time = None if step is None else self.flow.time
        for name, one in self.instruments.items():
            last = step if one.columns[0] == "step" else time
            self.folder.open_table(name, one.columns, last)
        self.folder.open_table("phases", PHASE_COLUMNS, step)
        self.folder.open_decomposition(step, self.flow.domain.size)
        if step is not None:
            self._cut_frames(time)
        self.frames = vtkhdf.ParticleSeries(self.folder.particles, self.case.output.fields)

    def _cut_frames(self, time):
        """Drop the frames after a time; a file, or a journal, that is damaged is set aside."""
        from mpslab.output import vtkhdf

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

    def read(self, *names):
        """Read some instruments, and write down what they give: rows by name."""
        found = {name: self.instruments[name].read(self.flow) for name in names}
        found = {name: rows for name, rows in found.items() if rows}
        for name, rows in found.items():
            for row in rows:
                self._check_row(name, row)
                self.series[name].add(row)
        if found:
            self._write(lambda: [self.folder.add_rows(*item) for item in found.items()])
        return found

    def _check_row(self, name, row):
        """Refuse a row of a user's instrument that is no row of its table."""
        columns = self.instruments[name].columns
        if not isinstance(row, tuple) or len(row) != len(columns):
            raise ValueError(
                f"instrument {name!r}: read() gave the row {shown(row)}: must be a tuple of "
                f"{len(columns)} values, {', '.join(columns)}"
            )

    def read_due(self, before):
        """Read the instruments that fall due in the step since `before` [s]."""
        time = self.flow.time
        self.read(*(name for name, every in self._schedule() if due(every, before, time)))

    def read_all(self):
        """Read all instruments that have a schedule."""
        self.read(*(name for name, _ in self._schedule()))

    def _schedule(self):
        """Name and interval of the instruments that are not read on request alone."""
        found = ((name, one.interval) for name, one in self.instruments.items())
        return [(name, every) for name, every in found if every is not None]

    def state(self):
        """What the instruments carry on from step to step, for the checkpoint."""
        return {
            f"{name}.{key}": value
            for name, one in self.instruments.items()
            for key, value in one.state().items()
        }

    def restore(self, state):
        """Give the instruments what they had at the checkpoint."""
        for name, one in self.instruments.items():
            mine = {key.removeprefix(f"{name}."): value for key, value in state.items()
                    if key.startswith(f"{name}.")}  # fmt: skip
            if mine:
                one.restore(mine)

    def add_phases(self, step, time, laps):
        """Add a row of where the time went, the mean over the ranks.

        Parameters
        ----------
        step : int
        time : float [s]
        laps : list of dict
            `mpslab.core.stopwatch.Stopwatch.lap` of each rank since the last row.
        """
        # After a restart the first row counts the steps since then.
        steps = min(len(self.series["steps"]), self.case.parallel.rebalance_every)
        places = {at for lap in laps for at in lap}
        spent = {at: sum(lap.get(at, 0.0) for lap in laps) / len(laps) / steps for at in places}
        self._write(lambda: self.folder.add_phases(step, time, spent))

    def add_decomposition(self, **entries):
        """Add a row; the keywords are the keys of `mpslab.core.columns.DECOMPOSITION_COLUMNS`."""
        self._write(lambda: self.folder.add_decomposition(**entries))

    def add_frame(self):
        """Write the particles for ParaView."""
        if self.folder:
            particles = self.flow.domain.gather(self.flow.particles)
            self._write(lambda: self._append_frame(particles))

    def _append_frame(self, particles):
        self.frames.append(self.flow.time, particles, kinds_of(self.case, particles))

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
        from mpslab.run.preflight import preflight

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
