"""Rows of instruments by one table: a [[gauge]] with a list of places, a [[probe]] with heights."""

import re

from mpslab.core.keys import CaseError

LISTED = {"gauge": "x", "probe": "z"}  # the key of each that may hold a list


def one_by_one(items, where):
    """The tables of a kind, with one for each place of a list, NAME-1, NAME-2 and so on.

    Returns them and, for each, the number of the table that it comes from.
    """
    key = LISTED.get(where)
    if key is None or not isinstance(items, list | tuple):
        return items, ()
    apart, numbers = [], []
    for i, values in enumerate(items):
        each = _apart(values, key, f"{where}.{i}")
        apart += each
        numbers += [i] * len(each)
    return apart, numbers


def _apart(values, key, where):
    places = values.get(key) if isinstance(values, dict) else None
    if not isinstance(places, list | tuple):
        return [values]
    if not places:
        raise CaseError(f"{where}.{key} = []: must be a number, or a list of numbers [m]")
    name = values.get("name")
    named = isinstance(name, str)
    return [
        {**values, **({"name": f"{name}-{k}"} if named else {}), key: place}
        for k, place in enumerate(places, 1)
    ]


def as_written(message, numbers):
    """A message whose keys have the numbers of the tables that they come from.

    Parameters
    ----------
    numbers : dict of str to sequence of int
        What `one_by_one` found for each kind.
    """

    def number(found):
        kind, k = found[1], int(found[2])
        return f"{kind}.{numbers[kind][k] if k < len(numbers[kind]) else k}"

    # Not in a quoted value, which may hold anything.
    return re.sub(rf"(?<![\w.'\"])({'|'.join(LISTED)})\.(\d+)", number, message)
