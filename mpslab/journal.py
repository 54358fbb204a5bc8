"""Changes to a large file that come about all together, or not at all.

A file that grows in place, as a series of frames does, is not whole while it is written to: a kill
or a full disk amid the writes would leave it damaged.  Here the writes are held back; at the end
they go into a journal beside the file, which is renamed when it is whole, and only then into the
file.  What a kill left undone is done from the journal when the file is opened the next time.
"""

import io
import os
import struct
from contextlib import contextmanager
from pathlib import Path

ENTRY = struct.Struct("<qq")  # offset and length of a piece, before its bytes; first, the file's


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
    """
    recover(path)
    held = HeldBack(path)
    with held:
        yield held
    _write_journal(path, held)
    recover(path)


def recover(path):
    """Make the changes of a journal that is whole, if there is one."""
    journal = _journal(path)
    if not journal.exists():
        return
    size, pieces = _read_journal(journal)
    with open(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "wb", buffering=0) as file:
        for offset, piece in pieces:
            file.seek(offset)
            file.write(piece)
        file.truncate(size)
    journal.unlink()


def _journal(path):
    path = Path(path)
    return path.with_name(path.name + ".journal")


def _write_journal(path, held):
    """The pieces held back, each with its place, in a file that is whole or not there."""
    journal = _journal(path)
    draft = journal.with_name(journal.name + ".tmp")
    try:
        with draft.open("wb") as file:
            file.write(ENTRY.pack(held.size, len(held.pieces)))
            for offset, piece in held.pieces:
                file.write(ENTRY.pack(offset, len(piece)))
                file.write(piece)
        os.replace(draft, journal)
    except OSError:
        draft.unlink(missing_ok=True)
        raise


def _read_journal(journal):
    with journal.open("rb") as file:
        size, count = ENTRY.unpack(file.read(ENTRY.size))
        pieces = []
        for _ in range(count):
            offset, length = ENTRY.unpack(file.read(ENTRY.size))
            pieces.append((offset, file.read(length)))
    return size, pieces


class HeldBack(io.RawIOBase):
    """A file as it will be: what is on the disk, and the pieces written over it, in memory.

    Attributes
    ----------
    size : int
        Bytes of the file as it will be.
    pieces : list of (int, bytes)
        Offset and content of each write, in their order.
    """

    def __init__(self, path):
        path = Path(path)
        self._file = path.open("rb") if path.exists() else io.BytesIO()
        self.size, self.pieces = self._file.seek(0, os.SEEK_END), []
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
