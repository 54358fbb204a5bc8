"""What a case may suffer from without being wrong."""

import numpy as np

from mpslab.cases.checks import WAVES
from mpslab.cases.contents import ROUNDING
from mpslab.cases.sizes import sizes
from mpslab.core import timestep
from mpslab.core.keys import shown
from mpslab.core.parameters import Case
from mpslab.forcings.frame import strongest

NARROW = 4.0  # spacings: the particles do not resolve what is narrower in the bed
# How many times shorter viscosity may make the step: if it is more, the viscosity was perhaps given
# in other units.
MOST_VISCOUS = 10.0


def warnings(case: Case, paddle=None) -> list[str]:
    """What a complete case may suffer from without being wrong, in plain words.

    Parameters
    ----------
    paddle : mpslab.solids.paddle.Paddle, optional
        Motion of the wavemaker; without it the stroke stands for how far the piston goes.
    """
    reach = case.wavemaker.stroke if case.wavemaker.type != "none" else 0.0
    if paddle:
        reach = paddle.foremost
    looks = (_coarse_wave, _low_walls, _uneven_width, _narrow_bed, _long_step, _viscous_step,
             _short_step, _late_pictures)  # fmt: skip
    found = [_uneven_bed(case, reach), *(look(case) for look in looks)]
    return [warning for warning in found if warning]


def _short_step(case):
    size = sizes(case)
    if size.step >= case.time.minimum:
        return ""
    return (
        f"time.minimum = {case.time.minimum:.3g} s: steps of {size.step:.3g} s are expected "
        f"(limit: {size.limit}), and the run stops where they are shorter than that"
    )


def _late_pictures(case):
    late = [time for time in case.output.pictures if time > case.time.end]
    if not late:
        return ""
    end = case.time.end
    return f"output.pictures: {shown(late)} s are after time.end = {end:g} s and not drawn"


def _wave_height(case):
    """Key and height of the wave that the case asks for; height 0 where it names none."""
    if case.initial.type == "standing_wave":
        return "2 initial.amplitude", 2.0 * case.initial.amplitude
    return "wavemaker.height", case.wavemaker.height if case.wavemaker.type in WAVES else 0.0


def _coarse_wave(case):
    key, height = _wave_height(case)
    count = height / case.particles.spacing
    if height == 0.0 or count >= 5.0 * (1.0 - ROUNDING):
        return ""
    return (
        f"{key} = {height:g} m: only {count:.2g} particles over the wave height, fewer than 5 damp"
        f" the wave; particles.spacing <= {height / 5.0:.3g} m resolves it"
    )


def _low_walls(case):
    key, height = _wave_height(case)
    if case.tank.lid or case.tank.height >= case.tank.depth + 2.0 * height:
        return ""
    return (
        f"tank.height = {case.tank.height:g} m: lower than tank.depth + 2 {key}, water may pass the"
        f" walls; {case.tank.depth + 2.0 * height:.3g} m is safe"
    )


def _uneven_width(case):
    count = case.tank.width / case.particles.spacing
    if abs(count - round(count)) < 1e-6:
        return ""
    return f"tank.width = {case.tank.width:g} m: {count:.3f} spacings, not a whole number of them"


def _long_step(case):
    limit = timestep.largest(case, strongest(case))
    if limit == 0.0 or case.time.maximum <= limit * (1.0 + ROUNDING):
        return ""
    return (
        f"time.maximum = {case.time.maximum:g} s: above the default for this scheme,"
        f" {limit:.3g} s, the run may be unstable; 0 takes that value"
    )


def _viscous_step(case):
    fluid, time = case.fluid, case.time
    if fluid.viscosity == 0.0:
        return ""
    step = time.viscous * case.particles.spacing**2 / fluid.viscosity
    if time.maximum <= MOST_VISCOUS * step:
        return ""
    return (
        f"fluid.viscosity = {fluid.viscosity:g} m2/s: holds the time step at {step:.2g} s, where "
        f"time.maximum is {time.maximum:.2g} s; it is the kinematic one, in m2/s (water 1e-6, "
        "honey 1e-2)"
    )


def _uneven_bed(case, reach):
    bed = case.tank.bed
    if case.initial.type == "standing_wave":
        reach = case.tank.length
    if all(z == bed[0][1] for x, z in bed if x <= reach) and (
        float(case.tank.bed_height(reach)) == bed[0][1]
    ):
        return ""
    what = "standing wave" if case.initial.type == "standing_wave" else "piston's path"
    return f"tank.bed = {shown(bed)}: not flat under the {what}, up to x = {reach:.4g} m"


def _narrow_bed(case):
    """Where the bed rises, or falls, by a spacing on both sides of a place, within two spacings of
    it.
    """
    spacing, x = case.particles.spacing, np.array(case.tank.bed)[:, 0]
    half, middle = 0.5 * NARROW * spacing, 0.5 * (x[:-1] + x[1:])
    place = np.concatenate([x, middle[np.diff(x) < 2.0 * half]])
    place = place[(place >= half) & (place <= case.tank.length - half)]
    here, left, right = (case.tank.bed_height(place + step) for step in (0.0, -half, half))
    deep = np.minimum(left, right) - here
    deep, high = np.maximum(deep, 0.0), np.maximum(here - np.maximum(left, right), 0.0)
    size = np.maximum(deep, high)
    worst = int(np.argmax(size)) if len(size) else 0
    if not len(size) or size[worst] <= spacing * (1.0 + ROUNDING):
        return ""
    what = "notch" if deep[worst] > 0.0 else "ridge"
    return (
        f"tank.bed: the {what} at x = {place[worst]:.4g} m, {size[worst]:.2g} m high where it is "
        f"{2.0 * half:.2g} m wide, is narrower than {NARROW:g} spacings: too fine for the "
        f"particles, the pressure there is not to be trusted"
    )
