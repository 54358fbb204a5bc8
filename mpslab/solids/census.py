"""How many particles a case has, by arithmetic: nothing is laid out, whatever the size.

The columns of the tank are counted as `filling` and the solids lay them out; if there are very
many, some columns stand for all.  The sum is exact, except for discs, solids of any shape, a
staircase with dips, and tanks with very many columns; a wall that an obstacle or a solid covers
still counts as wall.
"""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core.kinds import (
    DUMMY,
    FLUID,
    GATE,
    GATE_DUMMY,
    KIND_NAMES,
    PISTON,
    PISTON_DUMMY,
    WALL,
)
from mpslab.core.lattice import effective_length, ground, rows_across
from mpslab.solids import filling, gates, obstacles, shaped

MOST_COLUMNS = 10_000  # that are counted one by one


def census(case, backmost=0.0):
    """Numbers of particles by kind, (kinds,) float64.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    """
    count = np.zeros(len(KIND_NAMES))
    rows = rows_across(case)
    behind = np.ceil(-backmost / case.particles.spacing) if case.wavemaker.type != "none" else 0.0
    floor = _floor(case, behind)
    if case.tank.lid:
        floor = {kind: floor[kind] + number for kind, number in _lid(case).items()}
    count[FLUID] = _water(case)
    for kind, number in (*floor.items(), *_ends(case).items(), *_gates(case).items()):
        count[kind] += number * rows
    if case.tank.width > 0.0 and not case.tank.periodic:
        wall, all_of_it = _side(case, behind)
        layers = case.particles.layers
        count[WALL] += 2.0 * (wall + floor[WALL])
        count[DUMMY] += 2.0 * (layers * (all_of_it + sum(floor.values())) - wall - floor[WALL])
    count[WALL], count[DUMMY] = np.array([count[WALL], count[DUMMY]]) + _obstacles(case)
    if case.solid:
        count[WALL], count[DUMMY] = np.array([count[WALL], count[DUMMY]]) + shaped.count(case)
    return count


def columns_between(case, start, end):
    """How many columns of a box of water stand in no gate; start and end are its corners [m]."""
    spacing = case.particles.spacing
    first, last = round(start[0] / spacing), round(min(end[0], effective_length(case)) / spacing)
    held = [np.clip(np.round(faces / spacing), first, last) for faces in gates.faces(case)]
    return max(last - first, 0) - sum(float(high - low) for low, high in held if last > first)


def _columns(case, first, last):
    """x [m] of the columns from number `first` to `last`, and how many columns each stands for."""
    number = max(int(last) - int(first), 0)
    seen = min(number, MOST_COLUMNS)
    column = int(first) + np.floor((np.arange(seen) + 0.5) * number / max(seen, 1))
    return (column + 0.5) * case.particles.spacing, number / max(seen, 1)


def _stacked(case, x, top):
    """How many particles fit into solid columns at x from the bed up to `top`, (n,) float64."""
    spacing = case.particles.spacing
    low, first = ground(case, x)
    return np.maximum(np.round((top - low - first) / spacing + 0.5), 0.0)


def _water(case):
    spacing = case.particles.spacing
    boxes = [(water.start, water.end, water.shape) for water in case.water]
    boxes = boxes or [(*filling.filled(case), "box")]
    total = 0.0
    for start, end, shape in boxes:
        share = np.pi / 4.0 if shape == "disc" else 1.0
        for low, high in obstacles.around(case, start, end):
            last = round(min(high[0], effective_length(case)) / spacing)
            x, each = _columns(case, round(low[0] / spacing), last)
            for left, right in gates.faces(case):
                x = x[(x < left) | (x > right)]
            across = round(high[1] / spacing) - round(low[1] / spacing) if case.dim == 3 else 1
            height = np.maximum(high[2] - ground(case, x, low[2])[0], 0.0) / spacing
            total += share * across * each * height.sum()
        total -= share * shaped.taken(case, *filling.laid(case, start, end)) / spacing**case.dim
    return max(total, 0.0)


def _floor(case, behind):
    """Layers of the bed in the section, by kind."""
    spacing, layers = case.particles.spacing, case.particles.layers
    tail = layers - 1.0  # columns behind the first one of a wall, where the bed is dummy
    ends = tail if case.wavemaker.type != "none" else 2.0 * tail
    if case.particles.bed == "staircase":
        length = round(case.tank.length / spacing)
        x, each = _columns(case, -behind - layers, length + layers)
        near = np.arange(-layers, layers + 1)[:, np.newaxis] * spacing + x
        top = np.ceil(beds.elevation(case.tank.bed, near) / spacing - 0.5)
        here, next_to = top[layers], top[layers - 1 : layers + 2].min(axis=0)
        total = each * float(np.sum(here - top.min(axis=0) + layers))
        wall = each * float(np.sum(here - next_to + 1.0)) - ends
        return {WALL: wall, DUMMY: total - wall}
    points = beds.extended(case.tank.bed, (behind + layers) * spacing, layers * spacing)
    numbers = [beds.count(points, (k + 0.5) * spacing, spacing) for k in range(layers)]
    return {WALL: numbers[0] - ends, DUMMY: sum(numbers) - numbers[0] + ends}


def _lid(case):
    """Layers of the lid in the section, by kind."""
    length = round(case.tank.length / case.particles.spacing)
    layers = case.particles.layers
    faces = length + 2.0
    return {WALL: faces, DUMMY: layers * (length + 2.0 * layers) - faces}


def _ends(case):
    """End walls and piston in the section, by kind."""
    spacing, layers = case.particles.spacing, case.particles.layers
    out = (np.arange(layers) + 0.5) * spacing
    left = _stacked(case, -out, case.tank.height)
    right = _stacked(case, effective_length(case) + out, case.tank.height)
    if case.wavemaker.type == "none":
        return {WALL: left[0] + right[0], DUMMY: left[1:].sum() + right[1:].sum()}
    return {
        WALL: right[0],
        DUMMY: right[1:].sum(),
        PISTON: left[0],
        PISTON_DUMMY: left[1:].sum(),
    }


def _gates(case):
    """Gates in the section, by kind."""
    found, spacing = {GATE: 0.0, GATE_DUMMY: 0.0}, case.particles.spacing
    for low, high in gates.faces(case):
        x, _ = _columns(case, round(low / spacing), round(high / spacing))
        stacks = _stacked(case, x, case.tank.height)
        found[GATE] += stacks[0] + stacks[-1]
        found[GATE_DUMMY] += stacks[1:-1].sum()
    return found


def _side(case, behind):
    """A layer of a side wall above the bed: wall particles if it is the first, and all of it."""
    spacing, layers = case.particles.spacing, case.particles.layers
    length = round(case.tank.length / spacing)
    x, each = _columns(case, -behind - layers, length + layers)
    stacks = each * _stacked(case, x, case.tank.height)
    inside = (x > -(behind + 1.0) * spacing) & (x < effective_length(case) + spacing)
    return stacks[inside].sum(), stacks.sum()


def _obstacles(case):
    """Wall and dummy particles of the obstacles; what two of them share counts once: (2,) float64.
    """
    spacing, rows = case.particles.spacing, rows_across(case)
    length = round(case.tank.length / spacing)
    total, inner, seen = 0.0, 0.0, []
    for low, high in obstacles.blocks(case):
        meets = np.isfinite([low, high]).sum(axis=0)  # faces along each axis that meet water
        start = (max(low[0], 0.0), max(low[1], 0.0), low[2])
        end = (min(high[0], length), min(high[1], rows), high[2])
        pieces = [(start, end)]
        for other in seen:
            pieces = [left for piece in pieces for left in obstacles.cut(*piece, *other)]
        seen.append((low, high))
        all_of_it = sum(_filled(case, *piece) for piece in pieces)
        sizes = np.array([end[0] - start[0], end[1] - start[1]])
        share = np.prod(np.maximum(1.0 - meets[:2] / sizes, 0.0))
        height = all_of_it / np.prod(sizes)
        share *= max(1.0 - meets[2] / height, 0.0) if height > 0.0 else 0.0
        total, inner = total + all_of_it, inner + all_of_it * share
    return np.array([total - inner, inner])


def _filled(case, low, high):
    """Particles between two corners [spacings] and above the bed."""
    spacing = case.particles.spacing
    x, each = _columns(case, low[0], high[0])
    level = np.ceil(beds.elevation(case.tank.bed, x) / spacing - 0.5)
    stacks = np.maximum(high[2] - np.maximum(level, low[2]), 0.0)
    return each * stacks.sum() * max(high[1] - low[1], 0.0)
