"""Theories are given the depth of the water where the wave is made, not the height of its level."""

import numpy as np
import pytest
from tanks import flow_of, make_case

from mpslab.core.keys import CaseError
from mpslab.run import initial
from mpslab.run.preflight import preflight
from mpslab.solids.piston import make_paddle

WAVE = {"wavemaker.type": "linear", "wavemaker.height": 0.01, "wavemaker.period": 0.777}
RAISED = {"tank.length": 0.8, "tank.depth": 0.04, "tank.bed": [[0.0, 0.02], [0.8, 0.02]]}
FLAT = {"tank.length": 0.8, "tank.depth": 0.02}


def test_stroke_is_that_of_the_depth_at_the_paddle():
    raised, flat = (make_paddle(make_case({**tank, **WAVE})) for tank in (RAISED, FLAT))
    assert raised.stroke == pytest.approx(flat.stroke, rel=1e-12)
    assert raised.stroke == pytest.approx(0.0268, rel=0.01)


def test_wave_higher_than_the_water_at_the_paddle_bears_is_refused():
    with pytest.raises(ValueError, match=r"wavemaker.height = 0.03 m: must be below"):
        make_paddle(make_case({**RAISED, **WAVE, "wavemaker.height": 0.03}))


def test_wave_that_is_foretold_is_that_of_the_depth_at_the_paddle():
    raised, flat = (preflight(make_case({**tank, **WAVE})).sections["Wave"]
                    for tank in (RAISED, FLAT))  # fmt: skip
    assert raised == flat


def test_standing_wave_begins_above_its_bed():
    start = {"initial.type": "standing_wave", "initial.amplitude": 0.002}
    flows = [flow_of(make_case({**tank, **start})) for tank in (RAISED, FLAT)]
    for flow in flows:
        initial.set_velocity(flow.case, flow.particles, lambda values: values.sum())
    raised, flat = (flow.particles.velocity[flow.particles.fluid] for flow in flows)
    np.testing.assert_allclose(raised, flat, atol=1e-12)


def test_longest_step_is_that_of_the_deepest_water():
    raised, flat = (make_case(tank).time.maximum for tank in (RAISED, FLAT))
    assert raised == pytest.approx(flat, rel=1e-12)


def test_amplitude_that_reaches_the_bed_is_refused():
    with pytest.raises(CaseError, match=r"amplitude = 0.025.*less the bed at x = 0, 0.02 m"):
        make_case({**RAISED, "initial.type": "standing_wave", "initial.amplitude": 0.025})
