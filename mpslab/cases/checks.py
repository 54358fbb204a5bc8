"""Checks of a case that look at several keys at once."""

from dataclasses import fields
from itertools import combinations, pairwise
from math import ceil
from pathlib import Path

import numpy as np

from mpslab import bed as beds
from mpslab import filling, gates, geometry, obstacles, plugins
from mpslab.cases.complete import largest_dt
from mpslab.keys import CaseError, require_choice, shown, toml_name
from mpslab.parameters import Case

# Lengths from different keys count as equal when they differ by less than this share of the tank.
ROUNDING = 1e-9

# Above this a case is taken for a slip of the pen: its arrays would take hundreds of gigabytes.
MOST_PARTICLES = 1e9

# A disc so many spacings across holds the centre of a particle, wherever it lies.
LEAST_DISC = 2

# Theories in which wavemaker.height is the height of the wave.
WAVES = ("linear", "second_order", "cnoidal", "solitary")


def check(case: Case) -> None:
    """Raise CaseError, with key, value and range, if the values of a complete case clash."""
    _check_models(case)
    _check_bed(case)
    _check_walls(case)
    _check_spacing(case)
    _check_width(case)
    _check_water(case)
    _check_obstacles(case)
    _check_gates(case)
    _check_motion(case)
    _check_gravity(case)
    _check_time(case)
    for name in ("gauge", "probe"):
        _check_instruments(case, name)


def warnings(case: Case) -> list[str]:
    """What a complete case may suffer from without being wrong, in plain words."""
    looks = (_coarse_wave, _low_walls, _uneven_width, _uneven_bed, _long_step)
    return [warning for look in looks if (warning := look(case))]


def _require(fits, key, value, rule):
    if not fits:
        raise CaseError(f"{key} = {shown(value)}: must be {rule}")


def _check_models(case):
    for name in ("scheme", "wavemaker"):
        table = getattr(case, name)
        for item in fields(table):
            if "family" in item.metadata:
                value = getattr(table, item.name)
                words = value if isinstance(value, tuple) else (value,)
                for word in words:
                    require_choice(f"{name}.{toml_name(item)}", word, models(item.metadata))
    scheme = case.scheme
    _require(
        scheme.surface == "marked" or scheme.walls == "extrapolated",
        "scheme.surface",
        scheme.surface,
        "marked where scheme.walls = 'solved', for dry walls need p = 0 at marked particles",
    )


def models(metadata):
    """Names that a key of a family of models may have, from the metadata of its field."""
    choices = plugins.names(metadata["family"])
    return ("none", *choices) if metadata["family"] == "wavemakers" else choices


def _check_bed(case):
    tank, bed = case.tank, case.tank.bed
    along = [x for x, _ in bed]
    ends = abs(along[0]) + abs(along[-1] - tank.length) <= ROUNDING * tank.length
    rising = all(a < b for a, b in pairwise(along))
    _require(
        ends and rising,
        "tank.bed",
        bed,
        f"points [x, z] with x increasing from 0 to tank.length = {tank.length:g} m",
    )
    _require(
        bed[0][1] < tank.depth,
        "tank.bed",
        bed,
        f"below the still water at the piston: first z < tank.depth = {tank.depth:g} m",
    )


def _check_walls(case):
    tank = case.tank
    top = max(z for _, z in tank.bed)
    _require(
        tank.height > max(tank.depth, top),
        "tank.height",
        tank.height,
        f"> {max(tank.depth, top):g} m, above the still water and the bed",
    )


def _check_spacing(case):
    tank, spacing = case.tank, case.particles.spacing
    depth = tank.depth - tank.bed[0][1]
    most = min(depth, tank.length) / 3.0
    _require(
        spacing <= most,
        "particles.spacing",
        spacing,
        f"<= {most:g} m, a third of the water at the wavemaker, or there is no fluid",
    )
    count = (tank.length / spacing) * (tank.depth / spacing)
    count *= tank.width / spacing if case.dim == 3 else 1.0
    _require(
        count <= MOST_PARTICLES,
        "particles.spacing",
        spacing,
        f"wider: it gives {count:.1g} particles, more than {MOST_PARTICLES:.0g}",
    )
    radius = case.scheme.effective_radius
    _require(
        case.particles.layers >= ceil(radius),
        "particles.layers",
        case.particles.layers,
        f">= {ceil(radius)}, or 0, to fill scheme.effective_radius = {radius:g} spacings",
    )


def _check_width(case):
    tank, spacing = case.tank, case.particles.spacing
    if case.dim == 2:
        return
    radius = max(case.scheme.effective_radius, case.scheme.laplacian_radius)
    count, why = 3.0, "3 spacings between side walls"
    if tank.periodic:
        count = 2.0 * radius + 1.0
        why = f"{count:g} spacings (2 radii of {radius:g} + 1), or a particle meets itself"
    least = count * spacing
    _require(
        tank.width >= least * (1.0 - ROUNDING),
        "tank.width",
        tank.width,
        f">= {least:g} m, {why}, or 0 for 2-D",
    )


def _check_water(case):
    slack = ROUNDING * case.tank.length
    axes = (0, 1, 2) if case.dim == 3 else (0, 2)
    for i, box in enumerate(case.water):
        _check_box(case, f"water.{i}.to", box, "there is no fluid")
        least = LEAST_DISC * case.particles.spacing
        _require(
            box.shape == "box" or all(box.end[k] - box.start[k] >= least - slack for k in (0, 2)),
            f"water.{i}.to",
            box.end,
            f"beyond 'from' = {shown(box.start)} by {least:g} m, {LEAST_DISC} spacings, in x and z"
            f" for shape = 'disc'",
        )
    for i, j in combinations(range(len(case.water)), 2):
        a, b = case.water[i], case.water[j]
        apart = any(a.end[k] <= b.start[k] + slack or b.end[k] <= a.start[k] + slack for k in axes)
        rule = f"outside of the box water.{i}, or both overlap"
        _require(apart, f"water.{j}.from", b.start, rule)


def _check_box(case, key, box, lack):
    axes = (0, 1, 2) if case.dim == 3 else (0, 2)
    limit = (case.tank.length, case.tank.width, case.tank.height)
    slack = ROUNDING * case.tank.length
    spacing = case.particles.spacing
    _require(
        all(box.end[k] <= limit[k] + slack for k in axes),
        key,
        box.end,
        f"inside the tank, [x, y, z] <= {shown(limit)} m",
    )
    _require(
        all(box.end[k] - box.start[k] >= spacing - slack for k in axes),
        key,
        box.end,
        f"beyond 'from' = {shown(box.start)} by a spacing, {spacing:g} m, or {lack}",
    )
    bed = beds.lowest(case.tank.bed, box.start[0], box.end[0])
    _require(
        box.end[2] >= bed + spacing - slack,
        key,
        box.end,
        f"above the bed by a spacing, z >= {bed + spacing:g} m, or {lack}",
    )


def _check_obstacles(case):
    spacing, least = case.particles.spacing, obstacles.least_thickness(case)
    for i, box in enumerate(case.obstacle):
        _check_box(case, f"obstacle.{i}.to", box, "it has no particles")
    for i, (low, high) in enumerate(obstacles.blocks(case)):
        for axis, thickness in zip("xyz", high - low, strict=True):
            _require(
                thickness >= least,
                f"obstacle.{i}.to",
                case.obstacle[i].end,
                f"beyond 'from' = {shown(case.obstacle[i].start)} along {axis} by {least} spacings,"
                f" {least * spacing:g} m, or water on one side presses through to the other",
            )
    _require(
        not case.obstacle or _room(case),
        "obstacle",
        [[box.start, box.end] for box in case.obstacle],
        "boxes that leave room for the water",
    )


def _room(case):
    """What the obstacles leave of the water: boxes as pairs of corners [m]."""
    boxes = [(box.start, box.end) for box in case.water] or [filling.filled(case)]
    return [piece for box in boxes for piece in obstacles.around(case, *box)]


def _check_gates(case):
    faces, spacing = gates.faces(case), case.particles.spacing
    slack = 1e-6 * spacing
    _require(
        not case.gate or any(filling.columns(case, *piece) for piece in _room(case)),
        "gate",
        [gate.x for gate in case.gate],
        "elsewhere: where these stand there is no room for the water",
    )
    for i, (low, high) in enumerate(faces):
        most = geometry.effective_length(case) - (obstacles.least_thickness(case) + 1) * spacing
        x = case.gate[i].x
        inside = spacing - slack <= low <= most + slack
        rule = f"from {spacing:g} to {most:g} m, for a gate {high - low:g} m thick"
        _require(inside, f"gate.{i}.x", x, rule)
        for j, (other, end) in enumerate(faces[:i]):
            apart = low >= end + spacing - slack or other >= high + spacing - slack
            rule = f"a spacing or more off gate.{j}, which reaches from {other:g} to {end:g} m"
            _require(apart, f"gate.{i}.x", x, rule)
        for j, (start, end) in enumerate(obstacles.blocks(case) * spacing):
            apart = low >= end[0] - slack or start[0] >= high - slack
            rule = f"outside of obstacle.{j}, which a gate cannot pass"
            _require(apart, f"gate.{i}.x", x, rule)
        fastest = spacing / case.time.maximum if case.time.maximum else np.inf
        _require(
            case.gate[i].speed <= fastest * (1.0 + ROUNDING),
            f"gate.{i}.speed",
            case.gate[i].speed,
            f"<= {fastest:.4g} m/s, a spacing in time.maximum = {case.time.maximum:.4g} s",
        )


def _check_motion(case):
    maker, initial, tank = case.wavemaker, case.initial, case.tank
    _require(
        maker.stroke < tank.length,
        "wavemaker.stroke",
        maker.stroke,
        f"< tank.length = {tank.length:g} m, or the piston leaves the tank",
    )
    if maker.type == "file":
        exists = bool(maker.file) and Path(maker.file).is_file()
        _require(exists, "wavemaker.file", maker.file, "a CSV file that exists")
    if initial.type == "standing_wave":
        _require(
            0.0 < initial.amplitude < tank.paddle_depth,
            "initial.amplitude",
            initial.amplitude,
            f"> 0 and < the depth of the water at x = 0, {tank.paddle_depth:g} m",
        )
    _require(
        initial.rate != 0.0 or initial.type not in ("strain", "rotation"),
        "initial.rate",
        initial.rate,
        f"other than 0 for initial.type = {initial.type!r}",
    )
    _require(
        initial.speed != 0.0 or initial.type != "stream",
        "initial.speed",
        initial.speed,
        "other than 0 for initial.type = 'stream'",
    )


def _check_gravity(case):
    gravity, start, maker = case.fluid.gravity, case.initial.type, case.wavemaker.type
    if gravity > 0.0:
        return
    _require(maker not in WAVES, "fluid.gravity", gravity, f"> 0 for wavemaker.type = {maker!r}")
    calm = start != "standing_wave"
    _require(calm, "fluid.gravity", gravity, f"> 0 for initial.type = {start!r}")
    _require(
        case.time.maximum > 0.0,
        "time.maximum",
        case.time.maximum,
        "given, > 0 s, where fluid.gravity = 0 and the water starts at rest",
    )


def _check_time(case):
    time = case.time
    _require(
        time.start <= time.maximum,
        "time.start",
        time.start,
        f"<= time.maximum = {time.maximum:g} s",
    )
    _require(
        time.minimum <= time.start,
        "time.minimum",
        time.minimum,
        f"<= time.start = {time.start:g} s",
    )


def _check_instruments(case, kind):
    tank = case.tank
    slack = ROUNDING * tank.length
    first = {}
    for i, item in enumerate(getattr(case, kind)):
        where = f"{kind}.{i}"
        _require(
            first.setdefault(item.name, i) == i,
            f"{where}.name",
            item.name,
            f"different from {kind}.{first[item.name]}.name",
        )
        inside = item.x <= tank.length + slack
        _require(inside, f"{where}.x", item.x, f"from 0 to tank.length = {tank.length:g} m")
        inside = item.y <= tank.width + slack
        _require(inside, f"{where}.y", item.y, f"from 0 to tank.width = {tank.width:g} m")
        if kind == "probe":
            bed = float(tank.bed_height(item.x))
            inside = bed - slack <= item.z <= tank.height + slack
            rule = f"from the bed, {bed:g} m, to tank.height = {tank.height:g} m"
            _require(inside, f"{where}.z", item.z, rule)
            holder = obstacles.deep_inside(case, np.array([[item.x, item.y, item.z]]))[0]
            rule = f"outside of obstacle.{holder}, or on one of its faces"
            _require(holder < 0, where, [item.x, item.y, item.z], rule)


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
    if case.tank.height >= case.tank.depth + 2.0 * height:
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
    limit = largest_dt(case)
    if limit == 0.0 or case.time.maximum <= limit * (1.0 + ROUNDING):
        return ""
    return (
        f"time.maximum = {case.time.maximum:g} s: above the default for this scheme,"
        f" {limit:.3g} s, the run may be unstable; 0 takes that value"
    )


def _uneven_bed(case):
    bed = case.tank.bed
    reach = case.wavemaker.stroke if case.wavemaker.type != "none" else 0.0
    if case.initial.type == "standing_wave":
        reach = case.tank.length
    if all(z == bed[0][1] for x, z in bed if x <= reach) and (
        float(case.tank.bed_height(reach)) == bed[0][1]
    ):
        return ""
    what = "standing wave" if case.initial.type == "standing_wave" else "piston's path"
    return f"tank.bed = {shown(bed)}: not flat under the {what}, up to x = {reach:g} m"
