"""What a run, finished or not, has left in its folder: its case and record, series and frames.

>>> run = mpslab.open_run("results")
>>> run.outcome, run.preflight["wave"]["height [m]"]
>>> run.gauges["time"], run.gauges["toe"], run.steps["kinetic_energy"]
>>> frame = run.frames.at(1.04)
>>> frame.position[frame.fluid]
"""

import json
import operator
import tomllib
from functools import cached_property
from pathlib import Path

import numpy as np

from mpslab.cases import load_case
from mpslab.core import columns
from mpslab.core.kinds import FLUID
from mpslab.output.journal import journal_of
from mpslab.output.tables import read_rows

WORDS = {"steps": ("dt_limit",), "lost": ("reason",)}  # columns that hold words, by table
LISTS = {"decomposition": ("particles", "seconds", "waiting")}  # that have a number for each rank
KEYS = {heading: key for key, heading in columns.DECOMPOSITION_COLUMNS.items()}


def open_run(folder):
    """A run to be looked at, from the files in its folder, however it was started.

    A run that is still going, or was cut off, is read as far as its files are complete: a row or a
    frame that is being written is left out.

    Parameters
    ----------
    folder : str or Path

    Returns
    -------
    Run

    Raises
    ------
    ValueError
        If the folder holds no run.
    """
    run = Run(folder)
    _ = run.tables
    return run


class Run:
    """A run as it was left; `open_run` makes one.

    Each file is read when it is first asked for, and not again: open the run again to see how far
    it has come since. What cannot be read raises a ValueError of one line.

    Parameters
    ----------
    folder : str or Path
        A run folder. Any file but the case may be missing: what it would hold is then empty.

    Attributes
    ----------
    folder : Path
    """

    def __init__(self, folder):
        self.folder = Path(folder)

    def __repr__(self):
        return f"<Run '{self.folder}': {self.outcome}>"

    @cached_property
    def tables(self):
        """The tables of ``case.toml`` as they are, even those of an earlier mpslab; a dict."""
        path = self.folder / "case.toml"
        try:
            return tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise ValueError(
                f"'{path}': cannot be read as a case ({error}); allowed: the folder of a run"
            ) from error

    @cached_property
    def case(self):
        """The resolved case, a `mpslab.core.parameters.Case`, as `mpslab.load_case` gives it."""
        _ = self.tables
        return load_case(self.folder / "case.toml")

    @cached_property
    def record(self):
        """``run.json``: versions, machine, times, particles, phases, preflight; a dict."""
        path = self.folder / "run.json"
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as error:
            raise ValueError(f"'{path}': cannot be read as JSON ({error})") from error

    @property
    def outcome(self):
        """How the run ended: "finished", "stopped", "interrupted" or "failed".

        "running" if it has not ended, or was killed; None without a record.
        """
        return self.record.get("outcome")

    @property
    def reason(self):
        """Why the run stopped, a line; None if there is nothing to say."""
        return self.record.get("reason")

    @property
    def preflight(self):
        """What ``--check`` says of the run beforehand, `mpslab.run.preflight.Preflight.findings`.

        {"refused": why} for a case that ``--check`` refuses; empty for a run of an earlier mpslab.
        """
        return self.record.get("preflight", {})

    @cached_property
    def steps(self):
        """Rows of ``steps.csv``, a structured array (steps,).

        Its fields are those of `Simulation.steps`, the keys of `mpslab.core.columns.STEP_COLUMNS`
        in their units; so are those of gauges and probes.
        """
        return self._series("steps", columns.STEP_COLUMNS)

    @cached_property
    def gauges(self):
        """Water levels, (n,): field "time" [s] and one field [m] for each gauge, NaN if dry."""
        return self._readings("gauges", ["time", *self._instruments("gauge")])

    @cached_property
    def probes(self):
        """Readings, (n,): "time" [s], then of each probe "NAME pressure" [Pa] and "NAME u", "NAME
        v", "NAME w" [m/s]; NaN in the air.
        """
        read = [f"{p} {q}" for p in self._instruments("probe") for q in columns.PROBE_QUANTITIES]
        return self._readings("probes", ["time", *read])

    @cached_property
    def phases(self):
        """Where the time of a step goes, (n,): "step", "time" [s] and, for each phase, "PHASE",
        "PHASE communication" and "PHASE waiting" [s/step].
        """
        return self._series("phases", columns.PHASE_COLUMNS)

    @cached_property
    def decomposition(self):
        """How the tank was shared out among ranks, (n,); no row for a run on one rank.

        The fields are the keys of `mpslab.core.columns.DECOMPOSITION_COLUMNS`; "particles",
        "seconds" [s] and "waiting" [s] are (n, ranks). If a part of the run had fewer ranks than
        another, the rest is NaN.
        """
        return self._series("decomposition", columns.DECOMPOSITION_COLUMNS)

    @cached_property
    def lost(self):
        """Particles that left the tank, (n,): "step", "time" [s], "gid", "x", "y", "z" [m], and
        "reason", the side by which they left.
        """
        return self._series("lost", columns.LOST_COLUMNS)

    def table(self, name):
        """Rows of the table of any instrument, ``NAME.csv``, (n,): "time" [s] or "step" first.

        The fields are its headings without their units, as "NAME fx" [N], in 2-D [N/m], of forces.
        """
        return self._series(name, ["time"])

    @cached_property
    def frames(self):
        """The frames of particles, `Frames`."""
        return Frames(self.folder / "particles.vtkhdf")

    def _instruments(self, kind):
        return [instrument["name"] for instrument in self.tables.get(kind, ())]

    def _readings(self, table, headings):
        """Rows of a table of instruments, which must be those of the case."""
        found = self._series(table, headings)
        differ = set(map(_name, headings)) ^ set(found.dtype.names)
        if len(found) and differ:
            path, which = self.folder / f"{table}.csv", ", ".join(sorted(differ))
            raise ValueError(
                f"'{path}': cannot be read as a table of this run (its columns and those of "
                f"case.toml differ: {which})"
            )
        return found

    def _series(self, table, headings):
        """Rows of a table; no rows, with these headings, if there is no table yet."""
        path = self.folder / f"{table}.csv"
        header, *rows = read_rows(path) or [headings]
        try:
            cells = [*zip(*rows, strict=True)] or [()] * len(header)
            found = {}
            for heading, entries in zip(header, cells, strict=True):
                name = _name(heading)
                found[name] = _column(entries, name in WORDS.get(table, ()),
                                      name in LISTS.get(table, ()))  # fmt: skip
            if len(found) < len(header) or not {"time", "step"} & set(found):
                raise ValueError("its headings must differ, and one of them be time or step")
        except ValueError as error:
            raise ValueError(f"'{path}': cannot be read as a table of a run ({error})") from error
        series = np.empty(len(rows), [(n, c.dtype, c.shape[1:]) for n, c in found.items()])
        for name, column in found.items():
            series[name] = column
        series.flags.writeable = False
        return series


def _name(heading):
    """Name of the field of a column: "time" of "time [s]"."""
    return KEYS.get(heading) or columns.name_of(heading)


def _column(entries, of_words, of_lists):
    """A column as numbers, (n,) or (n, ranks), or as words."""
    if of_words:
        return np.array(entries, f"U{max(16, *map(len, entries), 0)}")
    if not of_lists:
        return np.array(entries, float)
    parts = [entry.split() for entry in entries]
    found = np.full((len(parts), max(map(len, parts), default=0)), np.nan)
    for row, part in zip(found, parts, strict=True):
        row[: len(part)] = part
    return found


class Frame(dict):
    """The particles at one time: arrays by name, "position" and those of ``output.fields``.

    Attributes
    ----------
    time : float [s]
    """

    def __init__(self, time, arrays):
        super().__init__(arrays)
        self.time = time

    def __repr__(self):
        return f"<Frame at t = {self.time:g} s: {len(self.kind)} particles, {', '.join(self)}>"

    @property
    def position(self):
        """(n, 3) float32 [m]."""
        return self["position"]

    @property
    def velocity(self):
        """(n, 3) float32 [m/s]."""
        return self._field("velocity")

    @property
    def pressure(self):
        """(n,) float32 [Pa]."""
        return self._field("pressure")

    @property
    def kind(self):
        """(n,) int8: number of the kind in `mpslab.core.kinds.KIND_NAMES`."""
        return self["kind"]

    @property
    def fluid(self):
        """Mask of the water, (n,) bool."""
        return self["kind"] == FLUID

    def _field(self, name):
        if name not in self:
            raise ValueError(
                f"the frames hold no {name}, only {', '.join(self)}; output.fields chooses them"
            )
        return self[name]


class Frames:
    """Frames of particles, each read when it is asked for: ``frames[-1]``, ``frames[::10]``.

    Parameters
    ----------
    path : Path
        The ``particles.vtkhdf`` of a run; it need not be there.
    """

    def __init__(self, path):
        self.path = Path(path)

    def __repr__(self):
        return f"<Frames '{self.path}': {len(self)}>"

    @cached_property
    def times(self):
        """Times of the frames, (frames,) float64 [s]."""
        if not (self.path.exists() or journal_of(self.path).exists()):
            return np.empty(0)
        from mpslab.output import vtkhdf  # here, because it loads HDF5

        return vtkhdf.read_times(self.path)

    @cached_property
    def _numbers(self):
        """Numbers of the frames in the file."""
        return range(len(self.times))

    def __len__(self):
        return len(self._numbers)

    def __iter__(self):
        return map(self._read, range(len(self)))

    def __getitem__(self, which):
        """The `Frame` with a number, counted from the end if negative; for a slice, `Frames`.

        ValueError if there is no frame at all, IndexError if there are fewer.
        """
        if isinstance(which, slice):
            part = Frames(self.path)
            part.times, part._numbers = self.times[which], self._numbers[which]
            return part
        count, number = len(self.required()), operator.index(which)
        if not -count <= number < count:
            raise IndexError(f"frame {number}: must be from {-count} to {count - 1}")
        return self._read(number)

    def at(self, time):
        """The `Frame` nearest to a time [s]; ValueError if there is none at all."""
        return self[int(np.argmin(np.abs(self.required().times - time)))]

    def required(self):
        """The frames, if there are any; else a ValueError."""
        if not len(self):
            raise ValueError(
                f"'{self.path.parent}': holds no {self.path.name} with a frame in it; allowed: the "
                "folder of a run that has written one"
            )
        return self

    def _read(self, place):
        from mpslab.output import vtkhdf

        try:
            arrays = vtkhdf.read_frame(self.path, self._numbers[place])
        except IndexError as error:
            raise ValueError(
                f"'{self.path}': the frame at t = {self.times[place]:g} s is there no more, since "
                "the run went back to its checkpoint; open it anew"
            ) from error
        return Frame(float(self.times[place]), arrays)
