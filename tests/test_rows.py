"""Compiled loops that pick, take or change rows of particles, against numpy."""


import numpy as np
import pytest
from tanks import make_case, particles_at

from mpslab.core.particles import FACE, FILLER, FLUID, add_where, put_where, squares
from mpslab.instruments import _near
from mpslab.kernels import density, vectors
from mpslab.run import guard

RANDOM = np.random.default_rng(7)
N = 500


def some(n=N):
    return RANDOM.normal(size=(n, 3))


def test_vectors_are_taken_and_padded():
    v, order = some(), RANDOM.permutation(N).astype(np.int32)
    taken, padded = np.empty((N, 3)), np.full((N, 4), np.nan)
    vectors.take(v, order, taken)
    vectors.pad(v, padded)
    np.testing.assert_array_equal(taken, v[order])
    np.testing.assert_array_equal(padded, np.column_stack([v, np.zeros(N)]))


@pytest.mark.parametrize("change", [some(), np.array([0.0, 0.5, -9.81]), np.asfortranarray(some())])
def test_changes_are_added_where_the_mask_says_so(change):
    v, mask = some(), RANDOM.random(N) < 0.3
    expected = np.where(mask[:, None], v + change, v)
    add_where(mask, v, change)
    np.testing.assert_array_equal(v, expected)


def test_vectors_are_put_where_the_mask_says_so():
    v, others, mask = some(), some(), RANDOM.random(N) < 0.3
    expected = np.where(mask[:, None], others, v)
    put_where(mask, v, others)
    np.testing.assert_array_equal(v, expected)


def test_squares_are_those_of_the_lengths():
    v = some()
    np.testing.assert_allclose(squares(v), np.linalg.norm(v, axis=1) ** 2, rtol=1e-14)


@pytest.mark.parametrize("places", [[0.3], [2.0, 0.1, 0.15, 3.0], [0.0, 0.2, 0.4]])
def test_particles_near_places_are_found_once_each(places):
    particles = particles_at(RANDOM.uniform(0.0, 4.0, (N, 3)))
    found = _near.within(particles, places, 0.11)
    far = np.abs(particles.position[:, :1] - np.array(places)).min(axis=1)
    np.testing.assert_array_equal(found, np.flatnonzero(far < 0.11))


@pytest.mark.parametrize("width", [0.0, 1.0])
@pytest.mark.parametrize("reach", [(0.2, 0.2, 0.2), (0.1, 0.3, np.inf), (0.3, np.inf, np.inf)])
def test_particles_beside_points_are_found_once_each(reach, width):
    particles = particles_at(RANDOM.uniform(0.0, 1.0, (N, 3)))
    points = [(0.3, 0.05, 0.5), (0.35, 0.1, 0.6), (0.9, 0.5, 0.0)]
    found = _near.beside(particles, points, reach, width)
    apart = np.abs(particles.position[:, np.newaxis] - points)
    if width:
        apart[..., 1] = np.minimum(apart[..., 1], width - apart[..., 1])
    np.testing.assert_array_equal(found, np.flatnonzero((apart < reach).all(axis=2).any(axis=1)))


@pytest.mark.parametrize("bed", [[], [[0.0, 0.0], [0.01, 0.0], [0.03, 0.01], [0.04, 0.003]]])
@pytest.mark.parametrize("width", [0.0, 0.02])
def test_all_that_is_outside_is_looked_at_and_little_else(bed, width):
    case = make_case({"tank.bed": bed, "tank.width": width})
    place = RANDOM.uniform(-0.005, 0.05, (4000, 3))
    particles = particles_at(place, RANDOM.choice([FLUID, FACE, FILLER], 4000))
    x, y, z = place.T
    slack = 1e-9
    inside = (x >= slack) & (x <= 0.04 - slack) & (z >= case.tank.bed_height(x) + slack)
    if width:
        inside &= (y >= slack) & (y <= 0.02 - slack)
    rows = guard._may_be_lost(case, particles, 0.0)
    fluid = particles.fluid
    assert set(np.flatnonzero(fluid & ~inside)) >= set(rows)
    lost = {row for lost in guard.find_lost(case, particles, 0.0) for row in lost.rows}
    assert lost and lost <= set(rows)
    below = z < case.tank.bed_height(x) - case.particles.spacing - slack
    assert set(np.flatnonzero(fluid & below)) <= lost


def test_thin_and_lopsided_water_is_found_and_no_solids():
    first = np.column_stack([0.1 * some(), RANDOM.uniform(0.0, 2.0, N)])
    first[0] = 0.0
    first[1] = np.nan
    role = RANDOM.choice([FLUID, FACE], N).astype(np.int8)
    role[:2] = FLUID
    rows = np.empty(N, np.int32)
    found = rows[: density.thin_or_lopsided(role, first, 0.8, 0.1, rows)]
    length = np.linalg.norm(first[:, :3], axis=1)
    even = (first[:, 3] >= 0.8) & (length <= 0.1 * first[:, 3])
    np.testing.assert_array_equal(found, np.flatnonzero((role == FLUID) & ~even))
