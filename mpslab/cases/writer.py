"""From a case to TOML."""

import json
from dataclasses import fields

from mpslab.core.keys import toml_name
from mpslab.core.parameters import LISTS, TABLES, Case

# Column at which the comments start, where a value leaves room for it.
COMMENT = 36


def dumps(case: Case) -> str:
    """TOML text of a case, every key with unit and meaning; `loads` reads an equal case from it."""
    lines = [*_lines(case, ("name", "title"))]
    for name in TABLES:
        table = getattr(case, name)
        lines += ["", f"[{name}]", *_lines(table)]
    for name in LISTS:
        for table in getattr(case, name):
            lines += ["", f"[[{name}]]", *_lines(table)]
    return "\n".join(lines) + "\n"


def _lines(table, names=None):
    for item in fields(table):
        value = getattr(table, item.name)
        if value is None or (names and item.name not in names):
            continue
        unit = f"[{item.metadata['unit']}] " if item.metadata["unit"] else ""
        pair = f"{toml_name(item)} = {_value(value)}"
        yield f"{pair:<{COMMENT}}  # {unit}{item.metadata['doc']}"


def _value(value):
    if isinstance(value, tuple):
        return f"[{', '.join(_value(part) for part in value)}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return str(value).lower() if isinstance(value, bool) else repr(value)
