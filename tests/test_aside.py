"""Solids far from the water are put aside in a step, and nothing comes out differently."""

import numpy as np
import pytest

from mpslab import Simulation, load_case
from mpslab.parallel.domain import arrays_of
from mpslab.run.flow import Flow

QUICK = {"scheme.settling": 3}
CASES = {
    "column that collapses": ("dam_break", {**QUICK, "particles.spacing": 0.03}),
    "piston and dry shore": ("solitary_runup", {**QUICK, "particles.spacing": 0.02}),
    "box that floats": ("floating_box", {**QUICK, "particles.spacing": 0.04}),
}
STEPS = 25


def outcome(case, keep):
    """Particles and steps of a run, and how many particles its last step could put aside.

    keep : whether it keeps all of them in the step
    """
    aside = []

    def idle(flow, particles):
        mask = found(flow, particles)
        aside.append(np.count_nonzero(mask))
        return np.zeros_like(mask) if keep else mask

    found = Flow.idle
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Flow, "idle", idle)
        simulation = Simulation(case)
        for _ in range(STEPS):
            simulation.advance()
    rows = simulation.steps[[n for n in simulation.steps.dtype.names if n != "seconds"]]
    return simulation.particles, rows.tolist(), aside[-1]


@pytest.mark.parametrize("name", CASES)
def test_what_is_put_aside_changes_no_bit(name):
    case = load_case(*CASES[name])
    (with_all, all_rows, aside), (without, rows, _) = (
        outcome(case, keep) for keep in (True, False)
    )
    assert 0 < aside < np.count_nonzero(~with_all.fluid)
    assert rows == all_rows
    for one, other in zip(arrays_of(with_all), arrays_of(without), strict=True):
        np.testing.assert_array_equal(one, other)
