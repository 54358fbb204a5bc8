"""Going on with a run: the case that its checkpoint belongs to, and what of it may change."""

import json
from dataclasses import dataclass, fields

from mpslab.cases import inputs, load_case, loads
from mpslab.core import own, plugins
from mpslab.core.keys import CaseError, shown, toml_name
from mpslab.core.parameters import LISTS, TABLES, Case
from mpslab.output import checkpoint

# Keys on which neither the state nor the layout of a run depends; all others are fixed when it
# begins.
FREE = (
    "name", "title", "time.end", "scheme.solver", "scheme.tolerance", "scheme.max_iterations",
)  # fmt: skip
FREE_TABLES = ("parallel", "output")

NOTHING = own.Own(None, None, None)  # nothing is given: all parts of the user's own are looked for

# Keys that are fixed only because the run has begun its files, and why.
HELD = {"output.fields": "the frames of particles.vtkhdf have their fields"}


@dataclass(frozen=True)
class Restart:
    """What a run goes on with.

    Attributes
    ----------
    case : mpslab.core.parameters.Case
    state : dict
        Of the checkpoint, as `mpslab.output.checkpoint.read` gives it.
    inputs : tuple of mpslab.cases.inputs.Input
    own : mpslab.core.own.Own
    changes : dict of str to [old, new]
        The keys of the case that differ from those of the checkpoint.
    """

    case: Case
    state: dict
    inputs: tuple
    own: own.Own
    changes: dict


def look(folder, overrides=None, given=NOTHING):
    """Find what a run goes on with; writes nothing.

    Parameters
    ----------
    folder : mpslab.output.run_folder.RunFolder
    overrides : dict, optional
        Values that replace those of ``case.toml``, by key, as for `mpslab.load_case`.
    given : mpslab.core.own.Own
        The user's own parts that are given again; the others are looked for.

    Returns
    -------
    Restart

    Raises
    ------
    ValueError
        If the checkpoint is damaged or does not hold its case, an input file is not what it was,
        the case differs from that of the checkpoint in what cannot change, or what the run has of
        the user's own is neither given nor found.
    """
    state = checkpoint.read_state(folder.checkpoint)
    if "case" not in state:
        raise ValueError(
            f"--resume {folder.path}: the checkpoint is of an earlier mpslab and does not hold the "
            "case that it belongs to; must be one that does: run the case anew"
        )
    parts = _own(folder.path, state, given)
    files = inputs.from_text(state["inputs"])
    inputs.check(files, folder.path)
    case = load_case(folder.case, overrides)
    began = loads(state["case"], f"the case in {folder.checkpoint}", folder.path.absolute())
    changes = differences(began, case)
    for key, (old, new) in changes.items():
        if not _free(key):
            now = "is absent" if new is None else f"= {shown(new)}"
            raise CaseError(f"--resume {folder.path}: {key} {now}: {_rule(key, old)}")
    if "time.end" in changes and case.time.end <= state["time"]:
        raise CaseError(
            f"--resume {folder.path}: time.end = {case.time.end:g} s: must be > "
            f"{state['time']:g} s, the time that the run has reached"
        )
    return Restart(case, state, files, parts, changes)


def _own(path, state, given):
    """The user's own parts, as given or found."""
    earlier = json.loads(state["outside"]) | json.loads(state["own"]) if "outside" in state else {}
    if any(earlier.values()):
        raise ValueError(
            f"--resume {path}: the checkpoint is of an earlier mpslab, and the run has parts of "
            "the user's own, which this one keeps in another way: run the case anew"
        )
    try:
        return own.again(state["own"], given)
    except CaseError as error:
        raise CaseError(f"--resume {path}: {error}") from error


def differences(old, new):
    """Keys in which two cases differ, a dict of key to [old value, new value]."""
    before, after = _by_key(old), _by_key(new)
    keys = dict.fromkeys([*before, *after])
    return {
        key: [before.get(key), after.get(key)] for key in keys if before.get(key) != after.get(key)
    }


def _by_key(case):
    """The values of a case by key: "tank.length", "gauge.0.x"."""
    values = {"name": case.name, "title": case.title}
    tables = {name: getattr(case, name) for name in TABLES}
    for name in LISTS:
        tables |= {f"{name}.{i}": one for i, one in enumerate(getattr(case, name))}
    for name, table in tables.items():
        for item in fields(table):
            values[f"{name}.{toml_name(item)}"] = getattr(table, item.name)
    return values


def _free(key):
    return key in FREE or (key.split(".")[0] in FREE_TABLES and key not in HELD)


def _rule(key, old):
    """What the value of a key must be that cannot change, and why."""
    table = f"{key.split('.')[0]}s"
    why = f"{table}.csv has its columns" if table in plugins.names("instruments") else ""
    why = HELD.get(key, why)
    stay = "be absent" if old is None else f"stay {shown(old)}"
    return (
        f"must {stay}, as when the run began" + (f", for {why}" if why else "")
        + f"; what may change: {', '.join([*FREE, *(f'[{name}]' for name in FREE_TABLES)])}"
    )  # fmt: skip
