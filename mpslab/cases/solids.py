"""Checks of the solids of any shape, ``[[solid]]``."""

from itertools import combinations

import numpy as np

from mpslab.core.keys import require, shown
from mpslab.core.lattice import effective_length, rows_across
from mpslab.core.motion import displacement
from mpslab.solids import gates, obstacles, shaped, surfaces

MOST_POINTS = 1000
SHORTEST = 0.1  # spacings, that a side may be long at the least
ROUND_OFF = 1e-9  # of a length
DOUBTFUL = 0.05  # share of the space around a mesh that may be neither inside nor outside
FLAT = ("polygon", "cylinder", "box")  # shapes for a 2-D tank
TURNED = ("box", "mesh")
LARGEST = 1.0  # sizes of the tank, that a solid may reach beyond it
BEYOND = 1.0  # spacings that a motion may lead beyond the walls and the bed
MOMENTS = 200  # of a motion, that are looked at
# The key that says how thick a solid is.
THICKNESS = {"polygon": "points", "cylinder": "radius", "sphere": "radius", "box": "size",
             "mesh": "scale"}  # fmt: skip


def check_solids(case):
    """Raise CaseError, with key, value and range, if a solid cannot be what it is said to be."""
    for number, given in enumerate(case.solid):
        where = f"solid.{number}"
        _check_shape(case, where, given)
        _check_motion(where, given, number)
    for number, (given, shape) in enumerate(zip(case.solid, shaped.shapes(case), strict=True)):
        _check_place(case, f"solid.{number}", given, shape)
        _check_size(case.tank, f"solid.{number}", given, shape)
        _check_gates(case, f"solid.{number}", given, shape)
        if given.shape == "mesh":
            _check_mesh(f"solid.{number}", given, shape)
        _check_thickness(case, f"solid.{number}", given, shape)
        _check_path(case, f"solid.{number}", given, number)


def _check_shape(case, where, given):
    flat = case.dim == 2
    require(not flat or given.shape in FLAT, f"{where}.shape", given.shape,
            f"{', '.join(FLAT[:-1])} or {FLAT[-1]} in a 2-D tank, tank.width = 0")  # fmt: skip
    require(not flat or given.axis == "y", f"{where}.axis", given.axis,
            "y in a 2-D tank, tank.width = 0")  # fmt: skip
    if given.shape == "polygon":
        _check_points(case, where, given.points)
    elif given.shape != "mesh":
        key = f"{where}.center"
        require(given.center is not None, key, given.center, f"given for a {given.shape}")
    if given.shape in ("cylinder", "sphere"):
        require(given.radius > 0.0, f"{where}.radius", given.radius, f"> 0 for a {given.shape}")
    if given.shape == "box":
        _check_sides(case, where, given.size)
    _check_rotation(where, given, flat)
    require(given.ends is None or given.ends[0] < given.ends[1], f"{where}.ends", given.ends,
            "[low, high] with low < high")  # fmt: skip


def _check_sides(case, where, size):
    key = f"{where}.size"
    require(size is not None and min(size) > 0.0, key, size, "three lengths > 0 for a box")
    least = SHORTEST * case.particles.spacing
    sides = size if case.dim == 3 else size[::2]
    require(min(sides) >= least, key, size, f"{least:g} m, a tenth of a spacing, long or more")


def _check_rotation(where, given, flat):
    key, turns = f"{where}.rotation", given.shape in TURNED
    rule = f"[0, 0, 0] for a {given.shape}; a box or a mesh may be turned"
    require(turns or not any(given.rotation), key, given.rotation, rule)
    about_y = given.rotation[0] == given.rotation[2] == 0.0
    require(not flat or about_y, key, given.rotation, "[0, angle, 0] in a 2-D tank")


def _check_mesh(where, given, shape):
    """Refuse triangles that are no surface of a solid."""
    doubtful = surfaces.read(given.file, f"{where}.file").doubtful
    rule = (
        "the surface of a solid: what is inside it cannot be told for "
        f"{100.0 * doubtful:.0f} % of it (winding numbers between {surfaces.DOUBTFUL[0]:g} and "
        f"{surfaces.DOUBTFUL[1]:g}), for it is open or its triangles face all ways"
    )
    require(doubtful <= DOUBTFUL, f"{where}.file", given.file, rule)


def _check_points(case, where, points):
    key = f"{where}.points"
    many = 3 <= len(points) <= MOST_POINTS
    require(many, key, points, f"3 corners or more, {MOST_POINTS:,} at the most")
    corners = np.array(points)
    least = SHORTEST * case.particles.spacing
    side = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    require(side.min() >= least, key, points,
            f"corners that are {least:g} m, a tenth of a spacing, apart or more")  # fmt: skip
    for i, j in combinations(range(len(points)), 2):
        if (j - i) % len(points) in (1, len(points) - 1):
            continue
        a, b, c, d = (corners[k % len(points)] for k in (i, i + 1, j, j + 1))
        rule = f"a line without crossings: its sides {i + 1} and {j + 1} cross"
        require(not _cross(a, b, c, d), key, points, rule)


def _cross(a, b, c, d):
    """Whether the lines from a to b and from c to d cross or touch."""

    def turn(p, q, r):
        return np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    if turn(a, b, c) == turn(a, b, d) == 0:
        low, high = np.maximum(np.minimum(a, b), np.minimum(c, d)), np.minimum(
            np.maximum(a, b), np.maximum(c, d))  # fmt: skip
        return bool(np.all(low <= high))
    return turn(a, b, c) != turn(a, b, d) and turn(c, d, a) != turn(c, d, b)


def _check_motion(where, given, number):
    if given.motion in ("none", "free"):
        return
    if given.motion == "file":
        shaped.motion_of(given, number)
        return
    rule = f"> 0 for motion = {given.motion!r}"
    require(given.amplitude > 0.0, f"{where}.amplitude", given.amplitude, rule)
    require(given.period > 0.0, f"{where}.period", given.period, rule)


def _check_place(case, where, given, shape):
    tank, slack = case.tank, ROUND_OFF * case.tank.length
    name = shaped.place_of(given)
    key, value = f"{where}.{name}", getattr(given, name)
    there = shape.low[0] < effective_length(case) and shape.high[0] > 0.0
    require(there, key, value, f"in the tank, x from 0 to {tank.length:g} m")
    require(
        shape.high[2] > shaped.lowest(tank),
        key,
        value,
        "above the bed, or it has no particles",
    )
    if case.dim == 3:
        width = rows_across(case) * case.particles.spacing
        there = shape.low[1] < width and shape.high[1] > 0.0
        require(there, key, value, f"in the tank, y from 0 to {width:g} m")
        inside = shape.low[1] >= -slack and shape.high[1] <= width + slack
        whole = given.shape in ("polygon", "cylinder") and given.axis == "y" and given.ends is None
        rule = f"between y = 0 and {width:g} m, for the tank is periodic there"
        require(not tank.periodic or whole or inside, key, value, rule)


def _check_size(tank, where, given, shape):
    """Refuse what is far larger than the tank, as a drawing in mm is that is taken for m."""
    most = (1.0 + LARGEST) * max(tank.length, tank.width, tank.height)
    ends = np.concatenate([shape.low, shape.high])
    farthest = float(np.abs(ends[np.isfinite(ends)]).max())
    name = THICKNESS[given.shape]
    hint = f"; is unit = {given.unit!r} right?" if given.shape == "mesh" else ""
    require(
        farthest <= most,
        f"{where}.{name}",
        getattr(given, name),
        f"such that it reaches no farther than {most:g} m from the origin, twice the largest size "
        f"of the tank; here it is {farthest:.4g} m{hint}",
    )


def _check_gates(case, where, given, shape):
    name = shaped.place_of(given)
    for k, (low, high) in enumerate(gates.faces(case)):
        apart = shape.high[0] <= low + ROUND_OFF or shape.low[0] >= high - ROUND_OFF
        rule = f"outside of gate.{k}, x = {low:g} to {high:g} m, which it would be in the way of"
        require(apart, f"{where}.{name}", getattr(given, name), rule)


def _check_path(case, where, given, number):
    """Refuse a prescribed motion that cannot be."""
    motion = shaped.motion_of(given, number)
    if motion is None:
        return
    name = "motion_file" if given.motion == "file" else "amplitude"
    key, value = f"{where}.{name}", getattr(given, name)
    points, times = shaped.faces(case, number), np.unique(motion.moments(case.time.end))
    _check_speed(case, key, value, motion, points, times)
    _check_stay(case, key, value, motion, points, times)


def _check_speed(case, key, value, motion, points, times):
    """Refuse a motion that is too fast for any step."""
    between = np.sort(np.concatenate([times, 0.5 * (times[1:] + times[:-1])]))
    rate = np.array([motion(time, 1) for time in between])
    arm = np.hypot(*(points[:, [0, 2]] - np.asarray(motion.center)).T).max(initial=0.0)
    speed = np.hypot(rate[:, 0], rate[:, 1]) + arm * np.abs(rate[:, 2])
    k = int(speed.argmax())
    fastest = case.time.courant * case.particles.spacing / case.time.minimum
    rule = (
        f"a motion slower than {fastest:.4g} m/s, for which steps would be shorter than "
        f"time.minimum; at t = {between[k]:.4g} s it is {speed[k]:.4g} m/s"
    )
    require(speed[k] <= fastest, key, value, rule)


def _check_stay(case, key, value, motion, points, times):
    """Refuse a motion that leads what begins in the tank out of it."""
    inside = _beyond(case.tank, points) <= 0.0
    for time in times[:: len(times) // MOMENTS + 1]:
        moved = points + displacement(motion, points, 0.0, time)
        out = float(_beyond(case.tank, moved)[inside].max(initial=0.0))
        rule = (
            f"a motion that stays in the tank: at t = {time:.4g} s it leads {out:.4g} m beyond its "
            "bed or end walls"
        )
        require(out <= BEYOND * case.particles.spacing, key, value, rule)


def _beyond(tank, points):
    """How far places (n, 3) [m] are beyond the end walls or below the bed, (n,) [m]."""
    x, z = points[:, 0], points[:, 2]
    ground = tank.bed_height(np.clip(x, 0.0, tank.length))
    return np.maximum(np.maximum(-x, x - tank.length), ground - z)


def _check_thickness(case, where, given, shape):
    least = obstacles.least_thickness(case)
    thick = least * case.particles.spacing
    name = THICKNESS[given.shape]
    key, value = f"{where}.{name}", getattr(given, name)
    if given.shape == "polygon" and shape.thinnest == shape.ends[1] - shape.ends[0]:
        key, value = f"{where}.ends", given.ends
    require(
        shape.thinnest >= thick * (1.0 - ROUND_OFF),
        key,
        value,
        f"{least} spacings, {thick:g} m, thick or more where sides face each other, or water on "
        f"one side presses through to the other; here it is {shown(float(shape.thinnest))} m",
    )
