"""The simulations of a suite: several at a time, each a process, kept when they have finished."""

import hashlib
import json
import re
import shutil
import signal
import subprocess
import sys
import threading
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path

import mpslab
from mpslab.cases import dumps
from mpslab.core.files import replacing
from validation.suite import PlannedRun

DONE, FAILED, INTERRUPTED = 0, 3, 130  # exit statuses of mpslab.tank
SOURCES = (".py", ".pyx", ".pxd", ".toml")
LOOK_EVERY = 0.5  # seconds between looks at the logs


@dataclass(frozen=True)
class Task:
    """A run of a case, and the folder it goes to."""

    case: str
    plan: PlannedRun
    folder: Path

    @property
    def log(self):
        """File of what the run printed."""
        return self._beside(".log")

    @property
    def record(self):
        """File of what is known of the run."""
        return self._beside(".json")

    @property
    def file(self):
        """File of its case."""
        return self._beside(".toml")

    def _beside(self, ending):
        """A file beside the folder; the name of a run may hold dots."""
        return self.folder.with_name(self.folder.name + ending)

    @property
    def done(self):
        """Share of the run that is done, by the last line of its log that says so."""
        found = re.findall(r"(\d+) %, ", self.log.read_text()) if self.log.exists() else []
        return int(found[-1]) / 100.0 if found else 0.0


@dataclass(frozen=True)
class Outcome:
    """How a run ended: "finished", "failed" or "interrupted", and why."""

    task: Task
    outcome: str
    reason: str | None = None


class Work:
    """Runs tasks side by side.

    Parameters
    ----------
    jobs : int
        Runs at a time.
    ranks : int
        Processes of each run.
    """

    def __init__(self, jobs, ranks=1):
        self.jobs, self.ranks = jobs, ranks
        self._stopping = threading.Event()
        self._processes = set()

    def do(self, tasks, progress=None):
        """Run the tasks, the longest first; yields an `Outcome` as each ends.

        Ctrl-C stops the runs after the step in hand, with a checkpoint, and is raised again.
        """
        tasks = sorted(tasks, key=lambda task: -task.plan.weight)
        for task in tasks:
            task.log.unlink(missing_ok=True)
        with ThreadPoolExecutor(self.jobs) as pool:
            waiting = {pool.submit(self.run, task) for task in tasks}
            try:
                while waiting:
                    ended, waiting = wait(waiting, LOOK_EVERY, FIRST_COMPLETED)
                    yield from (future.result() for future in ended)
                    if progress:
                        progress()
            except BaseException:
                self._stop(waiting)
                raise

    def _stop(self, waiting):
        self._stopping.set()
        for future in waiting:
            future.cancel()
        for process in list(self._processes):
            process.send_signal(signal.SIGINT)

    def run(self, task):
        """One task: taken over, gone on with, or run; returns its `Outcome`."""
        mark, known = fingerprint(task.plan.resolved), _read(task.record)
        if known.get("fingerprint") == mark and known["outcome"] == "finished":
            return Outcome(task, "finished")
        if known.get("fingerprint") == mark and (task.folder / "checkpoint.h5").exists():
            arguments = ["--resume", str(task.folder)]
        else:
            shutil.rmtree(task.folder, ignore_errors=True)
            task.folder.parent.mkdir(parents=True, exist_ok=True)
            task.file.write_text(dumps(task.plan.resolved), encoding="utf-8")
            arguments = [str(task.file), "--out", str(task.folder)]
        _write(task.record, fingerprint=mark, outcome="running")
        outcome = self._simulate(task, arguments)
        _write(task.record, fingerprint=mark, outcome=outcome.outcome)
        return outcome

    def _simulate(self, task, arguments):
        line = [sys.executable, "-m", "mpslab.tank", *arguments, "--no-pictures"]
        line += ["--ranks", str(self.ranks)] if self.ranks > 1 else []
        if self._stopping.is_set():
            return Outcome(task, "interrupted")
        with task.log.open("w") as log:
            process = subprocess.Popen(
                line, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
            )
            self._processes.add(process)
            status = process.wait()
            self._processes.discard(process)
        if status == DONE:
            return Outcome(task, "finished")
        # Stopped while it still loads its modules, a run dies of the signal.
        if status in (INTERRUPTED, -signal.SIGINT):
            return Outcome(task, "interrupted")
        return Outcome(task, "failed", _reason(task.log))


def _reason(log):
    """The line of a log that says why a run stopped, or its last one."""
    lines = log.read_text().splitlines() or ["no word of the reason"]
    said = [line.removeprefix("mpslab: ") for line in lines if line.startswith("mpslab: ")]
    return said[-1] if said else lines[-1]


def fingerprint(case):
    """What the result of a run depends on: the sources of mpslab and the case, as a short text."""
    return hashlib.sha256((_sources() + dumps(case)).encode()).hexdigest()


def _sources():
    folder = Path(mpslab.__file__).parent
    files = sorted(path for path in folder.rglob("*") if path.suffix in SOURCES)
    return "".join(hashlib.sha256(path.read_bytes()).hexdigest() for path in files)


def _read(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _write(path, **entries):
    with replacing(path) as draft:
        draft.write_text(json.dumps(entries), encoding="utf-8")
