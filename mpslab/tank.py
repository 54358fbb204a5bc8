"""The command line: ``python -m mpslab.tank``."""

import os
import shlex
import signal
import sys
import traceback
from pathlib import Path

from mpslab import cases
from mpslab.core.files import FULL, DiskFull
from mpslab.parallel import launch
from mpslab.parallel.communicator import all_here
from mpslab.parallel.domain import launched, world
from mpslab.terminal import Parser, unbroken

DEFAULT_CASE = "plunging_breaker"
BAD_INPUT, FAILED, INTERRUPTED = 2, 3, 130


def _parser():
    parser = Parser(
        prog="python -m mpslab.tank",
        description="Run a case of the particle wave tank.",
        epilog="Example: python -m mpslab.tank plunging_breaker --set particles.spacing=0.002",
    )
    parser.add_argument("case", nargs="?", metavar="CASE", help="built-in case or TOML file")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="change a key of the case; may be given several times")  # fmt: skip
    parser.add_argument("--out", metavar="DIR", help="new or empty folder for the results")
    parser.add_argument("--until", type=float, metavar="SECONDS", help="stop at this time")
    parser.add_argument("--resume", metavar="DIR",
                        help="go on with the run in this folder; with --set time.end=SECONDS "
                        "beyond its end")  # fmt: skip
    parser.add_argument("--ranks", type=int, metavar="N",
                        help="share the tank out among N processes")  # fmt: skip
    parser.add_argument("--no-pictures", action="store_true", help="draw no pictures at the end")
    parser.add_argument("--check", action="store_true", help="look at the case, run nothing")
    parser.add_argument("--draw", metavar="PNG",
                        help="with --check: draw the wavemaker's motion and spectrum; of a case "
                        "with solids the tank, in a second file NAME-tank.png")  # fmt: skip
    parser.add_argument("--list", action="store_true", help="list the built-in cases")
    parser.add_argument("--keys", nargs="?", const="", metavar="TABLE",
                        help="list the keys of a case, or of one table of it")  # fmt: skip
    parser.add_argument("--show", metavar="CASE", help="print the file of a built-in case")
    return parser


def main(arguments=None):
    """Run the command line; returns the exit status.

    0: done; 2: bad input, nothing done; 3: the run went wrong; 130: stopped by Ctrl-C.
    """
    with unbroken():
        return _main(arguments)


def _main(arguments):
    try:
        comm = world()
    except ValueError as error:  # before there are ranks that could agree which of them says it
        print(f"mpslab: {error}", file=sys.stderr)
        return BAD_INPUT
    with _Stop() as stop:
        return _on_ranks(comm, arguments, stop)


def _on_ranks(comm, arguments, stop):
    """Run the command line on the ranks of a communicator; returns the exit status."""
    aside = comm.Dup()
    tell = print if comm.rank == 0 else _silent
    simulation = None
    try:
        try:
            options = _parser().parse_args(arguments)
            simulation = _prepared(options, arguments, comm, tell)
        except (ValueError, OSError) as error:
            if stop.asked:
                raise KeyboardInterrupt from error  # which a library took for an error of its own
            if not all_here(aside):
                raise  # bad input, or a disk that is full, is so for all ranks
            if isinstance(error, OSError):
                folder = options.out or options.resume or "runs"
                tell(f"mpslab: {folder}: cannot be written ({_reason(error)}) before the first "
                     "step", file=sys.stderr)  # fmt: skip
                return FAILED
            tell(f"mpslab: {error}", file=sys.stderr)
            return BAD_INPUT
        if not simulation:
            return 0
        stop.follow(simulation)
        return _run(simulation, options, tell)
    except KeyboardInterrupt:
        tell("mpslab: stopped", file=sys.stderr)
        return INTERRUPTED
    except Exception:
        if comm.size == 1:
            raise
        # The other ranks would wait for this one for ever.
        print(f"mpslab: rank {comm.rank} of {comm.size} failed:\n{traceback.format_exc()}"
              + "The last checkpoint is good." * (simulation is not None),
              file=sys.stderr, flush=True)  # fmt: skip
        comm.Abort(FAILED)


def _prepared(options, arguments, comm, tell):
    """The simulation that is asked for, None if there is nothing to run; ValueError: bad input."""
    if _told(options, tell):
        return None
    from mpslab.output.run_folder import RunFolder, take
    from mpslab.run.preflight import check_ranks, preflight
    from mpslab.simulation import Simulation

    if options.draw and not options.check:
        raise ValueError(f"--draw {options.draw}: allowed together with --check only")
    changes = dict(cases.parse_set(item) for item in options.set)
    case, since = _case(options, changes)
    _check_until(options.until, since, case)
    ranks = _ranks(options, comm)
    check_ranks(case, ranks)
    if ranks != comm.size and not options.check:
        line = sys.argv[1:] if arguments is None else arguments
        line = launch.command(ranks, "-m", "mpslab.tank", *line)
        os.execv(line[0], line)
    if options.resume:
        return Simulation.resume(options.resume, changes)
    report = preflight(case)
    if options.check:
        tell(f"{case.name}: {case.title}\n{report.text()}")
        if options.draw and comm.rank == 0:
            _draw(case, Path(options.draw))
        return None
    for warning in report.warnings:
        tell(f"Warning: {warning}", file=sys.stderr)
    # Before the water is settled, which takes some time: no other run is to get the folder.
    if options.out:
        folder = take(RunFolder.create, options.out)
    else:
        folder = take(RunFolder.create_next, Path("runs") / case.name)
    return Simulation(case, folder)


def _draw(case, path):
    """The pictures of --check: the motion of the wavemaker, and the tank with its solids."""
    from mpslab.analysis import paddle_picture, tank_picture

    if not path.parent.is_dir():
        raise ValueError(f"--draw {path}: must be in a folder that exists")
    if case.solid:
        tank_picture.draw(case, path.with_stem(f"{path.stem}-tank"))
    if case.wavemaker.type != "none" or not case.solid:
        paddle_picture.draw(case, path)


def _told(options, tell):
    """Tell what there is, if that is asked for; returns whether it was.

    What only a run needs is not loaded yet, so that the answer comes at once.
    """
    if options.list:
        for name, title in cases.titles().items():
            tell(f"{name:<18} {title}")
    elif options.show:
        tell(cases.text(options.show), end="")
    elif options.keys is not None:
        from mpslab.cases import catalogue

        tell(catalogue.text(options.keys or None))
    else:
        return False
    return True


def _silent(*words, **options):
    """What all ranks except the first say: nothing."""


def _case(options, changes):
    """The case to run, or of the run to go on with, and the time [s] that the run has reached."""
    if not options.resume:
        return cases.load_case(options.case or DEFAULT_CASE, changes), 0.0
    from mpslab.output import restart
    from mpslab.output.run_folder import RunFolder

    for name in ("case", "out", "check"):
        if getattr(options, name):
            raise ValueError(
                f"--resume {options.resume}: goes on with the case and in the folder of that "
                f"run; not allowed together with {'CASE' if name == 'case' else '--' + name}"
            )
    found = restart.look(RunFolder.find(options.resume), changes)
    return found.case, found.state["time"]


def _ranks(options, comm):
    """How many ranks are to run: those that there are, unless another number is asked for."""
    asked = comm.size if options.ranks is None else options.ranks
    if asked < 1:
        raise ValueError(f"--ranks {asked}: must be a whole number >= 1")
    if asked != comm.size and launched():
        raise ValueError(
            f"--ranks {asked}: but mpiexec has started {comm.size} already (or it is not that of "
            "the MPI in use); allowed: one or the other"
        )
    return asked


def _check_until(until, since, case):
    end = case.time.end
    if until is None or since < until <= end:
        return
    if since >= end:
        raise ValueError(f"--until = {until:g} s: the run has reached {_further(end)}")
    reached = f"{since:.6g} s, the time that the run has reached," if since else "0"
    raise ValueError(f"--until = {until:g} s: must be > {reached} and <= time.end = {end:g} s")


def _further(end):
    return f"its end, time.end = {end:g} s; --set time.end=SECONDS takes it further"


def _run(simulation, options, tell):
    from mpslab.run.guard import RunFailed
    from mpslab.run.progress import make_progress

    folder = simulation.folder.path
    until = simulation.case.time.end if options.until is None else options.until
    found = simulation.domain.from_all((len(simulation.particles), os.getpid()))
    sizes, processes = zip(*found, strict=True)
    # When a process is killed, mpiexec says which by its number.
    numbers = ", ".join(f"{rank}: {number}" for rank, number in enumerate(processes))
    ranks = f" on {len(sizes)} ranks (processes {numbers})" if len(sizes) > 1 else ""
    tell(f"{simulation.case.name}: {sum(sizes):,} particles{ranks}, to t = {until:g} s, "
         f"results in {folder}", flush=True)  # fmt: skip
    if len(sizes) > 1:
        # Said here: when a process is killed its launcher ends all of them, and none is left to say
        # it.
        tell(f"Should a process be killed, go on with\n  {_go_on(folder)}", flush=True)
    try:
        if tell is print:
            with make_progress(until, simulation.time) as progress:
                simulation.run(options.until, progress)
        else:
            simulation.run(options.until)
    except RunFailed as failure:
        notes = getattr(failure, "__notes__", None)
        state = notes[0] if notes else f"The state to look at is in {folder / 'failed.h5'}"
        tell(f"mpslab: run stopped: {failure}\n{state}; the last good one is in "
             f"{folder / 'checkpoint.h5'}", file=sys.stderr)  # fmt: skip
        return FAILED
    except OSError as error:
        tell(f"mpslab: run stopped: {folder} cannot be written ({_reason(error)}) after step "
             f"{simulation.step}, t = {simulation.time:.6g} s; the last checkpoint there is good",
             file=sys.stderr)  # fmt: skip
        if error.errno in FULL:
            tell(f"Free space, then go on with\n  {_go_on(folder)}", file=sys.stderr)
        return FAILED
    return _report(simulation, options, tell)


def _go_on(folder):
    """The command that goes on with the run in a folder."""
    return f"python -m mpslab.tank --resume {shlex.quote(str(folder))}"


def _reason(error):
    """What the system says about an OSError, in one line."""
    if isinstance(error, DiskFull):
        return error.strerror
    return os.strerror(error.errno) if error.errno else " ".join(str(error).split())


class _Stop:
    """What Ctrl-C and SIGTERM do: they end the run after the step in hand, and before the first
    step the program at once.
    """

    def __init__(self):
        self.asked, self.simulation = False, None

    def __enter__(self):
        signals = signal.SIGINT, signal.SIGTERM
        self.earlier = {number: signal.signal(number, self) for number in signals}
        return self

    def __exit__(self, *_):
        for number, handler in self.earlier.items():
            signal.signal(number, handler)

    def __call__(self, number, frame):
        self.asked = True
        if self.simulation is None:
            raise KeyboardInterrupt
        self.simulation.stop_requested = True

    def follow(self, simulation):
        """From now on it is this run that is stopped; at once, if that was asked for before."""
        self.simulation = simulation
        simulation.stop_requested |= self.asked


def _report(simulation, options, tell):
    folder = simulation.folder.path
    _tell_cost(simulation, tell)
    if simulation.outcome == "interrupted":
        tell(f"Stopped at t = {simulation.time:.4f} s; go on with\n"
             f"  {_go_on(folder)}")  # fmt: skip
        return INTERRUPTED
    if not len(simulation.steps):
        end = simulation.case.time.end
        tell(f"Nothing to do: the run in {folder} has reached {_further(end)}")
    else:
        tell(f"Done: t = {simulation.time:.4f} s after {simulation.step} steps, "
             f"{simulation.lost} particles lost. Results in {folder}")  # fmt: skip
    if tell is print and not options.no_pictures:
        from mpslab.analysis import pictures

        tell("Pictures:", *pictures.listed(pictures.draw_run(folder)), sep="\n  ")
    return 0


def _tell_cost(simulation, tell):
    phases, steps = simulation.stopwatch.seconds, len(simulation.steps)
    total = sum(phases.values())
    if steps == 0:
        return
    shares = ", ".join(f"{name} {100 * s / total:.0f} %" for name, s in phases.items())
    tell(f"{total / steps:.3g} s a step: {shares}")


if __name__ == "__main__":
    sys.exit(main())
