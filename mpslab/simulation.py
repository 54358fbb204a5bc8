"""The run: choose a time step, advance, write down."""

import time as clock

import numpy as np

from mpslab import diagnostics, geometry, initial, settling, timestep
from mpslab.cases import dumps, load_case
from mpslab.communicator import on_root
from mpslab.domain import world
from mpslab.memory import keep_freed
from mpslab.output import RunFolder
from mpslab.particles import ParticleSet
from mpslab.piston import Piston, make_paddle
from mpslab.rebalance import Rebalancer
from mpslab.record import Record
from mpslab.step import advance, make_flow
from mpslab.watch import RunFailed, check_finite, check_lost, check_step, find_lost


class Simulation:
    """A run of a case, from Python; under mpiexec, this rank's part of it.

    Parameters
    ----------
    case : mpslab.parameters.Case
        From `mpslab.load_case`.
    out : str or Path, optional
        New or empty folder for the files of the run; without it everything stays in memory.

    Attributes
    ----------
    particles : ParticleSet
        The particles as numpy arrays, in SI units; of many ranks, those of this one.
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

    def __init__(self, case, out=None):
        paddle = make_paddle(case)
        particles = geometry.build_particles(case, paddle.backmost if paddle else 0.0)
        piston = Piston(particles, paddle, case.particles.spacing)
        self.at_start = int(np.count_nonzero(particles.fluid))
        flow = make_flow(case, particles, piston, geometry.period(case))
        settling.settle(flow)
        initial.set_velocity(case, flow.particles, flow.domain.total)
        self._set_up(case, flow, None if out is None else _on_root(RunFolder.create, out))
        self._record.write_case(dumps(case))
        self._record.begin()
        self._record.read_instruments()
        self._record.add_frame()
        self._record.write_checkpoint(self._state())

    @classmethod
    def resume(cls, folder):
        """Go on with the run in a folder from its last checkpoint.

        Raises
        ------
        ValueError
            If the folder holds no run, or its checkpoint is damaged.
        """
        from mpslab import checkpoint

        folder = _on_root(RunFolder.reopen, folder)
        case = load_case(folder.case)
        arrays, state = checkpoint.read(folder.checkpoint)
        particles = ParticleSet(**arrays)
        piston = Piston(particles, make_paddle(case), case.particles.spacing)
        piston.rest, piston.bed = state["piston_rest"], state["piston_bed"]
        self = cls.__new__(cls)
        flow = make_flow(case, particles, piston, geometry.period(case))
        self._set_up(case, flow, folder)
        self.step, self.dt, self.lost = state["step"], state["dt"], state["lost"]
        self.at_start = state["at_start"]
        self._flow.time = state["time"]
        self._record.begin(self.step)
        return self

    def _set_up(self, case, flow, folder):
        self.case = case
        self.step, self.dt, self.lost = 0, 0.0, 0
        self.stop_requested = False
        self.outcome, self.reason = "running", None
        self._flow = flow
        keep_freed()
        self._record = Record(case, flow, folder)
        self._rebalancer = Rebalancer(flow.domain, case.parallel.balance)

    @property
    def particles(self):
        """The particles, a `ParticleSet` of numpy arrays."""
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
        """The part of the tank of this rank, a `mpslab.domain.Domain`."""
        return self._flow.domain

    @property
    def steps(self):
        """Rows of steps.csv since the start or the restart, a structured array (steps,)."""
        return self._record.series("steps")

    @property
    def last_row(self):
        """The last row of the steps, a dict by the keys of `mpslab.output.STEP_COLUMNS`."""
        return self._record.last_row

    @property
    def gauges(self):
        """Water levels: field "time" [s] and one field [m] for each gauge."""
        return self._record.series("gauges")

    @property
    def probes(self):
        """Readings of the probes: "time" [s], then "NAME pressure" [Pa] and "NAME u" [m/s]."""
        return self._record.series("probes")

    @property
    def stopwatch(self):
        """Where the time of the steps went on this rank, a `mpslab.stopwatch.Stopwatch`."""
        return self._flow.stopwatch

    def run(self, until=None, progress=None):
        """Run to a time; the last step may end a little later, for no step is cut short.

        Parameters
        ----------
        until : float, optional
            Time to stop at [s]; ``case.time.end`` when left out.
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
        """
        until = self.case.time.end if until is None else until
        self._record.write_run("running")
        try:
            while self.time < until and not any(self.domain.from_all(self.stop_requested)):
                self.advance()
                if progress:
                    progress(self)
        except RunFailed as failure:
            self._end("failed", str(failure))
            raise
        finished = self.time >= until
        self._end("finished" if finished else "interrupted", None if finished else "stopped")
        return self

    def advance(self):
        """One time step, written down; raises RunFailed when no other may follow."""
        with self.stopwatch.phase("rest"):
            self._advance()

    def _advance(self):
        began, before = clock.perf_counter(), self.time
        check_finite(self._flow, self.step)
        speed = max(self.domain.from_all(diagnostics.max_speed(self.particles)))
        self.dt, limit = timestep.choose(self.case, self.dt, speed)
        report = advance(self._flow, self.dt)
        self.step += 1
        self._take_out_lost()
        check_step(self._flow, report, self.dt, self.step)
        check_lost(self._flow, self.lost, self.at_start, self.step)
        with self.stopwatch.phase("record"):
            self._record.add_step(
                step=self.step, time=self.time, dt=self.dt, dt_limit=limit,
                iterations=report.iterations, residual=report.residual, lost=self.lost,
                seconds=clock.perf_counter() - began, **self._record.measures(before),
            )  # fmt: skip
        # Before the checkpoint, for the rows up to its step have to be there after a kill.
        if self.step % self.case.parallel.rebalance_every == 0:
            self._take_stock()
        with self.stopwatch.phase("record"):
            self._write_due(before)

    def _take_stock(self):
        """Write down where the time went since the last time and, among ranks, cut anew."""
        laps = self.domain.from_all(self.stopwatch.lap())
        self._record.add_phases(self.step, self.time, laps)
        if self.domain.size > 1:
            cut = self._rebalancer.cut(self.particles, laps)
            self._record.add_decomposition(step=self.step, time=self.time, **cut)

    def _take_out_lost(self):
        particles = self.particles
        lost = find_lost(self.case, particles, self._flow.piston.face(self.time))
        self.lost += self._record.add_lost(self.step, lost)
        if lost:
            keep = np.ones(len(particles), bool)
            keep[np.concatenate([side.rows for side in lost])] = False
            self._flow.particles = self.domain.keep(particles, keep)

    def _write_due(self, before):
        """Write what fell due in this step; no state is kept, so a restart writes the same."""
        output = self.case.output

        def due(interval):
            return interval == 0.0 or int(self.time / interval) > int(before / interval)

        if due(output.gauge_interval):
            self._record.read_instruments()
        if due(output.interval):
            self._record.add_frame()
        if due(output.checkpoint):
            self._record.write_checkpoint(self._state())

    def _state(self):
        return {
            "time": self.time,
            "step": self.step,
            "dt": self.dt,
            "lost": self.lost,
            "at_start": self.at_start,
            "piston_rest": self._flow.piston.rest,
            "piston_bed": self._flow.piston.bed,
        }

    def _end(self, outcome, reason):
        """Leave a checkpoint and the record; a failed state does not replace a good one."""
        self.outcome, self.reason = outcome, reason
        name = "failed.h5" if outcome == "failed" else None
        self._record.write_checkpoint(self._state(), name)
        self._record.write_run(outcome, reason)
        self._record.flush()


def _on_root(make, path):
    """The `RunFolder` that rank 0 makes; the other ranks know where it is."""
    return on_root(world(), lambda: make(path)) or RunFolder(path)
