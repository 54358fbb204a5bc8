"""Checks of what a tank holds: boxes of water, obstacles, gates and solids."""

from itertools import combinations

import numpy as np

from mpslab.cases.solids import check_solids
from mpslab.core import bed as beds
from mpslab.core.keys import require, shown
from mpslab.core.lattice import effective_length
from mpslab.solids import filling, gates, obstacles
from mpslab.solids.census import columns_between

# Lengths from different keys count as equal when they differ by less than this share of the tank.
ROUNDING = 1e-9

# Names that no obstacle or gate may have.
RESERVED = ("water", "tank", "bed", "piston", "end_wall")

# A disc that is this many spacings across holds the centre of a particle wherever it lies.
LEAST_DISC = 2


def check(case):
    """Raise CaseError, with key, value and range, if what is in the tank cannot be there."""
    _check_water(case)
    _check_obstacles(case)
    _check_gates(case)
    check_solids(case)
    _check_names(case)


def _check_water(case):
    slack = ROUNDING * case.tank.length
    axes = (0, 1, 2) if case.dim == 3 else (0, 2)
    for i, box in enumerate(case.water):
        _check_box(case, f"water.{i}.to", box, "there is no fluid")
        least = LEAST_DISC * case.particles.spacing
        require(
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
        require(apart, f"water.{j}.from", b.start, rule)


def _check_box(case, key, box, lack):
    axes = (0, 1, 2) if case.dim == 3 else (0, 2)
    limit = (case.tank.length, case.tank.width, case.tank.height)
    slack = ROUNDING * case.tank.length
    spacing = case.particles.spacing
    require(
        all(box.end[k] <= limit[k] + slack for k in axes),
        key,
        box.end,
        f"inside the tank, [x, y, z] <= {shown(limit)} m",
    )
    require(
        all(box.end[k] - box.start[k] >= spacing - slack for k in axes),
        key,
        box.end,
        f"beyond 'from' = {shown(box.start)} by a spacing, {spacing:g} m, or {lack}",
    )
    bed = beds.lowest(case.tank.bed, box.start[0], box.end[0])
    require(
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
            require(
                thickness >= least,
                f"obstacle.{i}.to",
                case.obstacle[i].end,
                f"beyond 'from' = {shown(case.obstacle[i].start)} along {axis} by {least} spacings,"
                f" {least * spacing:g} m, or water on one side presses through to the other",
            )
    require(
        not case.obstacle or _room(case),
        "obstacle",
        [[box.start, box.end] for box in case.obstacle],
        "boxes that leave room for the water",
    )


def _room(case):
    """The water without the obstacles: boxes as pairs of corners [m]."""
    boxes = [(box.start, box.end) for box in case.water] or [filling.filled(case)]
    return [piece for box in boxes for piece in obstacles.around(case, *box)]


def _check_names(case):
    """Refuse two solids of one name: in the files a name stands for one thing."""
    seen = dict.fromkeys(RESERVED, f"those of the tank, {', '.join(RESERVED)}")
    for kind in ("obstacle", "gate", "solid"):
        for i, solid in enumerate(getattr(case, kind)):
            where = f"{kind}.{i}.name"
            rule = f"different from {seen.get(solid.name)}"
            require(solid.name not in seen, where, solid.name, rule)
            seen[solid.name] = where


def _check_gates(case):
    faces, spacing = gates.faces(case), case.particles.spacing
    blocks = obstacles.blocks(case) * spacing
    slack = 1e-6 * spacing
    for i, (low, high) in enumerate(faces):
        most = effective_length(case) - (obstacles.least_thickness(case) + 1) * spacing
        x = case.gate[i].x
        inside = spacing - slack <= low <= most + slack
        rule = f"from {spacing:g} to {most:g} m, for a gate {high - low:g} m thick"
        require(inside, f"gate.{i}.x", x, rule)
        for j, (other, end) in enumerate(faces[:i]):
            apart = low >= end + spacing - slack or other >= high + spacing - slack
            rule = f"a spacing or more off gate.{j}, which reaches from {other:g} to {end:g} m"
            require(apart, f"gate.{i}.x", x, rule)
        for j, (start, end) in enumerate(blocks):
            apart = low >= end[0] - slack or start[0] >= high - slack
            rule = f"outside of obstacle.{j}, which a gate cannot pass"
            require(apart, f"gate.{i}.x", x, rule)
        fastest = spacing / case.time.maximum if case.time.maximum else np.inf
        require(
            case.gate[i].speed <= fastest * (1.0 + ROUNDING),
            f"gate.{i}.speed",
            case.gate[i].speed,
            f"<= {fastest:.4g} m/s, a spacing in time.maximum = {case.time.maximum:.4g} s",
        )
    require(
        not case.gate or any(columns_between(case, *piece) > 0 for piece in _room(case)),
        "gate",
        [gate.x for gate in case.gate],
        "elsewhere: where these stand there is no room for the water",
    )
