"""Changes to a large file that come about all together, or not at all.

A file that grows in place, as a series of frames does, is not whole while it is written to: a kill
or a full disk in the middle of the writes would leave it damaged.  Here the writes are held back;
at the end they go into a journal beside the file, which is renamed when it is whole, and only then
into the file.  What a kill left undone is done from the journal when the file is next opened for
writing; a process that only reads the file lays the journal over it.
"""

import errno
import io
import os
import struct
import time
import zlib
from contextlib import contextmanager
from pathlib import Path

from mpslab.core.files import needing, replacing, synchronise, write_at

MAGIC = b"mpslab journal 1"
HEAD = struct.Struct("<16sqq")  # magic, size of the file as it will be, number of pieces
ENTRY = struct.Struct("<qq")  # offset and length of a piece, before its bytes
CHECK = struct.Struct("<I")  # of all that goes before, at the end
PATIENCE, PAUSE = 10.0, 2e-3  # s: how long a reader waits for a quiet moment, and between looks


@contextmanager
def changing(path):
    """A binary file to read and write, for ``h5py.File``; its changes are made when the block ends.

    Parameters
    ----------
    path : str or Path
        The file; it need not be there.

    Raises
    ------
    OSError
        If it cannot be written, on a full disk for example: `recover` goes on with it.
    ValueError
        If there is a journal that is damaged.
    """
    recover(path)
    with HeldBack(path) as held:
        yield held
    _write_journal(path, held)
    recover(path)


def recover(path):
    """Make the changes of a journal, if there is one; ValueError if it is damaged.

    It is there until the file is whole on the disk.
    """
    journal = journal_of(path)
    if not journal.exists():
        return
    size, pieces = _read_journal(journal)
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        with needing(path, max(size - os.fstat(descriptor).st_size, 0)):
            for offset, piece in pieces:
                write_at(descriptor, offset, piece)
            os.ftruncate(descriptor, size)
            os.fsync(descriptor)
    finally:
        os.close(descriptor)
    journal.unlink()
    synchronise(journal.parent)


def reading(path, read):
    """What a function finds in a file as it is between two changes, whoever writes it meanwhile.

    Nothing is written: the changes of a journal are seen as if they had been made.

    Parameters
    ----------
    path : str or Path
    read : callable
        Called with a binary file; once more where the file changed while it read.

    Raises
    ------
    OSError
        If there is no such file, or it is written to all the time.
    ValueError
        If there is a journal that is damaged.
    """
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        before = _marks(path)
        if before == [None, None]:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
        try:
            with HeldBack(path, *_read_journal(journal_of(path), missing_ok=True)) as file:
                found = read(file)
        except Exception:
            if _marks(path) == before:
                raise
        else:
            if _marks(path) == before:
                return found
        time.sleep(PAUSE)
    raise OSError(f"'{path}' is written to all the time")


def journal_of(path):
    """The journal of a file."""
    path = Path(path)
    return path.with_name(path.name + ".journal")


def _marks(path):
    """What changes when the file or its journal does."""
    found = []
    for each in (journal_of(path), Path(path)):
        try:
            status = os.stat(each)
            found.append((status.st_ino, status.st_size, status.st_mtime_ns))
        except FileNotFoundError:
            found.append(None)
    return found


def _write_journal(path, held):
    """The pieces held back, each with its place, in a file that is whole or not there."""
    parts = [HEAD.pack(MAGIC, held.size, len(held.pieces))]
    for offset, piece in held.pieces:
        parts += [ENTRY.pack(offset, len(piece)), piece]
    check = 0
    for part in parts:
        check = zlib.crc32(part, check)
    parts.append(CHECK.pack(check))
    needed = 2 * sum(map(len, parts))  # in the journal, and in the file
    with needing(path, needed), replacing(journal_of(path)) as draft:
        descriptor, place = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), 0
        try:
            for part in parts:
                write_at(descriptor, place, part)
                place += len(part)
        finally:
            os.close(descriptor)


def _read_journal(journal, missing_ok=False):
    """Size of the file as it will be, and the pieces; (None, []) where there may be no journal."""
    try:
        content = journal.read_bytes()
    except FileNotFoundError:
        if missing_ok:
            return None, []
        raise
    body, check = content[: -CHECK.size], content[-CHECK.size :]
    if not body.startswith(MAGIC) or CHECK.pack(zlib.crc32(body)) != check:
        raise ValueError(f"'{journal}': damaged, or not a journal of mpslab")
    _, size, count = HEAD.unpack_from(body)
    pieces, place = [], HEAD.size
    for _ in range(count):
        offset, length = ENTRY.unpack_from(body, place)
        place += ENTRY.size + length
        pieces.append((offset, body[place - length : place]))
    return size, pieces


class HeldBack(io.RawIOBase):
    """A file as it will be: what is on the disk, and the pieces written over it, in memory.

    Parameters
    ----------
    path : str or Path
        The file on the disk; it need not be there.
    size, pieces : optional
        Of a journal that is laid over it.

    Attributes
    ----------
    size : int
        Bytes of the file as it will be.
    pieces : list of (int, bytes)
        Offset and content of each write, in their order.
    """

    def __init__(self, path, size=None, pieces=()):
        path = Path(path)
        self._file = path.open("rb") if path.exists() else io.BytesIO()
        self.size = self._file.seek(0, os.SEEK_END) if size is None else size
        self.pieces = list(pieces)
        self._place = 0

    def readable(self):
        """It can be read."""
        return True

    def writable(self):
        """It can be written."""
        return True

    def seekable(self):
        """It can be read and written at any place."""
        return True

    def seek(self, offset, whence=os.SEEK_SET):
        """Go to a place; returns it."""
        base = {os.SEEK_SET: 0, os.SEEK_CUR: self._place, os.SEEK_END: self.size}[whence]
        self._place = base + offset
        return self._place

    def readinto(self, buffer):
        """Fill a buffer from the present place on; returns the number of bytes."""
        view = memoryview(buffer).cast("B")
        begin, end = self._place, min(self._place + len(view), self.size)
        if end <= begin:
            return 0
        self._file.seek(begin)
        known = self._file.readinto(view[: end - begin])
        view[known : end - begin] = bytes(end - begin - known)
        for offset, piece in self.pieces:
            low, high = max(offset, begin), min(offset + len(piece), end)
            if low < high:
                view[low - begin : high - begin] = piece[low - offset : high - offset]
        self._place = end
        return end - begin

    def write(self, content):
        """Write at the present place; returns the number of bytes."""
        piece = bytes(content)
        self.pieces.append((self._place, piece))
        self._place += len(piece)
        self.size = max(self.size, self._place)
        return len(piece)

    def truncate(self, size=None):
        """Cut the file, or make it longer; returns its size."""
        self.size = self._place if size is None else size
        return self.size

    def close(self):
        """Close the file on the disk."""
        self._file.close()
        super().close()
