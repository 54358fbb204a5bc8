"""Initial particles of a case: water, bed, end walls, piston, gates, side walls, obstacles.

The cross-section (x, z) is laid out first and then repeated across the tank.  Water particles
stand half a spacing off every boundary, wall particles half a spacing behind it.  A kind is here a
pair: role and body.
"""

import numpy as np

from mpslab import bed as beds
from mpslab import filling, gates, obstacles
from mpslab.core.later import scipy
from mpslab.filling import effective_length
from mpslab.particles import FACE, FILLER, FLUID, PISTON, TANK, WATER, make_particles


def rows_across(case):
    """Number of particles across the tank; 1 in 2-D."""
    return max(round(case.tank.width / case.particles.spacing), 1)


def period(case):
    """Period across the tank [m], 0 when it is walled or 2-D."""
    periodic = case.tank.periodic and case.tank.width > 0.0
    return rows_across(case) * case.particles.spacing if periodic else 0.0


def extent(case, backmost=0.0):
    """Where the bed begins and ends in x, the layers behind the end walls included [m].

    Parameters
    ----------
    case : mpslab.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    """
    spacing = case.particles.spacing
    beyond = case.particles.layers * spacing
    behind = np.ceil(-backmost / spacing) * spacing + beyond
    return -behind, effective_length(case) + beyond


def build_particles(case, backmost=0.0):
    """Particles of a case at rest, with hydrostatic pressure.

    Parameters
    ----------
    case : mpslab.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    """
    spacing = case.particles.spacing
    solid, kind = _solid_section(case, backmost)
    position, kinds = _repeat_across(case, solid, kind, backmost)
    if case.obstacle:
        position, kinds = _with_obstacles(case, position, kinds)
    water = kinds[:, 0] == FLUID
    position[water] += _jitter(case, np.count_nonzero(water))
    cell = np.floor(position / spacing + 1e-6)
    order = np.lexsort((position[:, 2], cell[:, 1], cell[:, 0]))
    particles = make_particles(position[order], *kinds[order].T)
    _set_hydrostatic(case, particles)
    if case.obstacle or case.gate:
        obstacles.press(case, particles)
    return particles


def labels(n, role, body=TANK):
    """Role and body of n particles, (n, 2) int16; each a number, or (n,)."""
    return np.column_stack([np.broadcast_to(what, n) for what in (role, body)]).astype(np.int16)


def _with_obstacles(case, position, kinds):
    obstacles.cover(case, position, kinds)
    body, kind = obstacles.fill(case, position[kinds[:, 0] != FLUID])
    return np.vstack([position, body]), np.vstack([kinds, kind])


def _jitter(case, n):
    random = np.random.default_rng(case.particles.seed)
    move = random.uniform(-1.0, 1.0, (n, 3)) * case.particles.jitter * case.particles.spacing
    if case.tank.width == 0.0:
        move[:, 1] = 0.0
    return move


def _stack(case, x, top):
    """Solid particles of one column, from the bed up, none squeezed in: (n, 2) [m]."""
    spacing = case.particles.spacing
    low, first = filling.ground(case, x)
    first = float(low + first)
    n = max(round((top - (first - 0.5 * spacing)) / spacing), 0)
    return np.column_stack([np.full(n, x), first + np.arange(n) * spacing])


def _solid_section(case, backmost):
    """Bed, end walls, piston and gates in the cross-section: (n, 2) [m] and kinds (n, 2)."""
    layers, spacing = case.particles.layers, case.particles.spacing
    behind = (layers + np.ceil(-backmost / spacing)) * spacing
    build = _staircase if case.particles.bed == "staircase" else _smooth_bed
    floor, floor_kind = build(case, behind)
    left, left_kind = _end_wall(case, floor, -1)
    right, right_kind = _end_wall(case, floor, 1)
    if case.wavemaker.type != "none":
        left_kind[:, 1] = PISTON
    plates, plate_kind = _gates(case, floor)
    kinds = np.vstack([floor_kind, left_kind, right_kind, plate_kind])
    return np.vstack([floor, left, right, plates]), kinds


def _smooth_bed(case, behind):
    """Layers along the bed, the uppermost of wall particles."""
    layers, spacing = case.particles.layers, case.particles.spacing
    points = beds.extended(case.tank.bed, behind, layers * spacing)
    rows = [beds.layer(points, (k + 0.5) * spacing, spacing) for k in range(layers)]
    kinds = [labels(len(row), FILLER if k else FACE) for k, row in enumerate(rows)]
    outside = rows[0][:, 0] > effective_length(case) + spacing
    if case.wavemaker.type == "none":
        outside |= rows[0][:, 0] < -spacing
    kinds[0][outside, 0] = FILLER
    return np.vstack(rows), np.vstack(kinds)


def _staircase(case, behind):
    """Bed cut out of the lattice, in steps of one spacing (to compare with the smooth bed)."""
    layers, spacing = case.particles.layers, case.particles.spacing
    end = effective_length(case)
    x = filling.between(case, -behind, end + layers * spacing)
    top = np.ceil(beds.elevation(case.tank.bed, x) / spacing - 0.5)
    lowest = np.array([top[max(i - layers, 0) : i + layers + 1].min() for i in range(len(x))])
    high = np.array([top[max(i - 1, 0) : i + 2].min() for i in range(len(x))])
    rows, kinds = [], []
    for i, place in enumerate(x):
        level = np.arange(lowest[i] - layers, top[i])
        rows.append(np.column_stack([np.full(len(level), place), (level + 0.5) * spacing]))
        wall = (level >= high[i] - 1) & (place < end + spacing)
        if case.wavemaker.type == "none":
            wall &= place > -spacing
        kinds.append(labels(len(level), np.where(wall, FACE, FILLER)))
    return np.vstack(rows), np.vstack(kinds)


def _end_wall(case, floor, side):
    """Vertical layers at the seaward (-1) or landward (+1) end, standing on the bed."""
    spacing, end = case.particles.spacing, effective_length(case)
    rows, kinds = [], []
    for k in range(case.particles.layers):
        x = -(k + 0.5) * spacing if side < 0 else end + (k + 0.5) * spacing
        stack = _stack(case, x, case.tank.height)
        rows.append(stack)
        kinds.append(labels(len(stack), FILLER if k else FACE))
    wall, kind = np.vstack(rows), np.vstack(kinds)
    free = _clear(case, wall, floor)
    return wall[free], kind[free]


def _gates(case, floor):
    """Vertical columns of the gates, standing on the bed: (n, 2) [m] and kinds (n, 2)."""
    rows, kinds = [np.zeros((0, 2))], [labels(0, FACE)]
    for number, (low, high) in enumerate(gates.faces(case)):
        columns = filling.between(case, low, high)
        for x in columns:
            rows.append(_stack(case, x, case.tank.height))
            outer = x in (columns[0], columns[-1])
            role = FACE if outer else FILLER
            kinds.append(labels(len(rows[-1]), role, gates.first(case) + number))
    plates, kind = np.vstack(rows), np.vstack(kinds)
    free = _clear(case, plates, floor)
    return plates[free], kind[free]


def _clear(case, section, floor):
    """Which places of a section do not come too close to the bed's particles, (n,) bool."""
    return scipy.spatial.cKDTree(floor).query(section)[0] > beds.CLOSEST * case.particles.spacing


def _repeat_across(case, solid, kind, backmost):
    """Repeat the cross-section in y; add side walls where the tank has them."""
    spacing, n = case.particles.spacing, rows_across(case)
    flat = case.tank.width == 0.0
    positions, kinds = [], []
    sections = [filling.section(case, row) for row in range(1 if flat else len(filling.PHASES))]
    walled = not (flat or case.tank.periodic)
    layers = case.particles.layers if walled else 0
    for row in range(-layers, n + layers):
        y = 0.0 if flat else (row + 0.5) * spacing
        outside = max(-row, row - n + 1)
        if outside <= 0:
            water = sections[row % len(sections)]
            wet = flat | ((water[:, 2] < y) & (y < water[:, 3]))
            _add(positions, kinds, water[wet, :2], labels(np.count_nonzero(wet), FLUID, WATER), y)
            _add(positions, kinds, solid, kind, y)
        else:
            side, side_kind = _side_wall(case, solid, kind, outside, backmost)
            _add(positions, kinds, side, side_kind, y)
    return np.vstack(positions), np.vstack(kinds)


def _side_wall(case, solid, kind, outside, backmost):
    """One layer of a side wall: the whole section of the tank, and the solids beyond it."""
    spacing, layers = case.particles.spacing, case.particles.layers
    behind = np.ceil(-backmost / spacing) * spacing if case.wavemaker.type != "none" else 0.0
    x = filling.between(case, -behind - layers * spacing, effective_length(case) + layers * spacing)
    section = np.vstack([_stack(case, place, case.tank.height) for place in x])
    below = solid[:, 1] < beds.elevation(case.tank.bed, solid[:, 0])
    below &= kind[:, 1] == TANK
    floor = solid[below]
    inside = (section[:, 0] > -behind - spacing) & (
        section[:, 0] < effective_length(case) + spacing
    )
    first = outside == 1
    faces = np.concatenate([inside, kind[below, 0] == FACE]) & first
    return np.vstack([section, floor]), labels(len(faces), np.where(faces, FACE, FILLER))


def _add(positions, kinds, section, kind, y):
    positions.append(np.column_stack([section[:, 0], np.full(len(section), y), section[:, 1]]))
    kinds.append(kind)


def _set_hydrostatic(case, particles):
    """Start from the pressure of the water column above each particle."""
    fluid = particles.fluid
    if not fluid.any():
        return
    spacing = case.particles.spacing
    column = np.floor(particles.position[:, 0] / spacing).astype(int)
    column = np.clip(column, 0, round(effective_length(case) / spacing) - 1)
    top = np.full(column.max() + 1, -np.inf)
    np.maximum.at(top, column[fluid], particles.position[fluid, 2] + 0.5 * spacing)
    depth = np.maximum(top[column] - particles.position[:, 2], 0.0)
    weight = case.fluid.density * case.fluid.gravity
    particles.pressure[:] = np.where(particles.carries_pressure, weight * depth, 0.0)
    if case.water:  # which may float above the bed
        off = scipy.spatial.cKDTree(particles.position[fluid]).query(particles.position)[0]
        particles.pressure[off > obstacles.NEAR * spacing] = 0.0
