"""Gates: where their particles stand, what they hold back, and how they rise."""

import numpy as np
import pytest
from ranks import alone, start
from scipy.spatial import cKDTree
from tanks import CLASSIC, SINGLE, closest, flow_of, make_case, number_density_over_n0, run

from mpslab import load_case
from mpslab.cases import dumps
from mpslab.cases.reader import loads
from mpslab.core.gauges import probe
from mpslab.core.keys import CaseError
from mpslab.core.particles import FACE, FILLER, FIRST_SOLID
from mpslab.run.preflight import preflight
from mpslab.simulation import Simulation
from mpslab.solids import layout
from mpslab.solids.collection import solids_of
from mpslab.solids.piston import make_paddle

D0, WEIGHT, DT = 0.002, 1000.0 * 9.81, 4e-4
WALLED = {"tank.width": 0.02, "tank.periodic": False}
LEFT, RIGHT = ({"from": [a, 0, 0], "to": [b, 0.02, z]} for a, b, z in
               ((0.0, 0.03, 0.03), (0.03, 0.06, 0.01)))  # fmt: skip


SIZE = {"tank.length": 0.06, "tank.depth": 0.03, "tank.height": 0.04}


def tank_with(*plates, **changes):
    """Tank of 30 x 20 spacings, its water 15 deep to x = 0.03 m and 5 deep beyond."""
    return make_case({**SIZE, "water": [LEFT, RIGHT], "gate": list(plates), **changes})


def gate(x=0.03, speed=1.0, **more):
    return {"x": x, "speed": speed, **more}


def is_gate(particles):
    return particles.body >= FIRST_SOLID


def rise(case, time):
    """How far the first gate has risen at a time [m]."""
    return solids_of(case).bodies[FIRST_SOLID].motion(time)[1]


# Where the particles stand


@pytest.mark.parametrize(("radius", "columns"), [(2.1, 4), (2.6, 6), (3.1, 6)])
def test_gate_stands_onshore_of_its_place_and_takes_the_room_of_the_water(radius, columns):
    case = tank_with(gate(), **{"scheme.effective_radius": radius})
    particles = layout.build_particles(case)
    plate = particles.position[is_gate(particles)]
    wet = particles.position[particles.fluid, 0]
    assert len(plate) == columns * 20
    ends = 0.03 + D0 * np.array([0.5, columns - 0.5])
    np.testing.assert_allclose([plate[:, 0].min(), plate[:, 0].max()], ends)
    assert np.count_nonzero(wet < 0.03) == 15 * 15
    assert np.count_nonzero(wet > 0.03) == (15 - columns) * 5
    assert closest(particles.position) > 0.999 * D0
    reach = cKDTree(particles.position[particles.fluid & (particles.position[:, 0] > 0.03)])
    apart = reach.query(particles.position[particles.fluid & (particles.position[:, 0] < 0.03)])[0]
    assert apart.min() > radius * D0


@pytest.mark.parametrize("changes", [{}, WALLED], ids=["2-D", "3-D"])
def test_lattice_goes_on_from_the_water_into_the_gate(changes):
    case = tank_with(gate(), **changes)
    particles = layout.build_particles(case)
    assert np.count_nonzero(is_gate(particles)) == 4 * 20 * (10 if changes else 1)
    below = particles.fluid & (particles.position[:, 2] < 0.01 - 2.0 * D0)
    np.testing.assert_allclose(number_density_over_n0(case, particles)[below], 1.0, rtol=SINGLE)


def test_gate_on_a_slope_is_clear_of_the_bed():
    bed = {"tank.bed": [[0.0, 0.0], [0.02, 0.0], [0.06, 0.02]]}
    particles = layout.build_particles(tank_with(gate(), water=[], **bed))
    assert np.count_nonzero(is_gate(particles)) > 30
    assert closest(particles.position) > 0.7 * D0


def test_gate_starts_with_the_pressure_of_the_water_beside_it():
    particles = layout.build_particles(tank_with(gate()))
    first = is_gate(particles) & (particles.role == FACE)
    first &= (particles.position[:, 0] < 0.03 + D0)
    exact = WEIGHT * np.maximum(0.03 - particles.position[first, 2], 0.0)
    np.testing.assert_allclose(particles.pressure[first], exact, atol=1e-9)


def test_preflight_names_the_gate():
    lines = dict(preflight(tank_with(gate(0.0309))).sections["Particles"])
    assert lines["gate.0 in whole spacings"] == "x 0.03 m to 0.038 m"
    assert "40 gate, 40 gate dummy" in " ".join(lines.values())


# How they rise


def test_gate_rises_at_its_speed_from_its_time_on_and_stops_clear_of_the_walls():
    case = tank_with(gate(speed=1.3, opens=0.01))
    for time, height in ((0.0, 0.0), (0.01, 0.0), (0.015, 0.0065), (0.03, 0.026), (1.0, 0.04)):
        assert rise(case, time) == pytest.approx(height, abs=1e-12)


def test_particles_of_each_gate_follow_their_own():
    """In any order of the gates, and whatever the order of the particles."""
    case = tank_with(gate(0.04, 1.3), gate(0.02, 1.0))
    flow = flow_of(case)
    before = flow.particles.position.copy()
    run(flow, 5, 1e-4)
    moved = (flow.particles.position - before)[is_gate(flow.particles)]
    x = before[is_gate(flow.particles), 0]
    np.testing.assert_allclose(moved[:, 2], np.where(x < 0.03, 5e-4, 6.5e-4), rtol=1e-12)
    np.testing.assert_allclose(moved[:, :2], 0.0)
    speed = flow.particles.velocity[is_gate(flow.particles), 2]
    np.testing.assert_allclose(speed, np.where(x < 0.03, 1.0, 1.3), rtol=1e-9)


def test_predicted_projection_moves_the_gate_as_far():
    flow = run(flow_of(tank_with(gate(), **{**CLASSIC, "scheme.gradient": "gc"})), 5, 1e-4)
    plate = flow.particles.position[is_gate(flow.particles), 2]
    assert plate.min() == pytest.approx(0.5 * D0 + 5e-4)


# What they hold back, and let go


@pytest.mark.parametrize(
    ("changes", "weightless"),
    [
        ({}, 0.0),
        ({**CLASSIC, "scheme.gradient": "gc"}, 0.5 * D0),
    ],
    ids=["extrapolated", "solved"],
)
def test_closed_gate_holds_the_water_and_bears_its_weight(changes, weightless):
    """Where the surface is marked, half a layer has no weight (docs/recipe.md)."""
    case = tank_with(gate(opens=1.0), **{"particles.jitter": 0.001, **changes})
    p = run(flow_of(case), 250, DT).particles
    x = p.position[p.fluid]
    assert np.count_nonzero(x[:, 0] < 0.03) == 15 * 15
    assert x[x[:, 0] > 0.03, 2].max() < 0.01
    assert np.sqrt(np.mean(p.velocity[p.fluid] ** 2)) < 0.02
    for place, level in ((0.03, 0.03), (0.038, 0.01)):
        found = probe(p.position, p.velocity, p.pressure, p.role, D0, (place, 0.0, 0.005))[0]
        assert found == pytest.approx(WEIGHT * (level - weightless - 0.005), rel=0.06)


@pytest.mark.parametrize("changes", [{}, WALLED], ids=["2-D", "3-D"])
def test_water_leaves_first_below_a_gate_that_rises(changes):
    case = tank_with(gate(speed=0.5), **{"particles.jitter": 0.001, **changes})
    p = run(flow_of(case), 75, DT).particles  # the edge is 15 mm up, half the depth of the water
    through = p.fluid & (p.position[:, 0] > 0.03) & (p.velocity[:, 0] > 0.1)
    assert np.count_nonzero(through) > 8
    assert p.position[through, 2].max() < 0.017
    behind = p.fluid & (p.position[:, 0] < 0.03)
    assert p.position[behind, 2].max() > 0.025


def test_run_with_a_gate_goes_on_from_its_checkpoint_as_if_it_had_not_stopped(tmp_path):
    case = tank_with(gate(), **{"time.end": 0.02, "output.checkpoint": 0.01})
    whole = Simulation(case).run()
    Simulation(case, tmp_path / "cut").run(until=0.01)
    resumed = Simulation.resume(tmp_path / "cut").run()
    for name in ("position", "velocity", "pressure", "role"):
        np.testing.assert_array_equal(
            getattr(resumed.particles, name), getattr(whole.particles, name)
        )


def test_gate_stops_where_it_is_told_to_and_water_runs_out_below_it():
    case = tank_with(gate(speed=1.0, lift=0.01))
    assert rise(case, 0.005) == pytest.approx(0.005)
    assert rise(case, 0.5) == pytest.approx(0.01)
    sim = Simulation(case).run(until=0.1)
    p = sim.particles
    foot = p.position[is_gate(p), 2].min()
    assert foot == pytest.approx(0.01 + 0.5 * D0)
    below = p.fluid & (p.position[:, 0] > 0.03) & (p.position[:, 0] < 0.038)
    assert p.position[below, 2].max() < 0.01
    assert np.count_nonzero(p.fluid & (p.position[:, 0] > 0.04)) > 5 * 7 + 30


def test_gate_is_not_lifted_farther_than_clear_of_the_walls():
    assert rise(tank_with(gate(lift=9.0)), 10.0) == rise(tank_with(gate()), 10.0)


CALLS = {
    name: ["steps", {**SIZE, "water": [LEFT, RIGHT], "gate": [gate()], **changes}, 20, DT]
    for name, changes in {
        "2-D": {},
        "3-D periodic": {"tank.width": 0.02, "tank.periodic": True},
        "solved": {**CLASSIC, "scheme.solver": "piccg"},
    }.items()
}


@pytest.fixture(scope="module")
def on_two_ranks():
    """Outputs of all calls, which take one start."""
    return dict(zip(CALLS, start("each", 2, list(CALLS.values())), strict=True))


@pytest.mark.parametrize("name", CALLS)
def test_ranks_give_the_same_bits_with_a_gate_as_one(on_two_ranks, name):
    assert on_two_ranks[name] == alone(*CALLS[name])


# Bad input


def refusal(**changes):
    with pytest.raises(CaseError) as caught:
        tank_with(**changes)
    message = str(caught.value)
    assert "\n" not in message
    return message


@pytest.mark.parametrize(
    ("plates", "part"),
    [
        ([gate(0.0001)], "gate.0.x = 0.0001: must be from 0.002 to 0.05 m, for a gate 0.008 m"),
        ([gate(0.052)], "gate.0.x = 0.052: must be from 0.002 to 0.05 m"),
        ([gate(), gate(0.038)], "gate.1.x = 0.038: must be a spacing or more off gate.0, which"),
        ([gate(speed=0.0)], "gate.0.speed = 0.0: must be a number > 0"),
        ([gate(opens=-1.0)], "gate.0.opens = -1.0: must be "),
        ([gate(speed=2.8)], "gate.0.speed = 2.8: must be <= 1.356 m/s, a spacing in time.maximum"),
        ([{"x": 0.03}], "gate.0.speed"),
    ],
)
def test_gate_that_does_not_fit_is_refused(plates, part):
    assert part in refusal(gate=plates)


def test_gate_that_takes_all_the_room_of_the_water_is_refused():
    water = [{"from": [0.03, 0, 0], "to": [0.038, 0.02, 0.03]}]
    part = "gate = [0.03]: must be elsewhere: where these stand there is no room for the water"
    assert part in refusal(gate=[gate()], water=water)


def test_gate_over_a_dip_of_the_bed_rises_clear_of_the_walls():
    case = tank_with(gate(), water=[], **{"tank.bed": [[0, 0.01], [0.034, 0.0], [0.06, 0.01]]})
    assert rise(case, 9.0) == pytest.approx(0.04)


def test_gate_in_an_obstacle_is_refused():
    obstacle = [{"from": [0.032, 0, 0], "to": [0.044, 0, 0.012]}]
    message = refusal(gate=[gate()], obstacle=obstacle)
    assert message == "gate.0.x = 0.03: must be outside of obstacle.0, which a gate cannot pass"
    assert tank_with(gate(0.024), obstacle=obstacle).gate


def test_gate_in_the_way_of_the_piston_is_refused():
    changes = {"tank.width": 0.0, "gate": [gate(0.01)]}
    with pytest.raises(CaseError, match=r"^gate\.0\.x = 0\.01: must be at x >= 0\.0"):
        make_paddle(load_case("plunging_breaker", changes))
    assert make_paddle(load_case("plunging_breaker", {**changes, "gate": [gate(0.1)]}))


def test_case_with_gates_comes_back_from_its_toml():
    case = tank_with(gate(), gate(0.05, 1.3, opens=0.5))
    assert loads(dumps(case), "test") == case


def test_gate_of_unknowns_keeps_the_pressure_of_its_two_sides_apart():
    """Its inner columns are dummies: nothing is felt on the dry side."""
    case = tank_with(gate(opens=1.0), water=[LEFT], **{**CLASSIC, "scheme.gradient": "gc"})
    p = run(flow_of(case), 50, DT).particles
    inner = (p.position[:, 0] > 0.032) & (p.position[:, 0] < 0.036) & (p.position[:, 2] > 0.0)
    assert np.all(p.role[inner] == FILLER)
    dry = is_gate(p) & (p.role == FACE) & (p.position[:, 0] > 0.036)
    assert np.count_nonzero(dry) == 20
    assert np.all(p.pressure[dry] == 0.0)
