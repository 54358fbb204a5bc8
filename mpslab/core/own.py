"""What a user adds to a run from Python, known by its name: "module:name" of an object."""

import json
import pkgutil
import sys


def name_of(thing):
    """Name by which `find` finds an object again; "" where there is none.

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


def to_text(own):
    """Names of what a run was given, a dict of lists by what they are, as text."""
    return json.dumps({kind: [name_of(thing) for thing in things] for kind, things in own.items()})


def again(text, given):
    """What a run goes on with: what is given, or else the same things, found by their names.

    Parameters
    ----------
    text : str
        From `to_text`.
    given : dict of str to sequence or None
        None where nothing was said.

    Raises
    ------
    ValueError
        If a thing has no name to be found by, or what is given has other names.
    """
    found = {}
    for kind, names in json.loads(text).items():
        things = given.get(kind)
        if things is None:
            things = [_found(kind, name) for name in names]
        now = [name_of(thing) for thing in things]
        if now != names:
            raise ValueError(f"{kind} = {now}: must be {names}, those that the run began with")
        found[kind] = tuple(things)
    return found


def _found(kind, name):
    if not name:
        raise ValueError(
            f"{kind}: the run began with one that no module holds by a name, so that it cannot be "
            f"found again: must be given to Simulation.resume as {kind} = [...]"
        )
    try:
        return find(name)
    except ValueError as error:
        raise ValueError(f"{kind}: {error}: must be importable, as when the run began") from error
