"""Checkpoints: exact, and never half written."""

import os

import h5py
import numpy as np
import pytest

from mpslab.core.particles import ParticleSet, make_particles
from mpslab.output import checkpoint

STATE = {
    "step": 12,
    "time": 0.1 + 0.2,
    "next_frame": np.float64(0.35),
    "resumed": False,
    "dt_limit": "courant",
    "case": "[tank]\nlength = 0.8  # größer\n" * 4000,
    "previous": np.array([1e-300, -0.0, np.nan]),
    "none_lost": np.zeros((0, 3)),
}


def some_particles(n=40):
    rng = np.random.default_rng(5)
    particles = make_particles(rng.normal(size=(n, 3)), rng.integers(0, 5, n))
    particles.velocity[:] = rng.normal(size=(n, 3)) * 1e-7
    particles.pressure[:] = rng.normal(size=n) / 3
    particles.number_density[:] = 6.54 + rng.random(n)
    particles.surface[:] = rng.integers(0, 2, n)
    return particles


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "checkpoint.h5"
    checkpoint.write(path, some_particles(), STATE)
    return path


def test_particles_come_back_to_the_byte(path):
    arrays, _ = checkpoint.read(path)
    back, particles = ParticleSet(**arrays), some_particles()
    for name in checkpoint.FIELDS:
        expected = getattr(particles, name)
        assert getattr(back, name).dtype == expected.dtype
        assert getattr(back, name).tobytes() == expected.tobytes()


def test_state_comes_back_with_its_types(path):
    _, state = checkpoint.read(path)
    assert set(state) == set(STATE)
    for key in ("step", "time", "next_frame", "resumed", "dt_limit", "case"):
        assert state[key] == STATE[key]
    assert [type(state[k]) for k in ("step", "time", "resumed", "dt_limit")] == [
        int,
        float,
        bool,
        str,
    ]
    assert state["previous"].tobytes() == STATE["previous"].tobytes()
    assert state["none_lost"].shape == (0, 3)


def test_datasets_are_in_the_order_of_gid(tmp_path):
    particles = some_particles()
    shuffled = particles.take(np.random.default_rng(1).permutation(len(particles)))
    checkpoint.write(tmp_path / "c.h5", shuffled, {})
    arrays, _ = checkpoint.read(tmp_path / "c.h5")
    np.testing.assert_array_equal(arrays["gid"], particles.gid)
    np.testing.assert_array_equal(arrays["position"], particles.position)


def test_later_checkpoint_takes_the_place_of_the_earlier(path):
    checkpoint.write(path, some_particles(7), {"step": 13})
    arrays, state = checkpoint.read(path)
    assert len(arrays["gid"]) == 7
    assert state == {"step": 13}
    assert [p.name for p in path.parent.iterdir()] == ["checkpoint.h5"]


def test_interrupted_write_leaves_the_earlier_one(path, monkeypatch):
    before = path.read_bytes()

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(checkpoint, "_store", interrupt)
    with pytest.raises(KeyboardInterrupt):
        checkpoint.write(path, some_particles(), STATE)
    assert path.read_bytes() == before
    assert [p.name for p in path.parent.iterdir()] == ["checkpoint.h5"]


def test_kill_before_the_rename_leaves_the_earlier_one(path):
    before = path.read_bytes()
    child = os.fork()
    if child == 0:
        # No clean-up runs in a killed process: os._exit in place of the rename.
        os.replace = lambda *_: os._exit(9)
        checkpoint.write(path, some_particles(7), {"step": 13})
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 9
    assert path.read_bytes() == before
    assert checkpoint.read(path)[1]["step"] == 12


def test_truncated_temporary_file_does_no_harm(path):
    path.with_name("checkpoint.h5.tmp").write_bytes(path.read_bytes()[:1000])
    assert checkpoint.read(path)[1]["step"] == 12
    checkpoint.write(path, some_particles(), {"step": 14})
    assert checkpoint.read(path)[1] == {"step": 14}


def test_value_that_hdf5_cannot_hold_is_named(tmp_path):
    with pytest.raises(TypeError, match="generator"):
        checkpoint.write(tmp_path / "c.h5", some_particles(), {"generator": object()})
    assert not list(tmp_path.iterdir())


def damage_missing(path):
    path.unlink()


def damage_text(path):
    path.write_text("position = 1\n")


def damage_truncated(path):
    path.write_bytes(path.read_bytes()[:-500])


def damage_no_position(path):
    with h5py.File(path, "r+") as file:
        del file["position"]


def damage_version(path):
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = 99


def damage_format(path):
    with h5py.File(path, "r+") as file:
        del file.attrs["format"]


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (damage_missing, "no such file"),
        (damage_text, "not a checkpoint"),
        (damage_truncated, "damaged"),
        (damage_no_position, "damaged"),
        (damage_version, "version 99"),
        (damage_format, "not a checkpoint"),
    ],
)
def test_bad_file_is_named_in_one_line(path, damage, said):
    damage(path)
    with pytest.raises(ValueError, match=said) as caught:
        checkpoint.read(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)
