"""Checks of a case that look at several keys at once."""

import math
from dataclasses import fields, replace
from itertools import pairwise

import numpy as np

from mpslab import instruments
from mpslab.cases import bodies, contents
from mpslab.cases.contents import ROUNDING
from mpslab.core import plugins
from mpslab.core.files import is_file
from mpslab.core.keys import CaseError, require, require_choice, toml_name
from mpslab.core.kinds import FLUID
from mpslab.core.parameters import Case
from mpslab.forcings import frame, sponge
from mpslab.solids import layout, obstacles
from mpslab.solids.absorption import SEAS
from mpslab.solids.census import census

# A case with more than this is taken for a mistake: its arrays would take hundreds of gigabytes.
MOST_PARTICLES = 1e9

# Share of the water that solids may leave for it to be laid out, and most particles of it: how much
# is left is known roughly by arithmetic, and so not whether any is.
MUCH, MOST_LAID_OUT = 0.7, 1e6

# How many tables, or points, there may be under a key.
MOST = {
    "water": 100, "obstacle": 100, "gate": 100, "solid": 100, "mooring": 100, "sponge": 100,
    "gauge": 1000, "probe": 1000, "runup": 100, "overtopping": 100,
}  # fmt: skip
MOST_POINTS, MOST_PICTURES = 2000, 1000

# Theories in which wavemaker.height is the height of the wave.
WAVES = (
    "linear", "second_order", "cnoidal", "solitary", "stream_function", "irregular", "focused",
    "bichromatic",
)  # fmt: skip

LATEST = 1e4  # s, until which a sea may fade in

# Largest radius [spacings] with which walls that are solved for hold the water: with 2.3 the
# hydrostatic pressure of 20 layers is 0.97 of what it should be in 2-D, 0.95 in 3-D, with 3.1 it is
# 0.75.
WIDEST_SOLVED = 2.3

SHARPEST = 165  # degrees that the bed may turn by at a corner

NARROWEST = 1.5  # spacings that a radius may have at the least


def check(case: Case) -> None:
    """Raise CaseError, with key, value and range, if the values of a complete case clash."""
    _check_models(case)
    _check_numbers(case)
    _check_bed(case)
    _check_walls(case)
    _check_spacing(case)
    _check_width(case)
    contents.check(case)
    _check_count(case)
    _check_motion(case)
    _check_frame(case)
    _check_gravity(case)
    _check_time(case)
    bodies.check_bodies(case)
    _check_absorption(case)
    sponge.check(case)
    for name in ("gauge", "probe"):
        _check_places(case, name)
    instruments.check(case)


def _check_models(case):
    for name in ("scheme", "wavemaker"):
        table = getattr(case, name)
        for item in fields(table):
            if "family" in item.metadata:
                value = getattr(table, item.name)
                words = value if isinstance(value, tuple) else (value,)
                for word in words:
                    if plugins.is_path(word):
                        plugins.load(item.metadata["family"], word)
                    else:
                        require_choice(f"{name}.{toml_name(item)}", word, models(item.metadata))
    scheme = case.scheme
    require(
        scheme.surface == "marked" or scheme.walls == "extrapolated",
        "scheme.surface",
        scheme.surface,
        f"marked where scheme.walls = {scheme.walls!r}, for dry walls need p = 0 at marked "
        "particles",
    )
    require(
        not scheme.wall_law or scheme.wall_slip,
        "scheme.wall_law",
        scheme.wall_law,
        "false where scheme.wall_slip = false: walls have one friction or the other",
    )
    require(
        not scheme.wall_law or case.fluid.viscosity > 0.0 or case.tank.roughness > 0.0,
        "scheme.wall_law",
        scheme.wall_law,
        "false where fluid.viscosity and tank.roughness are 0: nothing holds the water back",
    )
    _check_radii(scheme)


def _check_radii(scheme):
    radius = scheme.radius_of_gradient
    key = "gradient_radius" if scheme.gradient_radius else "effective_radius"
    require(radius >= NARROWEST, f"scheme.{key}", radius, f"0, or >= {NARROWEST:g} spacings")
    require(
        radius <= WIDEST_SOLVED or scheme.walls != "solved",
        f"scheme.{key}",
        radius,
        f"<= {WIDEST_SOLVED:g} spacings where scheme.walls = 'solved', for only the first layer of "
        "such walls has a pressure, and water that sees more of them is not held up",
    )


def models(metadata):
    """Names that a key of a family of models may have, from the metadata of its field."""
    choices = plugins.names(metadata["family"])
    return ("none", *choices) if metadata["family"] == "wavemakers" else choices


def _check_numbers(case):
    lists = [(name, getattr(case, name), most) for name, most in MOST.items()]
    lists.append(("tank.bed", case.tank.bed, MOST_POINTS))
    lists.append(("output.pictures", case.output.pictures, MOST_PICTURES))
    for name, items, most in lists:
        if len(items) > most:
            raise CaseError(f"{name} has {len(items):,} entries: must have at most {most:,}")


def _check_bed(case):
    tank, bed = case.tank, case.tank.bed
    along = [x for x, _ in bed]
    ends = abs(along[0]) + abs(along[-1] - tank.length) <= ROUNDING * tank.length
    rising = all(a < b for a, b in pairwise(along))
    require(
        ends and rising,
        "tank.bed",
        bed,
        f"points [x, z] with x increasing from 0 to tank.length = {tank.length:g} m",
    )
    require(
        bed[0][1] < tank.depth,
        "tank.bed",
        bed,
        f"below the still water at the piston: first z < tank.depth = {tank.depth:g} m",
    )


    for (x0, z0), (x1, z1), (x2, z2) in zip(bed, bed[1:], bed[2:], strict=False):
        turn = abs(math.atan2(z2 - z1, x2 - x1) - math.atan2(z1 - z0, x1 - x0))
        rule = f"a line that turns by {SHARPEST} degrees or less, and not as at x = {x1:g} m"
        require(turn <= math.radians(SHARPEST), "tank.bed", bed, rule)


def _check_walls(case):
    tank = case.tank
    top = max(z for _, z in tank.bed)
    require(
        tank.height > max(tank.depth, top),
        "tank.height",
        tank.height,
        f"> {max(tank.depth, top):g} m, above the still water and the bed",
    )


def _check_spacing(case):
    tank, spacing = case.tank, case.particles.spacing
    depth = tank.depth - tank.bed[0][1]
    most = min(depth, tank.length) / 3.0
    require(
        spacing <= most,
        "particles.spacing",
        spacing,
        f"<= {most:g} m, a third of the water at the wavemaker, or there is no fluid",
    )
    count = (tank.length / spacing) * (tank.depth / spacing)
    count *= tank.width / spacing if case.dim == 3 else 1.0
    require(count <= MOST_PARTICLES, "particles.spacing", spacing, _wider(case, count))
    most = MOST_PARTICLES * spacing
    require(tank.height <= most, "tank.height", tank.height, f"<= {most:g} m, 1e9 spacings")
    scheme = case.scheme
    key = max(("effective_radius", "gradient_radius"), key=lambda name: getattr(scheme, name))
    radius = getattr(scheme, key)
    require(
        case.particles.layers >= math.ceil(radius),
        "particles.layers",
        case.particles.layers,
        f">= {math.ceil(radius)}, or 0, to fill scheme.{key} = {radius:g} spacings",
    )


def _wider(case, count):
    size = " x ".join(f"{side:g}" for side in (case.tank.length, case.tank.width, case.tank.depth))
    return (
        f"wider: it gives {count:.1g} particles in a tank of {size} m, more than "
        f"{MOST_PARTICLES:.0g}"
    )


def _check_count(case):
    """Walls count as well: they may be much higher than the water."""
    found = census(case)
    count = found.sum()
    key = "solid" if case.solid else "tank.bed"
    value = [given.name for given in case.solid] or case.tank.bed
    wet = _has_water(case, found[FLUID])
    require(wet, key, value, "such that there is room for water: here is none")
    if count <= MOST_PARTICLES:
        return
    top = max(case.tank.depth, max(z for _, z in case.tank.bed))
    least = census(replace(case, tank=replace(case.tank, height=top))).sum()
    rule = f"lower: with walls so high there are {count:.1g} particles, more than 1e+09"
    require(least > MOST_PARTICLES, "tank.height", case.tank.height, rule)
    require(False, "particles.spacing", case.particles.spacing, _wider(case, count))


def _has_water(case, count):
    """Whether solids leave any water; where they take much of it, the water is laid out to see."""
    whole = census(replace(case, solid=()))[FLUID] if case.solid else count
    if not case.solid or count > MUCH * whole or whole > MOST_LAID_OUT:
        return count >= 0.5
    return len(layout.water(case)) > 0


def _check_width(case):
    tank, spacing = case.tank, case.particles.spacing
    if case.dim == 2:
        return
    radius = case.scheme.reach
    count, why = 3.0, "3 spacings between side walls"
    if tank.periodic:
        count = 2.0 * radius + 1.0
        why = f"{count:g} spacings (2 radii of {radius:g} + 1), or a particle meets itself"
    least = count * spacing
    require(
        tank.width >= least * (1.0 - ROUNDING),
        "tank.width",
        tank.width,
        f">= {least:g} m, {why}, or 0 for 2-D",
    )


def _check_motion(case):
    maker, initial, tank = case.wavemaker, case.initial, case.tank
    require(
        maker.stroke < tank.length,
        "wavemaker.stroke",
        maker.stroke,
        f"< tank.length = {tank.length:g} m, or the piston leaves the tank",
    )
    turns = maker.type in ("linear", "second_order") or maker.first == "forward"
    rule = f"'forward' for wavemaker.type = {maker.type!r}"
    require(turns, "wavemaker.first", maker.first, rule)
    if maker.type == "file" or (
        maker.type in ("irregular", "focused") and maker.spectrum == "file"
    ):
        exists = is_file(maker.file)
        require(exists, "wavemaker.file", maker.file, "a CSV file that exists")
    soon = maker.start <= LATEST or maker.type not in SEAS
    rule = f"<= {LATEST:g} s for wavemaker.type = {maker.type!r}, whose motion is a table"
    require(soon, "wavemaker.start", maker.start, rule)
    inside = maker.type != "focused" or 0.0 < maker.place <= tank.length
    rule = f"> 0 and <= tank.length = {tank.length:g} m, where the wave has its focus"
    require(inside, "wavemaker.place", maker.place, rule)
    if initial.type == "standing_wave":
        require(
            0.0 < initial.amplitude < tank.paddle_depth,
            "initial.amplitude",
            initial.amplitude,
            f"> 0 and < tank.depth = {tank.depth:g} m less the bed at x = 0, {tank.bed[0][1]:g} m",
        )
    require(
        initial.rate != 0.0 or initial.type not in ("strain", "rotation"),
        "initial.rate",
        initial.rate,
        f"other than 0 for initial.type = {initial.type!r}",
    )
    require(
        initial.speed != 0.0 or initial.type != "stream",
        "initial.speed",
        initial.speed,
        "other than 0 for initial.type = 'stream'",
    )


def _check_frame(case):
    motion, lid = case.frame, case.tank.lid
    rule = "false with a wavemaker or a gate, which it would be in the way of"
    require(not lid or (case.wavemaker.type == "none" and not case.gate), "tank.lid", lid, rule)
    if motion.type != "none":
        frame.motion_of(motion)


def _check_gravity(case):
    gravity, start, maker = case.fluid.gravity, case.initial.type, case.wavemaker.type
    if gravity > 0.0:
        return
    require(maker not in WAVES, "fluid.gravity", gravity, f"> 0 for wavemaker.type = {maker!r}")
    calm = start != "standing_wave"
    require(calm, "fluid.gravity", gravity, f"> 0 for initial.type = {start!r}")
    require(
        case.time.maximum > 0.0,
        "time.maximum",
        case.time.maximum,
        "given, > 0 s, where fluid.gravity = 0 and the water starts at rest",
    )


def _check_absorption(case):
    absorbs, piston = case.wavemaker.absorption, case.wavemaker.type != "none"
    rule = "false for wavemaker.type = 'none', a wall; 'still' is a piston without waves"
    require(piston or not absorbs, "wavemaker.absorption", absorbs, rule)


def _check_time(case):
    time = case.time
    require(
        time.start <= time.maximum,
        "time.start",
        time.start,
        f"<= time.maximum = {time.maximum:g} s",
    )
    require(
        time.minimum <= time.start,
        "time.minimum",
        time.minimum,
        f"<= time.start = {time.start:g} s",
    )


def _check_places(case, kind):
    tank = case.tank
    slack = ROUNDING * tank.length
    items = getattr(case, kind)
    instruments.check_names(kind, items)
    places = np.array([[item.x, item.y, getattr(item, "z", 0.0)] for item in items]).reshape(-1, 3)
    ground, holders = tank.bed_height(places[:, 0]), obstacles.deep_inside(case, places)
    for i, item in enumerate(items):
        where = f"{kind}.{i}"
        inside = item.x <= tank.length + slack
        require(inside, f"{where}.x", item.x, f"from 0 to tank.length = {tank.length:g} m")
        inside = item.y <= tank.width + slack
        require(inside, f"{where}.y", item.y, f"from 0 to tank.width = {tank.width:g} m")
        if kind == "probe":
            inside = ground[i] - slack <= item.z <= tank.height + slack
            rule = f"from the bed, {ground[i]:g} m, to tank.height = {tank.height:g} m"
            require(inside, f"{where}.z", item.z, rule)
            rule = f"outside of obstacle.{holders[i]}, or on one of its faces"
            require(holders[i] < 0, where, [item.x, item.y, item.z], rule)
