"""What one time step does besides the pressure: viscosity, the period, the piston, stages."""

from types import SimpleNamespace

import numpy as np
import pytest
from tanks import CLASSIC, flow_of, inside, make_case, run

from mpslab.core.particles import PISTON
from mpslab.core.stopwatch import PHASES
from mpslab.run.step import advance

D0, DT = 0.002, 1e-4
# A square lattice resists shear along its rows by so much less: 8 sum w x^2 z^2/r^2 / (lambda0 n0).
SOFTER = 0.8545


def block(changes=None):
    """Block of water in the air, 20 x 20 particles, and its coordinates about the middle."""
    case = make_case({"tank.length": 0.04, "tank.depth": 0.04, **(changes or {})})
    flow = flow_of(case, keep=lambda particles: particles.fluid)
    return flow, flow.particles.position - flow.particles.position.mean(axis=0)


@pytest.mark.parametrize("viscosity", [0.0, 1e-4, 1e-3])
def test_viscosity_slows_a_parabolic_profile_at_its_rate(viscosity):
    """du/dt = nu d2u/dz2 inside the block, along the rows of a square lattice (`SOFTER`)."""
    flow, x = block({"fluid.viscosity": viscosity})
    flow.time = 1.0  # from when on the density of a block in the air keeps its pressure at zero
    curvature = 40.0
    flow.particles.velocity[:, 0] = 0.5 * curvature * x[:, 2] ** 2
    before = flow.particles.velocity[:, 0].copy()
    run(flow, 1, DT)
    change = (flow.particles.velocity[:, 0] - before)[inside(x, 5 * D0)]
    np.testing.assert_allclose(change, SOFTER * viscosity * curvature * DT, rtol=0.01, atol=1e-9)


def test_periodic_tank_brings_water_back_across():
    tank = {"tank.width": 0.016, "tank.periodic": True}
    flow = flow_of(make_case(tank))
    water = flow.particles.fluid
    start = flow.particles.position[water, 1].copy()
    flow.particles.velocity[water, 1] = 2.0
    run(flow, 20, 2e-4)
    y = flow.particles.position[:, 1]
    assert np.all((y >= 0.0) & (y < 0.016))
    moved = np.round((y[water] - start - 20 * 2e-4 * 2.0) / 0.016, 2)
    assert np.mean(np.isin(moved, [0.0, -1.0])) > 0.9
    assert np.any(moved == -1.0)


def test_piston_pushes_the_water_ahead_and_lets_none_through():
    wave = {"wavemaker.type": "linear", "wavemaker.height": 0.006, "wavemaker.period": 0.4}
    flow = flow_of(make_case({"tank.length": 0.1, **wave}))
    water = flow.particles.fluid
    middle = flow.particles.position[water, 0].mean()
    run(flow, 400, 5e-4)
    face = flow.solids.face(flow.time)
    assert flow.time == pytest.approx(0.2)
    assert face > 2.0 * D0
    assert flow.particles.position[flow.particles.body == PISTON, 0].max() == pytest.approx(
        face - 0.5 * D0
    )
    assert flow.particles.position[water, 0].min() > face
    assert flow.particles.position[water, 0].mean() > middle + 0.25 * face


def test_walls_never_move():
    flow = flow_of(make_case())
    solid = ~flow.particles.fluid
    position = flow.particles.position[solid].copy()
    run(flow, 5, 2e-4)
    assert np.all(flow.particles.position[solid] == position)
    assert np.all(flow.particles.velocity[solid] == 0.0)


def test_report_of_a_solve_that_failed_is_handed_back():
    flow = flow_of(make_case({"scheme.max_iterations": 1, "scheme.tolerance": 1e-12}))
    report = advance(flow, 2e-4)
    assert not report.converged
    assert report.iterations == 1


def test_stabilisers_act_in_their_stage_with_the_positions_of_the_prediction():
    """`predicted` before the pressure is solved; `corrected` with the positions before it acted."""
    flow, calls = flow_of(make_case(CLASSIC)), []

    def model(stage):
        def stabilise(near, dt, pace, scheme):
            by_gid = np.argsort(near.particles.gid)
            before, now = near.position[:, :3], near.particles.position
            calls.append((stage, before[by_gid], now[by_gid], dt))

        return SimpleNamespace(STAGE=stage, stabilise=stabilise)

    flow.stabilisers = (model("corrected"), model("predicted"))
    start = flow.particles.position.copy()
    run(flow, 1, DT)
    (first, _, predicted, _), (second, before, corrected, dt) = calls
    assert (first, second, dt) == ("predicted", "corrected", DT)
    fall = np.where(flow.particles.fluid, -9.81 * DT**2, 0.0)
    np.testing.assert_allclose(predicted - start, np.outer(fall, [0, 0, 1]), atol=1e-15)
    np.testing.assert_array_equal(before, predicted)
    change = flow.particles.velocity[:, 2] + np.where(flow.particles.fluid, 9.81 * DT, 0.0)
    np.testing.assert_allclose(corrected[:, 2] - before[:, 2], change * DT, atol=1e-12)
    assert np.abs(corrected - before).max() > 0.0


def test_phases_of_the_step_are_timed():
    flow = flow_of(make_case())
    run(flow, 2, DT)
    assert set(flow.stopwatch.seconds) == set(PHASES) - {"record", "rest"}
    assert all(seconds > 0.0 for seconds in flow.stopwatch.seconds.values())
