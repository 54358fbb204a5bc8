"""Walls whose layers behind the first one have a copy of its pressure."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tanks import CLASSIC, flow_of, lattice, make_case, near_of, run

from mpslab.core.particles import FACE, FILLER, FLUID, make_particles
from mpslab.models import copied

LAYERS = np.array([FLUID, FACE, FILLER, FILLER, FILLER, FILLER])


def bed(dim):
    """Water above a bed of one layer of faces and four of fillers, shaken, spacing 1."""
    position = lattice(dim, 5)
    role = LAYERS[np.maximum(-position[:, 2].astype(int), 0)]
    shake = np.random.default_rng(3).uniform(-0.2, 0.2, position.shape)
    particles = make_particles(position + shake * [1.0, dim - 2.0, 1.0], role)
    particles.pressure[:] = np.where(role == FILLER, 0.0, np.arange(1.0, len(role) + 1.0))
    return particles


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("width", [0.0, 11.0])
def test_fillers_have_the_pressure_of_the_nearest_face(dim, width):
    """Found by brute force, across a period too; fillers too far from any face stay as they are."""
    particles = bed(dim)
    before, role = particles.pressure.copy(), particles.role
    faces = np.flatnonzero(role == FACE)
    copies = [-width, 0.0, width] if width else [0.0]
    places = np.vstack([particles.position[faces] + [0.0, y, 0.0] for y in copies])
    distance, nearest = cKDTree(places).query(particles.position)
    reached = (role == FILLER) & (distance < 3.1)
    loaded = copied.fill(near_of(particles, dim, 3.1, width))
    assert 0 < np.count_nonzero(reached) < np.count_nonzero(role == FILLER)
    np.testing.assert_array_equal(loaded, (role != FILLER) | reached)
    expected = np.where(reached, before[faces[nearest % len(faces)]], before)
    np.testing.assert_array_equal(particles.pressure, expected)


WIDE = {"scheme.gradient": "symmetric", "scheme.gradient_radius": 3.1, "scheme.walls": "copied"}


def test_copies_hold_up_water_that_sees_three_layers_of_a_bed():
    """The bed carries the weight of the water; without copies it would be 1.24 times as much."""
    tank = {"tank.length": 0.03, "tank.depth": 0.04, "particles.jitter": 0.001}
    flow = flow_of(make_case({**tank, **CLASSIC, **WIDE}))
    mean = []
    for _ in range(150):
        run(flow, 1, 4e-4)
        x, z = flow.particles.position[:, 0], flow.particles.position[:, 2]
        low = (flow.particles.role == FACE) & (z < 0.0) & (x > 0.0) & (x < 0.03)
        mean.append(flow.particles.pressure[low].mean())
    assert np.mean(mean[50:]) == pytest.approx(1000.0 * 9.81 * 0.041, rel=0.05)
