"""Free bodies: their mass, how they move with the water, contact, moorings, and what is refused."""

import numpy as np
import pytest
from ranks import alone, start
from tanks import make_case

from mpslab import Simulation
from mpslab.core import rotation
from mpslab.core.keys import CaseError
from mpslab.run import coupling
from mpslab.run.preflight import preflight
from mpslab.solids import contact, mass
from mpslab.solids.outlines import Circle, Polygon
from mpslab.solids.shapes import Prism, Sphere

D0, WATER, GRAVITY = 0.002, 1000.0, 9.81
FLAT = (-np.inf, np.inf)
BOX = [[0.03, 0.02], [0.05, 0.02], [0.05, 0.036], [0.03, 0.036]]
MODES = [0, 2, 4]


def tank_with(*solids, **changes):
    """Tank of 40 x 15 particles, 2-D, with solids in it."""
    tank = {"tank.length": 0.08, "tank.depth": 0.03, "tank.height": 0.08, "scheme.settling": 100}
    return make_case({**tank, "solid": list(solids), **changes})


def box(points=BOX, **more):
    return {"shape": "polygon", "points": points, "motion": "free", "density": 500.0,
            "name": "box", **more}  # fmt: skip


def ball(x, z, radius=0.006, **more):
    return {"shape": "cylinder", "center": [x, 0.0, z], "radius": radius, "motion": "free",
            "density": 500.0, "name": "ball", **more}  # fmt: skip


def fleet(run):
    return run._flow.coupling.fleet


def advance(run, count):
    for _ in range(count):
        run.advance()
    return run


# Mass and rotation


def test_mass_of_a_box_is_that_of_the_formulas():
    found = mass.bulk(Prism(Polygon([[1, 2], [5, 2], [5, 5], [1, 5]]), "y", FLAT, np.zeros(1)), 2)
    assert found.volume == pytest.approx(12.0)
    np.testing.assert_allclose(found.center, [3.0, 0.0, 3.5])
    assert found.inertia[1, 1] == pytest.approx(12.0 * (16 + 9) / 12)


@pytest.mark.parametrize("shape", [
    Prism(Polygon([[0.0, 0.0], [0.3, 0.05], [0.15, 0.3]]), "y", (0.1, 0.3), np.zeros(1)),
    Prism(Circle((0.1, 0.2), 0.1), "z", (0.0, 0.3), np.zeros(1)),
    Sphere((0.1, 0.1, 0.1), 0.2),
], ids=["wedge", "pile", "ball"])  # fmt: skip
def test_mass_by_formula_is_that_of_a_fine_grid(shape):
    exact, counted = mass.bulk(shape, 3), mass._sampled(shape, 3)
    assert counted.volume == pytest.approx(exact.volume, rel=5e-3)
    np.testing.assert_allclose(counted.center, exact.center, atol=1e-3)
    limit = 5e-3 * np.trace(exact.inertia)
    np.testing.assert_allclose(counted.inertia, exact.inertia, atol=limit)


def test_turns_add_up_and_angles_come_back():
    turn = rotation.STILL
    for _ in range(100):
        turn = rotation.turned(turn, [0.0, -0.5, 0.0], 0.01)
    np.testing.assert_allclose(rotation.angles(rotation.matrix(turn)), [0.5, 0.0, 0.0], atol=1e-12)
    turned = rotation.matrix(rotation.turned(turn, [0.3, 0.2, -0.1], 1.0))
    np.testing.assert_allclose(turned @ turned.T, np.eye(3), atol=1e-14)


# Water and bodies


def test_body_without_water_falls_freely_and_turns_evenly():
    case = tank_with(ball(0.06, 0.05), water=[{"from": [0, 0, 0], "to": [0.03, 0, 0.02]}])
    run = advance(Simulation(case), 30)
    (body,) = fleet(run).bodies
    np.testing.assert_allclose(body.velocity[[0, 2]], [0.0, -GRAVITY * run.time], atol=1e-12)
    assert body.center[2] - body.start[2] == pytest.approx(-0.5 * GRAVITY * run.time**2, rel=0.1)


def test_particles_of_a_body_move_as_one():
    run = advance(Simulation(tank_with(box(velocity=[0.3, 0.0, -0.2]))), 40)
    (body,) = fleet(run).bodies
    p = run.particles
    mine = p.body == body.body
    np.testing.assert_allclose(p.position[mine], body.places(body.rest), atol=1e-15)
    arm = p.position[mine] - body.center
    rigid = body.velocity[:3] + np.cross(body.velocity[3:], arm)
    np.testing.assert_allclose(p.velocity[mine], rigid, atol=1e-3)
    assert abs(body.velocity[4]) > 0.01


@pytest.mark.parametrize("density", [10.0, 500.0])
def test_momentum_of_water_body_and_walls_closes(density):
    """What the body has got is its weight and what the water gave it; and it moves by it."""
    case = tank_with(box(density=density, velocity=[0.1, 0.0, 0.0]),
                     force=[{"name": name, "on": name} for name in ("box", "tank")])  # fmt: skip
    run = Simulation(case)
    (body,) = fleet(run).bodies
    before, weight = body.momentum.copy(), 400 * D0**2 * WATER * GRAVITY
    for _ in range(60):
        run.advance()
        row, dt = run.table("forces")[-1], run.dt
        got = np.array([row["box fx"], row["box fz"]]) * dt - [0.0, body.mass * GRAVITY * dt]
        np.testing.assert_allclose(body.momentum[[0, 2]] - before[[0, 2]], got, rtol=0.0,
                                   atol=1e-10 * weight * dt)  # fmt: skip
        all_ = row["water -dP/dt x"] + row["water weight x"]
        assert all_ == pytest.approx(row["box fx"] + row["tank fx"], abs=1e-10 * weight)
        before = body.momentum.copy()
    left = body.momentum - body.times_mass(body.velocity)
    assert np.abs(left[MODES][:2]).max() < 0.01 * weight * run.dt


@pytest.mark.parametrize(("density", "sign"), [(10.0, 1.0), (3000.0, -1.0)])
def test_cylinder_let_go_under_water_starts_as_its_added_mass_says(density, sign):
    """In 2-D that is about the water it displaces; the free surface and walls change some."""
    case = tank_with(ball(0.04, 0.02, 0.008, density=density), **{"tank.depth": 0.04})
    run = advance(Simulation(case), 8)
    (body,) = fleet(run).bodies
    water = WATER * np.pi * 0.008**2
    own, added = body.mass / water, body.added[2, 2] / water
    assert 0.9 < added < 1.3 and body.added[0, 0] / water == pytest.approx(added, rel=0.25)
    assert body.velocity[2] / run.time == pytest.approx(GRAVITY * (1 - own) / (own + added),
                                                        rel=0.1)  # fmt: skip
    assert sign * body.velocity[2] > 0.0


@pytest.mark.parametrize("density", [10.0, 100.0])
def test_light_body_that_hits_the_water_stops_and_hardly_bounces(density):
    """Its added mass is many times its mass, and comes within some steps. With the added mass of
    before it would be thrown up at 1.6 and 5 m/s.
    """
    flat = [[0.03, 0.036], [0.05, 0.036], [0.05, 0.048], [0.03, 0.048]]
    run = Simulation(tank_with(box(flat, density=density, velocity=[0.0, 0.0, -1.0])))
    (body,) = fleet(run).bodies
    speeds = []
    while run.time < 0.02:
        run.advance()
        speeds.append(body.velocity[2])
    assert min(speeds) == pytest.approx(-1.04, abs=0.02) and max(speeds) < 0.4
    assert abs(speeds[-1]) < 0.3
    left = body.momentum - body.times_mass(body.velocity)
    assert abs(left[2]) < 0.02 * body.added[2, 2]


def test_held_body_stays_until_it_is_let_go():
    run = Simulation(tank_with(ball(0.04, 0.015, release=0.01)))
    run.run(until=0.01)
    (body,) = fleet(run).bodies
    assert np.all(body.center == body.start) and body.age < 0
    began = run.time
    advance(run, 20)
    assert 0.5 < body.velocity[2] / (run.time - began) < 0.5 * GRAVITY


def test_added_mass_is_found_when_a_body_is_let_go_and_every_so_many_steps(monkeypatch):
    monkeypatch.setattr(coupling, "EVERY", 20)
    case = tank_with(ball(0.02, 0.015), ball(0.06, 0.015, name="late", release=0.003))
    run, ages = Simulation(case), []
    for _ in range(42):
        run.advance()
        ages.append([body.age for body in fleet(run).bodies])
    early, late = np.array(ages).T
    assert early.max() == late.max() == 20 and late[0] == -1
    assert early[np.flatnonzero(late >= 0)[0]] == 1


def test_locked_body_moves_in_no_other_way():
    run = advance(Simulation(tank_with(ball(0.03, 0.015, locked=["x", "roll"]))), 30)
    (body,) = fleet(run).bodies
    assert body.velocity[2] > 0.01
    assert np.all(np.delete(body.velocity, 2) == 0.0)


def test_sphere_rises_in_three_dimensions_without_turning_aside():
    sphere = {"shape": "sphere", "center": [0.024, 0.024, 0.016], "radius": 0.008,
              "motion": "free", "density": 300.0}  # fmt: skip
    case = tank_with(sphere, **{"tank.length": 0.048, "tank.width": 0.048, "tank.depth": 0.036,
                                "tank.periodic": False, "scheme.settling": 60})  # fmt: skip
    run = advance(Simulation(case), 8)
    (body,) = fleet(run).bodies
    water = WATER * 4.0 / 3.0 * np.pi * 0.008**3
    added = np.diag(body.added)[:3] / water
    np.testing.assert_allclose(added, 0.5, atol=0.15)
    expected = GRAVITY * (1.0 - 0.3) / (0.3 + added[2])
    assert body.velocity[2] / run.time == pytest.approx(expected, rel=0.15)
    assert np.abs(body.velocity[:2]).max() < 0.2 * body.velocity[2]


# Contact and moorings


def test_heavy_box_comes_to_rest_a_spacing_above_the_bed():
    run = Simulation(tank_with(box([[0.03, 0.008], [0.046, 0.008], [0.046, 0.02], [0.03, 0.02]],
                                   density=3000.0)))  # fmt: skip
    run.run(until=0.08)
    (body,) = fleet(run).bodies
    (gap,) = [gap for name, gap in fleet(run).contact.gaps(0, run.time) if name == "tank"]
    assert gap == pytest.approx(D0, rel=1e-3)
    assert np.abs(body.velocity[[2, 4]] * [1.0, 0.01]).max() < 1e-3
    assert run.lost == 0


def test_two_bodies_meet_and_do_not_pass():
    solids = [ball(0.025, 0.015, density=1000.0, velocity=[0.5, 0.0, 0.0], locked=["z", "roll"]),
              ball(0.045, 0.015, density=1000.0, name="other", locked=["z", "roll"])]  # fmt: skip
    run = Simulation(tank_with(*solids))
    nearest = np.inf
    for _ in range(120):
        run.advance()
        gaps = dict(fleet(run).contact.gaps(0, run.time))
        nearest = min(nearest, gaps["other"])
    assert 0.999 * D0 < nearest < 1.3 * D0


def test_impulses_stop_what_would_come_too_near_and_nothing_else():
    rows, least = np.array([[1.0, 0.0], [1.0, 0.5]]), np.array([-0.1, -0.1])
    found = contact.impulses(rows, least, np.array([-1.0, 0.0]), np.diag([0.5, 2.0]))
    velocity = np.array([-1.0, 0.0]) + np.diag([0.5, 2.0]) @ found
    assert np.all(rows @ velocity > least - 1e-5)
    assert np.all(contact.impulses(rows, least, np.array([1.0, 0.0]), np.eye(2)) == 0.0)


def test_moored_body_hangs_where_the_line_holds_its_weight():
    """Above the water, with damping: the stretch is weight over stiffness."""
    line = {"on": "ball", "anchor": [0.06, 0.0, 0.075], "at": [0.06, 0.0, 0.056],
            "stiffness": 400.0, "damping": 8.0, "length": 0.019}  # fmt: skip
    case = tank_with(ball(0.06, 0.05), water=[{"from": [0, 0, 0], "to": [0.03, 0, 0.01]}],
                     mooring=[line])  # fmt: skip
    run = Simulation(case)
    run.run(until=0.15)
    (body,) = fleet(run).bodies
    stretch = body.start[2] - body.center[2]
    assert stretch == pytest.approx(body.mass * GRAVITY / 400.0, rel=0.02)
    assert fleet(run).lines[0].tension == pytest.approx(body.mass * GRAVITY, rel=0.02)


def test_slack_line_does_not_pull():
    line = {"on": "ball", "anchor": [0.06, 0.0, 0.05], "at": [0.06, 0.0, 0.056],
            "stiffness": 400.0, "length": 0.03}  # fmt: skip
    case = tank_with(ball(0.06, 0.05), water=[{"from": [0, 0, 0], "to": [0.03, 0, 0.01]}],
                     mooring=[line])  # fmt: skip
    run = advance(Simulation(case), 20)
    assert fleet(run).lines[0].tension == 0.0
    assert fleet(run).bodies[0].velocity[2] == pytest.approx(-GRAVITY * run.time)


# The same bits

LONG = {"tank.length": 0.16, "tank.depth": 0.03, "scheme.settling": 0, "scheme.solver": "deflated",
        "solid": [box([[0.046, 0.02], [0.066, 0.02], [0.066, 0.036], [0.046, 0.036]],
                      velocity=[1.0, 0.0, -0.3]),
                  ball(0.11, 0.012, velocity=[-1.0, 0.0, 0.0])]}  # fmt: skip


def test_bodies_that_cross_cuts_have_the_same_bytes_on_1_to_3_ranks():
    call = ["steps", LONG, 12, 2e-4]
    one = alone(*call)
    for ranks in (2, 3):
        assert start("steps", ranks, *call[1:]) == one


def test_bodies_go_on_to_the_same_bytes(tmp_path):
    line = {"on": "box", "anchor": [0.01, 0.0, 0.01], "at": [0.03, 0.0, 0.02], "stiffness": 100.0,
            "length": 0.01}  # fmt: skip
    case = tank_with(box(velocity=[0.2, 0.0, 0.0]), mooring=[line])
    whole = Simulation(case).run(until=0.03)
    Simulation(case, tmp_path / "run").run(until=0.014)
    again = Simulation.resume(tmp_path / "run").run(until=0.03)
    for name in ("position", "velocity", "pressure"):
        assert getattr(again.particles, name).tobytes() == getattr(whole.particles, name).tobytes()
    a, b = again._flow.solids.state(), whole._flow.solids.state()
    for name in a:
        np.testing.assert_array_equal(a[name], b[name])


def test_water_inside_a_body_is_lost():
    run = Simulation(tank_with(box()))
    p, (body,) = run.particles, fleet(run).bodies
    row = int(np.flatnonzero(p.fluid)[0])
    p.position[row] = body.center
    (lost,) = [one for one in run_lost(run) if "into box" in one.reason]
    assert lost.rows.tolist() == [row]


def run_lost(run):
    from mpslab.run.guard import find_lost

    return find_lost(run.case, run.particles, 0.0, run._flow.solids.free)


# What it tells


def test_table_has_place_angle_and_speeds_of_bodies_and_tensions():
    line = {"name": "chain", "on": "box", "anchor": [0.01, 0.0, 0.01], "at": [0.03, 0.0, 0.02],
            "stiffness": 100.0, "length": 0.01}  # fmt: skip
    run = advance(Simulation(tank_with(box(velocity=[0.2, 0.0, 0.0]), mooring=[line])), 22)
    rows, (body,) = run.table("bodies"), fleet(run).bodies
    last = rows[-1]
    assert rows.dtype.names == ("time", "box x", "box z", "box roll", "box u", "box w",
                                "box roll rate", "chain tension")  # fmt: skip
    assert last["box x"] == body.center[0] and last["box w"] == body.velocity[2]
    assert last["box roll rate"] == np.degrees(-body.velocity[4])
    assert last["box roll"] * last["box roll rate"] > 0.0
    assert last["chain tension"] == pytest.approx(100.0 * (np.hypot(0.02, 0.01) - 0.01), rel=0.1)


def test_check_tells_how_a_body_floats():
    """Draft of half the height; BM = b^2/12T over a centre of buoyancy half-way up the draft."""
    found = preflight(tank_with(box(), mooring=[])).findings["bodies"]["box"]
    assert found["mass [kg]"] == pytest.approx(500.0 * 0.02 * 0.016)
    assert found["draft [m]"] == pytest.approx(0.008, rel=1e-3)
    assert found["floats_at [m]"] == pytest.approx(0.03, rel=1e-3)
    height = 0.02**2 / (12 * 0.008) - 0.004
    assert found["metacentric_height [m]"] == pytest.approx(height, rel=0.01)
    assert (found["nearest"], found["smallest_gap [m]"]) == ("tank", pytest.approx(0.02))


def test_check_tells_that_a_body_sinks_or_turns_over():
    assert "it sinks" in preflight(tank_with(box(density=2000.0))).text()
    tall = [[0.03, 0.01], [0.042, 0.01], [0.042, 0.04], [0.03, 0.04]]
    assert "is not stable and turns over" in preflight(tank_with(box(tall))).text()


# What is refused

WALLED = {"tank.width": 0.03, "tank.periodic": False}
REFUSED = [
    ([box(density=0.0)], {}, "solid.0.density = 0.0: must be > 0, or mass given, for motion"),
    ([box(mass=1.0)], {}, "solid.0.mass = 1.0: must be 0 where density is given"),
    ([box(motion="none")], {}, "solid.0.density = 500.0: must be left out unless motion = 'free'"),
    ([box(locked=["pitch"])], {}, "solid.0.locked = ['pitch']: must be out of x, z, roll in a 2-D"),
    ([box(locked=["x", "z", "roll"])], {}, "must be such that one way to move is left"),
    ([box(inertia=[1.0, 1.0, 1.0])], {}, "solid.0.inertia = [1.0, 1.0, 1.0]: must be one number"),
    ([box(release=0.1, velocity=[1.0, 0.0, 0.0])], {}, "must be [0.0, 0.0, 0.0] with a release"),
    ([box()], {"scheme.recipe": "paper"}, "scheme.walls = 'copied': must be 'extrapolated' with"),
    ([box()], {"scheme.projection": "predicted"}, "must be 'start' with a free body"),
    ([box()], {"frame.type": "roll", "frame.amplitude": 1.0, "frame.period": 1.0},
     "frame.type = 'roll': must be none, sway or heave with a free body"),
    ([ball(0.04, 0.007)], {}, "0.002 m, a spacing, or more off the tank; here it is 0.001 m"),
    ([box()], WALLED, "solid.0.ends = None: must be given for a free polygon or cylinder in a"),
    ([box()], {"mooring": [{"on": "boat", "anchor": [0, 0, 0], "at": [0, 0, 0], "stiffness": 1.0,
                            "length": 0.1}]}, "mooring.0.on = 'boat': must be one of box"),
    ([box()], {"mooring": [{"on": "box", "anchor": [0, 0, 0], "at": [0, 0, 0], "stiffness": 1e9,
                            "length": 0.1}]}, "mooring.0.stiffness = 1000000000.0: must be <= "),
]  # fmt: skip


@pytest.mark.parametrize(("solids", "changes", "part"), REFUSED)
def test_body_that_cannot_be_is_refused(solids, changes, part):
    with pytest.raises(CaseError) as raised:
        tank_with(*solids, **changes)
    assert part in str(raised.value)
