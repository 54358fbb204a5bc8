"""The coarse system of the deflation: its groups, its factor, and what it takes out."""

import numpy as np
import pytest
from test_slabs import system_by_slab
from test_solvers import as_matrix

from mpslab.kernels import coarse
from mpslab.pressure import deflation, groups
from mpslab.pressure.conjugate_gradient import by_diagonal, conjugate_gradient
from mpslab.pressure.deflation import Band, Deflation, Nested
from mpslab.pressure.solvers import deflated, scg

TOLERANCE = 1e-8


def members(made):
    """Z, dense: one where a row belongs to a group."""
    z = np.zeros((len(made.group), made.count))
    z[np.arange(len(made.group)), made.group] = 1.0
    return z


@pytest.fixture
def system():
    system, _ = system_by_slab()
    system.cell[:, 1] = np.random.default_rng(5).integers(-2, 2, len(system))
    return system


def test_rows_of_a_group_are_in_one_slab_and_one_cell(system):
    made = Deflation(system, TOLERANCE)
    slab = system.blocks.of_rows
    places = {(s, *c) for s, c in zip(slab.tolist(), system.cell.tolist(), strict=True)}
    for g in range(made.count):
        inside = made.group == g
        assert len(set(slab[inside])) == 1
        assert len({tuple(c) for c in system.cell[inside].tolist()}) == 1
    assert made.count == len(places) > 2 * len(set(slab))


def test_projection_leaves_no_sum_in_any_group(system):
    made = Deflation(system, TOLERANCE)
    z = members(made)
    r = np.random.default_rng(6).normal(size=len(system))
    left = r.copy()
    made.project(left)
    assert np.abs(z.T @ r).max() > 1.0
    np.testing.assert_allclose(z.T @ left, 0.0, atol=1e-12)
    a = as_matrix(system).toarray()
    dense = r - a @ z @ np.linalg.solve(z.T @ a @ z, z.T @ r)
    np.testing.assert_allclose(left, dense, rtol=1e-9, atol=1e-12)


def test_pressure_that_is_constant_in_each_group_is_found_at_once(system):
    made = Deflation(system, TOLERANCE)
    exact = np.random.default_rng(7).normal(size=made.count)[made.group]
    x = np.zeros(len(system))
    made.complete(x, as_matrix(system) @ exact)
    np.testing.assert_allclose(x, exact, rtol=1e-9)


@pytest.fixture
def nested(system, monkeypatch):
    """A deflation whose coarse system is solved by iterations, with a direct one below it."""
    system.cell[:, 0] = np.random.default_rng(8).integers(0, 9, len(system))
    monkeypatch.setattr(deflation, "WORK", 1e9)
    direct = Deflation(system, TOLERANCE)
    monkeypatch.setattr(deflation, "WORK", 8)
    made = Deflation(system, TOLERANCE)
    assert isinstance(direct.coarse, Band) and isinstance(made.coarse, Nested)
    return direct, made


def test_factor_is_cheap_at_the_level_that_is_solved_directly(nested, system):
    made, cost = nested[1], 8 * len(system)
    assert np.prod(nested[0].coarse.band.shape) * nested[0].coarse.band.shape[1] > cost
    while isinstance(made.coarse, Nested):
        below = made.coarse.deflation
        assert below.count < made.count
        made = below
    assert made.count * (made.coarse.band.shape[1] - 1) ** 2 <= cost


def test_nested_system_is_the_coarse_one(nested, system):
    z = members(nested[1])
    exact = z.T @ as_matrix(system).toarray() @ z
    np.testing.assert_allclose(
        as_matrix(nested[1].coarse.system).toarray(), exact, rtol=1e-12, atol=1e-12
    )


def test_nested_deflation_takes_out_what_a_direct_one_does(nested, system):
    b = np.random.default_rng(8).normal(size=len(system))
    p, q, left = b.copy(), [b.copy(), b.copy()], [b.copy(), b.copy()]
    products = []
    for made, at, r in zip(nested, q, left, strict=True):
        made.project(r)
        products.append(made.project_product(p, at))
    scale = np.linalg.norm(b)
    np.testing.assert_allclose(members(nested[1]).T @ left[1], 0.0, atol=TOLERANCE * scale)
    np.testing.assert_allclose(left[1], left[0], atol=TOLERANCE * scale)
    np.testing.assert_allclose(q[1], q[0], atol=TOLERANCE * scale)
    assert products[1] == pytest.approx(products[0], rel=1e-6)


def test_nested_deflation_needs_as_many_iterations(nested, system):
    reports, found = [], []
    for made in nested:
        x = np.zeros(len(system))
        reports.append(conjugate_gradient(
            system, x, by_diagonal(system), TOLERANCE, 500, deflation=made
        ))  # fmt: skip
        found.append(x)
    assert reports[1].converged
    assert abs(reports[1].iterations - reports[0].iterations) <= 1
    np.testing.assert_allclose(found[1], found[0], atol=1e-6 * np.abs(found[0]).max())


@pytest.mark.parametrize("tolerance, converged", [(TOLERANCE, False), (0.9, True)])
def test_a_coarse_solve_that_does_not_converge_is_reported(
    nested, system, monkeypatch, tolerance, converged
):
    """The residual is then that of x itself, which has a smooth part that CG does not see."""
    monkeypatch.setattr(deflation, "MOST", 1)
    x = np.zeros(len(system))
    report = conjugate_gradient(
        system, x, by_diagonal(system), tolerance, 500, deflation=nested[1]
    )
    left = np.linalg.norm(system.right - as_matrix(system) @ x) / np.linalg.norm(system.right)
    assert report.coarse > nested[1].coarse.tolerance
    assert report.residual == pytest.approx(left, rel=1e-6)
    assert report.converged == (left <= tolerance) == converged


def test_neighbours_around_a_periodic_tank_are_near_in_the_band():
    aside, up = np.meshgrid(np.arange(-3, 6), np.arange(4))
    cell = np.column_stack([aside.ravel(), up.ravel()])
    found, number = groups.number_groups([groups.keys(np.zeros(36, int), cell, 1)])
    place = number[np.searchsorted(found, groups.keys(np.zeros(36, int), cell, 1))]
    place = place.reshape(aside.shape)
    assert sorted(number) == list(range(36))
    assert np.abs(place - np.roll(place, 1, axis=1)).max() == 2
    assert np.abs(np.diff(place, axis=0)).max() == 9


@pytest.fixture
def towering(monkeypatch):
    """The system of a long layer of water with a tower in its middle, and a small budget."""
    x, y, z = np.meshgrid(np.arange(48), np.arange(3), np.arange(60), indexing="ij")
    there = (z < 4) | ((x > 20) & (x < 26))
    system, _ = system_by_slab(position=np.column_stack([x[there], y[there], z[there]]))
    monkeypatch.setattr(deflation, "WORK", 10)
    return system


def test_a_tower_of_water_does_not_make_the_band_wide(towering, monkeypatch):
    made = Deflation(towering, TOLERANCE)
    monkeypatch.setattr(deflation, "WORK", 1e9)
    usual = Deflation(towering, TOLERANCE)
    assert isinstance(made.coarse, Band)
    assert 2 * made.coarse.band.shape[1] < usual.coarse.band.shape[1]
    assert sorted(made.groups) == sorted(usual.groups)
    np.testing.assert_array_equal(made.groups[made.group], usual.groups[usual.group])
    r = np.random.default_rng(10).normal(size=len(towering))
    left = [r.copy(), r.copy()]
    made.project(left[0])
    usual.project(left[1])
    np.testing.assert_allclose(left[0], left[1], atol=1e-10)


def test_groups_keep_their_numbers_where_no_others_make_the_band_cheap(towering, monkeypatch):
    monkeypatch.setattr(deflation, "WORK", 0.5)
    made = Deflation(towering, TOLERANCE)
    assert isinstance(made.coarse, Nested)
    assert np.all(np.diff(made.groups // groups.SIDE**2) >= 0)


def test_banded_factor_solves_as_a_dense_one():
    n, half = 40, 6
    rng = np.random.default_rng(9)
    a = np.zeros((n, n))
    band = np.zeros((n, half + 1))
    for i in range(n):
        for j in range(max(0, i - half), i + 1):
            a[i, j] = a[j, i] = rng.normal() + 20.0 * (i == j)
            band[i, half + j - i] = a[i, j]
    inverse, y = np.empty(n), rng.normal(size=n)
    exact = np.linalg.solve(a, y)
    coarse.factorise(band, inverse)
    coarse.substitute(band, inverse, y)
    np.testing.assert_allclose(y, exact, rtol=1e-10)


def test_group_that_adds_nothing_is_left_out():
    """Two groups that are the same but for the sign: the second is no unknown of its own."""
    band, inverse = np.array([[0.0, 2.0], [-2.0, 2.0], [0.0, 4.0]]), np.empty(3)
    coarse.factorise(band, inverse)
    y = np.array([2.0, -2.0, 4.0])
    coarse.substitute(band, inverse, y)
    np.testing.assert_allclose(y, [1.0, 0.0, 1.0])


def test_deflation_saves_most_of_the_iterations():
    reports = []
    for solver in (scg, deflated):
        system, _ = system_by_slab(48, 12)
        reports.append(solver.solve(system, np.zeros(len(system)), 1e-8, 500))
    assert all(r.converged for r in reports)
    assert reports[1].iterations < 0.5 * reports[0].iterations
