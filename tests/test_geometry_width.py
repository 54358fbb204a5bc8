"""The initial particles of tanks with a width, of boxes of water, and their numbering."""

import numpy as np
import pytest
from tanks import SINGLE, closest, make_case, number_density_over_n0

from mpslab.core import bed as beds
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.solids import layout

D0 = 0.002


def walled(**changes):
    """Small 3-D tank between side walls, 10 rows wide, without jitter."""
    tank = {"tank.length": 0.02, "tank.depth": 0.012, "tank.width": 0.02, "tank.periodic": False}
    case = make_case({**tank, **changes})
    return case, layout.build_particles(case)


def test_side_walls_close_the_tank():
    case, particles = walled()
    n = number_density_over_n0(case, particles)
    below = particles.fluid & (particles.position[:, 2] < 0.012 - 2.0 * D0)
    np.testing.assert_allclose(n[below], 1.0, rtol=SINGLE)
    assert closest(particles.position) > 0.999 * D0


def test_side_walls_are_one_layer_of_walls_and_dummies_behind():
    _, particles = walled()
    x, y, z = particles.position.T
    over = (z > 0.0) & (x > 0.0) & (x < 0.02)
    outside = np.maximum(-y, y - 0.02) / D0
    assert np.all(particles.role[over & (outside < 0.0)] == FLUID)
    assert np.all(particles.role[over & (outside > 0.0) & (outside < 1.0)] == FACE)
    assert np.all(particles.role[over & (outside > 1.0)] == FILLER)
    assert np.ptp(np.unique(np.round(outside[outside > 0.0], 6))) == pytest.approx(2.0)


def test_side_walls_carry_pressure_only_along_the_tank():
    _, particles = walled()
    x = particles.position[particles.role == FACE, 0]
    assert (x.min(), x.max()) == (pytest.approx(-0.5 * D0), pytest.approx(0.02 + 0.5 * D0))


def test_periodic_tank_has_no_side_walls():
    case, particles = walled(**{"tank.periodic": True})
    assert layout.period(case) == pytest.approx(0.02)
    y = particles.position[:, 1]
    assert (y.min(), y.max()) == (pytest.approx(0.5 * D0), pytest.approx(0.02 - 0.5 * D0))
    n = number_density_over_n0(case, particles)
    below = particles.fluid & (particles.position[:, 2] < 0.012 - 2.0 * D0)
    np.testing.assert_allclose(n[below], 1.0, rtol=SINGLE)


def test_water_reaches_both_side_walls_of_a_width_that_is_no_multiple_of_the_spacing():
    """0.0152 m: 7.6 spacings, so 8 rows, and water in every one of them."""
    _, particles = walled(**{"tank.width": 0.0152})
    row = np.round(particles.position[particles.fluid, 1] / D0 - 0.5)
    rows, count = np.unique(row, return_counts=True)
    assert rows.tolist() == list(range(8))
    assert np.all(count == count[0])


def box(start, end):
    return {"from": start, "to": end}


def test_water_boxes_hold_their_volume_at_their_place():
    below = box([0.0, 0.0, 0.0], [0.01, 0.02, 0.006])
    above = box([0.014, 0.004, 0.008], [0.02, 0.01, 0.01])
    _, particles = walled(water=[below, above])
    x = particles.position[particles.fluid]
    assert len(x) == 5 * 10 * 3 + 3 * 3 * 1
    second = x[x[:, 0] > 0.012]
    assert len(second) == 9
    assert np.all(second > [0.014, 0.004, 0.008])
    assert np.all(second < [0.02, 0.01, 0.01])


@pytest.mark.parametrize("width", [0.0, 0.02])
def test_disc_holds_the_lattice_sites_inside_the_ellipse_of_its_box(width):
    disc = {**box([0.0052, 0.004, 0.006], [0.0352, 0.01, 0.026]), "shape": "disc"}
    _, particles = walled(**{"tank.length": 0.04, "tank.width": width, "water": [disc]})
    x, y, z = particles.position[particles.fluid].T / D0
    np.testing.assert_allclose([x % 1.0, z % 1.0], 0.5, rtol=1e-9)
    sites = np.stack(np.meshgrid(np.arange(20) + 0.5, np.arange(18) + 0.5, indexing="ij"), -1)
    away = ((sites[..., 0] - 10.1) / 7.5) ** 2 + ((sites[..., 1] - 8.0) / 5.0) ** 2
    assert len(x) == np.count_nonzero(away < 1.0) * (3 if width else 1)
    assert np.all(((x - 10.1) / 7.5) ** 2 + ((z - 8.0) / 5.0) ** 2 < 1.0)
    assert set(np.round(y, 9)) == ({2.5, 3.5, 4.5} if width else {0.0})
    assert closest(particles.position) > 0.999 * D0


@pytest.mark.parametrize("across", [20, 21])
def test_disc_is_symmetric(across):
    """Radius 10 puts sites of a lattice on the circle itself: they count on every side of it."""
    size = across * D0
    disc = {**box([0.01, 0.0, 0.01], [0.01 + size, 0.0, 0.01 + size]), "shape": "disc"}
    tank = {"tank.length": 0.06, "tank.depth": 0.03, "tank.height": 0.06, "water": [disc]}
    position = layout.build_particles(make_case(tank)).position
    inside = np.all((position > [0.01, -1, 0.01]) & (position < 0.01 + size), axis=1)
    middle = np.round((position[inside] - 0.01) / D0 - 0.5 * across, 6)[:, [0, 2]]
    sites = {tuple(site) for site in middle}
    assert len(sites) == pytest.approx(np.pi * (0.5 * across) ** 2, rel=0.03)
    assert sites == {(-x, z) for x, z in sites} == {(z, x) for x, z in sites}


def test_floating_water_does_not_press_on_the_bed():
    disc = {**box([0.01, 0.0, 0.02], [0.03, 0.0, 0.04]), "shape": "disc"}
    case = make_case({"water": [disc]})
    particles = layout.build_particles(case)
    assert np.all(particles.pressure[~particles.fluid] == 0.0)
    assert particles.pressure.max() > 1000.0 * 9.81 * 0.015


def test_disc_beside_an_obstacle_leaves_its_place_free():
    disc = {**box([0.01, 0.0, 0.0], [0.03, 0.0, 0.02]), "shape": "disc"}
    obstacle = box([0.02, 0.0, 0.0], [0.04, 0.0, 0.02])
    particles = layout.build_particles(make_case({"water": [disc], "obstacle": [obstacle]}))
    x = particles.position[particles.fluid, 0]
    assert x.max() < 0.02
    assert len(x) == pytest.approx(0.5 * np.pi * 5.0**2, rel=0.05)


def test_water_box_on_a_slope_stands_on_the_bed():
    bed = [[0.0, 0.0], [0.1, 0.0], [0.4, 0.1]]
    water = [box([0.15, 0.0, 0.0], [0.2, 0.0, 0.06])]
    case = make_case({"tank.length": 0.4, "tank.depth": 0.06, "tank.bed": bed, "water": water})
    particles = layout.build_particles(case)
    x, z = particles.position[particles.fluid, 0], particles.position[particles.fluid, 2]
    assert (x.min(), x.max()) == (pytest.approx(0.151), pytest.approx(0.199))
    assert np.all(z > beds.elevation(case.tank.bed, x))
    area = 0.05 * (0.06 - 0.075 / 3.0)
    assert len(x) * D0**2 == pytest.approx(area, rel=0.03)


@pytest.mark.parametrize("width", [0.0, 0.02])
def test_particles_are_numbered_in_columns_along_the_tank(width):
    _, particles = walled(**{"tank.width": width})
    np.testing.assert_array_equal(particles.gid, np.arange(len(particles)))
    column = np.floor(particles.position / D0 + 1e-6)[:, :2]
    later = np.diff(column, axis=0)
    assert np.all((later[:, 0] > 0) | ((later[:, 0] == 0) & (later[:, 1] >= 0)))
    same = np.all(later == 0.0, axis=1)
    assert np.all(np.diff(particles.position[:, 2])[same] > 0.0)


@pytest.mark.parametrize("width", [0.0, 0.02])
def test_jitter_is_seeded_bounded_and_moves_only_water(width):
    def positions(jitter, seed):
        _, particles = walled(
            **{"tank.width": width, "particles.jitter": jitter, "particles.seed": seed}
        )
        return particles.position, particles.fluid

    (still, fluid), (shaken, _), (again, _), (other, _) = (
        positions(0.0, 1), positions(0.1, 1), positions(0.1, 1), positions(0.1, 2)
    )  # fmt: skip
    np.testing.assert_array_equal(shaken, again)
    assert np.any(shaken != other)
    assert np.all(shaken[~fluid] == still[~fluid])
    assert 0.05 * D0 < np.abs(shaken - still).max() <= 0.1 * D0
    assert np.any(shaken[:, 1] != still[:, 1]) == (width > 0.0)
