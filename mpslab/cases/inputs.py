"""The input files of a case: kept in the run folder, and known by their checksums.

A run reads its input files again whenever it goes on. It keeps copies of them, so that it finds the
same files even if its folder was moved, or the files were changed.
"""

import hashlib
import json
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path

from mpslab.core.files import is_file, replacing
from mpslab.core.keys import toml_name
from mpslab.core.parameters import LISTS, TABLES

# Keys that name an input file, (table, key), and the name of its copy in a run folder; of tables
# that there may be several of, with the number of the table and the suffix of the file.
FILES = {
    (table, toml_name(item)): item.metadata["copy"]
    for table, kind in {**TABLES, **LISTS}.items()
    for item in fields(kind)
    if "copy" in item.metadata
}
DIGITS = 12  # of a checksum, in messages


@dataclass(frozen=True)
class Input:
    """An input file.

    Attributes
    ----------
    key : str
        The key of the case that names it, such as "wavemaker.file".
    copy : str
        Name of its copy in a run folder.
    origin : str
        Where it was found.
    sha256 : str
        Checksum of its content.
    content : bytes or None
        None where only the record of a run is known.
    """

    key: str
    copy: str
    origin: str
    sha256: str
    content: bytes | None = field(default=None, repr=False, compare=False)


def of(case):
    """The input files of a case that are there, a tuple of `Input`."""
    found = []
    for key, path, copy in _named(case):
        if is_file(path):
            content = Path(path).read_bytes()
            found.append(Input(key, copy, path, _checksum(content), content))
    return tuple(found)


def _named(case):
    """Key, path and name of the copy of all input files that the keys of a case may name."""
    for (table, name), copy in FILES.items():
        found = getattr(case, table)
        if table in TABLES:
            yield f"{table}.{name}", getattr(found, name), copy
            continue
        for i, one in enumerate(found):
            path = getattr(one, name)
            own = copy.format(number=i + 1, suffix=Path(path).suffix.lower())
            yield f"{table}.{i}.{name}", path, own


def keep(inputs, folder):
    """Write the copies into a run folder."""
    for item in inputs:
        with replacing(Path(folder) / item.copy) as draft:
            draft.write_bytes(item.content)


def pointed(case, inputs, folder=None):
    """The case with the paths of its input files in a run folder; without a folder, with the names
    of the copies alone.
    """
    for item in inputs:
        table, *number, name = item.key.split(".")
        path = str(Path(folder).absolute() / item.copy) if folder else item.copy
        found = getattr(case, table)
        if number:
            i = int(number[0])
            found = (*found[:i], replace(found[i], **{name: path}), *found[i + 1 :])
        else:
            found = replace(found, **{name: path})
        case = replace(case, **{table: found})
    return case


def record(inputs):
    """What a run writes down of its input files, a list of dict."""
    entries = [asdict(item) for item in inputs]
    return [{key: entry[key] for key in entry if key != "content"} for entry in entries]


def to_text(inputs):
    """The record as one text, for a checkpoint."""
    return json.dumps(record(inputs))


def from_text(text):
    """`Input`s without their content, from what `to_text` wrote."""
    return tuple(Input(**entry) for entry in json.loads(text))


def check(inputs, folder):
    """Raise ValueError unless the copies in a run folder are those that the run began with."""
    for item in inputs:
        path = Path(folder) / item.copy
        what = f"--resume {folder}: {item.copy}, the copy of {item.key} = {item.origin!r},"
        rule = f"must be the file that the run began with (sha256 {item.sha256[:DIGITS]}...)"
        if not path.is_file():
            raise ValueError(f"{what} is missing: {rule}")
        now = _checksum(path.read_bytes())
        if now != item.sha256:
            raise ValueError(f"{what} has changed (sha256 {now[:DIGITS]}...): {rule}")


def _checksum(content):
    return hashlib.sha256(content).hexdigest()
