"""Detection of the free surface, and the number density it rests on."""

import numpy as np
import pytest
from tanks import SINGLE, cloud, inside, lattice, near_of, particles_at

from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.models.surface import mark_surface


def marked(position, dim, radius=2.1, role=FLUID, search=None, threshold=0.97):
    """Particles with number density and surface mark, spacing 1."""
    particles = particles_at(np.asarray(position, float), role)
    near = near_of(particles, dim, radius, reach=search)
    particles.number_density[:] = near.number_density
    mark_surface(near, threshold, particles.carries_pressure)
    return particles, near.stencil


def layers_under_a_flat_surface(dim, radius):
    """n/n0 and surface mark of a column below a flat surface, from the top."""
    particles, stencil = marked(lattice(dim, 9 if dim == 2 else 6), dim, radius)
    x = particles.position
    column = np.flatnonzero(inside(x[:, :2], 0))
    column = column[np.argsort(-x[column, 2])]
    return particles.number_density[column] / stencil.n0, particles.surface[column]


# n/n0 of the top layers of a flat surface (reference 1.2).
FLAT = [
    (3, 2.1, [0.727, 0.997, 1.0]),
    (3, 2.4, [0.714, 0.978]),
    (3, 3.1, [0.675, 0.929, 0.999]),
    (3, 4.0, [0.644, 0.872, 0.974]),
    (2, 2.1, [0.676, 0.992]),
    (2, 3.1, [0.641, 0.918]),
    (2, 4.0, [0.622, 0.868, 0.970]),
]


@pytest.mark.parametrize(("dim", "radius", "expected"), FLAT)
def test_number_density_under_a_flat_surface(dim, radius, expected):
    n, _ = layers_under_a_flat_surface(dim, radius)
    np.testing.assert_allclose(n[: len(expected)], expected, atol=6e-4)


@pytest.mark.parametrize("dim", [2, 3])
def test_number_density_is_the_sum_of_the_weights(dim):
    """Also where the list reaches further than the radius."""
    position = cloud(dim, 300, 1)
    particles, _ = marked(position, dim, search=3.1)
    r = np.linalg.norm(position[:, None] - position, axis=-1) + 1e9 * np.eye(len(position))
    expected = np.maximum(2.1 / r - 1.0, 0.0).sum(axis=1)
    np.testing.assert_allclose(particles.number_density, expected, rtol=SINGLE)


@pytest.mark.parametrize("dim", [2, 3])
def test_only_the_top_layer_of_still_water_is_surface(dim):
    _, surface = layers_under_a_flat_surface(dim, 2.1)
    assert surface[0] == 1
    assert np.all(surface[1 : len(surface) // 2] == 0)


@pytest.mark.parametrize("dim", [2, 3])
def test_inside_of_a_lattice_is_at_n0_and_not_surface(dim):
    particles, stencil = marked(lattice(dim, 5), dim)
    core = inside(particles.position, 2)
    np.testing.assert_allclose(particles.number_density[core], stencil.n0, rtol=SINGLE)
    assert np.all(particles.surface[core] == 0)


@pytest.mark.parametrize("dim", [2, 3])
def test_thin_but_evenly_surrounded_particles_are_not_surface(dim):
    """A stretched lattice: n is far below the threshold, but nothing is lopsided inside."""
    particles, stencil = marked(1.1 * lattice(dim, 5), dim)
    core = inside(particles.position, 2.5)
    assert np.all(particles.number_density[core] < 0.9 * stencil.n0)
    assert np.all(particles.surface[core] == 0)
    assert np.all(particles.surface[~inside(particles.position, 5)] == 1)


def test_spray_is_surface():
    position = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.5, 0.0, 0.0], [9.5, 0.0, 0.0]])
    particles, _ = marked(position, 3)
    assert particles.surface.tolist() == [1, 1, 1, 1]


def test_four_even_neighbours_are_too_few_to_be_inside():
    cross = np.array([[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]])
    particles, _ = marked(cross, 2)
    assert particles.surface[0] == 1


def test_only_neighbours_inside_the_radius_count():
    """The list may reach further, for the Laplacian: those particles surround nothing."""
    around = 2.5 * np.vstack([np.zeros((1, 3)), np.eye(3), -np.eye(3)])
    particles, _ = marked(around, 3, search=3.1)
    assert particles.surface.tolist() == [1] * 7


@pytest.mark.parametrize("role", [FLUID, FACE])
def test_mark_does_not_depend_on_how_far_the_list_reaches(role):
    random = np.random.default_rng(1)
    position = lattice(3, 3)[random.random(343) < 0.6]
    near, _ = marked(position, 3, role=role)
    far, _ = marked(position, 3, role=role, search=3.1)
    np.testing.assert_array_equal(near.surface, far.surface)


def test_dry_walls_are_surface_and_dummies_never():
    role = np.array([FACE, FILLER, FLUID])
    particles, _ = marked(np.diag([10.0, 20.0, 30.0]), 3, role=role)
    assert particles.surface.tolist() == [1, 0, 1]


@pytest.mark.parametrize(("threshold", "mark"), [(0.97, 1), (0.68, 1), (0.67, 0)])
def test_threshold_decides(threshold, mark):
    """The top layer of a flat surface has n = 0.676 n0 in 2-D."""
    particles, _ = marked(lattice(2, 9), 2, threshold=threshold)
    x = particles.position
    top = (x[:, 2] == 9.0) & (np.abs(x[:, 0]) < 6.0)
    assert np.all(particles.surface[top] == mark)
