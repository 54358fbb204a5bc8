"""From TOML to a case."""

import tomllib
from dataclasses import MISSING, fields
from pathlib import Path

from mpslab.cases.checks import check
from mpslab.cases.complete import complete
from mpslab.cases.inputs import FILES
from mpslab.cases.recipes import RECIPES
from mpslab.cases.rows import as_written, one_by_one
from mpslab.core.keys import (
    CaseError,
    check_value,
    did_you_mean,
    require_choice,
    rule,
    shown,
    toml_name,
)
from mpslab.core.parameters import LISTS, TABLES, Case


def loads(source: str, name: str = "case", folder: Path = Path()) -> Case:
    """Case from the text of a TOML file, completed and checked; raises CaseError.

    A relative path of an input file counts from `folder`.
    """
    return from_tables(with_absolute_file(parse(source, name), folder), name)


def parse(source: str, where: str) -> dict:
    """Tables of a TOML text; raises CaseError with `where` and the line if it is not TOML."""
    try:
        return tomllib.loads(source)
    except (ValueError, RecursionError) as error:
        raise CaseError(f"{where}: must be a file in TOML: {error}") from None


def from_tables(tables: dict, name: str = "case") -> Case:
    """Case from tables as TOML holds them, completed and checked.

    Parameters
    ----------
    tables : dict
        {"tank": {"length": 0.8, ...}, "gauge": [{...}, ...], ...}
    name : str
        Name of the case, where the tables give none.

    Raises
    ------
    CaseError
        If a key is unknown or missing, or a value does not fit.
    """
    tables = {"name": name, **with_absolute_file(tables, Path.cwd())}
    _refuse_unknown("", tables, [item.name for item in fields(Case)])
    tables["scheme"] = _with_recipe(tables.get("scheme", {}))
    parts = {key: tables[key] for key in ("name", "title") if key in tables}
    for key, kind in TABLES.items():
        parts[key] = _table(kind, tables.get(key, {}), key)
    lists = {key: one_by_one(tables.get(key, []), key) for key in LISTS}
    try:
        for key, kind in LISTS.items():
            parts[key] = _tables(kind, lists[key][0], key)
        case = complete(Case(**parts))
        check(case)
    except CaseError as error:
        numbers = {key: found for key, (_, found) in lists.items()}
        raise CaseError(as_written(str(error), numbers)) from None
    return case


def with_absolute_file(tables: dict, folder: Path) -> dict:
    """The tables, with a relative path of an input file taken from a folder."""
    for table, key in FILES:
        values = tables.get(table)
        if isinstance(values, list | tuple):
            tables = {**tables, table: [_absolute(one, key, folder) for one in values]}
        elif values is not None:
            tables = {**tables, table: _absolute(values, key, folder)}
    return tables


def _absolute(values, key, folder):
    path = values.get(key) if isinstance(values, dict) else None
    named = isinstance(path, str | Path) and str(path)
    return {**values, key: str(folder / path)} if named else values


def _with_recipe(scheme):
    if not isinstance(scheme, dict):
        return scheme
    recipe = scheme.get("recipe", "standard")
    require_choice("scheme.recipe", recipe, tuple(RECIPES))
    return {**RECIPES[recipe], **scheme}


def _tables(kind, items, where):
    if not isinstance(items, list | tuple):
        raise CaseError(f"{where} = {shown(items)}: must be tables, each under [[{where}]]")
    return tuple(_table(kind, values, f"{where}.{i}") for i, values in enumerate(items))


def _table(kind, values, where):
    if not isinstance(values, dict):
        raise CaseError(f"{where} = {shown(values)}: must be a table of keys, under [{where}]")
    known = {toml_name(item): item for item in fields(kind)}
    _refuse_unknown(where, values, known)
    for name, item in known.items():
        if item.default is MISSING and name not in values:
            raise CaseError(f"{where}.{name} is missing: must be {rule(item.metadata)}")
    checked = {
        known[name].name: check_value(f"{where}.{name}", value, known[name].metadata)
        for name, value in values.items()
    }
    return kind(**checked)


def _refuse_unknown(where, values, known):
    for name, value in values.items():
        if name not in known:
            full = f"{where}.{name}" if where else str(name)
            full = full if full.isprintable() else repr(full)
            hint = _nearest(where, str(name), known)
            raise CaseError(
                f"{full} = {shown(value)}: unknown key; must be one of {', '.join(known)}{hint}"
            )


def _nearest(where, name, known):
    """The same key of another table, or a like one of this table."""
    tail = name.rsplit(".", 1)[-1]
    everywhere = [
        f"{table}.{toml_name(item)}"
        for table, kind in {**TABLES, **LISTS}.items()
        for item in fields(kind)
    ]
    same = [full for full in everywhere if full.rsplit(".", 1)[-1] == tail]
    if same:
        return f"; did you mean {' or '.join(same)}?"
    hint = did_you_mean(name, known)
    if where and hint:
        return hint.replace("did you mean ", f"did you mean {where}.")
    return hint
