"""The particle series: what is written comes back, in h5py and in VTK."""

import fcntl
import re
from pathlib import Path

import h5py
import numpy as np
import pytest
from tanks import make_case

from mpslab.core.particles import make_particles
from mpslab.output import vtkhdf
from mpslab.simulation import Simulation

FIELDS = ("velocity", "pressure", "surface")


def cloud(n, seed):
    """Random particles whose arrays can be told apart."""
    rng = np.random.default_rng(seed)
    particles = make_particles(rng.random((n, 3)), rng.integers(0, 5, n))
    particles.velocity[:] = rng.random((n, 3))
    particles.pressure[:] = 1000 * rng.random(n)
    particles.surface[:] = rng.integers(0, 2, n)
    return particles


@pytest.fixture
def frames():
    """Three frames; the number of particles changes, as it does when some are lost."""
    return [(0.0, cloud(50, 1)), (0.1, cloud(48, 2)), (0.25, cloud(60, 3))]


@pytest.fixture
def path(tmp_path, frames):
    path = tmp_path / "particles.vtkhdf"
    series = vtkhdf.ParticleSeries(path, FIELDS)
    for time, particles in frames:
        series.append(time, particles)
    return path


def assert_same_frames(path, frames):
    found = list(vtkhdf.read_frames(path))
    assert [time for time, _ in found] == [time for time, _ in frames]
    for (_, frame), (_, particles) in zip(found, frames, strict=True):
        assert set(frame) == {"position", "kind", "body", *FIELDS}
        for name, array in frame.items():
            written = getattr(particles, "role" if name == "kind" else name)
            np.testing.assert_array_equal(array, written.astype(array.dtype))


def test_frames_come_back(path, frames):
    assert_same_frames(path, frames)


def test_a_reader_does_not_stop_the_writer(path, frames):
    """HDF5 locks a file that it reads; a run must not fail for someone's looking at it."""
    with path.open("rb") as reader:
        fcntl.flock(reader, fcntl.LOCK_SH)
        vtkhdf.ParticleSeries(path, FIELDS).append(0.3, frames[0][1])
    assert vtkhdf.read_times(path).tolist() == [0.0, 0.1, 0.25, 0.3]


def test_a_writer_does_not_stop_a_reader(path, frames):
    with path.open("rb") as writer:
        fcntl.flock(writer, fcntl.LOCK_EX)
        assert_same_frames(path, frames)


def test_kind_is_written_though_not_asked_for(tmp_path):
    series = vtkhdf.ParticleSeries(tmp_path / "p.vtkhdf", [])
    series.append(0.0, cloud(5, 1))
    assert set(vtkhdf.read_frame(series.path, 0)) == {"position", "kind", "body"}


def test_layout_is_that_of_vtkhdf_2(path):
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0]
        assert root.attrs["Type"] == b"PolyData"
        assert root["Steps"].attrs["NSteps"] == 3
        assert list(root["Steps/PointOffsets"]) == [0, 50, 98]
        assert list(root["Steps/PointDataOffsets/velocity"]) == [0, 50, 98]
        assert list(root["Steps/PartOffsets"]) == [0, 1, 2]
        assert root["Steps/CellOffsets"].shape == (3, 4)
        assert len(root["Vertices/Offsets"]) == 158 + 3
        assert len(root["Lines/Offsets"]) == 3
        assert root["PointData/pressure"].dtype == np.float32


def test_series_goes_on_where_it_was_truncated(path, frames):
    vtkhdf.truncate(path, 0.1)
    assert_same_frames(path, frames[:2])
    vtkhdf.ParticleSeries(path, FIELDS).append(*frames[2])
    assert_same_frames(path, frames)


def test_truncation_clears_an_unfinished_frame(path, frames):
    with h5py.File(path, "r+") as file:
        file["VTKHDF/Steps"].attrs["NSteps"] = 2
    vtkhdf.truncate(path, 9.0)
    vtkhdf.ParticleSeries(path, FIELDS).append(*frames[2])
    assert_same_frames(path, frames)


def test_truncation_to_nothing_leaves_a_series_to_append_to(path, frames):
    vtkhdf.truncate(path, -1.0)
    assert len(vtkhdf.read_times(path)) == 0
    vtkhdf.ParticleSeries(path, FIELDS).append(*frames[0])
    assert_same_frames(path, frames[:1])


def test_truncation_of_no_file_is_no_error(tmp_path):
    vtkhdf.truncate(tmp_path / "none.vtkhdf", 1.0)


@pytest.mark.parametrize("content", [None, b"no HDF5"])
def test_unreadable_file_is_named(tmp_path, content):
    path = tmp_path / "p.vtkhdf"
    if content:
        path.write_bytes(content)
    with pytest.raises(ValueError, match=r"p\.vtkhdf") as caught:
        vtkhdf.read_times(path)
    assert "\n" not in str(caught.value)


def test_other_hdf5_file_is_refused(tmp_path):
    path = tmp_path / "p.vtkhdf"
    h5py.File(path, "w").close()
    with pytest.raises(ValueError, match="not a VTKHDF time series"):
        vtkhdf.truncate(path, 0.0)


@pytest.mark.parametrize("cut", [False, True])
def test_vtk_reads_the_series(path, frames, cut):
    pyvista = pytest.importorskip("pyvista")
    if cut:
        vtkhdf.truncate(path, 0.1)
        vtkhdf.ParticleSeries(path, FIELDS).append(*frames[2])
    reader = pyvista.get_reader(path)
    reader.reader.UpdateInformation()
    assert reader.reader.GetNumberOfSteps() == len(frames)
    for step, (time, particles) in enumerate(frames):
        reader.reader.SetStep(step)
        mesh = reader.read()
        assert reader.reader.GetTimeValue() == time
        assert mesh.n_verts == len(particles)
        np.testing.assert_array_equal(mesh.verts[1::2], np.arange(len(particles)))
        np.testing.assert_array_equal(mesh.points, particles.position.astype(np.float32))
        np.testing.assert_array_equal(mesh["velocity"], particles.velocity.astype(np.float32))
        np.testing.assert_array_equal(mesh["kind"], particles.role)


def test_pyvista_reads_a_frame_of_a_run_as_the_documentation_says(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    text = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    (script,) = re.findall(r"```python\n(import pyvista\n.*?)```", text, re.DOTALL)
    case = make_case({"time.end": 0.01, "output.interval": 0.002})
    Simulation(case, tmp_path / "results").run()
    found = {}
    exec(script.replace('"results', f'"{tmp_path}/results'), found)
    path = tmp_path / "results/particles.vtkhdf"
    times = vtkhdf.read_times(path)
    assert len(times) == 6
    assert found["frames"].times.tolist() == times.tolist()
    last = vtkhdf.read_frame(path, 5)
    assert isinstance(found["mesh"], pyvista.PolyData)
    np.testing.assert_array_equal(found["mesh"].points, last["position"])
    np.testing.assert_array_equal(found["mesh"]["velocity"], last["velocity"])
    np.testing.assert_array_equal(found["frame"].velocity, last["velocity"])
    for step in range(len(times)):
        found["reader"].reader.SetStep(step)
        frame = vtkhdf.read_frame(path, step)
        np.testing.assert_array_equal(found["reader"].read().points, frame["position"])


def test_the_file_tells_vtk_all_of_its_times(path, frames):
    """Where VTK's pipeline, and with it ParaView, looks for them."""
    pyvista = pytest.importorskip("pyvista")
    model = pytest.importorskip("vtkmodules.vtkCommonExecutionModel")
    reader = pyvista.get_reader(path).reader
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    key = model.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    assert [information.Get(key, k) for k in range(information.Length(key))] == [
        time for time, _ in frames
    ]
