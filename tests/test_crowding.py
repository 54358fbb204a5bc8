"""Water that a blow presses together, and what lets it go again."""

from pathlib import Path

import numpy as np
import pytest

from mpslab import Simulation, load_case
from mpslab.core.stencil import make_stencil
from mpslab.models import crowding

COLUMN = Path(__file__).parents[1] / "validation/column/column.toml"
PACE = 1e-3


def rate(excess, relief=0.2, dt=PACE):
    """Where the number density is too high by a share."""
    stencil = make_stencil(2, 0.002, 2.1)
    density = stencil.relaxed * (1.0 + np.array([excess]))
    return crowding.rate(density, stencil, relief, dt, PACE)[0]


@pytest.mark.parametrize("excess", [-0.5, -0.03, 0.0, 0.03, 0.0499])
def test_up_to_a_twentieth_water_is_left_alone(excess):
    assert rate(excess) == 0.0


@pytest.mark.parametrize("steps", [1, 2, 5])
def test_in_a_pace_a_share_of_the_rest_goes_however_long_the_steps_are(steps):
    excess = 0.35
    for _ in range(steps):
        excess -= PACE / steps * rate(excess, dt=PACE / steps)
    assert excess == pytest.approx(0.05 + 0.8 * 0.30)


def pressed(relief):
    """Largest and last of what the 98th percentile of n is over that of relaxed water, in a column
    that runs into a wall at 0.13 s.
    """
    run = Simulation(load_case(COLUMN, {
        "particles.spacing": 0.004, "tank.length": 0.12, "scheme.settling": 40,
        "scheme.relief": relief,
    }))  # fmt: skip
    found, relaxed = [], run._flow.stencil.relaxed
    while run.time < 0.17:
        run.advance()
        density = run.particles.number_density[run.particles.fluid]
        found.append(np.percentile(density, 98) / relaxed)
    return max(found), found[-1]


def test_a_blow_does_not_press_water_together_for_good():
    """Without relief it is by a third; n has a noise of some hundredths at rest."""
    most, last = pressed(0.2)
    assert most < 1.25
    assert last < 1.15
    assert pressed(0.0)[1] > 1.2
