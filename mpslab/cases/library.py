"""Reads a case: a built-in one, or a file of the user."""

import os
from pathlib import Path

from mpslab.cases import changes, reader
from mpslab.cases.builtin import FOLDER, names, unknown
from mpslab.core.keys import NAME, CaseError, shown
from mpslab.core.parameters import Case

MOST_BYTES = 1_000_000  # of a case file


def load_case(name_or_path, overrides=None) -> Case:
    """A case with nothing left open: read, changed, completed and checked.

    Parameters
    ----------
    name_or_path : str or Path
        Name of a built-in case, or path of a TOML file.
    overrides : dict, optional
        Values that replace those of the file, by key: {"particles.spacing": 0.002}. A number picks
        one of several: {"gauge.0.x": 0.1}. A relative wavemaker.file in it counts from the current
        folder, one in the TOML file from the folder of that file.

    Returns
    -------
    Case

    Raises
    ------
    CaseError
        If there is no such case, or a key or value does not fit: one line with key, value, range.
    """
    path = _find(name_or_path)
    tables = reader.parse(_read(path), str(path))
    tables = reader.with_absolute_file(tables, path.parent)
    return reader.from_tables(changes.apply(tables, overrides or {}), name=_name_of(path))


def _name_of(path):
    """Name of a case whose file gives none: that of the file, without what a name must not hold."""
    good = "".join(c if c.isprintable() and c not in NAME["forbidden"] else " " for c in path.stem)
    return " ".join(good.split())[: NAME["longest"]].strip() or "case"


def _find(name_or_path):
    if not isinstance(name_or_path, str | os.PathLike):
        raise CaseError(
            f"case = {shown(name_or_path)}: must be the name of a case or the path of a TOML file"
        )
    if name_or_path in names():
        return FOLDER / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix != ".toml" and not os.path.isfile(path):
        raise unknown(str(name_or_path))
    return path.absolute()


def _read(path):
    try:
        if path.stat().st_size > MOST_BYTES:
            raise CaseError(
                f"case = {shown(str(path))}: must be a file of at most {MOST_BYTES / 1e6:g} MB"
            )
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise CaseError(f"case = {shown(str(path))}: must be text in UTF-8") from None
    except CaseError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise CaseError(f"case = {shown(str(path))}: must be a readable file ({reason})") from None
