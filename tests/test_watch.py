"""The watch over a run: who left the tank by which side, and which states stop the run."""

import re

import numpy as np
import pytest
from tanks import flow_of, make_case, particles_at

from mpslab import load_case
from mpslab.core.particles import FACE, FILLER
from mpslab.pressure.system import SolverReport
from mpslab.run.guard import RunFailed, check_lost, check_step, find_lost

D0 = 0.002
GOOD = SolverReport(12, 1e-7, True)
DT = 1e-4


@pytest.fixture
def flow():
    """Closed 2-D tank at step 7, t = 0.0125 s."""
    flow = flow_of(make_case())
    flow.time = 0.0125
    return flow


def fluid_row(flow):
    return int(np.flatnonzero(flow.particles.fluid)[50])


def failure(flow, report=GOOD, dt=DT, step=7):
    with pytest.raises(RunFailed) as caught:
        check_step(flow, report, dt, step)
    return str(caught.value)


def assert_names_step_time_and_place(message, flow, row):
    x, y, z = flow.particles.position[row]
    assert "\n" not in message
    assert re.search(r"\bstep 7\b", message)
    assert "t = 0.0125 s" in message
    assert f"particle {flow.particles.gid[row]} at" in message
    assert f"z = {z:.4g} m" in message
    assert f"y = {y:.4g}" in message
    assert f"x = {x:.4g}" in message


def test_good_step_passes(flow):
    check_step(flow, GOOD, DT, 7)


@pytest.mark.parametrize("field", ["position", "velocity"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_not_a_number_stops_the_run(flow, field, value):
    row = fluid_row(flow)
    getattr(flow.particles, field)[row, 2] = value
    getattr(flow.particles, field)[row + 1, 0] = value
    message = failure(flow)
    assert message.startswith("not a number in 2 particles")
    assert_names_step_time_and_place(message, flow, row)


def test_unconverged_pressure_stops_the_run_and_names_the_fastest_particle(flow):
    row = fluid_row(flow)
    flow.particles.velocity[row] = [0.0, 0.0, -3.0]
    message = failure(flow, SolverReport(2000, 3.4e-2, False))
    assert "did not converge" in message
    assert "residual 0.034 after 2000 iterations" in message
    assert "scheme.tolerance = 1e-05" in message
    assert_names_step_time_and_place(message, flow, row)
    message = failure(flow, SolverReport(2000, 3.4e-2, False, coarse=0.2))
    assert "did not converge, nor did its coarse system (residual 0.2): residual 0.034" in message


def test_unconverged_pressure_that_is_not_a_number_stops_the_run(flow):
    assert "residual nan" in failure(flow, SolverReport(1, float("nan"), False))


def test_time_step_below_the_floor_stops_the_run(flow):
    row = fluid_row(flow)
    flow.particles.velocity[row] = [500.0, 0.0, 0.0]
    least = flow.case.time.minimum
    message = failure(flow, dt=0.5 * least)
    assert f"below time.minimum = {least:.3g} s" in message
    assert f"time step {0.5 * least:.3g} s" in message
    assert_names_step_time_and_place(message, flow, row)


def test_time_step_at_the_floor_passes(flow):
    check_step(flow, GOOD, flow.case.time.minimum, 7)


def test_too_many_lost_particles_stop_the_run(flow):
    row = fluid_row(flow)
    flow.particles.velocity[row] = [0.0, 0.0, 9.0]
    with pytest.raises(RunFailed) as caught:
        check_lost(flow, 6, {"behind the end wall": 5, "below the bed": 1}, 5000, 7)
    message = str(caught.value)
    assert message.startswith("6 of 5000 fluid particles lost, more than 0.1 %")
    assert "5 behind the end wall, 1 below the bed" in message
    assert "tank.height" not in message
    assert_names_step_time_and_place(message, flow, row)


def test_water_that_went_over_the_walls_names_the_key_that_holds_it(flow):
    with pytest.raises(RunFailed, match=r"4 over the end wall; tank\.height = 0\.06 m is too low"):
        check_lost(flow, 8, {"over the end wall": 4}, 500, 7)


@pytest.mark.parametrize(("lost", "at_start"), [(0, 100), (0, 0), (5, 5000), (96, 96_000)])
def test_one_lost_particle_in_a_thousand_is_borne(flow, lost, at_start):
    check_lost(flow, lost, {"below the bed": lost}, at_start, 7)


@pytest.mark.parametrize("lost", [1, 5])
def test_small_run_bears_a_few_lost_particles(flow, lost):
    check_lost(flow, lost, {"over the end wall": lost}, 200, 7)


def lost_at(case, position, face=0.0, role=0):
    particles = particles_at(np.array([position, [0.02, 0.0, 0.01]]), np.array([role, 0]))
    return [(lost.rows.tolist(), lost.reason) for lost in find_lost(case, particles, face)]


# Tank of 0.04 x 0.02 m: a particle a spacing outside is borne, a little further it is lost.
SIDES = [
    ([-D0, 0.0, 0.01], [-0.01 * D0, 0.0, 0.0], "behind the wall at x = 0"),
    ([-D0, 0.0, 0.07], [-0.01 * D0, 0.0, 0.0], "over the wall at x = 0"),
    ([0.04 + D0, 0.0, 0.07], [0.01 * D0, 0.0, 0.0], "over the end wall"),
    ([0.04 + D0, 0.0, 0.01], [0.01 * D0, 0.0, 0.0], "behind the end wall"),
    ([0.01, 0.0, -D0], [0.0, 0.0, -0.01 * D0], "below the bed"),
]


@pytest.mark.parametrize(("limit", "outwards", "reason"), SIDES)
def test_water_beyond_a_wall_by_more_than_a_spacing_is_lost(limit, outwards, reason):
    case, limit, outwards = make_case(), np.array(limit), np.array(outwards)
    assert lost_at(case, limit + outwards) == [([0], reason)]
    assert lost_at(case, limit - outwards) == []


@pytest.mark.parametrize("role", [FACE, FILLER])
def test_walls_are_never_lost(role):
    assert lost_at(make_case(), [-1.0, 0.0, -1.0], role=role) == []


def test_wavemaker_takes_its_limit_along():
    case = make_case({"wavemaker.type": "still"})
    assert lost_at(case, [0.005, 0.0, 0.01], face=0.0) == []
    assert lost_at(case, [0.005, 0.0, 0.01], face=0.01) == [([0], "behind the wavemaker")]
    assert lost_at(case, [-0.005, 0.0, 0.01], face=-0.01) == []


def test_bed_limit_follows_the_slope():
    case = load_case("plunging_breaker", {"tank.width": 0.0, "particles.spacing": D0})
    assert lost_at(case, [0.6, 0.0, 0.04 - 1.1 * D0]) == [([0], "below the bed")]
    assert lost_at(case, [0.6, 0.0, 0.04 - 0.9 * D0]) == []


@pytest.mark.parametrize("y", [-1.01 * D0, 0.02 + 1.01 * D0])
def test_side_walls_lose_water_and_a_periodic_tank_does_not(y):
    tank = {"tank.width": 0.02}
    walled = make_case({**tank, "tank.periodic": False})
    periodic = make_case({**tank, "tank.periodic": True})
    assert lost_at(walled, [0.02, y, 0.01]) == [([0], "behind a side wall")]
    assert lost_at(periodic, [0.02, y, 0.01]) == []


def test_particle_beyond_two_walls_is_lost_once():
    assert lost_at(make_case(), [-1.0, 0.0, -1.0]) == [([0], "behind the wall at x = 0")]


def test_water_in_the_air_above_the_walls_is_not_lost():
    assert lost_at(make_case(), [0.02, 0.0, 5.0]) == []
