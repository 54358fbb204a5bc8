"""The velocities of the water at the start."""

import numpy as np
import pytest
from tanks import make_case

from mpslab.core.keys import CaseError
from mpslab.run import initial
from mpslab.solids import layout

DISC = {"from": [0.01, 0.0, 0.01], "to": [0.03, 0.01, 0.024], "shape": "disc"}
RATE = 7.0


def water_of(role, **changes):
    tank = {"tank.length": 0.05, "tank.height": 0.05, "particles.jitter": 0.1, "water": [DISC]}
    start = {"initial.type": role, "initial.rate": RATE}
    case = make_case({**tank, **start, **changes})
    particles = layout.build_particles(case)
    initial.set_velocity(case, particles, np.sum)
    assert np.all(particles.velocity[~particles.fluid] == 0.0)
    return particles.take(particles.fluid)


@pytest.mark.parametrize("width", [0.0, 0.02])
@pytest.mark.parametrize(
    ("role", "matrix"),
    [
        ("strain", [[RATE, 0, 0], [0, 0, 0], [0, 0, -RATE]]),
        ("rotation", [[0, 0, RATE], [0, 0, 0], [-RATE, 0, 0]]),
    ],
)
def test_velocity_is_linear_about_the_centre_of_mass(role, matrix, width):
    water = water_of(role, **{"tank.width": width})
    away = water.position - water.position.mean(axis=0)
    np.testing.assert_allclose(water.velocity, away @ np.transpose(matrix), atol=1e-14)


@pytest.mark.parametrize("role", ["strain", "rotation"])
def test_water_starts_without_momentum(role):
    water = water_of(role)
    assert np.abs(water.velocity.sum(axis=0)).max() < 1e-15 * np.abs(water.velocity).sum()


def test_rate_may_be_negative_but_not_zero():
    np.testing.assert_allclose(
        water_of("strain", **{"initial.rate": -RATE}).velocity, -water_of("strain").velocity,
        atol=1e-14,
    )  # fmt: skip
    with pytest.raises(CaseError, match=r"^initial\.rate = 0\.0: must be other than 0 for"):
        water_of("rotation", **{"initial.rate": 0.0})


def test_stream_has_its_speed_along_x_which_may_be_negative_but_not_zero():
    water = water_of("stream", **{"initial.rate": 0.0, "initial.speed": -2.0})
    np.testing.assert_array_equal(water.velocity, np.tile([-2.0, 0.0, 0.0], (len(water), 1)))
    with pytest.raises(CaseError, match=r"^initial\.speed = 0\.0: must be other than 0 for"):
        water_of("stream")


def test_stream_without_weight_chooses_its_time_step_by_its_speed():
    changes = {"initial.type": "stream", "initial.speed": -2.0, "fluid.gravity": 0.0}
    case = make_case(changes)
    assert case.time.maximum == pytest.approx(0.2 * case.particles.spacing / 2.0)


def test_water_at_rest_has_no_velocity():
    assert np.all(water_of("rest").velocity == 0.0)
