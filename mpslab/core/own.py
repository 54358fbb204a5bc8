"""The user's own parts of a run: instruments, forcings, solids, and models that were added.

A checkpoint keeps two names of each part: that which it has in the run, and "module:name", by which
Python finds it. A run that goes on takes the parts that it is given, and finds the others by these
names. It is refused, with the reason, where a part is neither given nor found, or is another one.
"""

import json
import pkgutil
import sys
from dataclasses import dataclass

from mpslab.core import plugins
from mpslab.core.keys import CaseError, shown


@dataclass(frozen=True)
class Own:
    """What a user gives a run beside its case, sequences; None for what is to be found.

    Models are not among them: a case names those, and `mpslab.core.plugins` has them.
    """

    instruments: tuple | None = ()
    forcings: tuple | None = ()
    solids: tuple | None = ()

    def to_text(self, case):
        """The names of all parts, those of the models of a case as well, for a checkpoint."""
        names = {kind: [_names(part) for part in parts] for kind, parts in vars(self).items()}
        names["models"] = [
            [f"{family}.{name}", name_of(plugins.load(family, name))]
            for family, name in plugins.added(case)
        ]
        return json.dumps(names)


def again(text, given):
    """The parts that a run goes on with; models that it finds are added.

    Parameters
    ----------
    text : str
        From `Own.to_text`.
    given : Own

    Returns
    -------
    Own

    Raises
    ------
    CaseError
        If a part is neither given nor found, or others are given than the run began with.
    """
    names = json.loads(text)
    for name, reference in names.pop("models", []):
        family, model = name.split(".")
        if not plugins.has(family, model):
            how = f"mpslab.add_model({family!r}, {model!r}, ...), before the run goes on"
            plugins.add(family, model, _again("models", name, reference, how))
    return Own(**{
        kind: _checked(kind, parts, names.get(kind, [])) for kind, parts in vars(given).items()
    })  # fmt: skip


def _checked(kind, given, names):
    """The parts of a kind, which must have the names that they had when the run began."""
    if given is None:
        how = f"Simulation.resume(folder, {kind}=[...])"
        given = [_again(kind, *pair, how) for pair in names]
    parts = tuple(given)
    now, began = ([name or reference for name, reference in pairs]
                  for pairs in (map(_names, parts), names))  # fmt: skip
    if now != began:
        raise CaseError(
            f"{kind} = {shown(now)}: must be those that the run began with, {shown(began)}"
        )
    return parts


def _again(kind, name, reference, how):
    """A part found by its reference, "module:name"."""
    why = "no module holds it by a name"
    if reference:
        try:
            return find(reference)
        except ValueError as error:
            why = str(error)
    raise CaseError(
        f"{kind}: the run began with {shown(name) if name else 'one without a name'}, and {why}: "
        f"must be given again, {how}"
    )


def _names(part):
    """Name of a part in the run, "" for a function, and name that Python finds it by."""
    return [str(getattr(part, "name", "")), name_of(part)]


def name_of(thing):
    """Name by which `find` finds an object again, "module:name"; "" where there is none.

    A function or class of a module has one, and so has an object that a module holds by a name.
    """
    module = getattr(thing, "__module__", None) or type(thing).__module__
    held = vars(sys.modules.get(module, sys))
    name = next((name for name, one in held.items() if one is thing), "")
    return f"{module}:{name}" if name and module != "__main__" else ""


def find(name):
    """The object of a name that `name_of` gave.

    Raises
    ------
    ValueError
        If there is no such module on Python's path, or nothing of that name in it.
    """
    try:
        return pkgutil.resolve_name(name)
    except (ImportError, AttributeError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"{name!r} cannot be found ({reason})") from error
