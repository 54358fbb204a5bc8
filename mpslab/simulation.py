"""The run: choose a time step, advance, write down."""

import time as clock
from collections import Counter
from contextlib import suppress
from numbers import Real

import numpy as np

from mpslab.cases import dumps, inputs
from mpslab.core import diagnostics, timestep
from mpslab.core.keys import require_choice
from mpslab.core.memory import keep_freed
from mpslab.core.own import Own
from mpslab.core.schedule import due
from mpslab.instruments import with_own
from mpslab.output import restart
from mpslab.output.run_folder import RunFolder, take
from mpslab.parallel.rebalance import Rebalancer
from mpslab.run import start
from mpslab.run.actions import Actions
from mpslab.run.guard import (
    DRAINED,
    RunFailed,
    check_finite,
    check_lost,
    check_step,
    find_lost,
)
from mpslab.run.record import Record
from mpslab.run.step import advance

STOPPED = ("interrupted", "stopped")


class Simulation:
    """A run of a case, from Python; under mpiexec, this rank's part of it.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
        From `mpslab.load_case`.
    out : str, Path or RunFolder, optional
        New or empty folder for the files of the run, or one that `take` gave; without it
        everything stays in memory. No other run can have the folder until this one has ended, or
        is forgotten.
    instruments : sequence of mpslab.Instrument, optional
        What it reads besides the instruments of the case (docs/python.md).
    forcings, solids : sequence, optional
        The user's own, beside those of the case; `mpslab.forcings` and `mpslab.solids` say what
        they are (docs/python.md).

    Attributes
    ----------
    particles : ParticleSet
        The particles as numpy arrays, in SI units; under mpiexec those of this rank.
    time : float [s]
    step : int
        Number of steps done.
    dt : float [s]
        Last time step.

    Examples
    --------
    >>> case = mpslab.load_case("standing_wave", {"particles.spacing": 0.004})
    >>> run = mpslab.Simulation(case).run(until=0.1)
    >>> run.gauges["time"], run.particles.position
    """

    def __init__(self, case, out=None, instruments=(), forcings=(), solids=()):
        own = Own(tuple(instruments), tuple(forcings), tuple(solids))
        reading = with_own(case, own.instruments)
        if not (out is None or isinstance(out, RunFolder)):
            out = take(RunFolder.create, out)
        try:
            files = inputs.of(case)
            flow = start.lay_out(case, own)
        except BaseException:
            if out is not None:
                out.abandon()
            raise
        self._set_up(flow, out, files, own, reading)
        self._record.write_case(self._text, files)
        self._record.begin()
        self._record.read_all()
        self._record.add_frame()
        self._write_checkpoint()

    @classmethod
    def resume(cls, folder, changes=None, instruments=None, forcings=None, solids=None):
        """Go on with the run in a folder from its last checkpoint.

        Parameters
        ----------
        folder : str or Path
        changes : dict, optional
            Values that replace those of the case, by key: {"time.end": 3.0}. What may change is
            told in `mpslab.output.restart`.
        instruments, forcings, solids : sequence, optional
            One's own that the run began with; left out, they are found by their names
            (`mpslab.core.own`).

        Raises
        ------
        ValueError
            If the folder holds no run, or another run has it, its checkpoint is damaged, an input
            file is not what it was, the case differs from that of the checkpoint in what cannot
            change, or an instrument, a model, a forcing or a solid of the user's own is neither
            given nor found.
        """
        folder = take(RunFolder.reopen, folder)
        try:
            found = restart.look(folder, changes, Own(instruments, forcings, solids))
            reading = with_own(found.case, found.own.instruments)
            flow = start.take_up(found, folder.checkpoint)
            self = cls.__new__(cls)
            self._set_up(flow, folder, found.inputs, found.own, reading)
            self._take_up(found)
        except BaseException:
            folder.let_go()
            raise
        return self

    def _set_up(self, flow, folder, files, own, reading):
        case = inputs.pointed(flow.case, files, folder.path) if folder else flow.case
        self.case = flow.case = case
        self._files, self._own = inputs.to_text(files), own
        self._text = dumps(inputs.pointed(case, files))
        self.step, self.dt, self.lost, self._sides = 0, 0.0, 0, Counter()
        self.at_start = sum(flow.domain.from_all(int(np.count_nonzero(flow.particles.fluid))))
        self.stop_requested = False
        self.outcome, self.reason = "running", None
        self._flow = flow
        keep_freed()
        self._record, self._actions = Record(case, flow, folder, reading), Actions()
        self._rebalancer = Rebalancer(flow.domain, case.parallel.balance)

    def _take_up(self, found):
        """Go on from a checkpoint, and note so in the folder."""
        state = found.state
        self.step, self.dt, self.lost = state["step"], state["dt"], state["lost"]
        self.at_start = state["at_start"]
        self._record.begin(self.step)
        self._record.restore(state)
        self._record.note_resume(state, found.changes, self._text, found.inputs)

    @property
    def particles(self):
        """The particles in the order of gid, a `ParticleSet` of numpy arrays.

        The next step lays them in another order: ask again after it.
        """
        self._flow.particles = self.domain.by_gid(self._flow.particles)
        return self._flow.particles

    @property
    def time(self):
        """Time reached [s]."""
        return self._flow.time

    @property
    def folder(self):
        """The `RunFolder`, None for a run in memory."""
        return self._record.folder

    @property
    def domain(self):
        """The part of the tank of this rank, a `mpslab.parallel.domain.Domain`."""
        return self._flow.domain

    @property
    def steps(self):
        """Rows of steps.csv since the start or the restart, a structured array (steps,).

        As gauges and probes, the same on all ranks, and not to be written to.
        """
        return self.table("steps")

    @property
    def last_row(self):
        """The last row of the steps, a dict by the keys of `mpslab.core.columns.STEP_COLUMNS`."""
        return self._record.instruments["steps"].last

    @property
    def gauges(self):
        """Water levels: field "time" [s] and one field [m] for each gauge."""
        return self.table("gauges")

    @property
    def probes(self):
        """Readings of the probes: "time" [s], then "NAME pressure" [Pa] and "NAME u" [m/s]."""
        return self.table("probes")

    def table(self, name):
        """What an instrument has read since the start or the restart, a structured array (n,).

        Its fields are the headings of ``NAME.csv`` without their units. ValueError if there is none
        of this name.
        """
        require_choice("table", name, tuple(self._record.series))
        return self._record.series[name].rows

    @property
    def stopwatch(self):
        """Where the time of the steps went on this rank, a `mpslab.core.stopwatch.Stopwatch`."""
        return self._flow.stopwatch

    def every(self, interval, action):
        """Have `run` call `action(simulation)` every so often [s], 0 for after each step.

        On all ranks, when what is due in the step has been written: what it changes is not in the
        checkpoint of this step. A run that is resumed has to be told again. Returns the simulation.
        """
        self._actions.add(interval, action)
        return self

    def run(self, until=None, progress=None):
        """Run to a time; the last step may end a little later, for no step is cut short.

        Parameters
        ----------
        until : float, optional
            Time to stop at [s], the present time or later; ``case.time.end`` when left out.
        progress : callable, optional
            Called after every step with the simulation.

        Returns
        -------
        Simulation
            Itself, so that results can be read in one line.

        Raises
        ------
        RunFailed
            With the reason, step, time and place; the failed state is left in ``failed.h5``.
        ValueError
            If ``until`` is no such time, or another run has the folder.

        Whatever else is raised, by ``progress``, an action or Ctrl-C, ends the run: ``run.json``
        says how, and the checkpoint is that of the present state, or of the last one if a step was
        in hand.
        """
        until = self.case.time.end if until is None else self._checked(until)
        self._record.write_run("running")
        try:
            raised = self._run(until, progress)
        except RunFailed as failure:
            self._fail(failure)
            raise
        except BaseException as error:
            self.outcome, self.reason = _ending(error)
            self._record.leave(self.outcome, self.reason)
            raise
        finally:
            self._record.let_go()
        if raised is not None:
            raise raised
        return self

    def _checked(self, until):
        """A time to stop at; ValueError if it is none."""
        number = isinstance(until, Real) and not isinstance(until, bool)
        if not (number and self.time <= until < np.inf):
            raise ValueError(
                f"until = {until!r}: must be a number of seconds >= {float(self.time)}, the "
                "present time"
            )
        return until

    def _run(self, until, progress):
        """Run, and write down the end; returns what `progress` raised on this rank, if anything."""
        raised, stop = None, self._stop()
        while self.time < until and not stop:
            before = self.time
            self.advance()
            try:
                self._actions.do(self, before)
                if progress:
                    progress(self)
            except BaseException as error:
                raised = error
            stop = self._stop(raised)
        if stop == STOPPED and self.time >= until:
            stop = None
        self.outcome, self.reason = stop or ("finished", None)
        self._record.write_checkpoint(self._state())
        self._record.write_run(self.outcome, self.reason)
        return raised

    def _stop(self, raised=None):
        """Outcome and reason, the same on all ranks, if the run is to stop here; else None."""
        mine = STOPPED if self.stop_requested else None
        found = self.domain.from_all(mine if raised is None else _ending(raised))
        return next(filter(None, found), None)

    def advance(self):
        """One time step, written down; raises RunFailed when no other may follow."""
        with self.stopwatch.phase("rest"):
            self._advance()

    def _advance(self):
        began, before = clock.perf_counter(), self.time
        check_finite(self._flow, self.step)
        self.dt, limit = self._next_step()
        report = advance(self._flow, self.dt)
        self.step += 1
        self._flow.done = {
            "step": self.step, "before": before, "dt": self.dt, "dt_limit": limit,
            "iterations": report.iterations, "residual": report.residual,
        }  # fmt: skip
        self._take_out_lost()
        check_step(self._flow, report, self.dt, self.step)
        check_lost(self._flow, self.lost, self._sides, self.at_start, self.step)
        self._flow.done["lost"] = self.lost
        self._flow.done["seconds"] = self.domain.from_all(clock.perf_counter() - began)[0]
        with self.stopwatch.phase("record"):
            self._record.read_due(before)
        # Before the checkpoint: after a kill the rows up to its step have to be there.
        if self.step % self.case.parallel.rebalance_every == 0:
            self._take_stock()
        with self.stopwatch.phase("record"):
            self._write_due(before)

    def _next_step(self):
        """The next time step [s], and the name of the limit that it follows from."""
        speed = diagnostics.max_speed_together if self.step else diagnostics.max_speed
        mine = speed(self._flow.particles), self._flow.compression
        speed, compression = np.max(self.domain.from_all(mine), axis=0)
        return timestep.choose(self.case, self.dt, speed, compression)

    def _take_stock(self):
        """Write down where the time went since the last call and, on several ranks, cut anew."""
        laps = self.domain.from_all(self.stopwatch.lap())
        self._record.add_phases(self.step, self.time, laps)
        if self.domain.size > 1:
            cut = self._rebalancer.cut(self._flow.particles, laps)
            self._record.add_decomposition(step=self.step, time=self.time, **cut)

    def _take_out_lost(self):
        particles = self._flow.particles
        solids = self._flow.solids
        lost = find_lost(self.case, particles, solids.face(self.time), solids.free)
        self._flow.done["leaving"] = lost
        gone = self._record.read("lost").get("lost", [])
        self._flow.done["gone"] = gone
        sides = [row[-1] for row in gone if not row[-1].startswith(DRAINED)]
        self.lost += len(sides)
        self._sides.update(sides)
        if lost:
            keep = np.ones(len(particles), bool)
            keep[np.concatenate([side.rows for side in lost])] = False
            self._flow.particles = self.domain.keep(particles, keep)

    def _write_due(self, before):
        """Write the frame and the checkpoint that fell due in this step."""
        output = self.case.output
        if due(output.interval, before, self.time):
            self._record.add_frame()
        if due(output.checkpoint, before, self.time):
            self._write_checkpoint()

    def _state(self):
        return {
            **self._flow.state(),
            "step": self.step,
            "dt": self.dt,
            "lost": self.lost,
            "at_start": self.at_start,
            "own": self._own.to_text(self.case),
            "case": self._text,
            "inputs": self._files,
            **self._record.state(),
        }

    def _write_checkpoint(self):
        self._record.write_checkpoint(self._state())
        self._record.write_run("running")

    def _fail(self, failure):
        """Leave the failed state, which does not replace a good one, and the record."""
        self.outcome, self.reason = "failed", str(failure)
        try:
            self._record.write_checkpoint(self._state(), "failed.h5")
        except OSError as error:
            failure.add_note(f"The state could not be written to failed.h5 ({error.strerror})")
        with suppress(OSError):
            self._record.write_run(self.outcome, self.reason)


def _ending(error):
    """Outcome and reason of a run that an exception ends."""
    outcome = "failed" if isinstance(error, Exception) else "interrupted"
    return outcome, " ".join(f"{type(error).__name__} {error}".split())
