"""The list of all keys of a case: ``python -m mpslab.tank --keys``, which is also docs/keys.md."""

import dataclasses
import textwrap

from mpslab.cases.checks import models
from mpslab.cases.recipes import RECIPES
from mpslab.core.keys import CaseError, did_you_mean, rule, shown, toml_name
from mpslab.core.parameters import LISTS, TABLES, Case, Scheme

TITLE = """\
# The keys of a case

What `python -m mpslab.tank --keys` prints: of every key what it must be, its default and what it
means. A key without a default is required. A number other than 0 has a size from 1e-30 to 1e+30.
"""
WIDTH = 100


def text(table=None):
    """The keys of a case, or of one of its tables, as lines of Markdown.

    Parameters
    ----------
    table : str, optional
        Name of a table, such as "tank".

    Raises
    ------
    CaseError
        If there is no such table.
    """
    tables = TABLES | LISTS
    if table is None:
        parts = [TITLE, *_lines(Case), *(_section(name) for name in tables)]
        return "\n".join(parts)
    if table not in tables:
        hint = did_you_mean(table, tables)
        raise CaseError(f"--keys {shown(table)}: must be one of {', '.join(tables)}{hint}")
    return _section(table)


def _section(name):
    """Heading and keys of a table."""
    kind = (TABLES | LISTS)[name]
    heading = f"[[{name}]]" if name in LISTS else f"[{name}]"
    often = " There may be several." if name in LISTS else ""
    about = textwrap.fill(" ".join(kind.__doc__.split()) + often, WIDTH)
    return "\n".join([f"\n## {heading}\n", about, "", *_lines(kind)])


def _lines(table):
    """An entry for each key of a table."""
    for item in dataclasses.fields(table):
        if "kind" in item.metadata:
            default = _default(item) + (_of_recipes(item) if table is Scheme else "")
            entry = f"- `{toml_name(item)}`: {_rule(item)}{default}. {_meaning(item)}"
            yield textwrap.fill(entry, WIDTH, subsequent_indent="  ", break_on_hyphens=False)


def _rule(item):
    """What a key must be, in words, with the names of its models."""
    if item.name == "recipe":
        return rule({**item.metadata, "choices": tuple(RECIPES)})
    if "family" in item.metadata:
        return rule({**item.metadata, "choices": models(item.metadata)})
    return rule(item.metadata)


def _default(item):
    if item.default is dataclasses.MISSING:
        return ""
    if item.default is None:
        return "; may be left out"
    return f"; default {_quoted(item.default)}"


def _of_recipes(item):
    """Values that recipes fill in in place of the default."""
    return "".join(
        f", with recipe {name} {_quoted(keys[item.name])}"
        for name, keys in RECIPES.items()
        if item.name in keys and shown(keys[item.name]) != shown(item.default)
    )


def _quoted(value):
    return f"`{shown(value)}`".replace("'", '"')


def _meaning(item):
    doc = item.metadata["doc"]
    return f"{doc[0].upper()}{doc[1:]}."
