"""Solid boxes in the tank: where their particles stand, and the water around them."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tanks import CLASSIC, SINGLE, closest, flow_of, make_case, number_density_over_n0, run

from mpslab import load_case
from mpslab.core.gauges import probe, surface_elevation
from mpslab.core.keys import CaseError
from mpslab.core.particles import FACE, FILLER, FLUID, make_particles
from mpslab.run.guard import find_lost
from mpslab.run.preflight import preflight
from mpslab.solids import layout, obstacles
from mpslab.solids.piston import make_paddle

D0, WEIGHT = 0.002, 1000.0 * 9.81
WALLED = {"tank.width": 0.02, "tank.periodic": False}
SLOPE = [[0.0, 0.0], [0.02, 0.0], [0.06, 0.02]]


def box(start, end):
    return {"from": start, "to": end}


RESTING = box([0.02, 0.0, 0.0], [0.034, 0.0, 0.012])
FLOATING = box([0.02, 0.0, 0.01], [0.034, 0.0, 0.02])
PIERCING = box([0.02, 0.0, 0.0], [0.034, 0.0, 0.04])
BESIDE_THE_END_WALL = box([0.05, 0.0, 0.0], [0.06, 0.0, 0.012])
BOXES = [RESTING, FLOATING, PIERCING, BESIDE_THE_END_WALL]
NAMES = ["resting", "floating", "piercing", "beside the end wall"]


def tank_with(*boxes, **changes):
    """Tank of 30 x 15 particles with obstacles in it."""
    tank = {"tank.length": 0.06, "tank.depth": 0.03, "obstacle": list(boxes)}
    case = make_case({**tank, **changes})
    return case, layout.build_particles(case)


def within(position, start, end, axes=(0, 2)):
    return np.all([(position[:, k] > start[k]) & (position[:, k] < end[k]) for k in axes], axis=0)


# Where the particles stand


def test_box_of_kleefsman_is_laid_out_in_3d():
    """Kleefsman et al. 2005, its tank shortened; 8 x 20 x 8 spacings."""
    case, particles = tank_with(
        box([0.6635, 0.2955, 0.0], [0.8245, 0.6985, 0.161]),
        **{"tank.length": 1.2, "tank.width": 1.0, "tank.depth": 0.3, "tank.periodic": False},
        **{"particles.spacing": 0.02},
    )
    x = particles.position
    there = within(x, (0.66, 0.3, 0.0), (0.82, 0.7, 0.16), axes=(0, 1, 2))
    assert np.count_nonzero(there) == 8 * 20 * 8
    assert np.count_nonzero(particles.role[there] == FILLER) == 6 * 18 * 7
    assert np.count_nonzero(particles.role[there] == FACE) == 8 * 20 * 8 - 6 * 18 * 7
    np.testing.assert_allclose(x[there].min(axis=0), [0.67, 0.31, 0.01])
    np.testing.assert_allclose(x[there].max(axis=0), [0.81, 0.69, 0.15])
    assert np.count_nonzero(particles.fluid) == 60 * 50 * 15 - 8 * 20 * 8
    assert closest(x) > 0.999 * 0.02
    lines = dict(preflight(case).sections["Particles"])
    assert lines["obstacle.0 in whole spacings"] == (
        "x 0.66 m to 0.82 m, y 0.3 m to 0.7 m, z bed to 0.16 m"
    )


@pytest.mark.parametrize("obstacle", BOXES, ids=NAMES)
def test_outermost_particles_are_wall_and_those_inside_are_dummy(obstacle):
    _, particles = tank_with(obstacle)
    there = within(particles.position, obstacle["from"], obstacle["to"])
    assert not np.any(particles.fluid & there)
    wet = particles.position[particles.fluid]
    dry = lattice_above_the_water()
    apart = cKDTree(np.vstack([wet, dry])).query(particles.position[there])[0]
    np.testing.assert_array_equal(particles.role[there] == FACE, apart < 1.5 * D0)
    assert np.all(np.isin(particles.role[there], (FACE, FILLER)))


def lattice_above_the_water():
    """Sites of the lattice above 0.03 m that no obstacle here takes."""
    x, z = np.meshgrid(np.arange(0.001, 0.06, D0), np.arange(0.031, 0.06, D0))
    place = np.column_stack([x.ravel(), 0.0 * x.ravel(), z.ravel()])
    return place[~within(place, PIERCING["from"], PIERCING["to"])]


@pytest.mark.parametrize("changes", [{}, WALLED], ids=["2-D", "3-D"])
@pytest.mark.parametrize("obstacle", BOXES, ids=NAMES)
def test_lattice_goes_on_from_the_water_into_the_obstacle(obstacle, changes):
    """A gap or a squeeze at a face would push the water in the first step."""
    obstacle = {**obstacle, "to": [obstacle["to"][0], 0.02, obstacle["to"][2]]}
    case, particles = tank_with(obstacle, **changes)
    assert closest(particles.position) > 0.999 * D0
    below = particles.fluid & (particles.position[:, 2] < 0.03 - 2.0 * D0)
    np.testing.assert_allclose(number_density_over_n0(case, particles)[below], 1.0, rtol=SINGLE)


def test_water_around_an_obstacle_that_spans_a_part_of_the_width():
    case, particles = tank_with(box([0.02, 0.006, 0.0], [0.034, 0.014, 0.012]), **WALLED)
    assert np.count_nonzero(particles.fluid) == 30 * 10 * 15 - 7 * 4 * 6
    assert closest(particles.position) > 0.999 * D0
    below = particles.fluid & (particles.position[:, 2] < 0.03 - 2.0 * D0)
    np.testing.assert_allclose(number_density_over_n0(case, particles)[below], 1.0, rtol=SINGLE)


def test_faces_are_rounded_to_whole_spacings():
    exact, rounded = (
        tank_with(box([x0, 0.0, 0.0], [x1, 0.0, z1]))[1].position
        for x0, x1, z1 in ((0.02, 0.034, 0.012), (0.0209, 0.0331, 0.0129))
    )
    np.testing.assert_array_equal(rounded, exact)


def test_walls_against_an_obstacle_carry_no_pressure():
    """As unknowns or as points of a probe they would be cut off from the water."""
    _, particles = tank_with(BESIDE_THE_END_WALL, RESTING)
    x, z = particles.position[:, 0], particles.position[:, 2]
    bed = (z < 0.0) & (z > -D0)
    wall = particles.role == FACE
    np.testing.assert_allclose(x[bed & wall & (x > 0.02) & (x < 0.034)], [0.021, 0.033])
    end = (x > 0.06) & (x < 0.06 + D0)
    assert z[end & wall].min() == pytest.approx(0.011)
    assert not np.any(bed & wall & (x > 0.052))


def test_obstacles_that_touch_or_overlap_are_one_body():
    """Steps of a stair: boxes that all stand on the bed, or one upon the other."""
    low, high = box([0.02, 0.0, 0.0], [0.04, 0.0, 0.01]), box([0.03, 0.0, 0.0], [0.04, 0.0, 0.02])
    _, overlapping = tank_with(low, high)
    upper = box([0.03, 0.0, 0.01], [0.04, 0.0, 0.02])
    _, stacked = tank_with(low, upper)
    for name in ("position", "role", "pressure"):
        np.testing.assert_array_equal(getattr(overlapping, name), getattr(stacked, name))
    solid = within(overlapping.position, (0.02, 0, 0), (0.04, 0, 0.02)) & ~overlapping.fluid
    assert np.count_nonzero(solid) == 10 * 5 + 5 * 5
    inner = within(overlapping.position, (0.03 + D0, 0, 0), (0.04 - D0, 0, 0.02 - D0))
    assert np.all(overlapping.role[inner] == FILLER)


@pytest.mark.parametrize("layout", ["smooth", "staircase"])
@pytest.mark.parametrize("start", [0.0, 0.006, 0.018])
def test_obstacle_on_a_slope_is_clear_of_the_bed_and_of_the_water(layout, start):
    """From below the bed, across it, and above it."""
    obstacle = box([0.03, 0.0, start], [0.046, 0.0, 0.026])
    bed = {"tank.bed": SLOPE, "tank.depth": 0.04, "particles.bed": layout}
    case, particles = tank_with(obstacle, **bed)
    position, fluid = particles.position, particles.fluid
    assert closest(position) > 0.7 * D0
    assert not np.any(fluid & within(position, obstacle["from"], obstacle["to"]))
    solid = ~fluid & within(position, (0.03, 0.0, start), (0.046, 0.0, 0.026))
    body = solid & (position[:, 2] > case.tank.bed_height(position[:, 0]))
    lattice = position[body][:, [0, 2]] / D0 - 0.5
    np.testing.assert_allclose(lattice, np.round(lattice), atol=1e-9)
    assert np.all(particles.role[body & (position[:, 2] > 0.026 - D0)] == FACE)
    apart = cKDTree(position[~fluid]).query(position[fluid])[0]
    assert apart.min() > 0.874 * D0


def test_tank_without_an_obstacle_there_is_left_as_it_is():
    _, plain = tank_with()
    _, with_box = tank_with(RESTING)
    far = {
        name: np.abs(particles.position[:, 0] - 0.027) > 0.012
        for name, particles in (("plain", plain), ("with", with_box))
    }
    for name in ("position", "role", "pressure"):
        np.testing.assert_array_equal(
            getattr(plain, name)[far["plain"]], getattr(with_box, name)[far["with"]]
        )


@pytest.mark.parametrize("obstacle", BOXES, ids=NAMES)
def test_walls_of_an_obstacle_start_with_the_pressure_of_the_water_beside_them(obstacle):
    _, particles = tank_with(obstacle)
    z = particles.position[:, 2]
    wall = within(particles.position, obstacle["from"], obstacle["to"]) & (particles.role == FACE)
    exact = WEIGHT * np.maximum(0.03 - z[wall], 0.0)
    np.testing.assert_allclose(particles.pressure[wall], exact, atol=1e-9)


def test_dry_obstacle_starts_without_pressure():
    _, particles = tank_with(RESTING, water=[box([0.0, 0.0, 0.0], [0.01, 0.0, 0.03])])
    there = within(particles.position, RESTING["from"], RESTING["to"])
    assert np.all(particles.pressure[there] == 0.0)


# Water around them


def settled(obstacle, steps=250, **changes):
    """Flow after so many steps of 0.4 ms."""
    case, _ = tank_with(obstacle, **{"particles.jitter": 0.001, **changes})
    return run(flow_of(case), steps, 4e-4)


# Points of the faces that meet water, clear of the edges: seaward, landward, top, underside.
FACES = [
    [(0.02, 0.007), (0.034, 0.007), (0.027, 0.012)],
    [(0.02, 0.015), (0.034, 0.015), (0.027, 0.02), (0.027, 0.01)],
    [(0.02, 0.007), (0.034, 0.007), (0.02, 0.015)],
]


def assert_still_and_hydrostatic(flow, faces, rel):
    p = flow.particles
    assert np.linalg.norm(p.velocity[p.fluid], axis=1).max() < 0.1
    assert np.sqrt(np.mean(p.velocity[p.fluid] ** 2)) < 0.01
    for x, z in faces:
        found = probe(p.position, p.velocity, p.pressure, p.role, D0, (x, 0.0, z))[0]
        assert found == pytest.approx(WEIGHT * (0.03 - z), rel=rel), (x, z)


@pytest.mark.parametrize(("obstacle", "faces"), [*zip(BOXES, FACES, strict=False)], ids=NAMES[:3])
def test_water_stays_still_around_an_obstacle_and_presses_on_it_with_its_weight(obstacle, faces):
    assert_still_and_hydrostatic(settled(obstacle), faces, rel=0.04)


def test_water_stays_still_around_an_obstacle_with_solved_walls():
    flow = settled(RESTING, **{**CLASSIC, "scheme.gradient": "gc"})
    assert_still_and_hydrostatic(flow, FACES[0], rel=0.08)


def test_water_stays_still_around_a_box_in_3d():
    changes = {"tank.length": 0.028, "tank.depth": 0.02, "tank.height": 0.03, **WALLED}
    flow = settled(box([0.01, 0.006, 0.0], [0.018, 0.014, 0.01]), 120, **changes)
    p = flow.particles
    assert np.sqrt(np.mean(p.velocity[p.fluid] ** 2)) < 0.015
    for point in ((0.01, 0.01, 0.005), (0.014, 0.014, 0.005), (0.014, 0.01, 0.01)):
        found = probe(p.position, p.velocity, p.pressure, p.role, D0, point)[0]
        assert found == pytest.approx(WEIGHT * (0.02 - point[2]), rel=0.06)


def test_water_does_not_press_through_an_obstacle_of_the_least_thickness():
    """Still water 15 deep on one side, 4 deep on the other; the dividing wall is 4 thick."""
    wall = box([0.026, 0.0, 0.0], [0.034, 0.0, 0.05])
    water = [box([0.0, 0.0, 0.0], [0.026, 0.0, 0.03]), box([0.034, 0.0, 0.0], [0.06, 0.0, 0.008])]
    case, _ = tank_with(wall, water=water, **{"particles.jitter": 0.001})
    assert obstacles.least_thickness(case) == 4
    p = run(flow_of(case), 250, 4e-4).particles
    for x, level in ((0.026, 0.03), (0.034, 0.008)):
        found = probe(p.position, p.velocity, p.pressure, p.role, D0, (x, 0.0, 0.003))[0]
        assert found == pytest.approx(WEIGHT * (level - 0.003), rel=0.06)
    left = p.position[p.fluid, 0] < 0.03
    assert np.count_nonzero(left) == 13 * 15
    assert np.linalg.norm(p.velocity[p.fluid], axis=1).max() < 0.15


@pytest.mark.parametrize("changes", [{}, WALLED], ids=["2-D", "3-D"])
def test_gauge_reads_the_level_above_a_submerged_obstacle_and_none_in_a_dry_one(changes):
    y = 0.5 * changes.get("tank.width", 0.0)
    for obstacle in (RESTING, FLOATING, PIERCING):
        wide = {**obstacle, "to": [obstacle["to"][0], 0.02, obstacle["to"][2]]}
        _, p = tank_with(wide, **changes)
        for x in (0.004, 0.019, 0.02, 0.0271, 0.034, 0.04):
            level = surface_elevation(p.position, p.role, D0, x, y)
            if obstacle is PIERCING and x == 0.0271:
                assert np.isnan(level)
            else:
                assert level == pytest.approx(0.03, abs=0.05 * D0)


def test_water_more_than_a_spacing_inside_an_obstacle_is_lost():
    case, _ = tank_with(RESTING)
    for z, reason in ((0.0101, None), (0.0099, "into an obstacle")):
        drop = make_particles(np.array([[0.027, 0.0, z]]), [FLUID])
        found = [(lost.rows.tolist(), lost.reason) for lost in find_lost(case, drop, 0.0)]
        assert found == ([([0], reason)] if reason else [])


# Bad input


def refusal(changes, name="plunging_breaker"):
    with pytest.raises(CaseError) as caught:
        load_case(name, {"tank.width": 0.0, "particles.spacing": 0.002, "probe": [], **changes})
    message = str(caught.value)
    assert "\n" not in message
    return message


@pytest.mark.parametrize(
    ("start", "end", "part"),
    [
        ([0.5, 0, 0], [0.9, 0, 0.02], "inside the tank, [x, y, z] <= [0.8, 0.0, 0.12] m"),
        ([0.5, 0, 0], [0.6, 0, 0.13], "inside the tank"),
        ([0.5, 0, 0.05], [0.6, 0, 0.051], "by a spacing, 0.002 m, or it has no particles"),
        ([0.7, 0, 0], [0.8, 0, 0.051], "above the bed by a spacing, z >= 0.052 m"),
        ([0.1, 0, 0], [0.106, 0, 0.02], "along x by 4 spacings, 0.008 m, or water on one side"),
        ([0.1, 0, 0.02], [0.2, 0, 0.026], "along z by 4 spacings"),
    ],
)
def test_obstacle_that_does_not_fit_is_refused(start, end, part):
    message = refusal({"obstacle": [box(start, end)]})
    assert message.startswith("obstacle.0.to = [")
    assert part in message


def test_obstacle_may_be_thin_where_it_stands_against_the_bed_or_a_wall():
    thin = [box([0.1, 0, 0], [0.2, 0, 0.002]), box([0.798, 0, 0], [0.8, 0, 0.1])]
    changes = {"obstacle": thin, "tank.width": 0.0, "particles.spacing": 0.002}
    assert len(load_case("plunging_breaker", changes).obstacle) == 2


def test_obstacle_thinner_across_than_its_reach_is_refused_in_3d():
    changes = {"tank.width": 0.032, "obstacle": [box([0.1, 0.01, 0], [0.2, 0.016, 0.02])]}
    assert "along y by 4 spacings" in refusal(changes)
    changes["obstacle"] = [box([0.1, 0.0, 0], [0.2, 0.006, 0.02])]
    assert "along y by 4 spacings" in refusal(changes)
    changes["tank.periodic"] = False
    assert load_case("plunging_breaker", changes).obstacle


def test_obstacles_that_leave_no_room_for_water_are_refused():
    message = refusal({"obstacle": [box([0, 0, 0], [0.8, 0, 0.1])]})
    assert message.startswith("obstacle = [[[")
    assert "leave room for the water" in message


def test_probe_inside_an_obstacle_is_refused_and_on_its_face_is_taken():
    inside = [{"name": "p", "x": 0.11, "z": 0.01}]
    changes = {"obstacle": [box([0.1, 0, 0], [0.12, 0, 0.02])], "probe": inside}
    assert "probe.0 = [0.11, 0.0, 0.01]: must be outside of obstacle.0" in refusal(changes)
    changes["probe"] = [{"name": "p", "x": 0.1, "z": 0.01}]
    changes |= {"tank.width": 0.0, "particles.spacing": 0.002}
    assert load_case("plunging_breaker", changes).probe


def test_obstacle_in_the_way_of_the_piston_is_refused():
    obstacle = [box([0.01, 0, 0], [0.03, 0, 0.02])]
    case = load_case("plunging_breaker", {"obstacle": obstacle, "tank.width": 0.0})
    with pytest.raises(CaseError, match=r"^obstacle\.0\.from = \[0\.01.*must be at x >= 0\.0"):
        make_paddle(case)
    obstacle = [box([0.1, 0, 0], [0.12, 0, 0.02])]
    assert make_paddle(load_case("plunging_breaker", {"obstacle": obstacle, "tank.width": 0.0}))
