"""Particles against time for ParaView: VTKHDF, PolyData of vertices, with time steps.

The format (VTKHDF 2.0, https://docs.vtk.org) lays the frames of a series end to end in one dataset
for each array, and tells in ``Steps`` at which entry the arrays of a frame begin.
"""

from pathlib import Path

import h5py
import numpy as np

from mpslab.output.journal import changing, reading, recover

# The four families of cells of a PolyData, in the order of the columns of Steps/CellOffsets.
FAMILIES = ("Vertices", "Lines", "Polygons", "Strips")
CHUNK_BYTES, SMALL_CHUNK_BYTES = 1 << 16, 1 << 10


class ParticleSeries:
    """A time series of particles in a VTKHDF file, opened and closed at each frame.

    Between two calls of `append` the file is whole: it can be looked at while the run goes on. A
    kill, or a full disk, in the middle of one leaves all frames written so far to the readers here,
    and to the next call (`mpslab.output.journal`).

    Parameters
    ----------
    path : str or Path
        The file; an existing one is appended to (see `truncate`).
    fields : iterable of str
        Names of the arrays of the ParticleSet to write beside the positions. ``kind`` and ``body``
        are always written: nothing else tells water from wall, and one solid from another.
    """

    def __init__(self, path, fields):
        self.path = Path(path)
        self.fields = tuple(dict.fromkeys(("kind", "body", *fields)))

    def append(self, time, particles, kind=None):
        """Add a frame; floating-point arrays are written in single precision.

        Parameters
        ----------
        time : float
            Time of the frame [s], above that of the last one.
        particles : ParticleSet
            The particles, which may be fewer or more than in the last frame.
        kind : (n,) int8, optional
            Their kinds (`mpslab.core.kinds`); left out, those of water and tank alone.
        """
        arrays = {"kind": particles.role if kind is None else kind}
        arrays |= {name: getattr(particles, name) for name in self.fields if name != "kind"}
        with changing(self.path) as held, h5py.File(held, "r+" if held.size else "w") as file:
            root = _root(file)
            _append_step(root, time, [*self.fields])
            _append_points(root, particles.position, arrays)
            # The count comes last: it is what makes the frame part of the series.
            root["Steps"].attrs["NSteps"] += 1


def _root(file):
    """The group that holds everything, made if the file is new."""
    if "VTKHDF" not in file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 0], np.int64)
        root.attrs.create("Type", b"PolyData", dtype=h5py.string_dtype("ascii", 8))
        root.create_group("PointData")
        root.create_group("Steps").attrs["NSteps"] = 0
    return file["VTKHDF"]


def _append_step(root, time, fields):
    """Where the arrays of a new frame begin: at the present ends of the datasets."""
    steps = root["Steps"]
    frame = steps.attrs["NSteps"]
    begin = len(root["Points"]) if "Points" in root else 0
    only_vertices = np.array([[begin, 0, 0, 0]])
    _extend(steps, "Values", np.array([time], float))
    _extend(steps, "PartOffsets", np.array([frame]))
    _extend(steps, "NumberOfParts", np.array([1]))
    _extend(steps, "PointOffsets", np.array([begin]))
    _extend(steps, "CellOffsets", only_vertices)
    _extend(steps, "ConnectivityIdOffsets", only_vertices)
    for name in fields:
        _extend(steps, f"PointDataOffsets/{name}", np.array([begin]))


def _append_points(root, position, arrays):
    """The arrays of a new frame: one point and one vertex for each particle."""
    n = len(position)
    _extend(root, "NumberOfPoints", np.array([n]))
    _extend(root, "Points", position.astype(np.float32))
    for name, array in arrays.items():
        _extend(root, f"PointData/{name}", _narrow(array))
    for family, count in zip(FAMILIES, (n, 0, 0, 0), strict=True):
        _extend(root, f"{family}/NumberOfCells", np.array([count]))
        _extend(root, f"{family}/NumberOfConnectivityIds", np.array([count]))
        _extend(root, f"{family}/Offsets", np.arange(count + 1))
        _extend(root, f"{family}/Connectivity", np.arange(count))


def _narrow(array):
    """Single precision is enough to look at, and half the size."""
    return array.astype(np.float32) if array.dtype == np.float64 else array


def _extend(group, name, rows):
    """Add rows at the end of a dataset, which is made if it is not there.

    By the calls of the HDF5 library itself: a frame is thirty small writes, for which the indexing
    of h5py takes several times as long.
    """
    path = name.encode()
    if path not in group.id:
        _create(group, name, rows)
    if not len(rows):
        return
    dataset = h5py.h5d.open(group.id, path)
    begin = dataset.shape[0]
    dataset.set_extent((begin + len(rows), *rows.shape[1:]))
    added = dataset.get_space()
    added.select_hyperslab((begin, *[0] * (rows.ndim - 1)), rows.shape)
    dataset.write(h5py.h5s.create_simple(rows.shape), added, np.ascontiguousarray(rows))


def _create(group, name, rows):
    """An empty dataset for rows like these.

    A frame adds either many rows or one.  A chunk is packed anew whenever rows come into it: those
    of single rows are small and not packed.
    """
    single = len(rows) <= 1
    row_bytes = rows.dtype.itemsize * int(np.prod(rows.shape[1:]))
    group.create_dataset(
        name,
        shape=(0, *rows.shape[1:]),
        maxshape=(None, *rows.shape[1:]),
        dtype=rows.dtype,
        chunks=((SMALL_CHUNK_BYTES if single else CHUNK_BYTES) // row_bytes, *rows.shape[1:]),
        compression=None if single else "gzip",
        compression_opts=None if single else 1,
        shuffle=not single,
    )


def truncate(path, time):
    """Drop the frames after a time, and what a kill may have left of an unfinished frame.

    Parameters
    ----------
    path : str or Path
        A file of `ParticleSeries`; nothing happens if there is none.
    time : float
        Time of the last frame to keep [s].

    Raises
    ------
    ValueError
        If the file cannot be read.
    """
    recover(path)
    if not Path(path).exists():
        return
    with changing(path) as held, _opened(path, held, "r+") as file:
        root = file["VTKHDF"]
        frames = int(np.searchsorted(_times(root), time, side="right"))
        root["Steps"].attrs["NSteps"] = frames
        root.visititems(_cutter(frames, int(root["NumberOfPoints"][:frames].sum())))


def _cutter(frames, points):
    """Function that cuts a dataset of the series, given its name, to a number of frames."""

    def cut(name, item):
        if not isinstance(item, h5py.Dataset):
            return
        is_count = name.startswith("Steps/") or "NumberOf" in name
        per_point = 0 if is_count or name.startswith(FAMILIES[1:]) else points
        per_frame = frames if is_count or name.endswith("/Offsets") else 0
        item.resize(per_point + per_frame, axis=0)

    return cut


def read_times(path):
    """Times of the frames.

    Parameters
    ----------
    path : str or Path
        A file of `ParticleSeries`.

    Returns
    -------
    (n_frames,) float64 [s]

    Raises
    ------
    ValueError
        If the file cannot be read.
    """
    return _read(path, _times)


def _times(root):
    return root["Steps/Values"][: root["Steps"].attrs["NSteps"]]


def read_frame(path, index):
    """One frame.

    Parameters
    ----------
    path : str or Path
        A file of `ParticleSeries`.
    index : int
        Number of the frame, from 0.

    Returns
    -------
    dict of str to ndarray
        ``position`` (n, 3) float32 [m] and the fields of the series.

    Raises
    ------
    ValueError
        If the file cannot be read.
    """

    def frame(root):
        begin = int(root["Steps/PointOffsets"][index])
        rows = slice(begin, begin + int(root["NumberOfPoints"][index]))
        fields = {name: dataset[rows] for name, dataset in root["PointData"].items()}
        return {"position": root["Points"][rows], **fields}

    return _read(path, frame)


def read_frames(path):
    """Go through the frames of a series, one in memory at a time.

    Parameters
    ----------
    path : str or Path
        A file of `ParticleSeries`.

    Yields
    ------
    time : float [s]
    frame : dict of str to ndarray
        As `read_frame` returns it.
    """
    for index, time in enumerate(read_times(path)):
        yield float(time), read_frame(path, index)


def _read(path, find):
    """What a function finds in the group that holds everything, while the run may go on."""

    def read(held):
        with _opened(path, held, "r") as file:
            return find(file["VTKHDF"])

    try:
        return reading(path, read)
    except (OSError, KeyError, RuntimeError) as error:  # what h5py says of a damaged file
        raise _unreadable(path, error) from error


def _opened(path, held, mode):
    """What is held of the file, as HDF5, or a ValueError of one line."""
    try:
        file = h5py.File(held, mode)
    except OSError as error:
        raise _unreadable(path, error) from error
    if "VTKHDF/Steps/Values" not in file:
        file.close()
        raise ValueError(f"particles '{path}': not a VTKHDF time series")
    return file


def _unreadable(path, error):
    reason = " ".join(str(error).split())
    return ValueError(f"particles '{path}': cannot be read as HDF5 ({reason})")
