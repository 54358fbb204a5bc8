"""Solids of any shape: their particles, what they refuse, and the water around them."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tanks import make_case

from mpslab import Simulation
from mpslab.core.keys import CaseError
from mpslab.core.kinds import kinds_of
from mpslab.core.particles import FACE, FILLER, FIRST_SOLID, make_particles
from mpslab.run.guard import find_lost
from mpslab.run.preflight import preflight
from mpslab.solids import layout, shaped
from mpslab.solids.census import census
from mpslab.solids.outlines import Circle, Polygon
from mpslab.solids.shapes import Prism, Sphere

D0, WEIGHT = 0.002, 1000.0 * 9.81
RAMP = [[0.02, 0.0], [0.04, 0.014], [0.046, 0.014], [0.058, 0.0]]
BOX = [[0.02, 0.006], [0.034, 0.006], [0.034, 0.02], [0.02, 0.02]]
TRIANGLE = [[0.0, 0.0], [0.3, 0.05], [0.15, 0.3]]
TRIANGLE_WITHIN = 0.17721052883069904  # diameter of the circle in it, by Heron's formula
ELL = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.1], [0.1, 0.1], [0.1, 0.3], [0.0, 0.3]]
OUTLINES = {
    "triangle": Polygon(TRIANGLE),
    "turned round": Polygon(TRIANGLE[::-1]),
    "L": Polygon(ELL),
    "circle": Circle((0.1, 0.2), 0.13),
}


def tank_with(*solids, **changes):
    """Tank of 40 x 15 particles with solids in it."""
    tank = {"tank.length": 0.08, "tank.depth": 0.03, "solid": list(solids)}
    return make_case({**tank, **changes})


def polygon(points, **more):
    return {"shape": "polygon", "points": points, **more}


def cylinder(x, z, radius, **more):
    return {"shape": "cylinder", "center": [x, 0.0, z], "radius": radius, **more}


# Outlines and shapes


@pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES)
def test_distance_is_that_to_the_nearest_point_of_the_outline(outline):
    if isinstance(outline, Circle):
        angle = np.linspace(0.0, 2.0 * np.pi, 20_001)
        edge = outline.center + outline.radius * np.column_stack([np.cos(angle), np.sin(angle)])
    else:
        share = np.linspace(0.0, 1.0, 4001)[:, None]
        corners = outline.corners
        edge = np.vstack([a + share * (b - a) for a, b in
                          zip(corners, np.roll(corners, -1, axis=0), strict=True)])  # fmt: skip
    points = np.random.default_rng(1).uniform(-0.1, 0.45, (500, 2))
    far = cKDTree(edge).query(points)[0]
    found = outline.distance(points)
    np.testing.assert_allclose(np.abs(found), far, atol=1e-4)
    assert 0.02 < np.mean(found < 0.0) < 0.5


@pytest.mark.parametrize("depth", [0.005, 0.015, 0.025])
@pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES)
def test_ring_is_evenly_set_at_its_depth_with_normals_that_point_out(outline, depth):
    points, normals = outline.ring(depth, 0.01)
    middle = -depth
    if isinstance(outline, Circle):  # of the area that the ring stands for
        radius = outline.radius - depth + np.linspace(-0.005, 0.005, 2001)
        middle = np.average(radius, weights=radius) - outline.radius
        assert 0.0 < middle + depth < 1e-4
    np.testing.assert_allclose(outline.distance(points), middle, atol=1e-7)
    np.testing.assert_allclose(np.hypot(*normals.T), 1.0)
    assert np.all(outline.distance(points + 0.5 * depth * normals) > -0.9 * depth)
    near = cKDTree(points).query(points, k=3)[0][:, 1:]
    assert near[:, 0].min() > 0.6 * 0.01 and near[:, 1].max() < 1.5 * 0.01


def test_ring_of_a_box_in_whole_spacings_is_the_lattice():
    points, _ = Polygon([[0, 0], [8, 0], [8, 5], [0, 5]]).ring(0.5, 1.0)
    sites = {(x + 0.5, z + 0.5) for x in range(8) for z in range(5) if x in (0, 7) or z in (0, 4)}
    assert {tuple(np.round(point, 9)) for point in points} == sites


@pytest.mark.parametrize(("corners", "thinnest"), [
    (ELL, 0.1), ([[0, 0], [4, 0], [4, 1], [0, 1]], 1.0), (TRIANGLE, TRIANGLE_WITHIN),
])  # fmt: skip
def test_thinnest_is_between_sides_that_face_each_other(corners, thinnest):
    assert Polygon(corners).thinnest == pytest.approx(thinnest)


@pytest.mark.parametrize("shape", [
    Sphere((0.1, 0.1, 0.1), 0.06),
    Prism(Circle((0.1, 0.1), 0.06), "z", (0.05, np.inf), (np.arange(5, 20) + 0.5) * 0.01),
    Prism(Polygon(ELL), "y", (0.1, 0.3), (np.arange(10, 30) + 0.5) * 0.01),
], ids=["sphere", "pile", "block"])  # fmt: skip
def test_layers_lie_one_behind_the_other_below_the_faces(shape):
    position, normal, layer = shape.layers(0.01, 3)
    depth = -shape.distance(position)
    assert np.all(depth > (layer + 0.45) * 0.01)  # nearest in a ball, whose layers bend most
    assert np.all(depth[layer == 0] < 0.0051)
    np.testing.assert_allclose(np.linalg.norm(normal[layer == 0], axis=1), 1.0)
    assert np.all(shape.distance(position + 0.015 * normal)[layer == 0] > -1e-12)
    assert cKDTree(position).query(position, k=2)[0][:, 1].min() > 0.5 * 0.01


# In the tank


def test_polygon_on_the_lattice_stands_as_an_obstacle_does():
    obstacle = {"from": [0.02, 0.0, 0.006], "to": [0.034, 0.0, 0.02]}
    box = layout.build_particles(tank_with(obstacle=[obstacle]))
    same = layout.build_particles(tank_with(polygon(BOX)))
    a, b = (p.position[(p.role == FACE) & (p.body == FIRST_SOLID)] for p in (box, same))
    assert {tuple(np.round(x, 9)) for x in a} == {tuple(np.round(x, 9)) for x in b}
    np.testing.assert_allclose(box.position[box.fluid], same.position[same.fluid], atol=1e-12)
    faces = [p.pressure[(p.role == FACE) & (p.body == FIRST_SOLID)].sum() for p in (box, same)]
    assert faces[0] == pytest.approx(faces[1]) and faces[0] > 0.0


def test_water_keeps_half_a_spacing_off_and_its_volume():
    case = tank_with(polygon(RAMP), cylinder(0.012, 0.015, 0.006))
    p = layout.build_particles(case)
    water = p.position[p.fluid]
    for shape in shaped.shapes(case):
        assert shape.distance(water).min() > 0.49 * D0
    room = 0.08 * 0.03 - 0.5 * (0.038 + 0.006) * 0.014 - np.pi * 0.006**2
    assert len(water) * D0**2 == pytest.approx(room, rel=0.02)


def test_what_meets_no_water_is_filler():
    """The foot of a breakwater, the bed below it, and where two solids touch."""
    mound, block = RAMP, [[0.036, 0.014], [0.05, 0.014], [0.05, 0.026], [0.036, 0.026]]
    case = tank_with(polygon(mound), polygon(block))
    p = layout.build_particles(case)
    x, z, faces = p.position[:, 0], p.position[:, 2], p.role == FACE
    foot = (p.body == FIRST_SOLID) & (z < 0.0015) & (x > 0.026) & (x < 0.052)
    bed = (p.body == 1) & (z < 0.0) & (x > 0.026) & (x < 0.052)
    joint = (p.body == FIRST_SOLID + 1) & (z < 0.0155) & (x > 0.0405) & (x < 0.0455)
    for rows in (foot, bed, joint):
        assert rows.any() and not faces[rows].any()
    assert faces[(p.body == FIRST_SOLID + 1) & (z > 0.0245)].all()


def test_later_of_two_solids_that_overlap_leaves_room_for_the_earlier():
    case = tank_with(cylinder(0.03, 0.015, 0.008), cylinder(0.038, 0.015, 0.008))
    p = layout.build_particles(case)
    solid = p.position[p.body >= FIRST_SOLID]
    assert cKDTree(solid).query(solid, k=2)[0][:, 1].min() > 0.4 * D0
    first = shaped.shapes(case)[0]
    assert np.all(first.distance(p.position[p.body == FIRST_SOLID + 1]) > 0.0)


@pytest.mark.parametrize("solids", [
    [polygon(RAMP), cylinder(0.012, 0.015, 0.006)],
    [{"shape": "sphere", "center": [0.03, 0.02, 0.016], "radius": 0.008},
     cylinder(0.06, 0.0, 0.006, axis="z") | {"center": [0.06, 0.02, 0.0]}],
], ids=["2-D", "3-D"])  # fmt: skip
def test_census_and_check_tell_what_is_laid_out(solids):
    wide = {"tank.width": 0.04, "tank.periodic": False} if len(solids[0]) == 3 else {}
    wide = wide if solids[0]["shape"] == "sphere" else {}
    case = tank_with(*solids, **wide)
    real = np.bincount(kinds_of(case, layout.build_particles(case)), minlength=3)[:3]
    counted = census(case)
    assert counted[0] == pytest.approx(real[0], rel=0.02)
    assert counted.sum() == pytest.approx(real.sum(), rel=0.03)
    text = preflight(case).text()
    assert "solid-1" in text and "spacings at the thinnest" in text


def test_water_more_than_a_spacing_inside_a_solid_is_lost():
    case = tank_with(polygon(RAMP))
    shape = shaped.shapes(case)[0]
    place = np.random.default_rng(2).uniform([0.0, 0.0, 0.0], [0.08, 0.0, 0.03], (3000, 3))
    deep = shape.distance(place) < -D0
    assert np.array_equal(shaped.deep_inside(case, place), deep) and deep.sum() > 50
    lost = find_lost(case, make_particles(place, np.zeros(len(place))), 0.0)
    assert [one.reason for one in lost] == ["into a solid"]
    assert np.array_equal(np.sort(lost[0].rows), np.flatnonzero(deep))


def test_solid_goes_where_its_motion_takes_it_and_the_water_makes_way():
    moving = cylinder(0.04, 0.018, 0.008, motion="sway", amplitude=0.01, period=0.2, start=0.05)
    case = tank_with(moving, **{"scheme.settling": 50})
    run = Simulation(case).run(until=0.1)
    p = run.particles
    mine = p.body == FIRST_SOLID
    start = layout.build_particles(case)
    shift = 0.01 * np.sin(2.0 * np.pi * run.time / 0.2)
    gone = p.position[mine, 0].mean() - start.position[start.body == FIRST_SOLID, 0].mean()
    assert gone == pytest.approx(shift, abs=1e-12)
    far = np.hypot(p.position[p.fluid, 0] - 0.04 - shift, p.position[p.fluid, 2] - 0.018)
    assert far.min() > 0.008 - 0.1 * D0


@pytest.mark.parametrize("angle", [0.0, 15.0, 30.0, 45.0, 60.0, 75.0])
def test_still_water_lifts_a_turned_box_by_the_weight_it_displaces(angle):
    """14 x 14 mm, 7 spacings, under 15 layers of water; the mean of 0.1 s."""
    turn = np.radians(angle)
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    corners = [0.04, 0.016] + 0.007 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) @ axes
    case = tank_with(
        polygon(corners.tolist()), force=[{"name": "box", "on": "solid-1"}],
        **{"scheme.settling": 200},
    )  # fmt: skip
    run = Simulation(case).run(until=0.3)
    forces = run.table("forces")
    late = forces["time"] > 0.2
    weight = WEIGHT * 0.014**2
    assert forces["box fz"][late].mean() == pytest.approx(weight, rel=0.04)
    assert abs(forces["box fx"][late].mean()) < 0.04 * weight
    assert run.lost == 0


# What is refused

SPHERE = {"shape": "sphere", "center": [0.03, 0.0, 0.015], "radius": 0.008}
REFUSED = [
    ([SPHERE], {}, "solid.0.shape = 'sphere': must be polygon, cylinder or box in a 2-D tank"),
    ([cylinder(0.03, 0.015, 0.0)], {}, "solid.0.radius = 0.0: must be > 0 for a cylinder"),
    ([{"shape": "cylinder", "radius": 0.01}], {}, "solid.0.center = None: must be given"),
    ([cylinder(0.03, 0.015, 0.008, axis="z")], {}, "solid.0.axis = 'z': must be y in a 2-D"),
    ([polygon(RAMP[:2])], {}, "must be 3 corners or more"),
    ([polygon([RAMP[0], RAMP[2], RAMP[1], RAMP[3]])], {}, "its sides 1 and 3 cross"),
    ([polygon([RAMP[0], RAMP[0], RAMP[1]])], {}, "a tenth of a spacing, apart or more"),
    ([cylinder(0.03, 0.015, 0.003)], {}, "must be 4 spacings, 0.008 m, thick or more"),
    ([polygon([[0.02, 0.0], [0.06, 0.0], [0.06, 0.006], [0.02, 0.006]])], {}, "here it is 0.006"),
    ([cylinder(0.2, 0.015, 0.008)], {}, "must be in the tank, x from 0 to 0.08 m"),
    ([cylinder(0.03, -0.02, 0.008)], {}, "must be above the bed"),
    ([cylinder(0.03, 0.015, 0.008, motion="heave", period=1.0)], {},
     "solid.0.amplitude = 0.0: must be > 0 for motion = 'heave'"),
    ([cylinder(0.03, 0.015, 0.008, name="tank")], {}, "different from those of the tank"),
    ([polygon(RAMP, ends=[0.02, 0.01])], {"tank.width": 0.04}, "[low, high] with low < high"),
    ([SPHERE | {"center": [0.03, 0.001, 0.015]}], {"tank.width": 0.04, "tank.periodic": True},
     "for the tank is periodic there"),
    ([{"shape": "cone"}], {}, "solid.0.shape = 'cone': must be one of polygon, cylinder, sphere"),
]  # fmt: skip


@pytest.mark.parametrize(("solids", "changes", "part"), REFUSED)
def test_solid_that_cannot_be_is_refused(solids, changes, part):
    with pytest.raises(CaseError) as raised:
        tank_with(*solids, **changes)
    assert part in str(raised.value)


def test_filler_is_behind_faces():
    p = layout.build_particles(tank_with(cylinder(0.03, 0.015, 0.008)))
    mine = p.body == FIRST_SOLID
    far = np.hypot(p.position[:, 0] - 0.03, p.position[:, 2] - 0.015)
    assert far[mine & (p.role == FILLER)].max() < far[mine & (p.role == FACE)].min()
