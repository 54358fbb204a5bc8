"""One key of a case: its unit, meaning and range, and the check of a value against them."""

import dataclasses
import difflib
import math
import os


class CaseError(ValueError):
    """A case that cannot be run: one line with the key, its value and the allowed range."""


# A name becomes the heading of a column, or part of a file name.
NAME = {"kind": "text", "forbidden": ",;\"'[]/\\#", "longest": 80}

# Sizes of a number other than 0; what is derived from any others may be beyond floating point.
SMALLEST, LARGEST = 1e-30, 1e30

# What a key holds, where it is not said, follows from the type of its default.
_KINDS = {bool: "flag", int: "integer", str: "text"}


def key(doc, default=dataclasses.MISSING, *, kind="", unit="", name="", **limits):
    """Field of a case table.

    Parameters
    ----------
    doc : str
        What it is, in one line.
    default : optional
        Without it the key is required; None marks a number that is filled in when a case is loaded.
    kind : str
        "number", "integer", "flag", "text", "texts", "numbers", "place", "point" or "points"; left
        out, it follows from the type of the default.
    unit : str
    name : str
        Name in the TOML file, where that is not the name of the attribute.
    limits
        low, high: range, ends included; above: lower end, left out; choices: allowed words;
        family: package of models to choose from;
        forbidden: characters that a text must not hold (such a text must not be empty either);
        copy: of a key that names an input file, the name of its copy in a run folder;
        longest: most characters of a text.
    """
    kind = kind or _KINDS.get(type(default), "number")
    metadata = {"doc": doc, "kind": kind, "unit": unit, "name": name, **limits}
    return dataclasses.field(default=default, metadata=metadata)


def toml_name(field) -> str:
    """Name of a field in the TOML file."""
    return field.metadata["name"] or field.name


def check_table(table) -> None:
    """Check every value of a dataclass made of `key` fields; numbers become float, lists tuples.

    Raises CaseError with the first key that does not fit.
    """
    title = type(table).__name__.lower()
    for field in dataclasses.fields(table):
        value = getattr(table, field.name)
        if value is None and field.default is None:
            continue
        value = check_value(f"{title}.{toml_name(field)}", value, field.metadata)
        object.__setattr__(table, field.name, value)


def check_value(name: str, value, metadata):
    """The value of a key as the case holds it; raises CaseError if it does not fit."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    plain = value.tolist() if hasattr(value, "tolist") else value  # numpy's numbers and arrays
    try:
        return _READERS[metadata["kind"]](plain, metadata)
    except _ExtremeError:
        hint = f", and unless 0 of a size from {SMALLEST:g} to {LARGEST:g}"
    except (TypeError, ValueError, OverflowError):
        hint = did_you_mean(plain, metadata.get("choices", ()))
    raise CaseError(f"{name} = {shown(plain)}: must be {rule(metadata)}{hint}")


class _ExtremeError(ValueError):
    """A number within its range whose size is near the limits of floating point."""


def require_choice(name: str, value, choices) -> None:
    """Raise CaseError, with the choices and the nearest of them, unless `value` is one of them."""
    if value not in choices:
        hint = did_you_mean(value, choices)
        raise CaseError(f"{name} = {shown(value)}: must be one of {', '.join(choices)}{hint}")


def require(fits: bool, name: str, value, rule: str) -> None:
    """Raise CaseError, with the key, its value and what it must be, unless it fits."""
    if not fits:
        raise CaseError(f"{name} = {shown(value)}: must be {rule}")


def did_you_mean(word, choices) -> str:
    """The nearest of the choices, as the end of an error message; empty if none is near."""
    word = word if isinstance(word, str) else shown(word)
    close = difflib.get_close_matches(word, choices, n=1, cutoff=0.5)
    return f"; did you mean {close[0]}?" if close else ""


def shown(value) -> str:
    """A value in one short line; of a long one, as a path, the beginning and the end."""
    if isinstance(value, bool):
        return str(value).lower()
    try:
        line = repr(_as_lists(value))
    except ValueError:  # Python writes no whole number of thousands of digits
        line = "a number of thousands of digits"
    return line if len(line) <= 80 else f"{line[:30]}...{line[-47:]}"


def _as_lists(value):
    return [_as_lists(part) for part in value] if isinstance(value, list | tuple) else value


def rule(metadata) -> str:
    """What a value must be, in words."""
    if metadata.get("choices"):
        choices = ", ".join(metadata["choices"])
        many = metadata["kind"] == "texts"
        return f"a list out of {choices}, each once at most" if many else f"one of {choices}"
    parts = (_NOUNS[metadata["kind"]], _range(metadata), _unit(metadata))
    return " ".join(part for part in parts if part)


def _unit(metadata):
    return f"[{metadata['unit']}]" if metadata["unit"] else ""


def _range(metadata):
    if metadata.get("forbidden"):
        longest = f", of at most {metadata['longest']} characters" if "longest" in metadata else ""
        return f"and not empty, without any of {metadata['forbidden']}{longest}"
    low, above, high = (metadata.get(limit) for limit in ("low", "above", "high"))
    if above is not None:
        return f"> {above:g}" + (f" and <= {high:g}" if high is not None else "")
    if low is not None:
        return f">= {low:g}" if high is None else f"from {low:g} to {high:g}"
    return ""


def _number(value, metadata):
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError
    number = float(value)
    low, high = metadata.get("low", -math.inf), metadata.get("high", math.inf)
    if not (math.isfinite(number) and low <= number <= high):
        raise ValueError
    if number <= metadata.get("above", -math.inf):
        raise ValueError
    if number and not SMALLEST <= abs(number) <= LARGEST:
        raise _ExtremeError
    return number


def _integer(value, metadata):
    if not isinstance(value, int):
        raise TypeError
    _number(value, metadata)
    return value


def _flag(value, metadata):
    if not isinstance(value, bool):
        raise TypeError
    return value


def _text(value, metadata):
    if not isinstance(value, str):
        raise TypeError
    forbidden = metadata.get("forbidden", "")
    fits = value.isprintable() and value == value.strip() and not set(value) & set(forbidden)
    fits = fits and len(value) <= metadata.get("longest", math.inf)
    if not fits or (forbidden and not value) or value not in metadata.get("choices", (value,)):
        raise ValueError
    return value


def _texts(value, metadata):
    words = tuple(_text(word, metadata) for word in _list(value))
    if len(set(words)) < len(words):
        raise ValueError
    return words


def _numbers(value, metadata):
    return tuple(_number(number, metadata) for number in _list(value))


def _point(value, metadata, size=3):
    point = _numbers(value, metadata)
    if len(point) != size:
        raise ValueError
    return point


def _place(value, metadata):
    return _point(value, metadata, size=2)


def _points(value, metadata):
    return tuple(_place(point, metadata) for point in _list(value))


def _list(value):
    if not isinstance(value, list | tuple):
        raise TypeError
    return value


_READERS = {
    "number": _number,
    "integer": _integer,
    "flag": _flag,
    "text": _text,
    "texts": _texts,
    "numbers": _numbers,
    "place": _place,
    "point": _point,
    "points": _points,
}

_NOUNS = {
    "number": "a number",
    "integer": "a whole number",
    "flag": "true or false",
    "text": "text of one line",
    "texts": "a list of different words",
    "numbers": "a list of numbers",
    "place": "two numbers [x, z]",
    "point": "three numbers [x, y, z]",
    "points": "a list of points [x, z], each number",
}
