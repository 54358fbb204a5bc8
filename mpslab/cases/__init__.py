"""The cases: a TOML file each, and what reads, completes, checks and writes them."""

from mpslab.later import names_of

__all__ = [
    "dumps",
    "from_tables",
    "load_case",
    "loads",
    "names",
    "parse_set",
    "text",
    "titles",
    "warnings",
]
__getattr__, __dir__ = names_of(
    __name__,
    {
        "dumps": "mpslab.cases.writer:dumps",
        "from_tables": "mpslab.cases.reader:from_tables",
        "load_case": "mpslab.cases.library:load_case",
        "loads": "mpslab.cases.reader:loads",
        "names": "mpslab.cases.builtin:names",
        "parse_set": "mpslab.cases.changes:parse_set",
        "text": "mpslab.cases.builtin:text",
        "titles": "mpslab.cases.builtin:titles",
        "warnings": "mpslab.cases.doubts:warnings",
    },
)
