"""Hyperviscosity: what it takes off velocities, and what it leaves."""

import numpy as np
import pytest
from tanks import cloud, lattice, make_case, near_of, particles_at

from mpslab.core.particles import FACE, FLUID
from mpslab.models import hyperviscosity
from mpslab.simulation import Simulation


def change(position, velocity, dim=3, role=FLUID, share=0.5):
    near = near_of(particles_at(position, role), dim, 2.1)
    return hyperviscosity.change(near, velocity, share, lambda *arrays: None)


def scattered(dim):
    """Places off a lattice, with a surface all around."""
    position = cloud(dim, 300, 6, jitter=0.3)
    return position, np.random.default_rng(3).normal(size=position.shape)


def test_linear_velocities_stay_at_a_surface_too():
    position, _ = scattered(3)
    slope = np.random.default_rng(5).normal(size=(3, 3))
    assert np.abs(change(position, 1.0 + position @ slope)).max() < 1e-5


def test_momentum_and_angular_momentum_stay():
    position, velocity = scattered(3)
    found = change(position, velocity)
    size = np.abs(found).sum()
    assert np.abs(found.sum(axis=0)).max() < 1e-13 * size
    assert np.abs(np.cross(position, found).sum(axis=0)).max() < 1e-6 * size


@pytest.mark.parametrize("dim", [2, 3])
def test_whatever_the_velocities_energy_is_lost(dim):
    position, velocity = scattered(dim)
    if dim == 2:
        velocity[:, 1] = 0.0
    for _ in range(5):
        found = change(position, velocity, dim)
        assert np.sum(velocity * found) < 0.0
        assert np.sum((velocity + found) ** 2) < np.sum(velocity**2)
        velocity = found  # towards what is lost fastest


def test_a_wave_loses_its_wave_number_to_the_fourth():
    """Under exp(kz), at 64 and 32 spacings a wavelength: next to nothing, and 2^4 times as much."""
    position = lattice(2, 24)
    inner = np.abs(position[:, [0, 2]]).max(axis=1) < 18
    lost = []
    for k in (2.0 * np.pi / 64, 2.0 * np.pi / 32):
        velocity = np.zeros_like(position)
        velocity[:, 0] = np.sin(k * position[:, 0])
        found = change(position, velocity, 2)
        lost.append(-np.sum((velocity * found)[inner]) / np.sum(velocity[inner] ** 2))
    assert lost[0] < 0.5 * 0.13 * (2.0 * np.pi / 64) ** 4
    assert lost[1] == pytest.approx(16.0 * lost[0], rel=0.1)


def test_solids_and_what_is_alone_keep_their_velocities():
    position = np.array([[0.0, 0, 0], [0, 0, -1], [9, 0, 0], [19, 0, 0], [20, 0, 0]])
    role = np.array([FLUID, FACE, FLUID, FLUID, FLUID], np.int8)
    velocity = np.array([[1.0, 0, 0], [0, 0, 0], [2, 0, 0], [3, 0, 0], [-3, 0, 0]])
    found = change(position, velocity, 2, role)
    assert not found[:3].any()
    assert found[3, 0] < 0.0 < found[4, 0]  # two that meet: their difference becomes less
    assert found[3, 0] > -3.0


def stirs(strength, seed):
    """Mean square speed from 0.1 s on, in a box of 10 x 10 [m2/s2]."""
    tank = {"tank.length": 0.02, "scheme.settling": 200, "particles.jitter": 0.02,
            "particles.seed": seed, "scheme.hyperviscosity": strength}  # fmt: skip
    run, found = Simulation(make_case(tank)), []
    run.run(until=0.1)
    for _ in range(100):
        run.advance()
        found.append(np.mean(run.particles.velocity[run.particles.fluid] ** 2))
    return np.mean(found)


def test_still_water_is_the_stiller_for_it():
    """Over four seeds, whose speeds fall to 0.15 to 0.56."""
    with_it, without = (sum(stirs(s, seed) for seed in range(4)) for s in (0.5, 0.0))
    assert with_it < 0.36 * without
