"""Slabs of the tank, and the red-black order of PICCG-RP on them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tanks import flow_of, make_case, near_of, particles_at, run
from test_solvers import as_matrix, dense_factor

from mpslab.core.stencil import make_stencil
from mpslab.models.laplacians.standard import pair_terms
from mpslab.parallel.domain import Domain
from mpslab.parallel.slabs import make_slabs
from mpslab.pressure import equation
from mpslab.pressure.solvers import iccg, piccg, scg

RADIUS = 2.1
TANK = {"tank.width": 0.016, "tank.periodic": True, "particles.jitter": 0.01}


def system_by_slab(long=24, high=5, by_slab=True, position=None):
    """Shaken block of water, or other places (n, 3), in slabs along x, its top free surface."""
    if position is None:
        grid = np.meshgrid(*map(np.arange, (long, high, high)), indexing="ij")
        position = np.stack(grid, axis=-1).reshape(-1, 3)
    position = position + np.random.default_rng(1).uniform(-0.1, 0.1, position.shape)
    particles = particles_at(position)
    particles.surface[:] = position[:, 2] > position[:, 2].max() - 0.5
    stencil = make_stencil(3, 1.0, RADIUS)
    domain = Domain(make_slabs(position[:, 0].min(), position[:, 0].max(), RADIUS))
    particles, _ = domain.share_out(particles)
    source = np.random.default_rng(2).normal(size=len(particles))

    return equation.assemble(
        near_of(particles, 3, RADIUS), stencil, pair_terms(stencil), 1000.0, source,
        domain=domain if by_slab else None,
    )  # fmt: skip


@given(st.floats(-1, 1), st.floats(0.1, 3), st.floats(0.01, 1), st.integers(0, 10**6))
def test_places_two_slabs_apart_share_no_neighbour(lower, length, radius, seed):
    slabs = make_slabs(lower, lower + length, radius)
    x = np.random.default_rng(seed).uniform(lower - 1, lower + length + 1, 60)
    near = np.abs(x[:, None] - x) < 2 * radius
    slab = slabs.of(x)
    assert np.abs(slab[:, None] - slab)[near].max() <= 1
    assert 0 <= slab.min() <= slab.max() < slabs.count


def test_places_outside_and_places_that_are_no_numbers_have_a_slab():
    slab = make_slabs(0.0, 1.0, 0.1).of([-5.0, np.nan, 7.0, np.inf, -np.inf])
    assert list(slab) == [0, 0, 3, 3, 0]


def test_rows_of_a_slab_follow_one_another_in_the_order_of_the_particles():
    (system, rows), (_, others) = system_by_slab(), system_by_slab(by_slab=False)
    assert list(rows) == list(others)
    assert np.all(np.diff(rows) > 0)
    assert len(system.blocks) == 5
    slab, row = system.blocks.of_rows, np.diff(system.row)
    assert np.abs(slab.repeat(row) - slab[system.column]).max() == 1


def red_black(system):
    """Rows in the order of the elimination."""
    slab = system.blocks.of_rows
    return np.lexsort((np.arange(len(system)), slab, slab % 2))


def test_factor_is_that_of_the_whole_matrix_in_red_black_order():
    system, _ = system_by_slab()
    order = red_black(system)
    assert np.any(np.diff(order) < 0)
    a = as_matrix(system).toarray()[np.ix_(order, order)]
    unit, d = dense_factor(a)
    factor, found = piccg.Factor(system), np.eye(len(system))
    for i, (begin, end) in enumerate(zip(factor.lower[:-1], factor.lower[1:], strict=True)):
        found[i, factor.left[begin:end]] = factor.factor[begin:end]
    assert np.count_nonzero(unit) == np.count_nonzero(found)
    np.testing.assert_allclose(found[np.ix_(order, order)], unit, rtol=1e-10, atol=1e-14)
    np.testing.assert_allclose(1.0 / factor.pivot[order], d, rtol=1e-10)
    assert factor.replaced == 0


def test_substitution_inverts_the_red_black_factor():
    system, _ = system_by_slab()
    order = red_black(system)
    unit, d = dense_factor(as_matrix(system).toarray()[np.ix_(order, order)])
    r, z = np.random.default_rng(9).normal(size=len(system)), np.empty(len(system))
    piccg.Factor(system).substitute(r, z)
    np.testing.assert_allclose(unit @ (d * (unit.T @ z[order])), r[order], rtol=1e-9, atol=1e-9)


def test_piccg_in_one_slab_is_iccg_to_the_last_bit():
    system, _ = system_by_slab(by_slab=False)
    one, other = np.zeros(len(system)), np.zeros(len(system))
    reports = iccg.solve(system, one, 1e-8, 500), piccg.solve(system, other, 1e-8, 500)
    assert reports[0] == reports[1]
    assert one.tobytes() == other.tobytes()


def test_piccg_needs_few_more_iterations_than_iccg_and_far_fewer_than_scg():
    iterations = {}
    for solver in (iccg, piccg, scg):
        system, _ = system_by_slab(48, 12, by_slab=solver.BY_SLAB)
        report = solver.solve(system, np.zeros(len(system)), 1e-8, 500)
        assert report.converged
        iterations[solver] = report.iterations
    assert iterations[piccg] < 1.25 * iterations[iccg]
    assert iterations[scg] > 1.8 * iterations[piccg]


@pytest.mark.parametrize("solver", ["scg", "piccg", "deflated"])
def test_all_solvers_lead_to_the_same_flow(solver):
    tight = {**TANK, "scheme.tolerance": 1e-11}
    one = run(flow_of(make_case({**tight, "scheme.solver": "iccg"})), 5, 2e-4).particles
    other = run(flow_of(make_case({**tight, "scheme.solver": solver})), 5, 2e-4).particles
    np.testing.assert_allclose(one.position, other.position, atol=1e-9)
    np.testing.assert_allclose(one.velocity, other.velocity, atol=1e-6)


@pytest.mark.parametrize("solver", [iccg, piccg])
def test_factor_does_not_depend_on_the_order_of_the_entries_in_a_row(solver):
    """Lists that put water before solids give rows whose columns do not ascend."""
    answers = []
    for shuffled in (False, True):
        system, _ = system_by_slab(by_slab=solver.BY_SLAB)
        if shuffled:
            for a, b in zip(system.row[:-1], system.row[1:], strict=True):
                order = a + np.random.default_rng(a).permutation(b - a)
                system.column[a:b] = system.column[order]
                system.value[a:b] = system.value[order]
        x = np.zeros(len(system))
        answers.append((solver.solve(system, x, 1e-8, 500), x.tobytes()))
    assert answers[0] == answers[1]
