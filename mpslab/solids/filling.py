"""How the water is laid out: in columns, each filled by its volume up to the level asked for.

A column whose height is not a whole number of spacings gets the next smaller or the next larger
number of particles, spread evenly over its height. The two numbers take turns from column to
column, so that all columns together hold the volume of the water.
"""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core.lattice import between, effective_length, ground, size
from mpslab.solids import gates, obstacles, shaped

# Share of a particle that the first column begins with: it differs from row to row across the
# tank, so that all rows together hold the volume.
PHASES = (0.125, 0.625, 0.375, 0.875)
ROUND_OFF = 1e-6  # spacings
TIGHTEST = 0.75  # spacings from particle to particle in a column
CLEAR = 0.5 - ROUND_OFF  # spacings from the water to a particle of the lid


def filled(case):
    """Box of the water of a tank that is filled to its still depth, (start, end) [m]."""
    return (0.0, 0.0, -np.inf), (effective_length(case), case.tank.width, case.tank.depth)


def section(case, row=0):
    """Water of the cross-section at a row of particles across the tank.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    row : int
        Number of the row, from 0.

    Returns
    -------
    (n, 4) float64 [m]
        x and z of each particle, and the least and largest y that its water reaches.
    """
    phase = PHASES[row % len(PHASES)] if case.dim == 3 else 0.5
    if not case.water:
        return _box(case, *filled(case), phase)
    lay = {"box": lambda w: _box(case, w.start, w.end, phase), "disc": lambda w: _disc(case, w)}
    return np.vstack([lay[water.shape](water) for water in case.water])


def columns(case, start, end):
    """x of the columns of water in a box that stand in no gate [m], a list."""
    along = between(case, start[0], min(end[0], effective_length(case)))
    return [*along[~gates.holds(case, along)]]


def _box(case, start, end, phase):
    """Rows of the section for a box of water, without what solids take up of it, (n, 4) [m]."""
    rows, spacing = [np.zeros((0, 4))], case.particles.spacing
    for low, high in obstacles.around(case, start, end):
        x = np.array(columns(case, low, high))
        sides = [round(low[1] / spacing) * spacing, round(high[1] / spacing) * spacing]
        place = _fill(x, *ground(case, x, low[2]), high[2], spacing, phase)
        rows.append(np.hstack([place, np.broadcast_to(sides, (len(place), 2))]))
    return np.vstack(rows)


def _fill(x, low, first, top, spacing, phase):
    """Particles of columns at x from `low` to `top`, the lowest `first` above `low`: (n, 2) [m]."""
    # On a slope the lowest particle is farther up, because its distance is along the normal.
    base = low + first - 0.5 * spacing
    count = _share((top - low) / spacing, (top - base) / spacing, phase)
    pitch = (top - base) / np.maximum(count, 1)
    number = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    z = np.repeat(base, count) + (number + 0.5) * np.repeat(pitch, count)
    alone = np.repeat(count == 1, count)
    z[alone] = np.maximum(z[alone], (low + first)[count == 1])
    return np.column_stack([np.repeat(x, count), z])


def _share(height, room, phase):
    """How many particles each column gets, (n,) int; what a column cannot hold goes to the next.

    Parameters
    ----------
    height, room : (n,) float64 [spacings]
        Of each column: the height of the water that is to be in it, and of the room for particles;
        below 0 if it is dry.
    phase : float
        Share of a particle that the first column begins with.
    """
    most = np.minimum(np.floor(room / TIGHTEST), np.ceil(room))
    most = np.maximum(most, room >= 0.5).astype(int)
    count, left = np.zeros(len(height), int), phase + ROUND_OFF
    for i in range(len(height)):
        left += max(height[i], 0.0)
        count[i] = max(min(int(left), most[i]), 0)
        left -= count[i]
    return count


def _disc(case, water):
    """Rows of the section for the disc in a box: particles of the lattice with centres inside."""
    spacing = case.particles.spacing
    (x0, y0, z0), (x1, _, z1) = water.start, water.end
    low, high = (round(z / spacing) * spacing for z in (z0, z1))
    rows = _box(case, (x0, y0, low), (*water.end[:2], high), 0.5)
    across = (rows[:, 0] - 0.5 * (x0 + x1)) / (0.5 * (x1 - x0))
    up = (rows[:, 1] - 0.5 * (z0 + z1)) / (0.5 * (z1 - z0))
    return rows[across**2 + up**2 <= 1.0 + 1e-9]


def lid(case):
    """Lattice sites in the air beside and above the boxes of water, (n, 3) [m].

    Particles there hold the surface of the water while it settles.  A disc has none.
    """
    from scipy.spatial import cKDTree

    spacing = case.particles.spacing
    boxes = [laid(case, w.start, w.end) for w in case.water if w.shape == "box"]
    if not case.water:
        boxes = [laid(case, *filled(case))]
    sites = np.zeros((0, 3))
    for box in boxes:
        new = _around(case, *box)
        for low, high in boxes:
            new = new[~np.all((new > low - CLEAR * spacing) & (new < high + CLEAR * spacing), 1)]
        if len(sites):
            new = new[cKDTree(sites).query(new)[0] > beds.CLOSEST * spacing]
        sites = np.vstack([sites, new])
    dry = sites[:, 2] > beds.elevation(case.tank.bed, sites[:, 0])
    dry &= ~obstacles.holds(case, sites) & ~shaped.holds(case, sites)
    return sites[dry]


def laid(case, start, end):
    """Corners of a box of water as laid out, in whole spacings along x and y: (3,) [m] each."""
    spacing = case.particles.spacing
    low, high = np.array(start), np.array(end)
    low[:2], high[:2] = (np.round(corner[:2] / spacing) * spacing for corner in (low, high))
    return low, high


def _around(case, low, high):
    """Sites in and around a box of water, with its surface between two layers: (n, 3) [m]."""
    spacing, layers = case.particles.spacing, case.particles.layers
    length, width = size(case.tank, spacing)
    first = max(round(low[0] / spacing) - layers, 0)
    last = min(round(high[0] / spacing) + layers, length)
    edge = width * spacing if case.dim == 3 else 0.0
    bottom = max(low[2], beds.lowest(case.tank.bed, first * spacing, last * spacing))
    down = int(np.ceil((high[2] - bottom) / spacing)) + layers
    if np.all(low <= [0.0, 0.0, bottom]) and np.all(high[:2] >= [length * spacing, edge]):
        down = 0  # from wall to wall and down to the bed: the only air is above it
    x = (np.arange(first, last) + 0.5) * spacing
    y = (np.arange(width) + 0.5) * spacing if case.dim == 3 else np.zeros(1)
    z = high[2] + (np.arange(-down, layers) + 0.5) * spacing
    return np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
