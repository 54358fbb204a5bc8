"""Viscous acceleration, div(2 nu D)."""

import numpy as np
import pytest
from tanks import cloud, lattice, near_of, particles_at

from mpslab.core.neighbourhood import padded
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.kernels import viscosity

NU = 0.3


def acceleration(position, velocity, dim, radius=2.1, role=None, slip=True):
    particles = particles_at(position, FLUID if role is None else role)
    out = np.zeros_like(position)
    near = near_of(particles, dim, radius, reach=radius * 1.2)
    viscosity.acceleration(
        near.row, near.solid, near.other, near.offset, near.inverse, particles.role, near.stencil,
        padded(velocity), np.full(len(position), NU), slip, out,
    )  # fmt: skip
    return out


def turned(position, angle):
    """Places turned about y."""
    c, s = np.cos(angle), np.sin(angle)
    return position @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@pytest.mark.parametrize("radius", [2.1, 3.1])
def test_parabolic_profile_is_exact_in_the_mean_over_the_directions_of_a_lattice(radius):
    """A square lattice is stiffer along its rows than across them; half a right angle apart the
    two differences are opposite."""
    found = []
    for angle in (0.0, 0.25 * np.pi):
        position = turned(lattice(2, 8), angle)
        velocity = np.zeros_like(position)
        velocity[:, 0] = 1.0 + 2.0 * position[:, 2] - 3.0 * position[:, 2] ** 2
        middle = np.argmin(np.linalg.norm(position, axis=1))
        found.append(acceleration(position, velocity, 2, radius)[middle])
    np.testing.assert_allclose(np.mean(found, axis=0), [-6.0 * NU, 0.0, 0.0], atol=1e-6)
    assert found[0][0] == pytest.approx(-6.0 * NU, rel=0.2)


def test_water_that_turns_as_a_whole_has_no_friction_at_its_surface_either():
    position = cloud(3, 300, 6, jitter=0.3)
    found = acceleration(position, np.cross([0.3, -0.2, 0.5], position), 3)
    assert np.abs(found).max() < 1e-5


@pytest.mark.parametrize(("layers", "within"), [(20, 0.05), (40, 0.03)])
def test_a_wave_loses_what_a_surface_without_stress_lets_it(layers, within):
    """Energy is lost at the rate 2 nu int D:D; a Laplacian of the velocities there gives half.

    In rows of triangles, which have no direction that is stiffer than another.
    """
    k, side = 0.25 * np.pi / layers, np.sqrt(2.0 / np.sqrt(3.0))
    up, along = np.arange(0.5, layers * side) / side, np.arange(0.5, 4 * layers / side)
    row, place = (one.ravel() for one in np.meshgrid(np.arange(len(up)), along))
    x, z = side * (place + 0.5 * (row % 2) - 0.25), up[row]
    nothing = np.zeros_like(x)
    position = np.column_stack([x, nothing, z])
    velocity = np.column_stack([
        -np.cosh(k * z) * np.sin(k * x), nothing, np.sinh(k * z) * np.cos(k * x)
    ])  # fmt: skip
    power = -np.sum(acceleration(position, velocity, 2) * velocity)
    assert power == pytest.approx(4.0 * NU * k**2 * np.sum(velocity**2), rel=within)


@pytest.mark.parametrize("dim", [2, 3])
def test_momentum_and_its_moment_are_conserved(dim):
    position = cloud(dim, 500, 1)
    velocity = np.random.default_rng(2).normal(size=position.shape)
    found = acceleration(position, velocity, dim)
    size = np.linalg.norm(found, axis=1).sum()
    assert np.linalg.norm(found.sum(axis=0)) < 1e-13 * size
    assert np.linalg.norm(np.cross(position, found).sum(axis=0)) < 1e-6 * size


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
