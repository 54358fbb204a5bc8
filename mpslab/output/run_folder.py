"""The run folder: tables, the resolved case, and the record of the run."""

import json
import os
from contextlib import suppress
from datetime import UTC, datetime
from itertools import count
from pathlib import Path
from time import monotonic

from mpslab.cases import inputs
from mpslab.core.columns import DECOMPOSITION_COLUMNS
from mpslab.core.files import remove_drafts, replacing
from mpslab.core.stopwatch import KINDS, PHASES
from mpslab.output import lock
from mpslab.output.provenance import environment
from mpslab.output.tables import CsvTable
from mpslab.parallel.communicator import on_root
from mpslab.parallel.domain import world


class RunFolder:
    """The files of one run; make it with `create`, `create_next` or `reopen`, which hold it.

    No other run can have the folder until it is let go of, the object is forgotten, or the process
    ends. Made by the name alone, it is not held, and is not to be written to.

    Attributes
    ----------
    path, case, run, particles, checkpoint, pictures : Path
        The folder and its ``case.toml``, ``run.json``, ``particles.vtkhdf``, ``checkpoint.h5`` and
        ``pictures``.
    """

    def __init__(self, path):
        self.path = Path(path)
        self.case = self.path / "case.toml"
        self.run = self.path / "run.json"
        self.particles = self.path / "particles.vtkhdf"
        self.checkpoint = self.path / "checkpoint.h5"
        self.pictures = self.path / "pictures"
        self._lock, self._made = None, []
        self._tables = {}
        self._began = monotonic()
        self._started = _now()
        self._earlier_seconds = 0.0
        self._resumed = 0
        self._resumes = []
        self._inputs = ()

    @classmethod
    def create(cls, path):
        """A new run folder, held.

        Parameters
        ----------
        path : str or Path
            A folder that does not exist yet, or an empty one.

        Raises
        ------
        ValueError
            If there is something at ``path`` already, or nothing can be written there.
        """
        path = Path(path)
        if path.exists() and not path.is_dir():
            raise _bad_out(path, "is a file")
        made = _missing(path)
        try:
            path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise _bad_out(path, _why(error)) from error
        return cls._taken(path, made)

    @classmethod
    def create_next(cls, path):
        """A new run folder, held, at a path or the first of path-2, path-3 that is free.

        Raises
        ------
        ValueError
            If nothing can be written there.
        """
        for number in count(1):
            free = Path(path if number == 1 else f"{path}-{number}")
            made = _missing(free)
            try:
                free.parent.mkdir(parents=True, exist_ok=True)
                free.mkdir()
            except OSError as error:
                if os.path.lexists(free):
                    continue
                raise _bad_out(free, _why(error)) from error
            return cls._taken(free, made)

    @classmethod
    def _taken(cls, path, made):
        """The folder, held, if it is empty; `made` are those that were not there before."""
        folder = cls(path)
        folder._made = made
        try:
            folder._take_empty()
        except (OSError, ValueError) as error:
            folder.abandon()
            raise _bad_out(path, _why(error)) from error
        return folder

    @classmethod
    def find(cls, path):
        """The folder of an earlier run, to be looked at.

        Parameters
        ----------
        path : str or Path
            A folder with ``case.toml`` and ``checkpoint.h5``.

        Raises
        ------
        ValueError
            If one of the two is missing.
        """
        folder = cls(path)
        for file in (folder.case, folder.checkpoint):
            if not file.is_file():
                raise ValueError(
                    f"--resume: '{path}' holds no {file.name}; allowed: the folder of a run that "
                    "has written a checkpoint"
                )
        return folder

    @classmethod
    def reopen(cls, path):
        """The folder of an earlier run, held, to go on with it.

        Raises
        ------
        ValueError
            If `find` raises it, another run has the folder, or nothing can be written there.
        """
        folder = cls.find(path)
        try:
            folder.hold()
        except (OSError, lock.InUse) as error:
            raise ValueError(
                f"--resume: '{path}' {_why(error)}; allowed: a folder that can be written and that "
                "no other run writes to"
            ) from error
        folder._read_earlier_run()
        return folder

    def _take_empty(self):
        """Hold the folder; ValueError if anything is in it, and nothing is put there then."""
        names = set(os.listdir(self.path))
        if not names or lock.NAME in names:
            self.hold()
            names = set(os.listdir(self.path))
        if names - {lock.NAME}:
            raise ValueError("is not empty")

    def hold(self):
        """Hold the folder, if it is not held yet.

        Raises
        ------
        ValueError
            If another run has it (`lock.InUse`), or has gone on with it since it was let go of.
        """
        if self._lock:
            return
        self._lock = lock.FolderLock(self.path)
        if not all(table.in_place() for table in self._tables.values()):
            self.let_go()
            raise ValueError(
                f"'{self.path}': another run has gone on with it meanwhile; go on from there with "
                "Simulation.resume"
            )
        remove_drafts(self.path)

    def let_go(self):
        """Let other runs have the folder, until the next `hold`."""
        if self._lock:
            self._lock.release()
            self._lock = None

    def abandon(self):
        """Let go of the folder, and remove it if it was made here and nothing is in it."""
        self.let_go()
        with suppress(OSError):
            for path in self._made:
                path.rmdir()

    def _read_earlier_run(self):
        """Take over the start and the wall time; a damaged record is no reason not to go on."""
        try:
            earlier = json.loads(self.run.read_text(encoding="utf-8"))
            self._started = earlier["started"]
            self._earlier_seconds = earlier["wall_time [s]"]
            self._resumed = earlier["resumed"] + 1
            self._resumes = list(earlier.get("resumes", []))
        except (OSError, ValueError, KeyError, TypeError):
            self._resumed = 1

    def open_decomposition(self, last_step, ranks):
        """Open ``decomposition.csv``, which a run on several ranks writes.

        One that an earlier part of the run has left is cut to the step by a single rank as well.
        """
        if ranks == 1 and not (self.path / "decomposition.csv").exists():
            return
        self.open_table("decomposition", DECOMPOSITION_COLUMNS.values(), last_step)

    def add_decomposition(self, **entries):
        """Add a row to ``decomposition.csv``; a list has an entry a rank, with blanks between."""
        cells = [entries[key] for key in DECOMPOSITION_COLUMNS]
        row = [" ".join(map(str, c)) if isinstance(c, list) else c for c in cells]
        self.add_rows("decomposition", [row])

    def open_table(self, name, columns, last=None):
        """Open ``NAME.csv``.

        Parameters
        ----------
        name : str
        columns : sequence of str
            Its headings.
        last : int or float, optional
            Step or time [s] of the checkpoint that the run goes on from: later rows are dropped.
        """
        self._tables[name] = CsvTable(self.path / f"{name}.csv", columns, last)

    def add_rows(self, name, rows):
        """Add rows to ``NAME.csv``, each with an entry for each column."""
        for row in rows:
            self._tables[name].append(row)

    def add_phases(self, step, time, spent):
        """Add a row to ``phases.csv``: each phase whole, then the parts of it that were not work.

        Parameters
        ----------
        step : int
        time : float [s]
        spent : dict of (phase, kind) to float [s]
            For one step; see `mpslab.core.stopwatch.Stopwatch`.
        """
        cells = []
        for phase in PHASES:
            work, communication, waiting = (spent.get((phase, kind), 0.0) for kind in KINDS)
            cells += [work + communication + waiting, communication, waiting]
        self.add_rows("phases", [[step, time, *(round(s, 7) for s in cells)]])

    def write_case(self, text):
        """Write ``case.toml``: the resolved case as TOML."""
        with replacing(self.case) as draft:
            draft.write_text(text, encoding="utf-8")

    def keep_inputs(self, files):
        """Name the input files of the run in its record; new ones are copied into the folder.

        Parameters
        ----------
        files : tuple of mpslab.cases.inputs.Input
        """
        self._inputs = files
        inputs.keep([item for item in files if item.content is not None], self.path)

    def note_resume(self, step, time, changes):
        """Note in the record that the run goes on from a step and time [s], with these changes.

        Parameters
        ----------
        changes : dict of str to [old, new]
            By key of the case.
        """
        entry = {"date": _now(), "step": step, "time [s]": time, "changes": changes}
        self._resumes.append(entry)

    def write_run(self, outcome, particles, phases, reason=None, preflight=None):
        """Write ``run.json``, in place of the earlier one.

        Parameters
        ----------
        outcome : str
            "running", or how the run ended.
        particles : dict of str to int
            Particle counts.
        phases : dict of str to float
            Seconds spent in each phase of the steps since the start or the restart.
        reason : str, optional
            Why the run stopped.
        preflight : dict, optional
            `mpslab.run.preflight.Preflight.findings`.
        """
        record = {
            **environment(),
            "started": self._started,
            "ended": None if outcome == "running" else _now(),
            "wall_time [s]": round(self._earlier_seconds + monotonic() - self._began, 3),
            "resumed": self._resumed,
            "resumes": self._resumes,
            "inputs": inputs.record(self._inputs),
            "particles": {name: int(count) for name, count in particles.items()},
            "phases [s]": {name: round(seconds, 3) for name, seconds in phases.items()},
            "outcome": outcome,
            "reason": reason,
            "preflight": preflight or {},
        }
        with replacing(self.run) as draft:
            draft.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")

    def flush(self):
        """Bring the tables up to date on the disk.

        To be called before a checkpoint is written: a run that goes on from it keeps the rows up to
        its step, so they must be there after a kill.
        """
        for table in self._tables.values():
            table.flush()

    def close(self):
        """Close the tables, and let go of the folder."""
        for table in self._tables.values():
            table.close()
        self.let_go()


def take(make, path):
    """The `RunFolder` that rank 0 makes, and holds; the other ranks know where it is."""
    comm = world()
    folder = on_root(comm, lambda: make(path))
    path = comm.bcast(folder and folder.path)
    return folder or RunFolder(path)


def _missing(path):
    """The folders of a path that are not there yet, the innermost first."""
    return [folder for folder in (path, *path.parents) if not folder.exists()]


def _why(error):
    if isinstance(error, lock.InUse):
        return f"is {error}: wait for that run, or stop it"
    return f"cannot be written ({error.strerror})" if isinstance(error, OSError) else str(error)


def _bad_out(path, what):
    return ValueError(
        f"--out: '{path}' {what}; allowed: a new or an empty folder that can be written"
    )


def _now():
    """The time of day, with its zone."""
    return datetime.now(UTC).isoformat(timespec="seconds")
