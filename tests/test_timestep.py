"""Choice of the time step: every limit can be the one that holds."""

import numpy as np
import pytest
from tanks import make_case, particles_at

from mpslab import timestep
from mpslab.diagnostics import max_speed
from mpslab.particles import FACE, FILLER, FIRST_SOLID, FLUID, PISTON, TANK, WATER, make_particles

TIME = {"courant": 0.2, "viscous": 0.25, "growth": 1.1, "maximum": 1e-3, "start": 1e-4}


def case(viscosity=1e-6):
    changes = {f"time.{key}": value for key, value in TIME.items()}
    return make_case({"fluid.viscosity": viscosity, **changes})


# Previous dt, largest speed, viscosity; the limit that must hold and its value. Spacing: 2 mm.
HOLDS = [
    (0.0, 0.0, 1e-6, "start", 1e-4),
    (0.0, 100.0, 1e-6, "courant", 0.2 * 0.002 / 100.0),
    (2e-4, 0.1, 1e-6, "growth", 1.1 * 2e-4),
    (1e-3, 0.1, 1e-6, "maximum", 1e-3),
    (1e-3, 0.8, 1e-6, "courant", 0.2 * 0.002 / 0.8),
    (1e-3, 0.1, 1e-2, "viscous", 0.25 * 0.002**2 / 1e-2),
]


@pytest.mark.parametrize(("previous", "speed", "viscosity", "name", "dt"), HOLDS)
def test_least_limit_holds_and_is_named(previous, speed, viscosity, name, dt):
    found, limit = timestep.choose(case(viscosity), previous, speed)
    assert limit == name
    assert found == pytest.approx(dt, rel=1e-14)


def test_every_limit_is_among_those_that_can_hold():
    found = timestep.limits(case(), 0.0, 1.0).keys() | timestep.limits(case(), 1e-4, 1.0).keys()
    assert found == {name for *_, name, _ in HOLDS}


@pytest.mark.parametrize("previous", [0.0, 1e-5, 1.0])
@pytest.mark.parametrize("speed", [0.0, 1e-3, 1.0, 1e3])
@pytest.mark.parametrize("viscosity", [0.0, 1e-6, 1.0])
def test_time_step_is_below_every_limit(previous, speed, viscosity):
    dt, name = timestep.choose(case(viscosity), previous, speed)
    limits = timestep.limits(case(viscosity), previous, speed)
    assert isinstance(dt, float)
    assert dt > 0.0
    assert dt == limits[name]
    assert all(dt <= limit for limit in limits.values())


def test_fluid_without_viscosity_has_no_viscous_limit():
    assert "viscous" not in timestep.limits(case(viscosity=0.0), 1e-4, 1.0)


def test_still_water_has_no_courant_limit():
    assert "courant" not in timestep.limits(case(), 1e-4, 0.0)


def test_time_step_shrinks_at_once_and_grows_by_a_tenth():
    dt, _ = timestep.choose(case(), 1e-3, 100.0)
    assert dt == pytest.approx(4e-6)
    assert timestep.choose(case(), dt, 0.0) == (pytest.approx(4.4e-6), "growth")


@pytest.mark.parametrize(
    ("role", "body", "speed"),
    [
        (FLUID, WATER, 5), (FACE, PISTON, 5), (FACE, FIRST_SOLID, 5), (FACE, TANK, 0),
        (FILLER, TANK, 0), (FILLER, PISTON, 0),
    ],
)  # fmt: skip
def test_speed_is_that_of_water_and_faces_that_move(role, body, speed):
    particles = make_particles(np.zeros((2, 3)), [FLUID, role], [WATER, body])
    particles.velocity[1] = [3.0, 0.0, -4.0]
    assert max_speed(particles) == speed


def test_speed_without_water_is_zero():
    assert max_speed(particles_at(np.zeros((0, 3)))) == 0.0
