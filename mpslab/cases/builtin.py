"""The built-in cases, a TOML file each in this folder."""

import tomllib
from pathlib import Path

from mpslab.core.keys import CaseError, did_you_mean, shown

FOLDER = Path(__file__).parent


def names() -> tuple[str, ...]:
    """Names of the built-in cases."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.toml")))


def titles() -> dict[str, str]:
    """Title of each built-in case, by name."""
    return {name: tomllib.loads(text(name))["title"] for name in names()}


def text(name: str) -> str:
    """The TOML file of a built-in case, as written; raises CaseError if there is none."""
    if name not in names():
        raise unknown(name)
    return (FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def unknown(name):
    """The CaseError that says that there is no case of this name."""
    hint = did_you_mean(name, names())
    return CaseError(
        f"case = {shown(name)}: must be one of {', '.join(names())}, or a .toml file{hint}"
    )
