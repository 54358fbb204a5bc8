"""Changes to a case by key, as on the command line: particles.spacing=0.002."""

import copy
import re
import tomllib

from mpslab.cases.recipes import RECIPES
from mpslab.core.keys import CaseError, shown
from mpslab.core.parameters import LISTS

# A number as Python writes it, alone: not a part of a word or of another number.
NUMBER = re.compile(r"(?<![\w.+-])[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![\w.])")


def parse_set(text: str) -> tuple:
    """Key and value of "key=value".

    The value is in TOML, where words may stand without quotes, and numbers as Python has them:
    0.002, .002, 5., true, hl, [shifting, ds]. Raises CaseError if it is none of these.
    """
    name, _, value = (part.strip() for part in text.partition("="))
    if not name or not value:
        raise CaseError(f"{shown(text)}: must be key=value, such as particles.spacing=0.002")
    for form in (str, _full_numbers, _quote_words):
        try:
            return name, _only_value(form(value))
        except (ValueError, RecursionError):
            continue
    if value[0] in "[{\"'":
        raise CaseError(f"{name} = {shown(value)}: must be a value in TOML")
    return name, value


def apply(tables: dict, overrides: dict) -> dict:
    """A copy of the tables of a case with other values, by key.

    A recipe among the overrides replaces what the tables say of the keys that recipes set.

    Raises CaseError if a key leads nowhere.
    """
    tables = copy.deepcopy(tables)
    if "scheme.recipe" in overrides and isinstance(tables.get("scheme"), dict):
        for key in RECIPES["standard"]:
            tables["scheme"].pop(key, None)
    for name, value in overrides.items():
        _put(tables, str(name), copy.deepcopy(value))
    return tables


def _only_value(text):
    found = tomllib.loads(f"value = {text}")
    if list(found) != ["value"]:
        raise ValueError
    return found["value"]


def _full_numbers(text):
    """Numbers in TOML's form, with digits on both sides of the point and no leading zeros: -.5, 5.,
    007.
    """
    if not text.startswith("[") and not NUMBER.fullmatch(text):
        return text
    return NUMBER.sub(lambda number: repr(_read_number(number[0])), text)


def _read_number(text):
    return int(text) if text.lstrip("+-").isdecimal() else float(text)


def _quote_words(text):
    if not text.startswith("["):
        return text
    return re.sub(r"[A-Za-z_]\w*", r'"\g<0>"', text)


def _put(tables, name, value):
    *path, last = name.split(".")
    place = tables
    for part in path:
        if isinstance(place, dict):
            place = place.setdefault(part, [] if part in LISTS else {})
        else:
            place = place[_index(place, part, name, value)]
    if not isinstance(place, dict):
        last = _index(place, last, name, value)
    place[last] = value


def _index(place, part, name, value):
    """Index into a list; refuses what is not a list, and an index that is not in it."""
    if not isinstance(place, list):
        raise CaseError(f"{name} = {shown(value)}: must be a known key, and {part!r} leads nowhere")
    if not part.isdecimal() or int(part) >= len(place):
        known = f"from 0 to {len(place) - 1}" if place else "of a list, which is empty"
        raise CaseError(f"{name} = {shown(value)}: {part!r} must be a number {known}")
    return int(part)
