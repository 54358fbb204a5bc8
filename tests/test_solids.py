"""Solids: the contract, names, the lid, and solids of the user's own."""

import numpy as np
import pytest
from tanks import closest, flow_of, make_case, particles_at, run

from mpslab import Simulation
from mpslab.core.keys import CaseError
from mpslab.core.kinds import KIND_NAMES, kinds_of
from mpslab.core.motion import Sine, displacement
from mpslab.core.particles import FACE, FILLER, FIRST_SOLID
from mpslab.run.guard import find_lost
from mpslab.solids import layout
from mpslab.solids.census import census
from mpslab.solids.collection import solids_of
from mpslab.solids.piston import make_paddle
from mpslab.solids.solid import Solid

D0 = 0.002
FULL = {
    "tank.length": 0.1, "wavemaker.type": "linear", "wavemaker.height": 0.004,
    "wavemaker.period": 0.4, "obstacle": [{"from": [0.08, 0, 0], "to": [0.09, 0.02, 0.01]}],
    "gate": [{"x": 0.05, "speed": 0.5}],
}  # fmt: skip
WALLED = {"tank.width": 0.02, "tank.periodic": False}


# Contract


@pytest.fixture(params=[{}, WALLED], ids=["2-D", "3-D"])
def case(request):
    return make_case({**FULL, **request.param})


def test_contract_particles_are_faces_and_fillers_that_lie_in_their_solid(case):
    for solid in solids_of(case, make_paddle(case)).bodies.values():
        position, role = solid.particles(case)
        assert len(position) == len(role) > 0
        assert set(np.unique(role)) == {FACE, FILLER}
        assert np.all(solid.holds(position)), solid.name


def test_contract_water_is_in_no_solid(case):
    solids, particles = solids_of(case, make_paddle(case)), layout.build_particles(case)
    water = particles.position[particles.fluid]
    for solid in solids.bodies.values():
        assert not solid.holds(water).any(), solid.name


def test_contract_state_comes_back(case):
    paddle = make_paddle(case)
    particles = layout.build_particles(case, paddle.backmost)
    first, second = solids_of(case, paddle), solids_of(case, paddle)
    for solid in first.bodies.values():
        solid.begin(particles)
    second.restore(first.state())
    assert set(second.state()) == set(first.state())
    for name, value in first.state().items():
        np.testing.assert_array_equal(second.state()[name], value)


def test_contract_velocity_is_that_of_the_move(case):
    paddle = make_paddle(case)
    particles = layout.build_particles(case, paddle.backmost)
    solids, before = solids_of(case, paddle), particles.position.copy()
    for solid in solids.bodies.values():
        solid.begin(particles)
    solids.push(particles, 0.0, 0.01)
    solids.move(particles, 0.0, 0.01)
    moved = (particles.position - before) / 0.01
    np.testing.assert_allclose(moved, particles.velocity, atol=1e-12)
    assert set(particles.body[moved.any(axis=1)].tolist()) == {2, FIRST_SOLID + 1}


# Names


def test_solids_have_names_by_default_and_keep_theirs():
    boxes = [{"from": [0.02 * k, 0, 0], "to": [0.02 * k + 0.008, 0, 0.01]} for k in (1, 2)]
    boxes[0]["name"] = "sill"
    found = make_case({"tank.length": 0.08, "obstacle": boxes})
    assert [box.name for box in found.obstacle] == ["sill", "obstacle-2"]
    assert [s.name for s in solids_of(found).bodies.values()] == ["tank", "sill", "obstacle-2"]


@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("tank", "must be different from those of the tank, water, tank, bed, piston, end_wall"),
        ("obstacle-1", "gate.0.name = 'obstacle-1': must be different from obstacle.0.name"),
        ("a,b", "gate.0.name = 'a,b': must be text of one line and not empty, without any of"),
        ("", "gate.0.name = '': must be text of one line and not empty"),
    ],
)
def test_name_that_says_no_one_thing_is_refused(name, part):
    with pytest.raises(CaseError) as refused:
        make_case({**FULL, "gate": [{"x": 0.05, "speed": 0.5, "name": name}]})
    assert part in str(refused.value)


# Motion


def test_points_of_a_rolling_body_turn_about_its_axis():
    motion = Sine(2, np.pi / 2.0, 4.0, center=(1.0, 2.0))
    points = np.array([[2.0, 5.0, 2.0], [1.0, 0.0, 2.0]])
    moved = points + displacement(motion, points, 0.0, 1.0)
    np.testing.assert_allclose(moved, [[1.0, 5.0, 3.0], [1.0, 0.0, 2.0]], atol=1e-12)


# Lid


@pytest.mark.parametrize("changes", [{}, WALLED, {"particles.bed": "staircase"}],
                         ids=["2-D", "3-D", "staircase"])  # fmt: skip
@pytest.mark.parametrize("bed", [[], [[0.0, 0.0], [0.02, 0.0], [0.04, 0.011]]])
def test_lid_closes_the_tank(changes, bed):
    case = make_case({"tank.lid": True, "tank.height": 0.0301, "tank.bed": bed, **changes})
    particles = layout.build_particles(case)
    solid = particles.position[~particles.fluid]
    columns = np.unique(np.round(particles.position[particles.fluid, 0], 6))
    for x in columns:
        above = solid[(np.abs(solid[:, 0] - x) < 1e-6) & (solid[:, 2] > 0.03)]
        assert above[:, 2].min() == pytest.approx(0.03 + 0.5 * D0)
    assert closest(particles.position) > 0.69 * D0
    if not bed:
        counted = np.bincount(kinds_of(case, particles), minlength=len(KIND_NAMES))
        np.testing.assert_allclose(census(case), counted, atol=4)


def test_water_thrown_up_stays_below_the_lid():
    case = make_case({"tank.lid": True, "tank.height": 0.03})
    flow = flow_of(case)
    flow.particles.velocity[flow.particles.fluid, 2] = 1.0
    run(flow, 200, 2e-4)
    assert flow.particles.position[flow.particles.fluid, 2].max() < 0.03
    assert find_lost(case, flow.particles, 0.0) == []


def test_water_above_the_lid_is_lost():
    case = make_case({"tank.lid": True, "tank.height": 0.03})
    (lost,) = find_lost(case, particles_at(np.array([[0.02, 0.0, 0.04]])), 0.0)
    assert lost.reason == "through the lid"


@pytest.mark.parametrize("changes", [
    {"gate": [{"x": 0.02, "speed": 0.1}]}, {"wavemaker.type": "still"},
])  # fmt: skip
def test_lid_over_a_gate_or_wavemaker_is_refused(changes):
    with pytest.raises(CaseError, match=r"^tank\.lid = true: must be false with a wavemaker or"):
        make_case({"tank.lid": True, **changes})


# One's own


class Flap(Solid):
    """A square block in the middle of the tank that nods about its foot."""

    def __init__(self, name="flap", period=0.2):
        super().__init__(name)
        self.motion = Sine(2, np.radians(6.0), period, center=(0.02, 0.01))

    def particles(self, case):
        k = np.arange(4) + 0.5
        x, z = (a.ravel() for a in np.meshgrid(0.016 + k * D0, 0.008 + k * D0))
        outer = (np.abs(x - 0.02) > D0) | (np.abs(z - 0.012) > D0)
        return np.column_stack([x, 0.0 * x, z]), np.where(outer, FACE, FILLER)

    def holds(self, points):
        return (np.abs(points[:, 0] - 0.02) < 0.004) & (np.abs(points[:, 2] - 0.012) < 0.004)


flap = Flap()


def test_own_solid_takes_the_room_of_the_water_and_follows_its_motion():
    sim = Simulation(make_case(), solids=[flap])
    mine = sim.particles.body == FIRST_SOLID
    start = sim.particles.position[mine].copy()
    assert np.count_nonzero(mine) == 16
    assert np.count_nonzero(sim.particles.fluid) == 200 - 16
    sim.run(until=0.05)
    at = start + displacement(flap.motion, start, 0.0, sim.time)
    np.testing.assert_allclose(sim.particles.position[mine], at, atol=1e-6)
    assert np.abs(sim.particles.velocity[sim.particles.fluid]).max() > 0.02
    water = sim.particles.position[sim.particles.fluid]
    middle = (np.abs(water[:, 0] - 0.02) < D0) & (np.abs(water[:, 2] - 0.012) < D0)
    assert sim.lost == 0 and not middle.any()


def test_run_with_an_own_solid_goes_on_to_the_same_bytes(tmp_path):
    whole = Simulation(make_case(), solids=[flap]).run(until=0.03)
    Simulation(make_case(), tmp_path / "run", solids=[flap]).run(until=0.015)
    again = Simulation.resume(tmp_path / "run").run(until=0.03)
    assert again.particles.position.tobytes() == whole.particles.position.tobytes()


def test_own_solid_without_a_plain_name_is_refused():
    with pytest.raises(CaseError, match=r"^solids\.0\.name = 'a\.b': must be text of one line"):
        Simulation(make_case(), solids=[Flap("a.b")])


def test_own_solids_of_one_name_are_refused(tmp_path):
    with pytest.raises(ValueError, match="'flap': must have a name that no other solid has"):
        Simulation(make_case(), tmp_path / "run", solids=[flap, Flap()])
    assert not (tmp_path / "run").exists()
