"""A folder that one process at a time may write to."""

import fcntl
import os
import socket
import warnings
import weakref
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

NAME = "run.lock"
BUSY = (BlockingIOError, PermissionError)  # what flock says where the lock is held, by system


class InUse(ValueError):
    """Another run holds the folder; the message says which process, where and since when."""


class FolderLock:
    """Holds a folder from now on, until it is released or forgotten, or the process ends.

    The lock is that of the operating system on a file in the folder: a kill ends it as well. The
    file says who holds it, and goes when it is released.

    Parameters
    ----------
    folder : str or Path
        An existing folder that can be written.

    Raises
    ------
    InUse
        If it is held, by this process or another.
    OSError
        If nothing can be written there.
    """

    def __init__(self, folder):
        path = Path(folder).absolute() / NAME
        descriptor = _lock(path)
        self._end = weakref.finalize(self, _release, descriptor, path, os.getpid())
        _sign(descriptor)

    def release(self):
        """Let others have the folder."""
        self._end()


def _lock(path):
    """Descriptor of the locked file."""
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BUSY:
            with open(descriptor, encoding="utf-8", errors="replace") as file:
                raise InUse(f"in use by {file.read() or 'another process'}") from None
        except OSError as error:
            warnings.warn(f"'{path.parent}': not held against other runs, for its file system "
                          f"has no locks ({error.strerror})", stacklevel=3)  # fmt: skip
            return descriptor
        if _is_there(path, descriptor):
            return descriptor
        os.close(descriptor)  # its holder has removed it in between


def _is_there(path, descriptor):
    try:
        return os.path.samestat(os.stat(path), os.fstat(descriptor))
    except FileNotFoundError:
        return False


def _sign(descriptor):
    """Write down who holds the lock; on a disk that is full it is held all the same."""
    since = datetime.now(UTC).isoformat(timespec="seconds")
    who = f"process {os.getpid()} on {socket.gethostname()} since {since}"
    with suppress(OSError):
        os.ftruncate(descriptor, 0)
        os.pwrite(descriptor, who.encode(), 0)


def _release(descriptor, path, owner):
    """Remove the file while it is locked, so that nobody else's is removed."""
    with suppress(OSError):
        # A fork shares the lock, and must not end it.
        if os.getpid() == owner and _is_there(path, descriptor):
            path.unlink()
    os.close(descriptor)
