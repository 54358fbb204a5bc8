"""How much a run will do and write, by arithmetic; sizes that can only be a mistake are refused."""

import math
from dataclasses import dataclass

from mpslab.core import timestep
from mpslab.core.keys import require
from mpslab.core.parameters import Case
from mpslab.forcings.frame import strongest

MOST_STEPS = 1e8
MOST_FRAMES = 1e6
SHORTEST = 1e-9  # of the run: the least interval of what is written


@dataclass(frozen=True)
class Sizes:
    """Time step [s] and the limit that holds it; steps, frames, and rows of gauges.csv."""

    step: float
    limit: str
    steps: int
    frames: int
    readings: int


def sizes(case: Case) -> Sizes:
    """Sizes of a run, with the speed of water that falls from the highest to the lowest place.

    Raises
    ------
    CaseError
        If there are more steps or frames than any run has, or an interval is no time at all.
    """
    step, limit = _step(case)
    end, output = case.time.end, case.output
    count = end / step if step > 0.0 else math.inf
    if limit == "viscous":
        most = MOST_STEPS * case.time.viscous * case.particles.spacing**2 / end
        rule = f"<= {most:.3g} m2/s, for the run takes {_many(count, step)}"
        require(count <= MOST_STEPS, "fluid.viscosity", case.fluid.viscosity, rule)
    rule = f"<= {MOST_STEPS * step:.3g} s, for the run takes {_many(count, step)}"
    require(count <= MOST_STEPS, "time.end", end, rule)
    for name in ("interval", "checkpoint", "gauge_interval"):
        value = getattr(output, name)
        fits = value == 0.0 or value >= SHORTEST * end
        require(fits, f"output.{name}", value, f">= {SHORTEST * end:g} s, or 0")
    steps = math.ceil(count)
    frames = min(steps, int(end / output.interval)) + 1
    rule = f">= {end / MOST_FRAMES:.3g} s, for it makes {frames:.2g} frames, more than 1e+06"
    require(frames <= MOST_FRAMES, "output.interval", output.interval, rule)
    every = output.gauge_interval
    readings = 1 + (min(steps, int(end / every)) if every > 0.0 else steps)
    return Sizes(step, limit, steps, frames, readings)


def _step(case):
    """Time step expected [s], and the name of its limit."""
    top = max([box.end[2] for box in case.water], default=case.tank.depth)
    lowest = min(z for _, z in case.tank.bed)
    fall = math.sqrt(strongest(case)) * math.sqrt(top - lowest)
    speed = max([fall, timestep.initial_speed(case), *(gate.speed for gate in case.gate)])
    found = timestep.limits(case, math.inf, speed)
    name = min(found, key=found.get)
    return found[name], name


def _many(count, step):
    return f"{count:.2g} steps of {step:.2g} s, more than {MOST_STEPS:.0g}"
