"""Instruments: what a run reads, and the table that each of them fills.

Each module has one function::

    make(case) -> Instrument, or None where the case asks for none

and its file name is that of the table: ``gauges.py`` fills ``gauges.csv``. A module whose entries
come from tables of the case (``[[force]]``) may have a ``check(case)``, which raises CaseError.
"""

from collections import Counter

from mpslab.core import plugins
from mpslab.core.columns import name_of
from mpslab.core.keys import require, shown
from mpslab.core.schedule import check_interval

FIRST = ("time [s]", "step")  # what the first column may be: it tells which rows a restart drops
FORBIDDEN = "/\\."  # the dot stands between name and key in a checkpoint


class Instrument:
    """The contract; an instrument of one's own is a subclass.

    Attributes
    ----------
    name : str
        Name of its table, ``NAME.csv``.
    columns : sequence of str
        Headings with their units, "level [m]"; the first is "time [s]" or "step".
    interval : float [s]
        Time between readings, 0 for every step; None if it is read only when the run asks for it.
    words : dict of str to int
        Headings of the columns that hold words, and how many letters a word may have.
    """

    interval = 0.0
    words = {}  # noqa: RUF012

    def begin(self, flow):
        """Called once, before the first step and the first reading, also when a run goes on."""

    def read(self, flow):
        """The rows that it reads now: a list of tuples with an entry for each column.

        All ranks call it at the same time, and have to return the same rows: mostly one, none if
        there is nothing to say. At t = 0 no step has been done yet.

        Parameters
        ----------
        flow : mpslab.run.flow.Flow
            Its particles are those that this rank owns; ``flow.domain.total(values)`` adds values
            (n,), one for each of them, over all ranks, to the same bits on any number of ranks.
        """
        raise NotImplementedError

    def state(self):
        """What it carries on from step to step, for the checkpoint: a dict of names to numbers,
        strings and arrays.
        """
        return {}

    def restore(self, state):
        """Take over the `state` of a checkpoint."""


def of(case):
    """The instruments of a case, a dict by name."""
    made = [plugins.load("instruments", name).make(case) for name in plugins.names("instruments")]
    return {one.name: one for one in made if one is not None}


def with_own(case, own):
    """The instruments of a case and those of the user, a dict by name.

    Raises
    ------
    ValueError
        If one of the user's is no Instrument, or has a name, columns or an interval that it cannot
        have.
    """
    found = of(case)
    for number, one in enumerate(own):
        where = f"instruments[{number}]"
        if not isinstance(one, Instrument):
            raise ValueError(f"{where} = {shown(one)}: must be an mpslab.Instrument")
        _check_name(f"{where}.name", getattr(one, "name", None), found)
        _check_columns(f"{where}.columns", getattr(one, "columns", None))
        check_interval(f"{where}.interval", one.interval)
        found[one.name] = one
    return found


def _check_name(key, name, taken):
    fits = isinstance(name, str) and name.isprintable() and name.strip() == name != ""
    fits = fits and not set(name) & set(FORBIDDEN)
    require(fits, key, name, f"the name of a file, without any of {FORBIDDEN}")
    other = (*taken, *plugins.names("instruments"), "phases", "decomposition")
    require(name not in other, key, name, f"another name than {', '.join(dict.fromkeys(other))}")


def _check_columns(key, columns):
    fits = isinstance(columns, list | tuple) and all(isinstance(c, str) for c in columns)
    fits = fits and len(columns) > 1 and columns[0] in FIRST
    rule = f"a list of headings, the first of them one of {', '.join(FIRST)}"
    require(fits, key, columns, rule)
    twice = [name for name, count in Counter(map(name_of, columns)).items() if count > 1]
    require(not twice, key, columns, "headings that differ in more than their units")


def check(case):
    """Raise CaseError if an instrument cannot read what the case asks of it."""
    for name in plugins.names("instruments"):
        module = plugins.load("instruments", name)
        if hasattr(module, "check"):
            module.check(case)


def check_names(table, items):
    """Raise CaseError if two tables of a kind have the same name, or one is named "time"."""
    first = {}
    for i, item in enumerate(items):
        key = f"{table}.{i}.name"
        other = f"different from {table}.{first.setdefault(item.name, i)}.name"
        require(first[item.name] == i, key, item.name, other)
        rule = "another word than that of the column of times"
        require(item.name != "time", key, item.name, rule)
