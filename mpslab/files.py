"""Files that are either whole or not there."""

import os
from contextlib import contextmanager
from pathlib import Path


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
        Where the block is to write.
    """
    path = Path(path)
    draft = path.with_name(path.name + ".tmp")
    try:
        yield draft
        _synchronise(draft)
        os.replace(draft, path)
        _synchronise(path.parent)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


def _synchronise(path):
    """Wait until the disk holds a file, or a folder's list of names."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
