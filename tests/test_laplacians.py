"""Contract of the Laplacians of pressure, through the matrix that they give."""

import numpy as np
import pytest
from scipy.sparse import csr_array, diags_array
from tanks import cloud, inside, lattice, near_of, particles_at

from mpslab.core import plugins
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil
from mpslab.pressure import equation

NAMES = plugins.names("laplacians")
DENSITY = 1000.0
SINGLE = 1e-6  # what entries in single precision leave of "exact"


def matrix(particles, dim, radius, name, width=0.0):
    """Matrix of  -(1/rho) <lap p>  and the particle of each row."""
    stencil = make_stencil(dim, 1.0, radius, width)
    terms = plugins.load("laplacians", name).pair_terms(stencil)
    near = near_of(particles, dim, radius, width, reach=radius * 1.3)
    system, rows = equation.assemble(near, stencil, terms, DENSITY, np.zeros(len(particles)))
    m = len(system)
    off = csr_array((system.value, system.column, system.row), (m, m))
    return (off + diags_array(system.diagonal)).tocsr(), rows


def lattice_laplacian(name, dim, radius, function):
    """<lap f> of f(x, y, z) at the centre of a lattice whose outermost layer is free surface."""
    half = int(radius) + 2
    particles = particles_at(lattice(dim, half))
    particles.surface[:] = ~inside(particles.position, half - 1)
    a, rows = matrix(particles, dim, radius, name)
    x = particles.position[rows]
    centre = np.flatnonzero(inside(x, 0))[0]
    return -DENSITY * (a @ function(*x.T))[centre]


def test_two_models_are_there():
    assert {"standard", "hl"} <= set(NAMES)


QUADRATICS = [
    (lambda x, y, z: x * x, 2.0),
    (lambda x, y, z: z * z - 3.0 * z + 4.0, 2.0),
    (lambda x, y, z: x * z + 2.0 * x, 0.0),
    (lambda x, y, z: 3.0 * x * x - z * z + 5.0, 4.0),
]


@pytest.mark.parametrize("radius", [2.1, 3.1, 4.0])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize(("function", "exact"), QUADRATICS)
def test_standard_laplacian_of_quadratic_is_exact_on_the_lattice(dim, radius, function, exact):
    assert lattice_laplacian("standard", dim, radius, function) == pytest.approx(exact, abs=SINGLE)


def test_standard_laplacian_of_quadratic_across_the_tank_is_exact_in_3d():
    found = lattice_laplacian("standard", 3, 2.1, lambda x, y, z: y * y + x * y)
    assert found == pytest.approx(2.0, abs=SINGLE)


# Lattice values of the HL form over the exact Laplacian (reference 3.2), to the digits given.
RATIOS = [
    (2, 2.1, 2.13, 5e-3),
    (2, 3.1, 1.86, 5e-3),
    (2, 4.0, 1.68, 5e-3),
    (3, 2.1, 1.073, 5e-4),
    (3, 2.4, 1.152, 5e-4),
    (3, 3.1, 1.082, 5e-4),
    (3, 4.0, 1.005, 5e-4),
]


@pytest.mark.parametrize(("dim", "radius", "ratio", "digits"), RATIOS)
def test_hl_laplacian_has_its_known_ratio_to_the_exact_one(dim, radius, ratio, digits):
    found = lattice_laplacian("hl", dim, radius, lambda x, y, z: x * x + z * z) / 4.0
    assert found == pytest.approx(ratio, abs=digits)


@pytest.mark.parametrize("radius", [2.1, 3.1, 4.0])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_laplacian_of_linear_field_is_zero_on_the_lattice(name, dim, radius):
    found = lattice_laplacian(name, dim, radius, lambda x, y, z: 2.0 * x - z + 3.0)
    assert abs(found) < 1e-12


@pytest.mark.parametrize("radius", [2.1, 3.1, 4.0])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_pair_weight_is_positive_inside_the_radius(name, dim, radius):
    """Positive weights make an M-matrix: positive definite, and IC(0) exists."""
    stencil = make_stencil(dim, 0.002, radius)
    one, inverse, cubic = plugins.load("laplacians", name).pair_terms(stencil)
    r = np.linspace(1e-3, 1.0 - 1e-9, 2000) * stencil.radius
    assert np.all(one + inverse / r + cubic / r**3 > 0.0)


@pytest.mark.parametrize("name", NAMES)
def test_pair_weight_scales_with_the_spacing_squared(name):
    def at_one_spacing(d0):
        one, inverse, cubic = plugins.load("laplacians", name).pair_terms(make_stencil(3, d0, 2.1))
        return (one + inverse / d0 + cubic / d0**3) * d0**2

    assert at_one_spacing(0.002) == pytest.approx(at_one_spacing(1.0), rel=1e-13)


def shaken(dim, seed=3):
    """Shaken lattice, its outermost layer free surface, a fifth of it walls or dummies."""
    particles = particles_at(cloud(dim, 300, seed, jitter=0.3))
    random = np.random.default_rng(seed)
    particles.role[:] = random.choice([FLUID] * 8 + [FACE, FILLER], len(particles))
    x = particles.position
    particles.surface[:] = ~inside(x, np.abs(x).max() - 1.0) & (particles.role != FILLER)
    return particles


@pytest.mark.parametrize("radius", [2.1, 3.1])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_matrix_is_symmetric_to_the_last_bit(name, dim, radius):
    a, _ = matrix(shaken(dim), dim, radius, name)
    assert a.nnz > len(a.data) / 2
    assert abs(a - a.T).max() == 0.0


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_matrix_is_a_positive_definite_m_matrix(name, dim):
    a, _ = matrix(shaken(dim), dim, 2.1, name)
    off = a - diags_array(a.diagonal())
    assert off.max() <= 0.0
    assert np.linalg.eigvalsh(a.toarray())[0] > 0.0
    assert np.all(a.sum(axis=1) >= -1e-12 * a.diagonal())


@pytest.mark.parametrize("name", NAMES)
def test_dummies_leave_no_trace_in_the_matrix(name):
    particles = shaken(3)
    without = particles.take(particles.role != FILLER)
    assert abs(matrix(particles, 3, 2.1, name)[0] - matrix(without, 3, 2.1, name)[0]).max() == 0.0


@pytest.mark.parametrize("name", NAMES)
def test_rows_are_the_pressure_carriers_below_the_surface(name):
    particles = shaken(3)
    _, rows = matrix(particles, 3, 2.1, name)
    expected = (particles.role != FILLER) & (particles.surface == 0)
    np.testing.assert_array_equal(rows, np.flatnonzero(expected))


@pytest.mark.parametrize("name", NAMES)
def test_surface_particles_pull_with_their_full_weight(name):
    """p = 0 there: they stand in the diagonal of their neighbours and in no row."""
    position = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    particles = particles_at(position)
    particles.surface[1] = 1
    stencil = make_stencil(3, 1.0, 1.5)
    one, inverse, cubic = plugins.load("laplacians", name).pair_terms(stencil)
    weight = (one + inverse + cubic) / DENSITY
    a, rows = matrix(particles, 3, 1.5, name)
    assert rows.tolist() == [0, 2]
    np.testing.assert_allclose(a.toarray(), weight * np.array([[2, -1], [-1, 1]]), rtol=SINGLE)


@pytest.mark.parametrize("name", NAMES)
def test_periodic_lattice_has_the_same_matrix_row_everywhere_across(name):
    line, up = np.arange(8.0), np.arange(9.0)
    position = np.stack(np.meshgrid(up, line, up, indexing="ij"), axis=-1).reshape(-1, 3)
    particles = particles_at(position + np.array([0.0, 0.5, 0.0]))
    x = particles.position
    particles.surface[:] = (x[:, 0] % 8.0 == 0.0) | (x[:, 2] % 8.0 == 0.0)
    a, rows = matrix(particles, 3, 2.1, name, width=8.0)
    centre = (x[rows, 0] == 4.0) & (x[rows, 2] == 4.0)
    np.testing.assert_allclose(a.diagonal()[centre], a.diagonal()[centre][0], rtol=1e-14)
    field = (x[rows, 0] - 4.0) ** 2 + (x[rows, 2] - 4.0) ** 2
    across = (a @ field)[centre]
    assert np.ptp(across) < 1e-12 * np.abs(across).max()
