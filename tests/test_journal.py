"""A file that is changed all at once or not at all."""

import io

import h5py
import numpy as np
import pytest

from mpslab import journal, vtkhdf
from mpslab.particles import make_particles


@pytest.fixture
def path(tmp_path):
    (tmp_path / "file").write_bytes(b"0123456789")
    return tmp_path / "file"


def files(path):
    return sorted(p.name for p in path.parent.iterdir())


def test_changes_are_seen_at_once_inside_and_come_to_the_disk_at_the_end(path):
    with journal.changing(path) as held:
        held.seek(8)
        held.write(b"abcd")
        held.seek(5)
        assert held.read() == b"567abcd"
        assert path.read_bytes() == b"0123456789"
    assert path.read_bytes() == b"01234567abcd"
    assert files(path) == ["file"]


def test_an_error_amid_the_changes_leaves_the_file_as_it_was(path):
    with pytest.raises(KeyError), journal.changing(path) as held:
        held.write(b"abcd")
        raise KeyError
    assert path.read_bytes() == b"0123456789"
    assert files(path) == ["file"]


def test_a_file_that_is_not_there_is_made(tmp_path):
    with journal.changing(tmp_path / "new") as held:
        held.write(b"abc")
        held.truncate(2)
    assert (tmp_path / "new").read_bytes() == b"ab"


def test_reads_and_writes_are_those_of_a_file(path):
    rng = np.random.default_rng(1)
    with journal.changing(path) as held:
        plain = io.BytesIO(b"0123456789")
        for _ in range(200):
            place, length = (int(n) for n in rng.integers(0, 40, 2))
            assert held.seek(place) == plain.seek(place)
            if rng.random() < 0.5:
                content = rng.bytes(length)
                assert held.write(content) == plain.write(content)
            else:
                assert held.read(length) == plain.read(length)
            assert held.tell() == plain.tell()
    assert path.read_bytes() == plain.getvalue()


def test_a_kill_at_any_write_loses_at_most_the_frame_in_hand(tmp_path, monkeypatch):
    path = tmp_path / "p.vtkhdf"
    particles = make_particles(np.random.default_rng(0).random((500, 3)), np.zeros(500))
    series = vtkhdf.ParticleSeries(path, ["velocity"])
    for time in (0.0, 0.1):
        series.append(time, particles)
    before, recover = path.read_bytes(), journal.recover
    # The kill comes after the journal, and amid the changes: only the first `done` are made.
    monkeypatch.setattr(journal, "recover", lambda path: None)
    particles.position[:] += 1.0
    series.append(0.2, particles)
    held = journal.journal_of(path).read_bytes()
    size, pieces = journal._read_journal(journal.journal_of(path))
    assert path.read_bytes() == before
    assert len(pieces) > 10
    monkeypatch.setattr(journal, "recover", recover)
    for done in range(len(pieces) + 1):
        half = bytearray(before)
        for offset, piece in pieces[:done]:
            half[offset : offset + len(piece)] = piece
        path.write_bytes(half)
        journal.journal_of(path).write_bytes(held)
        vtkhdf.truncate(path, 0.15)
        assert vtkhdf.read_times(path).tolist() == [0.0, 0.1]
        for index in (0, 1):
            frame = vtkhdf.read_frame(path, index)
            assert np.array_equal(frame["position"], (particles.position - 1.0).astype("f4"))
    journal.journal_of(path).write_bytes(held)
    journal.recover(path)
    assert len(vtkhdf.read_times(path)) == 3
    assert path.stat().st_size == size


def test_a_whole_file_is_left_to_other_programs(tmp_path):
    particles = make_particles(np.zeros((3, 3)), np.zeros(3))
    vtkhdf.ParticleSeries(tmp_path / "p.vtkhdf", []).append(0.0, particles)
    with h5py.File(tmp_path / "p.vtkhdf") as file:
        assert len(file["VTKHDF/Points"]) == 3
