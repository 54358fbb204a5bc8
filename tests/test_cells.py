"""The order of particles by cell: near in memory what is near, the same on any ranks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tanks import flow_of, make_case, run

from mpslab.core.cells import make_cells
from mpslab.parallel.slabs import make_slabs

EXAMPLES = settings(max_examples=100, deadline=None, derandomize=True, database=None)


def cells_of(lower, length, radius, width=0.0):
    slabs = make_slabs(lower, lower + length, radius)
    return slabs, make_cells([lower, 0.0, 0.0], [lower + length, 0.0, 1.0], radius, width, slabs)


def by_cell_and_gid(cells, position, gid):
    """The order as the definition has it."""
    cell = np.floor((position - cells.lower) * cells.per)
    cell = np.clip(cell, 0, cells.count - 1)
    return np.lexsort((gid, cell[:, 2], cell[:, 1], cell[:, 0]))


@EXAMPLES
@given(st.booleans(), st.integers(0, 10**6))
def test_near_finds_all_that_are_within_a_radius_and_few_far_away(periodic, seed):
    radius, width = 0.1, 0.43
    _, cells = cells_of(0.0, 2.0, radius, width if periodic else 0.0)
    random = np.random.default_rng(seed)
    position = random.uniform([-0.1, 0.0, -0.1], [2.1, width, 1.1], (300, 3))
    others = np.arange(300) < 5
    ones = random.random(300) < 0.7
    gap = np.abs(position[:, np.newaxis] - position[others])
    if periodic:
        gap[..., 1] = np.minimum(gap[..., 1], width - gap[..., 1])
    within = np.linalg.norm(gap, axis=2).min(axis=1) < radius
    found = cells.near(position, ones, others)
    assert not np.any(found & ~ones)
    assert np.all(found[ones & within])
    far = np.abs(position[:, np.newaxis, 0] - position[others, 0]).min(axis=1) > 6 * radius
    assert not np.any(found[far])


@EXAMPLES
@given(st.floats(-1, 1), st.floats(0.2, 3), st.integers(0, 10**6))
def test_order_is_by_slab_then_by_cell_then_by_gid(lower, length, seed):
    slabs, cells = cells_of(lower, length, 0.1)
    random = np.random.default_rng(seed)
    position = random.uniform(lower - 0.2, lower + length + 0.2, (200, 3))
    position[::3, 0] = lower + random.integers(0, slabs.count + 1, 67) * slabs.width
    position[:, 1:] = random.uniform(-0.1, 1.1, (200, 2))
    gid = random.permutation(200)
    order = cells.order(position, gid)
    assert np.all(np.diff(slabs.of(position[order, 0])) >= 0)
    np.testing.assert_array_equal(order, by_cell_and_gid(cells, position, gid))


@EXAMPLES
@given(st.integers(0, 10**6))
def test_some_of_the_particles_are_in_the_order_that_they_have_among_all(seed):
    random = np.random.default_rng(seed)
    _, cells = cells_of(0.0, 2.0, 0.1)
    position, gid = random.uniform(0.0, 2.0, (300, 3)), random.permutation(300)
    some = random.random(300) < 0.3
    some[position[:, 0] > random.uniform(0.5, 2.0)] = False
    among_all = cells.order(position, gid)
    among_all = among_all[some[among_all]]
    alone = np.flatnonzero(some)[cells.order(position[some], gid[some])]
    np.testing.assert_array_equal(alone, among_all)


def test_places_that_are_no_numbers_and_places_far_outside_have_a_cell():
    _, cells = cells_of(0.0, 1.0, 0.1)
    far = [[np.nan] * 3, [np.inf, 0.0, -np.inf], [-1e300, np.nan, 1e300], [0.5, 0.0, 0.5]]
    order = cells.order(np.array(far), np.arange(4))
    assert sorted(order) == [0, 1, 2, 3]
    assert order[-1] == 1


def test_cells_of_a_huge_tank_do_not_fill_the_memory():
    slabs = make_slabs(0.0, 100.0, 0.01)
    cells = make_cells([0.0] * 3, [100.0, 10.0, 1000.0], 0.01, 0.0, slabs)
    assert cells.count.prod(dtype=float) < 2**25
    assert np.all(cells.reach(0.01) >= 1)


@pytest.mark.parametrize("seed", [1, 2])
def test_steps_do_not_depend_on_the_order_in_which_particles_lie_before(seed):
    """A run that resumes has them in the order of gid, one that goes on in that of the cells."""
    case = make_case({"particles.jitter": 0.05})
    straight, shuffled = flow_of(case), flow_of(case)
    for _ in range(4):
        order = np.random.default_rng(seed).permutation(len(shuffled.particles))
        shuffled.particles = shuffled.domain.keep(shuffled.particles, order)
        run(straight, 1, 2e-4)
        run(shuffled, 1, 2e-4)
    for name, array in vars(straight.particles).items():
        assert array.tobytes() == getattr(shuffled.particles, name).tobytes(), name
