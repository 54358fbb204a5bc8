"""Water without gravity, free of all walls: a drop that is stretched and a patch that spins."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tanks import make_case

from mpslab import Simulation
from mpslab.run.preflight import preflight

DENSITY = 1000.0
SQUARE = {"from": [3.0, 0.0, 3.0], "to": [5.0, 0.0, 5.0]}


def free(kind, shape, spacing, **changes):
    """Case of a disc of radius 1 m, or a square of 2 m, turned or stretched at 1/s."""
    tables = {
        "tank.length": 8.0, "tank.depth": 1.0, "tank.height": 8.0, "fluid.gravity": 0.0,
        "fluid.viscosity": 0.0, "particles.spacing": spacing, "initial.type": kind,
        "initial.rate": 1.0, "water": [{**SQUARE, "shape": shape}],
    }  # fmt: skip
    return make_case({**tables, **changes})


def water_of(simulation):
    """Position and velocity in x-z of the fluid, (n, 2) each."""
    p = simulation.particles
    return p.position[p.fluid][:, ::2], p.velocity[p.fluid][:, ::2]


def semi_axes(position):
    """Of the ellipse with the second moments of the water, the longer first."""
    return 2.0 * np.sqrt(np.linalg.eigvalsh(np.cov(position.T, bias=True))[::-1])


def ellipse(time):
    """Semi-axes of a drop of radius 1 under no force: da/dt = s a, db/dt = -s b, s(0) = 1."""

    def rate(_, y):
        a, b, s = y
        return s * a, -s * b, s**2 * (b**2 - a**2) / (a**2 + b**2)

    return solve_ivp(rate, (0.0, time), (1.0, 1.0, 1.0), rtol=1e-9).y[:2, -1]


def energy(simulation):
    return np.sum(water_of(simulation)[1] ** 2)


def test_stretched_drop_follows_the_ellipse_and_keeps_its_energy():
    """Without "ds" and relief: on a lattice they take rows that the stretch has brought near one
    another for water that is pressed together.
    """
    models = {"scheme.stabiliser": ["corrected_shifting"], "scheme.relief": 0.0,
              "particles.jitter": 0.0}  # fmt: skip
    simulation = Simulation(free("strain", "disc", 0.1, **models))
    before, start = energy(simulation), semi_axes(water_of(simulation)[0])
    simulation.run(until=0.4)
    position, velocity = water_of(simulation)
    np.testing.assert_allclose(semi_axes(position) / start, ellipse(simulation.time), rtol=0.015)
    assert energy(simulation) == pytest.approx(before, rel=0.02)
    assert np.abs(velocity.sum(axis=0)).max() < 1e-12 * np.abs(velocity).sum()
    np.testing.assert_allclose(position.mean(axis=0), 4.0, atol=1e-6)


def test_spinning_square_is_held_together_by_suction():
    """p = -0.1473 rho w^2 L^2 in its middle: the torsion function of a square, 2 x 0.0737."""
    simulation = Simulation(free("rotation", "box", 0.1, **{"scheme.clip_pressure": False}))
    before = energy(simulation)
    simulation.run(until=0.3)
    p = simulation.particles
    away = np.linalg.norm(p.position - [4.0, 0.0, 4.0], axis=1)
    assert p.pressure[away < 0.15].mean() == pytest.approx(-0.1473 * DENSITY * 4.0, rel=0.06)
    assert energy(simulation) == pytest.approx(before, rel=0.01)
    position, _ = water_of(simulation)
    spread = np.sum((position - 4.0) ** 2) / (len(position) * 4.0 / 6.0)
    assert spread == pytest.approx(1.0, abs=0.03)


def test_spinning_square_flies_apart_where_suction_is_clipped():
    simulation = Simulation(free("rotation", "box", 0.1)).run(until=0.3)
    position, _ = water_of(simulation)
    spread = np.sum((position - 4.0) ** 2) / (len(position) * 4.0 / 6.0)
    assert spread == pytest.approx(1.0 + simulation.time**2, rel=0.02)


def cost(case):
    return dict(preflight(case).sections["Cost (one core, rough)"])


def test_time_step_without_gravity_follows_from_the_rate():
    case = free("rotation", "box", 0.1)
    assert case.time.maximum == pytest.approx(0.2 * 0.1 / np.sqrt(2.0))
    assert cost(case)["expected steps"] == "71 to t = 1 s"
    heavy = free("rotation", "box", 0.1, **{"fluid.gravity": 9.81})
    assert heavy.time.maximum == pytest.approx(0.4 * 0.1 / np.sqrt(9.81))


def test_water_at_rest_without_gravity_stays_where_it_is():
    case = free("rest", "disc", 0.2, **{"time.maximum": 0.01})
    assert cost(case)["expected time step"] == "0.01 s"
    simulation = Simulation(case)
    assert np.all(simulation.particles.pressure == 0.0)
    before = simulation.particles.position.copy()
    simulation.run(until=0.1)
    jitter = 0.001 * 0.2
    assert np.abs(simulation.particles.position - before).max() < 2.0 * jitter
