"""The neighbour list against a comparison of all pairs.

Random clouds sit on a grid of 1/16 and radii and widths are multiples of it, so that every
distance is exact in floating point: particles on cell faces, coincident particles and pairs
exactly at the radius come up all the time, and must be treated as the definition says.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tanks import neighbors_of

from mpslab.core.cells import make_cells
from mpslab.core.neighbors import NeighborList

GRID = 1.0 / 16.0
EXAMPLES = settings(max_examples=150, deadline=None, derandomize=True, database=None)


def brute_force(position, radius, width=0.0, active=None):
    """Rows of the neighbour list by comparison of all pairs, nearest image across y."""
    apart = position[None] - position[:, None]
    if width > 0.0:
        apart[..., 1] -= width * np.round(apart[..., 1] / width)
    near = (apart**2).sum(axis=-1) < radius**2
    np.fill_diagonal(near, False)
    if active is not None:
        near &= active[:, None]
    return [np.flatnonzero(row) for row in near]


def rows(found):
    return [found.indices[a:b] for a, b in zip(found.indptr[:-1], found.indptr[1:], strict=True)]


def assert_same_rows(found, expected):
    assert len(found.indptr) == len(expected) + 1
    assert found.indptr[-1] == len(found.indices)
    for row, wanted in zip(rows(found), expected, strict=True):
        np.testing.assert_array_equal(row, wanted)


@st.composite
def clouds(draw, dim, periodic=False):
    """Positions on the grid, radius and width; periodic tanks of 1 to 5 cells across."""
    radius = draw(st.integers(4, 48))
    width = draw(st.integers(radius, 5 * radius)) if periodic else 0
    across = st.integers(-2, width + 2) if periodic else st.integers(0, 128)
    across = across if dim == 3 else st.just(0)
    point = st.tuples(st.integers(-64, 128), across, st.integers(0, 96))
    points = draw(st.lists(point, max_size=60))
    position = GRID * np.array(points, float).reshape(-1, 3)
    return position, GRID * radius, GRID * width


@EXAMPLES
@given(clouds(2))
def test_rows_equal_brute_force_in_2d(drawn):
    position, radius, _ = drawn
    assert_same_rows(neighbors_of(position, radius), brute_force(position, radius))


@EXAMPLES
@given(clouds(3))
def test_rows_equal_brute_force_in_3d(drawn):
    position, radius, _ = drawn
    assert_same_rows(neighbors_of(position, radius), brute_force(position, radius))


@EXAMPLES
@given(clouds(3, periodic=True))
def test_rows_equal_brute_force_with_periodic_width(drawn):
    position, radius, width = drawn
    assert_same_rows(neighbors_of(position, radius, width), brute_force(*drawn))


@pytest.mark.parametrize("cells", [1, 2, 3, 4])
def test_narrow_periodic_tank_lists_each_neighbour_once(cells):
    random = np.random.default_rng(cells)
    radius, width = 1.0, cells * 1.0 + 0.25
    position = random.uniform(0.0, 1.0, (300, 3)) * [4.0, width, 4.0]
    found = neighbors_of(position, radius, width)
    assert_same_rows(found, brute_force(position, radius, width))


@pytest.mark.parametrize("y", [-0.125, 4.125])
def test_particle_a_little_outside_the_period_has_all_its_neighbours(y):
    """Predicted positions are not folded back; the cells are exactly as wide as the radius."""
    line = np.arange(0.0, 4.0, 0.0625)
    position = np.column_stack([0.0 * line, line, 0.0 * line])
    position = np.vstack([position, [[0.0, y, 0.0625], [3.0, y, 3.0]]])
    assert_same_rows(neighbors_of(position, 1.0, 4.0), brute_force(position, 1.0, 4.0))


@EXAMPLES
@given(clouds(3, periodic=True), st.randoms(use_true_random=False))
def test_inactive_rows_are_empty_and_the_others_unchanged(drawn, random):
    position, radius, width = drawn
    active = np.array([random.random() < 0.6 for _ in position], bool)
    found = neighbors_of(position, radius, width, active)
    assert_same_rows(found, brute_force(position, radius, width, active))


@EXAMPLES
@given(clouds(3, periodic=True))
def test_rows_ascend_and_the_relation_is_symmetric(drawn):
    position, radius, width = drawn
    found = neighbors_of(position, radius, width)
    pairs = {(i, j) for i, row in enumerate(rows(found)) for j in row.tolist()}
    assert pairs == {(j, i) for i, j in pairs}
    assert all(np.all(np.diff(row) > 0) for row in rows(found))


@EXAMPLES
@given(clouds(3, periodic=True), st.randoms(use_true_random=False))
def test_rows_do_not_depend_on_whether_particles_lie_in_the_order_of_their_cells(drawn, random):
    position, radius, width = drawn
    active = np.array([random.random() < 0.6 for _ in position], bool)
    cells = make_cells([0.0] * 3, [4.0, 6.0, 3.0], radius, width)
    order = cells.order(position, np.arange(len(position)))
    found = neighbors_of(position, radius, width, active)
    by_cell = NeighborList().build(position[order], radius, width, active[order], cells)
    assert all(np.all(np.diff(row) > 0) for row in rows(by_cell))
    for row, i in zip(rows(by_cell), order, strict=True):
        np.testing.assert_array_equal(np.sort(order[row]), rows(found)[i])


def test_no_particles():
    found = neighbors_of(np.zeros((0, 3)), 1.0)
    assert found.indptr.tolist() == [0]
    assert len(found.indices) == 0


@pytest.mark.parametrize("width", [0.0, 0.5, 3.0])
def test_one_particle_is_not_its_own_neighbour(width):
    found = neighbors_of(np.full((1, 3), 0.25), 1.0, width)
    assert found.indptr.tolist() == [0, 0]
    assert len(found.indices) == 0


def test_coincident_particles_are_neighbours_of_each_other():
    found = neighbors_of(np.ones((3, 3)), 1.0)
    assert_same_rows(found, [[1, 2], [0, 2], [0, 1]])


def test_pair_exactly_at_the_radius_is_left_out():
    position = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.875]])
    assert_same_rows(neighbors_of(position, 1.0), [[], [2], [1]])


@pytest.mark.parametrize("dim", [2, 3])
def test_lattice_with_every_particle_on_a_cell_face(dim):
    line = np.arange(7.0)
    across = line if dim == 3 else np.zeros(1)
    position = np.stack(np.meshgrid(line, across, line), axis=-1).reshape(-1, 3)
    assert_same_rows(neighbors_of(position, 1.0), brute_force(position, 1.0))
    assert_same_rows(neighbors_of(position, 1.5), brute_force(position, 1.5))


def test_list_can_be_built_again_for_more_and_for_fewer_particles():
    random = np.random.default_rng(5)
    found = NeighborList()
    for n in (40, 500, 3, 0, 200):
        position = random.uniform(0.0, 3.0, (n, 3))
        assert_same_rows(found.build(position, 1.0), brute_force(position, 1.0))


@pytest.mark.parametrize("far", [1e4, 1e7, 1e12])
def test_particle_far_away_does_not_fill_the_memory(far):
    """A runaway particle stretches the grid of cells; across, the period must stay whole."""
    random = np.random.default_rng(6)
    width = 5.0
    position = random.uniform(0.0, 1.0, (200, 3)) * [4.0, width, 4.0]
    position[7] = [far, 2.0, far]
    found = neighbors_of(position, 1.0, width)
    assert_same_rows(found, brute_force(position, 1.0, width))
