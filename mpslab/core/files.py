"""Files that are either whole or not there."""

import errno
import os
import re
import secrets
import shutil
from contextlib import contextmanager
from pathlib import Path

FULL = {errno.ENOSPC: "the disk is full", errno.EDQUOT: "the disk quota is used up"}
DRAFT = re.compile(r".+\.[0-9a-f]{8}\.tmp")


class DiskFull(OSError):
    """There is no room for a file; ``strerror`` says for which, how much it needs and what is free.

    Writing goes on where it was once there is room.
    """


@contextmanager
def replacing(path):
    """Temporary path that takes the place of a file once the block has ended well.

    The block writes the temporary file, which lies in the same folder, so that the last act is a
    rename on one file system: whoever opens ``path``, at any instant and after a kill at any
    instant, finds either the earlier file or the whole new one.

    Parameters
    ----------
    path : str or Path
        The file to replace.

    Yields
    ------
    Path
        Where the block is to write; no other process writes there.
    """
    path = Path(path)
    draft = path.with_name(f"{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        yield draft
        synchronise(draft)
        os.replace(draft, path)
        synchronise(path.parent)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


def is_file(path):
    """Whether a path, which may be empty or too long for any file, is one of a file."""
    try:
        return bool(path) and Path(path).is_file()
    except (OSError, ValueError):
        return False


def stamp(path):
    """What tells one content of a file from another: its time and size, None if there is no file.

    Who keeps what a file held keeps it by path and stamp.
    """
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size


def remove_drafts(folder):
    """Remove what kills have left of `replacing` in a folder that nobody writes to."""
    for path in Path(folder).iterdir():
        if DRAFT.fullmatch(path.name):
            path.unlink(missing_ok=True)


@contextmanager
def needing(path, size):
    """Raise `DiskFull` in place of the bare error where a block finds no room for so many bytes."""
    try:
        yield
    except OSError as error:
        if error.errno not in FULL or isinstance(error, DiskFull):
            raise
        free = shutil.disk_usage(Path(path).parent).free
        raise DiskFull(
            error.errno,
            f"{FULL[error.errno]}: {Path(path).name} needs {in_words(size)} more, "
            f"{in_words(free)} are free",
        ) from error


def in_words(size):
    """A number of bytes, as "1.5 MB"."""
    for unit in ("bytes", "kB", "MB"):
        if size < 1000:
            return f"{size:.3g} {unit}"
        size /= 1000
    return f"{size:.3g} GB"


def write_at(descriptor, offset, content):
    """Write all of the content at a place of an open file, in as many pieces as it takes."""
    rest = memoryview(content)
    while rest:
        done = os.pwrite(descriptor, rest, offset)
        rest, offset = rest[done:], offset + done


def synchronise(path):
    """Wait until the disk holds a file, or a folder's list of names."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
