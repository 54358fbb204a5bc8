"""Short runs whose outcome is known: still water, free fall, a drop, a standing wave."""

import math

import numpy as np
import pytest
from tanks import CLASSIC, flow_of, make_case, run

from mpslab import Simulation, load_case
from mpslab.core import plugins, timestep
from mpslab.core.diagnostics import max_speed, volume
from mpslab.core.particles import FACE
from mpslab.run import initial
from mpslab.run.step import advance

D0, DENSITY, GRAVITY = 0.002, 1000.0, 9.81
PAPER = {"scheme.gradient": "cmps_soft", "scheme.gradient_radius": 3.1, "scheme.walls": "copied"}
CONSERVATIVE = [
    name
    for name in plugins.names("gradients")
    if plugins.load("gradients", name).CONSERVES_MOMENTUM
]


def floor_pressure(scheme, jitter=0.001, steps=200, settle=50, dt=4e-4):
    """Mean and standard deviation, after `settle` steps, of p at the bed over rho g h."""
    tank = {"tank.length": 0.03, "tank.depth": 0.04}
    flow = flow_of(make_case({**tank, **scheme, "particles.jitter": jitter}))
    x, z = flow.particles.position[:, 0], flow.particles.position[:, 2]
    bed = (flow.particles.role == FACE) & (z < 0.0) & (z > -D0) & (x > 0.0) & (x < 0.03)
    mean = []
    for _ in range(steps):
        run(flow, 1, dt)
        mean.append(flow.particles.pressure[bed].mean())
    ratio = np.array(mean[settle:]) / (DENSITY * GRAVITY * (0.04 + 0.5 * D0))
    return ratio.mean(), ratio.std()


@pytest.mark.parametrize("jitter", [0.001, 0.02])
def test_still_water_stands_on_the_bed_with_its_weight(jitter):
    mean, scatter = floor_pressure({}, jitter, steps=500, settle=200)
    assert mean == pytest.approx(1.0, abs=0.03)
    assert scatter < 0.03


@pytest.mark.parametrize("gradient", ["mps", "symmetric", "gc"])
def test_other_gradients_hold_still_water_as_well(gradient):
    mean, _ = floor_pressure({**CLASSIC, "scheme.gradient": gradient})
    assert mean == pytest.approx(1.0, abs=0.1)


def test_gc_holds_still_water_without_noise():
    mean, scatter = floor_pressure({**CLASSIC, "scheme.gradient": "gc"})
    assert mean == pytest.approx(1.0, abs=0.03)
    assert scatter < 0.005


def test_cmps_holds_still_water_with_several_times_its_weight_only():
    """It does not see a linear pressure: p ~ rho g z^2/(2 k d0) is what carries 20 layers.

    Here k is how many layers the radius reaches, 2 or 3: five times the weight, or 3.3 times.
    """
    mean, _ = floor_pressure({**CLASSIC, "scheme.gradient": "cmps"})
    assert 4.0 < mean < 6.5
    mean, _ = floor_pressure({**CLASSIC, **PAPER}, steps=150)
    assert 3.0 < mean < 4.5


@pytest.mark.parametrize("gradient", plugins.names("gradients"))
@pytest.mark.parametrize("width", [0.0, 0.02])
def test_block_in_the_air_falls_with_g(gradient, width):
    tank = {"tank.width": width, "tank.length": 0.02}
    case = make_case({**CLASSIC, **tank, "scheme.gradient": gradient})
    flow = flow_of(case, keep=lambda particles: particles.fluid)
    start = flow.particles.position.copy()
    steps, dt = 20, 5e-4
    run(flow, steps, dt)
    down = np.array([0.0, 0.0, -1.0])
    # Semi-implicit steps: the fall is g dt^2 (1 + 2 + ... + n).
    speed, fall = GRAVITY * steps * dt, GRAVITY * dt**2 * steps * (steps + 1) / 2
    assert np.abs(flow.particles.velocity - speed * down).max() < 1e-9
    assert np.abs(flow.particles.position - start - fall * down).max() < 1e-12


def drop(changes, dim):
    """A ball of water in the air, squeezed and stirred."""
    tank = {"tank.length": 0.03, "tank.depth": 0.03, "tank.width": 0.03 * (dim - 2)}
    case = make_case({**tank, "particles.jitter": 0.1, **changes})

    def ball(particles):
        middle = particles.position[particles.fluid].mean(axis=0)
        away = np.linalg.norm(particles.position - middle, axis=1)
        return particles.fluid & (away < 0.012)

    flow = flow_of(case, keep=ball)
    particles = flow.particles
    stir = np.random.default_rng(1).normal(size=(len(particles), 3)) * 0.1 * [1.0, dim - 2.0, 1.0]
    particles.velocity[:] = stir - 10.0 * (particles.position - particles.position.mean(axis=0))
    return flow


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize(
    "scheme",
    [*({"scheme.gradient": name} for name in CONSERVATIVE), {"scheme.recipe": "paper"}],
    ids=[*CONSERVATIVE, "paper"],
)
def test_momentum_of_a_drop_changes_by_its_weight_alone(scheme, dim):
    """Pressure, viscosity, stabilisers and clipping together: pair forces all of them."""
    flow = drop(scheme, dim)
    before, highest = flow.particles.velocity.sum(axis=0), 0.0
    scale = np.abs(flow.particles.velocity).sum()
    steps, dt = 40, 1e-4
    for _ in range(steps):
        run(flow, 1, dt)
        highest = max(highest, flow.particles.pressure.max())
    change = flow.particles.velocity.sum(axis=0) - before
    change[2] += GRAVITY * steps * dt * len(flow.particles)
    assert highest > 50.0
    assert np.abs(change).max() < 1e-12 * scale


@pytest.mark.parametrize(
    "scheme",
    [{}, {**CLASSIC, "scheme.gradient": "gc", "scheme.shifting_strength": 0.65}],  # 0.25 a step
    ids=["standard", "gc"],
)
def test_layer_of_water_keeps_its_level_and_volume(scheme):
    """3-D, periodic across, 10 layers on a bed between end walls."""
    tank = {"tank.length": 0.014, "tank.depth": 0.02, "tank.width": 0.014, "tank.periodic": True}
    case = make_case({**tank, **scheme, "particles.jitter": 0.02})
    flow = flow_of(case)
    water = flow.particles.fluid
    height = flow.particles.position[water, 2].mean()
    run(flow, 200, 2.5e-4)
    assert flow.particles.position[water, 2].mean() == pytest.approx(height, rel=0.015)
    assert volume(flow.particles, flow.stencil) == pytest.approx(0.014**2 * 0.02, rel=0.02)


def test_deep_column_has_its_pressure_from_the_first_steps_on():
    """60 layers.  As it leaves the lattice, unsettled water whose velocities may be uneven, and
    whose pressure may correct too much, has nothing to stand on, then a shock.

    In a collapsing column the pressure at the rear of the bed can only be less than rho g h.
    """
    lowest, highest = rear_pressure(80)
    assert lowest > 0.6
    assert highest < 1.2
    as_before = {"scheme.hyperviscosity": 0.0, "scheme.residue": 0.0, "time.maximum": 8.74e-4}
    lowest, highest = rear_pressure(0, as_before)
    assert lowest < 0.4
    assert highest > 2.0


def rear_pressure(settling, changes=None):
    """Least and largest p/(rho g h) near the rear of the bed, to 0.04 s, after ten steps."""
    column = {"tank.width": 0.0, "particles.spacing": 0.005, "scheme.settling": settling}
    simulation = Simulation(load_case("dam_break", column | (changes or {})))
    ratios = []
    while simulation.time < 0.04:
        simulation.advance()
        water = simulation.particles.take(simulation.particles.fluid)
        near = (water.position[:, 0] < 0.06) & (water.position[:, 2] < 0.015)
        ratios.append(water.pressure[near].mean() / (DENSITY * GRAVITY * 0.3))
    after_the_first = np.array(ratios[10:])
    return after_the_first.min(), after_the_first.max()


def test_short_waves_of_half_a_spacing_lose_little():
    """With the divergence counted at the surface, too, four of them lost 0.09 in two periods."""
    assert np.mean([lost_in_two_periods(seed) for seed in range(4)]) < 0.065


def lost_in_two_periods(seed):
    """Share that the first mode of the volume loses in a standing wave of 31 spacings."""
    case = load_case("standing_wave", {
        "tank.length": 0.62, "tank.depth": 0.3, "tank.height": 0.4, "particles.spacing": 0.01,
        "initial.amplitude": 0.005, "initial.mode": 4, "gauge": [], "particles.seed": seed,
    })  # fmt: skip
    k = 4.0 * math.pi / case.tank.length
    half = math.pi / math.sqrt(GRAVITY * k * math.tanh(k * case.tank.depth))
    simulation, time, mode = Simulation(case), [], []
    while simulation.time < 7.0 * half:
        simulation.advance()
        x = simulation.particles.position[simulation.particles.fluid, 0]
        time.append(simulation.time)
        mode.append(np.cos(k * x).sum())
    swing = np.array(time) // half
    peaks = [np.abs(np.array(mode)[swing == n]).max() for n in range(7)]
    return 1.0 - (peaks[5] + peaks[6]) / (peaks[1] + peaks[2])


def test_standing_wave_has_its_linear_period_and_does_not_die():
    """The centre of the water swings from side to side; it crosses the middle every T/2."""
    case = load_case("standing_wave", {"particles.spacing": 0.004, "initial.amplitude": 0.01})
    k = math.pi / case.tank.length
    period = 2.0 * math.pi / math.sqrt(GRAVITY * k * math.tanh(k * case.tank.depth))
    flow, dt = flow_of(case), 0.0
    initial.set_velocity(case, flow.particles, flow.domain.total)
    swing = []
    while flow.time < 1.2 * period and len(swing) < 1000:
        dt, _ = timestep.choose(case, dt, max_speed(flow.particles))
        assert advance(flow, dt).converged
        water = flow.particles.fluid
        swing.append((flow.time, flow.particles.position[water, 0].mean()))
    assert flow.time >= 1.2 * period
    time, x = np.transpose(swing)
    x -= 0.5 * case.tank.length
    crossings = time[1:][np.diff(np.sign(x)) != 0.0]
    np.testing.assert_allclose(crossings[-2:], [0.5 * period, period], rtol=0.03)
    assert -x.min() > 0.9 * x.max()
