"""Gauges and probes on particles whose surface and fields are known."""

import numpy as np
import pytest

from mpslab.core.gauges import probe, surface_elevation
from mpslab.core.particles import FACE, FILLER, FLUID

D0 = 0.002
TOP = 20 * D0
X = np.linspace(0.0, 3 * D0, 7)


def lattice(nx, ny, nz, x0=0):
    """Cell centres; y = 0 for ny = 0 (2-D)."""
    x, y, z = np.meshgrid(
        x0 + np.arange(nx) + 0.5, np.arange(max(ny, 1)) + 0.5, np.arange(nz) + 0.5, indexing="ij"
    )
    return D0 * np.stack([x, y if ny else 0 * y, z], axis=-1).reshape(-1, 3)


def still_water(ny=0):
    return lattice(40, ny, 20, x0=-20)


def elevation(position, x=0.0, y=0.0, role=None, width=0.0):
    role = np.zeros(len(position), np.int8) if role is None else role
    return surface_elevation(position, role, D0, x, y, width)


@pytest.mark.parametrize("ny", [0, 8])
@pytest.mark.parametrize("offset", [0.0, 0.13, 0.5, 0.77])
def test_flat_surface_at_any_offset(ny, offset):
    position = still_water(ny) + np.array([0.0, 0.0, offset * D0])
    for x in X:
        y = 4 * D0 + x
        assert elevation(position, x, y) == pytest.approx(TOP + offset * D0, abs=0.01 * D0)


def test_periodic_width_sees_the_other_side():
    position = still_water(8)
    assert elevation(position, y=0.0, width=8 * D0) == pytest.approx(TOP, abs=0.01 * D0)
    assert elevation(position, y=0.0) != pytest.approx(TOP, abs=0.1 * D0)


def test_sinusoidal_surface():
    length, amplitude = 100 * D0, 5 * D0
    position = lattice(200, 0, 20, x0=-100)

    def surface(x):
        return TOP + amplitude * np.sin(2 * np.pi * x / length)

    # A shear: the surface bends, and each particle keeps its volume.
    position[:, 2] += surface(position[:, 0]) - TOP
    x = np.linspace(-40 * D0, 40 * D0, 57)
    found = np.array([elevation(position, place) for place in x])
    assert np.abs(found - surface(x)).max() < 0.1 * D0


def test_level_is_smooth_while_particles_pass():
    """A rough sheet drifts below the gauge: steps of a hundredth of a spacing, no jumps."""
    rng = np.random.default_rng(2)
    position = still_water()
    position[:, [0, 2]] += rng.uniform(-0.1, 0.1, (len(position), 2)) * D0
    drift = np.outer(np.arange(0, 5, 0.01), [D0, 0, 0])
    found = np.array([elevation(position + s) for s in drift])
    assert np.abs(found - TOP).max() < 0.4 * D0
    assert found.std() < 0.1 * D0
    assert np.abs(np.diff(found)).max() < 0.01 * D0


@pytest.mark.parametrize("layers", [1, 2, 3])
def test_thin_layer_on_a_wall(layers):
    water = lattice(40, 0, layers, x0=-20)
    wall = lattice(40, 0, 3, x0=-20) - [0, 0, 3 * D0]
    role = np.repeat([FLUID, FACE], [len(water), len(wall)])
    found = elevation(np.concatenate([water, wall]), 0.3 * D0, role=role)
    assert found == pytest.approx(layers * D0, abs=0.01 * D0)


@pytest.mark.parametrize("distance", [0.0, 0.4, 1.0])
def test_gauge_beside_a_vertical_wall(distance):
    water = lattice(40, 0, 20)
    wall = lattice(3, 0, 60, x0=-3)
    role = np.repeat([FLUID, FACE], [len(water), len(wall)])
    found = elevation(np.concatenate([water, wall]), distance * D0, role=role)
    assert found == pytest.approx(TOP, abs=0.02 * D0)


def test_spray_and_overhanging_jet_do_not_count():
    spray = np.array([[0.0, 0.0, TOP + 3 * D0]])
    jet = lattice(10, 0, 4, x0=-5) + np.array([0, 0, TOP + 3 * D0])
    for extra in (spray, jet):
        found = elevation(np.concatenate([still_water(), extra]))
        assert found == pytest.approx(TOP, abs=0.01 * D0)


def test_small_bubble_does_not_end_the_column():
    position = still_water()
    bubble = (np.abs(position[:, 0]) < D0) & (np.abs(position[:, 2] - 10.5 * D0) < 0.1 * D0)
    assert bubble.sum() == 2
    assert elevation(position[~bubble]) == pytest.approx(TOP, abs=0.01 * D0)


def test_dry_place_is_nan():
    water = still_water()
    wall = np.repeat(lattice(20, 0, 3, x0=30), 2, axis=0)
    position = np.concatenate([water, wall, [[40 * D0, 0.0, 9 * D0]]])
    role = np.repeat([FLUID, FILLER, FLUID], [len(water), len(wall), 1])
    assert np.isnan(elevation(position, 25 * D0, role=role))
    assert np.isnan(elevation(position, 35 * D0, role=role))
    assert np.isnan(elevation(position, 40 * D0, role=role)), "a falling drop is not the surface"


def disordered(ny):
    """Water over a wall, with jitter, and linear fields."""
    water = lattice(30, ny, 20, x0=-15)
    wall = lattice(30, ny, 1, x0=-15) - [0, 0, D0]
    position = np.concatenate([water, wall])
    jitter = np.random.default_rng(3).uniform(-0.1, 0.1, position.shape) * D0
    position += jitter if ny else jitter * [1, 0, 1]
    role = np.repeat([FLUID, FACE], [len(water), len(wall)])
    pressure = 9810 * (TOP - position[:, 2]) + 3000 * position[:, 0] + 7 * position[:, 1]
    velocity = position @ np.array([[1.0, 0.2, 3.0], [0.1, 0.0, 0.5], [2.0, 1.0, -1.0]]) + 0.1
    return position, velocity, pressure, role


@pytest.mark.parametrize("ny", [0, 8])
@pytest.mark.parametrize("z", [0.0, 0.4, 5.25, 10.0])
def test_linear_fields_come_back(ny, z):
    position, velocity, pressure, role = disordered(ny)
    y = 4.2 * D0 if ny else 0.0
    point = np.array([1.3 * D0, y, z * D0])
    p, *u = probe(position, velocity, pressure, role, D0, point)
    assert p == pytest.approx(9810 * (TOP - z * D0) + 3000 * point[0] + 7 * y, rel=0.001)
    expected = point @ np.array([[1.0, 0.2, 3.0], [0.1, 0.0, 0.5], [2.0, 1.0, -1.0]]) + 0.1
    np.testing.assert_allclose(u, expected, rtol=0.01)


def test_wall_velocity_does_not_enter():
    position, velocity, pressure, role = disordered(0)
    velocity[role == FACE] = 1e6
    assert np.abs(probe(position, velocity, pressure, role, D0, (0, 0, 0))[1:]).max() < 1.0


def test_probe_across_the_period():
    position, velocity, pressure, role = disordered(8)
    pressure[:] = position[:, 1] > 4 * D0
    middle = probe(position, velocity, pressure, role, D0, (0, 8 * D0, 10 * D0), 8 * D0)[0]
    assert 0.2 < middle < 0.8
    assert probe(position, velocity, pressure, role, D0, (0, 8 * D0, 10 * D0))[0] > 0.99


def test_probe_without_neighbours_is_nan():
    position, velocity, pressure, role = disordered(0)
    far = (0.0, 0.0, TOP + 4 * D0)
    assert np.isnan(probe(position, velocity, pressure, role, D0, far)).all()


def test_probe_on_a_dry_wall_reads_the_wall_pressure():
    wall = lattice(10, 0, 1)
    pressure = np.full(10, 2.5)
    found = probe(wall, 0 * wall, pressure, np.full(10, FACE), D0, (5 * D0, 0, D0))
    assert found[0] == pytest.approx(2.5)
    assert np.isnan(found[1:]).all()


def test_single_particle_gives_its_own_values():
    position, velocity = np.zeros((1, 3)), np.array([[1.0, 2.0, 3.0]])
    found = probe(position, velocity, np.array([5.0]), np.array([FLUID]), D0, (D0, 0, 0))
    np.testing.assert_allclose(found, [5.0, 1.0, 2.0, 3.0])


@pytest.mark.parametrize("ny", [0, 8])
@pytest.mark.parametrize("above", [0.55, 1.0, 1.5, 2.5, 9.0])
def test_probe_in_the_air_above_the_water_is_nan(ny, above):
    position, velocity, pressure, role = disordered(ny)
    position = position.round(12)
    point = (0.3 * D0, 4.2 * D0 if ny else 0.0, TOP + (above + 0.1) * D0)
    assert np.isnan(probe(position, velocity, pressure, role, D0, point)).all()


@pytest.mark.parametrize("place", [0.0, 0.25, 0.5])
def test_probe_on_the_surface_of_still_water_reads_next_to_nothing(place):
    position = still_water()
    pressure = 9810 * (TOP - position[:, 2])
    role = np.zeros(len(position), np.int8)
    found = probe(position, 0 * position, pressure, role, D0, (place * D0, 0.0, TOP))
    np.testing.assert_allclose(found, 0.0, atol=1e-6)


@pytest.mark.parametrize("above", [1.0, 1.5, 3.0])
def test_probe_on_the_wall_above_the_water_reads_the_dry_wall(above):
    water, wall = lattice(40, 0, 20), lattice(1, 0, 60, x0=-1)
    position = np.concatenate([water, wall])
    role = np.repeat([FLUID, FACE], [len(water), len(wall)])
    pressure = np.maximum(9810 * (TOP - position[:, 2]), 0.0)
    for off in (-0.5, 0.0, 0.5):  # the wall as it is laid, from where the case has it
        point = (off * D0, 0.0, TOP + above * D0)
        found = probe(position, 0 * position, pressure, role, D0, point)
        assert found[0] == 0.0
        assert np.isnan(found[1:]).all()
