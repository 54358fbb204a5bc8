"""A disk that is full: all earlier frames can be read, and the run goes on when there is room."""

import errno
import json
import os
import shutil
import subprocess

import numpy as np
import pytest
from tanks import make_case

from mpslab import tank
from mpslab.cases import dumps
from mpslab.core import files
from mpslab.core.files import DiskFull
from mpslab.core.particles import make_particles
from mpslab.output import checkpoint, journal, vtkhdf
from mpslab.simulation import Simulation

FRAMED = {"output.interval": 0.002, "output.checkpoint": 0.004, "time.end": 0.02,
          "output.fields": ["velocity", "pressure"]}  # fmt: skip
SIZES = 20


class Disk:
    """A disk with room for so many bytes more: the write that meets its end comes short."""

    def __init__(self, monkeypatch):
        self.room, self.written = float("inf"), 0
        self._write = os.pwrite
        monkeypatch.setattr(files.os, "pwrite", self.write)

    def write(self, descriptor, content, offset):
        if self.room <= 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        done = self._write(descriptor, content[: min(len(content), self.room)], offset)
        self.room, self.written = self.room - done, self.written + done
        return done


def cloud(seed):
    particles = make_particles(np.random.default_rng(seed).random((300, 3)), np.zeros(300))
    particles.velocity[:] = seed
    return particles


def assert_frames(path, times):
    found = list(vtkhdf.read_frames(path))
    assert [time for time, _ in found] == times
    for time, frame in found:
        expected = cloud(round(10 * time))
        np.testing.assert_array_equal(frame["position"], expected.position.astype("f4"))
        np.testing.assert_array_equal(frame["velocity"], expected.velocity.astype("f4"))


def test_a_write_that_comes_short_at_any_byte_leaves_the_file_before_or_after(
    tmp_path, monkeypatch
):
    path, disk = tmp_path / "file", Disk(monkeypatch)

    def change():
        with journal.changing(path) as held:
            held.seek(3)
            held.write(b"abcdefgh")
            held.seek(0)
            held.write(b"xy")

    path.write_bytes(b"0123456789")
    change()
    states = {b"0123456789", b"xy2abcdefgh"}
    assert path.read_bytes() in states
    seen = set()
    for room in range(disk.written):
        path.write_bytes(b"0123456789")
        disk.room = room
        with pytest.raises(DiskFull, match="the disk is full: file needs"):
            change()
        found = journal.reading(path, lambda file: file.read())
        assert found in states
        seen.add(found)
        disk.room = float("inf")
        journal.recover(path)
        assert path.read_bytes() == found
        assert [p.name for p in tmp_path.iterdir()] == ["file"]
    assert seen == states


def test_earlier_frames_are_readable_wherever_a_frame_comes_short_and_the_series_goes_on(
    tmp_path, monkeypatch
):
    disk, whole, path = Disk(monkeypatch), tmp_path / "whole", tmp_path / "p.vtkhdf"
    series = vtkhdf.ParticleSeries(path, ["velocity"])
    for time in (0.0, 0.1):
        series.append(time, cloud(round(10 * time)))
    shutil.copy(path, whole)
    before = disk.written
    series.append(0.2, cloud(2))
    needed = disk.written - before
    journalled = 0
    for room in range(0, needed, needed // 30):
        shutil.copy(whole, path)
        disk.room = room
        with pytest.raises(DiskFull):
            series.append(0.2, cloud(2))
        disk.room = float("inf")
        names = sorted(p.name for p in tmp_path.iterdir())
        left = journal.journal_of(path).exists()
        assert names == ["p.vtkhdf", *["p.vtkhdf.journal"] * left, "whole"]
        assert_frames(path, [0.0, 0.1, 0.2] if left else [0.0, 0.1])
        assert sorted(p.name for p in tmp_path.iterdir()) == names  # readers write nothing
        vtkhdf.truncate(path, 0.15)
        assert_frames(path, [0.0, 0.1])
        series.append(0.2, cloud(2))
        assert_frames(path, [0.0, 0.1, 0.2])
        journalled += left
    assert 7 < journalled < 23


@pytest.mark.parametrize("spoil", ["cut", "flip", "empty"])
def test_a_damaged_journal_is_named_and_not_applied(tmp_path, monkeypatch, spoil):
    path = tmp_path / "p.vtkhdf"
    series = vtkhdf.ParticleSeries(path, [])
    series.append(0.0, cloud(0))
    with monkeypatch.context() as patch:
        patch.setattr(journal, "recover", lambda path: None)
        series.append(0.1, cloud(1))
    left, before = journal.journal_of(path), path.read_bytes()
    content = left.read_bytes()
    half = len(content) // 2
    flipped = content[:half] + bytes([content[half] ^ 1]) + content[half + 1 :]
    left.write_bytes({"cut": content[:half], "flip": flipped, "empty": b""}[spoil])
    for act in (vtkhdf.read_times, lambda path: series.append(0.2, cloud(2))):
        with pytest.raises(ValueError, match=r"p\.vtkhdf\.journal': damaged"):
            act(path)
    assert path.read_bytes() == before


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed") / "run"
    Simulation(make_case(FRAMED), folder).run()
    return folder


def assert_same(folder, other):
    arrays, states = zip(*(checkpoint.read(f / "checkpoint.h5") for f in (folder, other)),
                         strict=True)  # fmt: skip
    for name in arrays[0]:
        assert arrays[0][name].tobytes() == arrays[1][name].tobytes()
    assert states[0]["time"] == states[1]["time"]
    frames = [list(vtkhdf.read_frames(f / "particles.vtkhdf")) for f in (folder, other)]
    assert [time for time, _ in frames[0]] == [time for time, _ in frames[1]]
    for (_, a), (_, b) in zip(*frames, strict=True):
        assert all(np.array_equal(a[name], b[name]) for name in b)


def test_resume_sets_a_damaged_journal_aside_with_its_file(tmp_path):
    Simulation(make_case(FRAMED), tmp_path / "run").run(until=0.01)
    path = tmp_path / "run/particles.vtkhdf"
    journal.journal_of(path).write_bytes(b"cut off")
    before = path.read_bytes()
    with pytest.warns(UserWarning, match="journal': damaged.+ set aside, the frames begin anew"):
        Simulation.resume(tmp_path / "run").run()
    aside = path.with_suffix(".damaged.vtkhdf")
    assert aside.read_bytes() == before
    assert journal.journal_of(aside).read_bytes() == b"cut off"
    assert vtkhdf.read_times(path)[0] > 0.01


def test_a_run_goes_on_to_the_same_data_wherever_its_frames_meet_a_full_disk(
    tmp_path, monkeypatch, undisturbed
):
    disk = Disk(monkeypatch)
    Simulation(make_case(FRAMED), tmp_path / "whole").run()
    needed = disk.written
    for part in (0.3, 0.45, 0.6, 0.75, 0.9, 0.99):
        folder = tmp_path / str(part)
        disk.room = int(part * needed)
        with pytest.raises(DiskFull):
            Simulation(make_case(FRAMED), folder).run()
        record = json.loads((folder / "run.json").read_text())
        assert record["outcome"] == "failed"
        assert "the disk is full: particles.vtkhdf needs" in record["reason"]
        assert len(vtkhdf.read_times(folder / "particles.vtkhdf")) >= 2
        disk.room = float("inf")
        Simulation.resume(folder).run()
        assert_same(folder, undisturbed)


def test_the_message_of_a_full_disk_says_what_was_needed_and_what_to_do(
    tmp_path, monkeypatch, capsys
):
    disk = Disk(monkeypatch)
    append = vtkhdf.ParticleSeries.append

    def fill(self, time, *what):
        disk.room = float("inf") if time < 0.01 else 100
        append(self, time, *what)

    monkeypatch.setattr(vtkhdf.ParticleSeries, "append", fill)
    (tmp_path / "case.toml").write_text(dumps(make_case(FRAMED)))
    folder = tmp_path / "run"
    assert tank.main([str(tmp_path / "case.toml"), "--out", str(folder)]) == 3
    error = capsys.readouterr().err
    assert f"{folder} cannot be written (the disk is full: particles.vtkhdf needs " in error
    assert "kB more, " in error and " are free) after step " in error
    assert f"Free space, then go on with\n  python -m mpslab.tank --resume {folder}\n" in error


@pytest.fixture(params=["tmpfs", "ext4"])
def small_disk(request, tmp_path):
    """A mounted disk of 16 MB."""
    place = tmp_path / "disk"
    place.mkdir()
    line = ["mount", "-t", "tmpfs", "-o", "size=16m", "tmpfs", str(place)]
    if request.param == "ext4":
        image = tmp_path / "image"
        with image.open("wb") as file:
            file.truncate(1 << 24)
        if not shutil.which("mkfs.ext4"):
            pytest.skip("there is no mkfs.ext4")
        subprocess.run(["mkfs.ext4", "-q", "-m", "0", str(image)], check=True)
        line = ["mount", "-o", "loop", str(image), str(place)]
    try:
        done = subprocess.run(line, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("there is no mount")
    if done.returncode:
        pytest.skip(f"mount is not permitted: {done.stderr.strip()}")
    yield place
    subprocess.run(["umount", "-l", str(place)], check=True)


@pytest.mark.slow
def test_a_real_disk_full_at_20_sizes_loses_no_frame_and_the_run_goes_on(small_disk, undisturbed):
    needed = sum(path.stat().st_size for path in undisturbed.iterdir() if path.is_file())
    filler, stopped, journals = small_disk / "filler", [], []
    for room in np.linspace(0.3 * needed, 1.1 * needed, SIZES).astype(int):
        folder = small_disk / "run"
        fill(filler, small_disk, room)
        try:
            Simulation(make_case(FRAMED), folder).run()
        except OSError as error:
            assert error.errno == errno.ENOSPC
            stopped.append(room)
        filler.unlink()
        journals.append((folder / "particles.vtkhdf.journal").exists())
        if (folder / "checkpoint.h5").exists():
            last = checkpoint.read_state(folder / "checkpoint.h5")["time"]
            times = vtkhdf.read_times(folder / "particles.vtkhdf")
            whole = vtkhdf.read_times(undisturbed / "particles.vtkhdf")
            assert times.tolist() == whole[: len(times)].tolist()
            assert len(times) >= np.searchsorted(whole, last, side="right")
            list(vtkhdf.read_frames(folder / "particles.vtkhdf"))
            Simulation.resume(folder).run()
            assert_same(folder, undisturbed)
        shutil.rmtree(folder)
    assert len(stopped) > SIZES // 2
    assert sum(journals) > SIZES // 4  # where the frames file itself came short


def fill(filler, disk, room):
    """Leave so many bytes of a disk free."""
    with filler.open("wb") as file:
        rest = shutil.disk_usage(disk).free - room
        while rest > 0:
            rest -= file.write(bytes(min(rest, 1 << 16)))
