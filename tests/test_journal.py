"""A file that is changed all at once or not at all."""

import io
import os

import h5py
import numpy as np
import pytest

from mpslab.core.files import remove_drafts, replacing
from mpslab.core.particles import make_particles
from mpslab.output import journal, vtkhdf


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


def test_readers_beside_a_writer_see_whole_frames(tmp_path):
    """A process adds frames without a pause; each look finds all frames of an instant, whole."""
    path = tmp_path / "p.vtkhdf"
    vtkhdf.ParticleSeries(path, []).append(0.0, make_particles(np.zeros((200, 3)), np.zeros(200)))
    child = os.fork()
    if child == 0:
        try:
            series = vtkhdf.ParticleSeries(path, [])
            for k in range(1, 60):
                series.append(float(k), make_particles(np.full((200, 3), k), np.zeros(200)))
        finally:
            os._exit(0)
    looks, count = 0, 1
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        times = vtkhdf.read_times(path)
        assert times.tolist() == [float(k) for k in range(len(times))]
        assert len(times) >= count
        count = len(times)
        assert np.all(vtkhdf.read_frame(path, count - 1)["position"] == count - 1)
        looks += 1
    assert len(vtkhdf.read_times(path)) == 60
    assert looks > 20


def test_what_is_read_while_the_file_changes_is_read_again(path):
    contents = []

    def look(file):
        contents.append(file.read())
        if len(contents) == 1:
            with journal.changing(path) as held:
                held.write(b"abcd")
            raise KeyError("half of it")
        return contents[-1]

    assert journal.reading(path, look) == b"abcd456789"
    assert len(contents) == 2


def test_what_goes_wrong_in_a_file_that_does_not_change_is_raised(path):
    with pytest.raises(KeyError):
        journal.reading(path, lambda file: {}["nothing"])


def test_a_file_that_is_written_all_the_time_is_given_up(path, monkeypatch):
    monkeypatch.setattr(journal, "PATIENCE", 0.05)
    with pytest.raises(OSError, match="written to all the time"):
        journal.reading(path, lambda file: path.write_bytes(path.read_bytes() + b"x"))


def test_drafts_of_two_writers_are_two_files(tmp_path):
    with replacing(tmp_path / "a") as one, replacing(tmp_path / "a") as other:
        one.write_text("one")
        other.write_text("other")
        assert one != other
        (tmp_path / "notes.tmp").write_text("mine")
        remove_drafts(tmp_path)
        assert files(tmp_path / "a") == ["notes.tmp"]
        one.write_text("one")
        other.write_text("other")
    assert (tmp_path / "a").read_text() == "one"
    assert files(tmp_path / "a") == ["a", "notes.tmp"]
