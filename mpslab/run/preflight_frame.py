"""What the motion of a tank will be like, and how high the water may rise in it."""

from dataclasses import replace

import numpy as np

from mpslab.forcings import frame
from mpslab.theory import sloshing
from mpslab.theory.waves import standing_wave_frequency

SAMPLES = 20  # in the period of the last mode
MOST = 10_000  # samples: of a longer run its beginning alone
STEEP = 1.5  # a steep crest over that of linear theory; 1.3 at a third of a depth of 20 particles


def tank_motion(case, notes):
    """Findings of a tank that moves, a dict; a line goes to `notes` if the water may rise too high.

    `mpslab.run.preflight.Preflight` says what is in it.
    """
    motion, end = frame.motion_of(case.frame), case.time.end
    farthest = np.max([np.abs(motion(t)) for t in motion.moments(end)], axis=0)
    farthest[2] = np.degrees(farthest[2])
    named = zip(("sway [m]", "heave [m]", "roll [deg]"), farthest, strict=True)
    weightless = replace(case, fluid=replace(case.fluid, gravity=0.0))
    found = {
        "type": case.frame.type,
        **{name: value for name, value in named if value > 0.0},
        **({} if case.frame.type == "file" else {"period [s]": case.frame.period}),
        "largest_acceleration [m/s2]": frame.strongest(weightless),
    }
    if _is_a_box_of_water(case):
        found |= _rise(case, motion, notes)
    return found


def _is_a_box_of_water(case):
    """Whether nothing but water stands in the tank, equally deep everywhere."""
    flat = all(z == case.tank.bed[0][1] for _, z in case.tank.bed)
    bare = not (case.water or case.obstacle or case.gate) and case.wavemaker.type == "none"
    return flat and bare and case.fluid.gravity > 0.0 and case.tank.deepest > 0.0


def _rise(case, motion, notes):
    """Natural period, and the highest that the water rises at the walls, by linear theory."""
    tank, gravity, depth = case.tank, case.fluid.gravity, case.tank.deepest
    first, last = (
        2.0 * np.pi / standing_wave_frequency(mode, tank.length, depth, gravity)
        for mode in (1, sloshing.MODES[-1])
    )
    end = min(case.time.end, MOST * last / SAMPLES)
    times = np.linspace(0.0, end, int(SAMPLES * end / last) + 2)
    angle = np.array([motion(t)[2] for t in times])
    sway, _, spin = np.array([motion(t, 2) for t in times]).T
    above = motion.center[1] - tank.depth
    at_wall = sloshing.rise(times, sway, angle, spin, tank.length, depth, above, gravity)
    rise, room = float(np.abs(at_wall).max()), tank.height - tank.depth
    if rise == 0.0:
        return {"natural_period [s]": first}
    if STEEP * rise > room:
        what = "lid" if tank.lid else "top of the walls"
        notes.append(
            f"the water may reach the {what}, {room:.3g} m above it: by linear theory it rises "
            f"{rise:.3g} m at the walls, and steep waves rise higher"
        )
    return {"natural_period [s]": first, "rise [m]": rise, "room [m]": room}
