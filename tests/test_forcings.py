"""Forcings: gravity, the inertia of a tank that moves, and those of the user's own."""

import numpy as np
import pytest
from ranks import alone, start
from tanks import flow_of, make_case, particles_at, run

from mpslab import Simulation
from mpslab.core.keys import CaseError
from mpslab.core.motion import Sine, Table
from mpslab.core.particles import FLUID
from mpslab.forcings import forcings_of, frame, total

G = 9.81
RECORD = "time [s],x [m],z [m],roll [deg]\n0,0,0,0\n0.2,0.03,0,4\n0.5,0.05,0.02,-3\n0.9,0,0,6\n"


@pytest.fixture
def record(tmp_path):
    path = tmp_path / "tank.csv"
    path.write_text(RECORD)
    return path


def moving(**keys):
    return make_case({f"frame.{key}": value for key, value in keys.items()})


def test_case_at_rest_has_gravity_alone():
    (only,) = forcings_of(make_case())
    np.testing.assert_array_equal(only(np.zeros((4, 3)), np.zeros((4, 3)), 0.3), [0.0, 0.0, -G])


# The frame


def in_earth(motion, place, time):
    """Where a place of the tank, at its (x, z), is in the earth's frame."""
    x, z, angle = motion(time)
    cosine, sine = np.cos(angle), np.sin(angle)
    turn, center = np.array([[cosine, -sine], [sine, cosine]]), np.array(motion.center)
    return center + [x, z] + turn @ (place - center)


@pytest.mark.parametrize("kind", ["sway", "heave", "roll", "file"])
def test_free_particle_flies_straight_in_the_earths_frame(kind, record):
    """A path in the tank that follows the forcings is a parabola seen from the earth."""
    keys = {"file": record} if kind == "file" else {"amplitude": 3.0, "period": 0.4, "start": 0.3}
    case = moving(type=kind, center=[0.01, -0.02], **keys)
    forcings, motion = forcings_of(case), frame.motion_of(case.frame)
    state, time, dt = np.array([0.02, 0.03, 0.5, -0.2]), 0.05, 1e-4

    def rate(s, t):
        p = particles_at(np.array([[s[0], 0.0, s[1]]]))
        p.velocity[0] = s[2], 0.0, s[3]
        force = np.broadcast_to(total(forcings, p, t), (1, 3))
        return np.array([s[2], s[3], force[0, 0], force[0, 2]])

    path = []
    for _ in range(1201):
        path.append(in_earth(motion, state[:2], time))
        k1 = rate(state, time)
        k2 = rate(state + 0.5 * dt * k1, time + 0.5 * dt)
        k3 = rate(state + 0.5 * dt * k2, time + 0.5 * dt)
        state, time = state + dt / 6 * (k1 + 2 * k2 + 2 * k3 + rate(state + dt * k3, time + dt)), (
            time + dt
        )
    t = dt * np.arange(len(path))
    x, z = np.array(path).T
    np.testing.assert_allclose(x, np.polyval(np.polyfit(t, x, 1), t), atol=1e-7)
    np.testing.assert_allclose(np.polyfit(t, z, 2)[0], -0.5 * G, rtol=1e-4)


@pytest.mark.parametrize("motion", [
    Sine(2, 0.1, 0.7, start=0.5),
    Table(np.array([0.0, 0.2, 0.5, 1.2]), np.random.default_rng(1).normal(size=(4, 3))),
])  # fmt: skip
def test_derivatives_of_a_motion_are_those_of_its_path(motion):
    h = 1e-4
    for t in np.linspace(0.01, 1.1, 23):
        for order in (1, 2):
            slope = (motion(t + h, order - 1) - motion(t - h, order - 1)) / (2 * h)
            np.testing.assert_allclose(motion(t, order), slope, rtol=1e-3, atol=1e-3)


def test_recorded_motion_is_at_rest_before_and_after_its_rows():
    motion = Table(np.array([0.0, 0.2, 0.5]), np.array([[0.1, 0, 0], [0.3, 0, 0], [0.2, 0, 0]]))
    for time, place in ((-1.0, 0.1), (0.7, 0.2)):
        np.testing.assert_allclose(motion(time), [place, 0.0, 0.0])
        assert np.all(motion(time, 1) == 0.0) and np.all(motion(time, 2) == 0.0)


def test_constant_angle_tilts_gravity_and_lifts_the_far_end(tmp_path):
    path = tmp_path / "still.csv"
    path.write_text("time,roll\n0,10\n1,10\n2,10\n")
    forcings = forcings_of(moving(type="file", file=path))
    force = total(forcings, particles_at(np.zeros((1, 3))), 0.5)
    a = np.radians(10.0)
    np.testing.assert_allclose(force, [[-G * np.sin(a), 0.0, -G * np.cos(a)]])


def test_heaving_tank_weighs_more_where_it_speeds_up():
    """Walls see the inertia as the water does: no flow, and the pressure of g + a."""
    case = moving(type="heave", amplitude=0.005, period=0.2)
    flow = run(flow_of(case), 40, 5e-4)
    p, t = flow.particles, flow.time - 0.5 * 5e-4
    w = 2.0 * np.pi / 0.2
    gravity = G - 0.005 * w * w * np.sin(w * t)
    deep = p.fluid & (p.position[:, 2] < 0.01)
    exact = 1000.0 * gravity * (0.02 - p.position[deep, 2])
    assert gravity < 0.85 * G
    np.testing.assert_allclose(p.pressure[deep], exact, rtol=0.03)
    assert np.abs(p.velocity[p.fluid]).max() < 5e-3


@pytest.mark.parametrize(
    ("keys", "part"),
    [
        ({"type": "roll", "period": 1.0}, "frame.amplitude = 0.0: must be > 0 for frame.type"),
        ({"type": "sway", "amplitude": 0.1}, "frame.period = 0.0: must be > 0 for frame.type"),
        ({"type": "file"}, "frame.file = '': must be a CSV file that exists"),
        ({"type": "yaw"}, "frame.type = 'yaw': must be one of none, sway"),
        ({"center": [0.0, 0.0, 0.0]}, "must be two numbers [x, z] [m]"),
    ],
)
def test_frame_that_lacks_something_is_refused(keys, part):
    with pytest.raises(CaseError, match="frame") as refused:
        moving(**keys)
    assert part in str(refused.value)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "heading"),
        ("t,x\n0,0\n", "must be time [s] and any of"),
        ("time,y\n0,0\n", "must be time [s] and any of"),
        ("time [s],x [m]\n0,0\n1,1\n", "must have 3 rows"),
        ("time,x\n0,0\n1,nan\n2,0\n", "row 3: '1,nan' must be 2 finite numbers"),
        ("time,x\n0,0\n1,1,1\n2,0\n", "row 3"),
        ("time,x\n0,0\n1,1\n1,0\n", "row 4: time must be above that of the row before"),
    ],
)
def test_file_that_is_no_record_is_refused_in_one_line(tmp_path, text, part):
    (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(ValueError, match=r"^frame\.file") as refused:
        moving(type="file", file=tmp_path / "bad.csv")
    assert part in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1


def test_run_goes_on_to_the_same_bytes_with_its_copy_of_the_file(tmp_path, record):
    case = moving(type="file", file=record)
    whole = Simulation(case, tmp_path / "whole").run(until=0.05)
    part = Simulation(case, tmp_path / "part").run(until=0.02)
    record.unlink()
    again = Simulation.resume(tmp_path / "part").run(until=0.05)
    assert (tmp_path / "part/frame.csv").read_text() == RECORD
    assert part.time < again.time == whole.time
    assert again.particles.position.tobytes() == whole.particles.position.tobytes()


ROLL = {"frame": {"type": "roll", "amplitude": 4.0, "period": 0.3}, "tank.lid": True}
CALLS = {
    name: ["steps", {"tank.length": 0.08, **ROLL, **changes}, 20, 4e-4]
    for name, changes in {
        "2-D": {}, "3-D": {"tank.width": 0.02, "tank.periodic": True},
    }.items()
}  # fmt: skip


@pytest.fixture(scope="module")
def on_two_ranks():
    """Outputs of all calls, which take one start."""
    return dict(zip(CALLS, start("each", 2, list(CALLS.values())), strict=True))


@pytest.mark.parametrize("name", CALLS)
def test_ranks_give_the_same_bits_in_a_rolling_tank_as_one(on_two_ranks, name):
    assert on_two_ranks[name] == alone(*CALLS[name])


# One's own


def wind(position, velocity, time):
    """Pushes the water along, more so above, from a time on."""
    push = np.zeros_like(position)
    push[:, 0] = 3.0 * position[:, 2] / 0.02 * (time > 0.005)
    return push


def test_own_forcing_moves_the_water_and_is_found_again_by_its_name(tmp_path):
    calm = Simulation(make_case()).run(until=0.03)
    whole = Simulation(make_case(), forcings=[wind]).run(until=0.03)
    fluid = whole.particles.role == FLUID
    blown = whole.particles.velocity[fluid, 0].mean() - calm.particles.velocity[fluid, 0].mean()
    assert blown > 1e-3
    Simulation(make_case(), tmp_path / "run", forcings=[wind]).run(until=0.015)
    again = Simulation.resume(tmp_path / "run").run(until=0.03)
    assert again.particles.position.tobytes() == whole.particles.position.tobytes()


def test_own_forcing_without_a_name_is_refused_unless_it_is_given_again(tmp_path):
    def breeze(position, velocity, time):
        return np.array([0.1, 0.0, 0.0])

    Simulation(make_case(), tmp_path / "run", forcings=[breeze]).run(until=0.005)
    with pytest.raises(ValueError, match=r"given again, Simulation.resume\(folder, forcings"):
        Simulation.resume(tmp_path / "run")
    Simulation.resume(tmp_path / "run", forcings=[breeze])


def test_another_forcing_than_the_run_began_with_is_refused(tmp_path):
    Simulation(make_case(), tmp_path / "run", forcings=[wind]).run(until=0.005)
    with pytest.raises(ValueError, match=r"forcings = \[\]: .*, \['test_forcings:wind'\]"):
        Simulation.resume(tmp_path / "run", forcings=[])


@pytest.mark.parametrize(
    ("gives", "why"),
    [
        (lambda position: np.ones(len(position)), r"gave an array of shape \(2,\) for 2 particles"),
        (lambda position: position[:, :2], r"gave an array of shape \(2, 2\) .*: must be"),
        (lambda position: 1.0, r"gave an array of shape \(\)"),
        (lambda position: None, r"gave an array of shape \(\)"),
        (lambda position: [[1.0], [1.0, 2.0]], r"gave \[\[1.0\], \[1.0, 2.0\]\]"),
        (lambda position: [0.0, 0.5, 0.0], "gave 0.5 m/s2 along y: must be 0 in a 2-D tank"),
        (lambda position: np.add(position, [0.0, -2.0, 0.0]), "gave -2 m/s2 along y"),
    ],
)
def test_own_forcing_that_gives_no_acceleration_is_refused_by_name(tmp_path, gives, why):
    def gale(position, velocity, time):
        return gives(position)

    with pytest.raises(ValueError, match=f"^forcing 'gale': {why}"):
        Simulation(make_case(), tmp_path / "run", forcings=[gale])
    assert not (tmp_path / "run").exists()


def test_own_forcing_that_goes_wrong_later_is_named(tmp_path):
    def gale(position, velocity, time):
        return np.zeros(3 if time < 0.002 else 2)

    with pytest.raises(ValueError, match=r"^forcing 'gale': gave an array of shape \(2,\)"):
        Simulation(make_case(), forcings=[gale]).run(until=0.01)


def test_own_forcing_that_is_no_function_is_refused():
    with pytest.raises(ValueError, match=r"^forcing = 9\.81: must be a function"):
        Simulation(make_case(), forcings=[9.81])


def test_own_forcing_may_push_across_a_tank_that_has_a_width():
    case = make_case({"tank.width": 0.02, "tank.periodic": True})
    forcings = forcings_of(case, [lambda *given: [0.0, 1.0, 0.0]])
    force = total(forcings, particles_at(np.zeros((2, 3))), 0.0)
    np.testing.assert_allclose(force, [0.0, 1.0, -G])
