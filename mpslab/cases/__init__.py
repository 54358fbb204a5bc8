"""The cases: a TOML file each, and what reads, completes, checks and writes them."""

from mpslab.cases.changes import parse_set
from mpslab.cases.doubts import warnings
from mpslab.cases.library import load_case, names, text
from mpslab.cases.reader import from_tables, loads
from mpslab.cases.writer import dumps

__all__ = [
    "dumps",
    "from_tables",
    "load_case",
    "loads",
    "names",
    "parse_set",
    "text",
    "warnings",
]
