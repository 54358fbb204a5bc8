"""Checkpoints: everything that a restart needs, to the byte."""

import io
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from mpslab.core.files import needing, replacing

FORMAT = "mpslab checkpoint"
VERSION = 3
FIELDS = ("gid", "role", "body", "position", "velocity", "pressure", "number_density", "surface")


def write(path, particles, state):
    """Write a checkpoint that takes the place of the earlier one only when it is whole.

    Parameters
    ----------
    path : str or Path
        The checkpoint file.
    particles : ParticleSet
        Its arrays become datasets of the same names, in the order of gid.
    state : dict
        What else a restart needs: names to numbers, strings or arrays.

    Raises
    ------
    TypeError
        If HDF5 cannot hold a value of ``state``.
    DiskFull
        If there is no room for it; the earlier one stays.
    """
    import h5py

    order = np.argsort(particles.gid, kind="stable")
    # In memory first: HDF5 does not survive a disk that is full.
    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        file.attrs["format"] = FORMAT
        file.attrs["version"] = VERSION
        for name in FIELDS:
            file[name] = getattr(particles, name)[order]
        group = file.create_group("state")
        for key, value in state.items():
            _store(group, key, value)
    with needing(path, len(content.getbuffer())), replacing(path) as draft:
        draft.write_bytes(content.getbuffer())


def _store(group, key, value):
    """One value of the state; strings too are datasets, as attributes end at 64 kB."""
    try:
        group[key] = value
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(
            f"checkpoint state {key} = {value!r}: allowed are numbers, strings and arrays"
        ) from error


def read(path):
    """Read a checkpoint back.

    Parameters
    ----------
    path : str or Path
        The checkpoint file.

    Returns
    -------
    arrays : dict of str to ndarray
        The arrays of the ParticleSet: ``ParticleSet(**arrays)`` makes one.
    state : dict of str to int, float, bool, str or ndarray
        As it was given to `write`.

    Raises
    ------
    ValueError
        If the file is missing, damaged, not a checkpoint, or of another version.
    """
    with _opened(path) as file:
        return {name: file[name][:] for name in FIELDS}, _state(file)


def read_state(path):
    """The state alone, without the particles; raises as `read` does."""
    with _opened(path) as file:
        return _state(file)


@contextmanager
def _opened(path):
    """The file of a checkpoint; what is wrong with it is a ValueError of one line."""
    import h5py

    path = Path(path)
    if not path.is_file():
        raise ValueError(f"checkpoint '{path}': there is no such file")
    try:
        with h5py.File(path, "r") as file:
            _check_version(path, file.attrs)
            yield file
    except (OSError, KeyError, RuntimeError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"checkpoint '{path}': damaged, or not a checkpoint ({reason})") from error


def _state(file):
    return {key: _value(dataset) for key, dataset in file["state"].items()}


def _check_version(path, attributes):
    """Raise unless the file says that it is a checkpoint of the version read here."""
    if attributes.get("format") != FORMAT:
        raise ValueError(f"checkpoint '{path}': not a checkpoint of mpslab")
    if attributes["version"] != VERSION:
        raise ValueError(
            f"checkpoint '{path}': version {attributes['version']}, but this mpslab reads {VERSION}"
        )


def _value(dataset):
    """A number or a string as Python's own type, an array as an array."""
    value = dataset[()]
    if isinstance(value, bytes):
        return value.decode()
    return value.item() if isinstance(value, np.generic) else value
