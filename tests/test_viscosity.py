"""Viscous acceleration, nu <lap u>."""

import numpy as np
import pytest
from tanks import cloud, inside, lattice, near_of, particles_at

from mpslab.core.neighbourhood import padded
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.kernels import viscosity

NU = 0.3


def acceleration(position, velocity, dim, radius=2.1, role=None, slip=True):
    particles = particles_at(position, FLUID if role is None else role)
    out = np.zeros_like(position)
    near = near_of(particles, dim, radius, reach=radius * 1.2)
    viscosity.viscous_acceleration(
        near.row, near.solid, near.other, near.inverse, particles.role, near.stencil,
        padded(velocity), NU, slip, out,
    )  # fmt: skip
    return out


@pytest.mark.parametrize("radius", [2.1, 3.1])
@pytest.mark.parametrize("dim", [2, 3])
def test_parabolic_profile_is_exact_on_the_lattice(dim, radius):
    position = lattice(dim, 6)
    velocity = np.zeros_like(position)
    velocity[:, 0] = 1.0 + 2.0 * position[:, 2] - 3.0 * position[:, 2] ** 2
    found = acceleration(position, velocity, dim, radius)[inside(position, 2)]
    exact = np.broadcast_to([-6.0 * NU, 0.0, 0.0], found.shape)
    np.testing.assert_allclose(found, exact, atol=1e-12)


@pytest.mark.parametrize("dim", [2, 3])
def test_momentum_of_random_particles_is_conserved(dim):
    position = cloud(dim, 500, 1)
    velocity = np.random.default_rng(2).normal(size=position.shape)
    found = acceleration(position, velocity, dim)
    assert np.linalg.norm(found.sum(axis=0)) < 1e-13 * np.linalg.norm(found, axis=1).sum()


def test_uniform_motion_has_no_friction():
    position = cloud(3, 300, 3)
    assert np.all(acceleration(position, np.ones_like(position), 3) == 0.0)


def test_energy_is_lost_and_never_gained():
    position = cloud(3, 300, 4, jitter=0.3)
    velocity = np.random.default_rng(5).normal(size=position.shape)
    assert np.sum(acceleration(position, velocity, 3) * velocity) < 0.0


@pytest.mark.parametrize("wall", [FACE, FILLER])
def test_walls_brake_the_water_only_without_slip(wall):
    position = lattice(3, 3)
    role = np.where(position[:, 2] < 0.0, wall, FLUID)
    velocity = np.zeros_like(position)
    velocity[role == FLUID, 0] = 2.0
    slip = acceleration(position, velocity, 3, role=role, slip=True)
    rough = acceleration(position, velocity, 3, role=role, slip=False)
    assert np.all(slip == 0.0)
    assert np.all(rough[position[:, 2] == 0.0, 0] < 0.0)
    assert np.all(rough[role != FLUID] == 0.0)
