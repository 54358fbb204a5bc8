"""The lattice on which a tank is laid out: its columns and rows, and where the bed meets them."""

import numpy as np

from mpslab.core import bed as beds
from mpslab.later import scipy


def effective_length(case):
    """Length of the tank in whole spacings [m]."""
    return round(case.tank.length / case.particles.spacing) * case.particles.spacing


def rows_across(case):
    """Number of particles across the tank; 1 in 2-D."""
    return max(round(case.tank.width / case.particles.spacing), 1)


def size(tank, spacing):
    """Length and width of the tank in whole spacings; width 1 in 2-D."""
    return round(tank.length / spacing), max(round(tank.width / spacing), 1)


def between(case, start, end):
    """x of the columns of the lattice between two places [m]."""
    spacing = case.particles.spacing
    return (np.arange(round(start / spacing), round(end / spacing)) + 0.5) * spacing


def ground(case, x, bottom=-np.inf):
    """Height where each column begins, and least height of its first particle above it: (n,) [m].

    Parameters
    ----------
    x : (n,) float64 [m]
    bottom : float [m]
        Lower end of the box that is filled; above the bed, that is where columns begin.
    """
    spacing, bed = case.particles.spacing, case.tank.bed
    level = beds.elevation(bed, x)
    lean = np.sqrt(1.0 + beds.slope(bed, x) ** 2)
    if case.particles.bed == "staircase":
        level, lean = np.ceil(level / spacing - 0.5) * spacing, np.ones_like(lean)
    floats = bottom > level
    return np.where(floats, bottom, level), 0.5 * spacing * np.where(floats, 1.0, lean)


def stack(case, x, top):
    """Solid particles of one column, from the bed up, as many as fit: (n, 2) [m]."""
    spacing = case.particles.spacing
    low, first = ground(case, x)
    first = float(low + first)
    n = max(round((top - (first - 0.5 * spacing)) / spacing), 0)
    return np.column_stack([np.full(n, x), first + np.arange(n) * spacing])


def clear(case, section, others):
    """Which places of a section do not come too close to other particles, (n,) bool.

    section, others : (n, 2), (m, 2) float64 [m], x and z
    """
    return scipy.spatial.cKDTree(others).query(section)[0] > beds.CLOSEST * case.particles.spacing


def across(case, section):
    """A section repeated in every row across the tank, (rows n, 3) [m].

    section : (n, 2) float64 [m], x and z
    """
    if case.dim == 2:
        return at_row(section, 0.0)
    places = (np.arange(rows_across(case)) + 0.5) * case.particles.spacing
    return np.vstack([at_row(section, y) for y in places])


def at_row(section, y):
    """A section at a place across the tank [m], (n, 3) [m]."""
    return np.column_stack([section[:, 0], np.full(len(section), y), section[:, 1]])
