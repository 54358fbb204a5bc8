"""Contract of the solvers of the pressure equation, and the incomplete factor of ICCG."""

import numpy as np
import pytest
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import spsolve
from tanks import cloud, inside, near_of, particles_at

from mpslab.core import plugins
from mpslab.core.stencil import make_stencil
from mpslab.kernels import sparse
from mpslab.models.laplacians.standard import pair_terms
from mpslab.pressure import equation
from mpslab.pressure.system import PressureSystem

NAMES = plugins.names("solvers")
TOLERANCE = 1e-10


def water(dim=3, n=700, seed=1, radius=2.1):
    """System of a shaken block of water whose outermost layer is free surface."""
    particles = particles_at(cloud(dim, n, seed, jitter=0.1))
    x = particles.position
    particles.surface[:] = ~inside(x, np.abs(x).max() - 0.5)
    stencil = make_stencil(dim, 1.0, radius)
    source = np.random.default_rng(seed).normal(size=len(particles))
    near = near_of(particles, dim, radius)
    return equation.assemble(near, stencil, pair_terms(stencil), 1000.0, source)[0]


def column_of_water():
    """As `water`, but closed below and on the sides: only the top is free surface."""
    particles = particles_at(cloud(3, 2000, 3, jitter=0.05))
    x = particles.position
    particles.surface[:] = x[:, 2] > x[:, 2].max() - 0.5
    stencil = make_stencil(3, 1.0, 2.1)
    source = np.random.default_rng(4).normal(size=len(particles))
    near = near_of(particles, 3)
    return equation.assemble(near, stencil, pair_terms(stencil), 1000.0, source)[0]


def as_matrix(system):
    m = len(system)
    off = csr_array((system.value, system.column, system.row), (m, m))
    return (off + diags_array(system.diagonal)).tocsc()


def solve(name, system, x, tolerance=TOLERANCE, most=1000):
    return plugins.load("solvers", name).solve(system, x, tolerance, most)


def test_three_solvers_are_there():
    assert {"iccg", "piccg", "scg"} <= set(NAMES)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_solution_equals_a_direct_solve_to_the_tolerance(name, dim):
    system = water(dim)
    a, x = as_matrix(system), np.zeros(len(system))
    report = solve(name, system, x)
    residual = np.linalg.norm(system.right - a @ x) / np.linalg.norm(system.right)
    assert report.converged
    assert report.iterations > 5
    assert residual <= 1.01 * TOLERANCE
    assert report.residual == pytest.approx(residual, rel=0.05)
    exact = spsolve(a, system.right)
    condition = np.linalg.cond(a.toarray())
    error = np.linalg.norm(x - exact) / np.linalg.norm(exact)
    assert error < condition * TOLERANCE


@pytest.mark.parametrize("name", NAMES)
def test_start_at_the_solution_needs_no_iteration_and_leaves_it(name):
    system = water()
    exact = spsolve(as_matrix(system), system.right)
    x = exact.copy()
    report = solve(name, system, x)
    assert report.iterations == 0
    assert report.converged
    np.testing.assert_array_equal(x, exact)


@pytest.mark.parametrize("name", NAMES)
def test_start_near_the_solution_saves_iterations(name):
    system = water()
    exact = spsolve(as_matrix(system), system.right)
    cold, warm = np.zeros(len(system)), exact * (1.0 + 1e-6)
    assert solve(name, system, warm).iterations < solve(name, system, cold).iterations


@pytest.mark.parametrize("name", NAMES)
def test_zero_right_hand_side_gives_zero_pressure(name):
    system = water()
    system.right[:] = 0.0
    x = np.ones(len(system))
    report = solve(name, system, x)
    assert np.all(x == 0.0)
    assert (report.iterations, report.residual, report.converged) == (0, 0.0, True)


@pytest.mark.parametrize("name", NAMES)
def test_system_without_rows_is_solved(name):
    empty, none = np.zeros(0), np.zeros(0, np.int32)
    system = PressureSystem(np.zeros(1, np.int32), none, empty.astype(np.float32), empty, empty)
    assert solve(name, system, empty.copy()).converged


@pytest.mark.parametrize("name", NAMES)
def test_too_few_iterations_are_reported(name):
    system = water()
    report = solve(name, system, np.zeros(len(system)), most=3)
    assert not report.converged
    assert report.iterations == 3
    assert report.residual > TOLERANCE


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("where", ["right", "start", "diagonal", "value"])
def test_not_a_number_is_reported_as_not_converged(name, where):
    system = water(n=200)
    x = np.zeros(len(system))
    array = x if where == "start" else getattr(system, where)
    array[len(array) // 2] = np.nan
    report = solve(name, system, x)
    assert not report.converged
    assert np.isnan(report.residual)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("scale", [1e-12, 1e12])
def test_scale_of_the_right_hand_side_does_not_matter(name, scale):
    system = water(n=300)
    x = np.zeros(len(system))
    unit = solve(name, system, x)
    system.right *= scale
    scaled_x = np.zeros(len(system))
    scaled = solve(name, system, scaled_x)
    assert scaled.converged
    assert abs(scaled.iterations - unit.iterations) <= 1
    np.testing.assert_allclose(scaled_x, x * scale, rtol=1e-7)


@pytest.mark.parametrize("dim", [2, 3])
def test_iccg_needs_fewer_iterations_than_scg(dim):
    system = water(dim) if dim == 2 else column_of_water()
    found = {name: solve(name, system, np.zeros(len(system)), 1e-6) for name in ("iccg", "scg")}
    assert all(report.converged for report in found.values())
    assert found["iccg"].iterations < 0.5 * found["scg"].iterations
    assert found["iccg"].replaced == 0


def factorised(system):
    m = len(system)
    end, work = np.empty(m, np.int32), np.zeros(m)
    factor, pivot = np.empty(len(system.value)), np.empty(m)
    sparse.lower_ends(system.row, system.column, end)
    replaced = sparse.factorise(
        system.row, system.column, system.value, system.diagonal, end, factor, pivot, work
    )
    return end, factor, pivot, replaced


def dense_factor(a):
    """(I + L) D (I + L)^T on the pattern of A, by the textbook's three loops."""
    m = len(a)
    unit, d = np.eye(m), np.zeros(m)
    for i in range(m):
        for j in range(i):
            if a[i, j] != 0.0:
                inner = sum(unit[i, k] * d[k] * unit[j, k] for k in range(j))
                unit[i, j] = (a[i, j] - inner) / d[j]
        d[i] = a[i, i] - sum(unit[i, k] ** 2 * d[k] for k in range(i))
    return unit, d


def as_dense_factor(system, end, factor):
    unit = np.eye(len(system))
    for i, (a, b) in enumerate(zip(system.row[:-1], end, strict=True)):
        unit[i, system.column[a:b]] = factor[a:b]
    return unit


@pytest.mark.parametrize("dim", [2, 3])
def test_incomplete_factor_equals_a_dense_reference(dim):
    system = water(dim, n=140)
    end, factor, pivot, replaced = factorised(system)
    unit, d = dense_factor(as_matrix(system).toarray())
    assert np.count_nonzero(unit) > 2 * len(system)
    np.testing.assert_allclose(as_dense_factor(system, end, factor), unit, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(1.0 / pivot, d, rtol=1e-12)
    assert replaced == 0


def test_substitution_inverts_the_factor():
    system = water(n=140)
    end, factor, pivot, _ = factorised(system)
    unit = as_dense_factor(system, end, factor)
    r, z = np.random.default_rng(9).normal(size=len(system)), np.empty(len(system))
    sparse.substitute(system.row, system.column, end, factor, pivot, r, z)
    np.testing.assert_allclose(unit @ np.diag(1.0 / pivot) @ unit.T @ z, r, rtol=1e-9, atol=1e-9)


def test_lost_pivots_are_put_back_and_counted():
    """A matrix that is not positive definite: the second pivot would be 1 - 4 < 0."""
    row, column = np.array([0, 1, 2], np.int32), np.array([1, 0], np.int32)
    value, ones = np.array([-2.0, -2.0], np.float32), np.ones(2)
    end, _, pivot, replaced = factorised(PressureSystem(row, column, value, ones, ones))
    assert end.tolist() == [0, 2]
    assert replaced == 1
    assert pivot.tolist() == [1.0, 1.0]


@pytest.mark.parametrize("dim", [2, 3])
def test_product_equals_the_matrix_of_scipy(dim):
    system = water(dim)
    x = np.random.default_rng(2).normal(size=len(system))
    np.testing.assert_allclose(
        system.multiply(x, np.empty(len(system))), as_matrix(system) @ x, rtol=1e-12, atol=1e-16
    )
