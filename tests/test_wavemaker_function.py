"""A paddle that follows a function, or an object with a state, of the user's own."""

import numpy as np
import pytest
from tanks import make_case

from mpslab import Simulation
from mpslab.solids.piston import make_paddle

MODULE = "test_wavemaker_function"
D0 = 0.002


def forward(t):
    return 0.01 * (1.0 - np.cos(2.0 * np.pi * t / 0.4))


def jumps(t):
    return 0.001 + 0.01 * t


NUMBER = 3


class Follows:
    """A paddle that goes where the water stands high: half way to it in each step."""

    def __init__(self):
        self.old = self.new = self.begin = self.end = 0.0

    def __call__(self, time):
        return self.new if time > 0.5 * (self.begin + self.end) else self.old

    def advance(self, time, dt, readings):
        self.begin, self.end, self.old = time, time + dt, self.new
        push = readings["middle"] - 0.02 + 0.01 * np.sin(20.0 * time)
        self.new = float(np.clip(self.old + dt * push, -0.004, 0.004))

    def state(self):
        return {"new": self.new}

    def restore(self, state):
        self.new = state["new"]


def case(name, stroke=0.02, **changes):
    wavemaker = {"type": "function", "function": f"{MODULE}:{name}", "stroke": stroke}
    return make_case({
        "tank.length": 0.1, "wavemaker": wavemaker,
        "gauge": [{"name": "middle", "x": 0.05}], "output.gauge_interval": 0.004, **changes,
    })  # fmt: skip


def test_piston_follows_the_function():
    run = Simulation(case("forward")).run(until=0.1)
    piston = run.particles.position[run.particles.moves_with_piston, 0]
    assert piston.max() == pytest.approx(forward(run.time) - 0.5 * D0)
    assert make_paddle(case("forward")).stroke == pytest.approx(0.02, rel=1e-4)


def test_bed_is_laid_for_the_stroke_whatever_the_end_of_the_run():
    early, late = (make_paddle(case("forward", **{"time.end": end})) for end in (0.1, 2.0))
    assert (early.backmost, early.farthest) == (late.backmost, late.farthest) == (-0.02, 0.02)


def test_run_with_a_paddle_that_follows_the_water_goes_on_to_the_same_bytes(tmp_path):
    """Its own state and the readings that it goes by are in the checkpoint."""
    keys = {"name": "Follows", "stroke": 0.004}
    whole = Simulation(case(**keys)).run(until=0.06)
    face = whole.particles.position[whole.particles.moves_with_piston, 0].max() + 0.5 * D0
    assert abs(face) > 1e-5
    Simulation(case(**keys), tmp_path / "run").run(until=0.03)
    again = Simulation.resume(tmp_path / "run").run(until=0.06)
    assert again.particles.position.tobytes() == whole.particles.position.tobytes()


@pytest.mark.parametrize(
    ("keys", "part"),
    [
        ({"name": "forward", "stroke": 0.019}, "at t = 0.2 s: must be 0 at first, and never"),
        ({"name": "jumps"}, "is 0.001 m at t = 0"),
        ({"name": "absent"}, 'must be "module:name" of a function'),
        ({"name": "NUMBER"}, "must be a function of time"),
        ({"name": "forward", "stroke": 0.0}, "wavemaker.stroke = 0 m: must be above 0 m"),
    ],
)
def test_function_that_cannot_be_a_paddle_is_refused_before_any_work(keys, part, tmp_path):
    with pytest.raises(ValueError, match="wavemaker") as refused:
        Simulation(case(**keys), tmp_path / "run")
    assert part in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1
    assert not (tmp_path / "run").exists()
