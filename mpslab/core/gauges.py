"""Instruments: the water level at a place, pressure and velocity at a point."""

import numpy as np

from mpslab.core.particles import FLUID, carries_pressure
from mpslab.kernels import column

# The water level is looked for on a vertical line of points, so many to a particle spacing.
POINTS = 8
# A gap in the water column wider than this, from surface to surface, ends it [spacings]; between
# the centres of the particles on either side of the gap it is one spacing more.
LARGEST_GAP = 1.0
# Inside a solid no room is left for water, and a fraction of nothing would be noise.
LEAST_ROOM = 0.25
PROBE_RADIUS = 2.1  # [spacings]
# A probe is in the water where a particle of it is as near as that: within it one always is, and
# half a spacing above its surface none is any more [spacings].
WET = 1.1
# A particle of a wall is as near as that to any place on its face, which is laid out up to half a
# spacing from where the case has it [spacings].
ON_WALL = 1.25
# Share of the largest moment of the neighbours below which they count as in one plane.
LEAST_SPREAD = 0.04
ONE_PLACE = 1e-12  # [spacings^2] moment of neighbours that are all at one place


def surface_elevation(position, role, spacing, x, y=0.0, width=0.0):
    r"""Level of the water surface over a place.

    Along the vertical line through (x, y), the water fraction is

    .. math::
        \phi(z) = \frac{\sum_{j \in \text{fluid}} B_j}{1 - \sum_{j \in \text{solid}} B_j}, \qquad
        B_j = B(x_j - x)\, B(y_j - y)\, B(z_j - z)

    with the quadratic B-spline B of half width 1.5 spacings. Its values over a lattice add up to
    one wherever the line lies in it, so that the fraction is exactly one in a lattice of water, and
    1/2 exactly half a spacing above its uppermost layer. The level is the highest point with a
    fraction of 1/2 of the column that is connected to the bed: a gap of more than two spacings
    between particles ends it, so that neither spray nor a jet that overhangs counts. A particle
    that moves in or out adds to the sum, or leaves it, with zero slope: the level is smooth in
    time.

    Parameters
    ----------
    position : (n, 3) float64 [m]
    role : (n,) int8
    spacing : float
        Particle spacing [m].
    x, y : float
        The place [m]; y has no meaning where all particles have the same y (2-D).
    width : float, optional
        Period in y [m], 0 if there is none.

    Returns
    -------
    float
        z of the water surface [m]; NaN where it is dry.
    """
    near, weight = _column(position, spacing, x, y, width)
    height = position[near, 2] / spacing
    is_fluid = role[near] == FLUID
    if not is_fluid.any():
        return np.nan
    lowest = np.floor(height.min()) - 2
    count = POINTS * int(np.ceil(height.max()) + 2 - lowest) + 1
    fluid, solid = np.zeros(count), np.zeros(count)
    column.spread(height - lowest, weight, is_fluid.view(np.uint8), POINTS, fluid, solid)
    gap = int(LARGEST_GAP * POINTS)
    point, part = column.top(fluid, solid, gap, LEAST_ROOM)
    return spacing * (lowest + point / POINTS + part / POINTS)


def _column(position, spacing, x, y, width):
    """Rows of the particles around a vertical line, and their horizontal weights."""
    near, weight = np.empty(len(position), np.int32), np.empty(len(position))
    count = column.around(position, spacing, x, y, width, near, weight)
    return near[:count], weight[:count]


def _minimal_image(offset, width):
    """Distance in y to the nearest of the periodic images."""
    return offset - width * np.round(offset / width) if width else offset


def probe(position, velocity, pressure, role, spacing, point, width=0.0):
    """Pressure and velocity at a point, by moving least squares of first order.

    Where there is water within 1.1 spacings, so up to half a spacing above its surface: the
    pressure is that of the particles that carry one (water, walls, piston, gates), the velocity
    that of the water, within 2.1 spacings. A linear field comes back exactly. Elsewhere there is no
    velocity, and a pressure on walls only: that which they hold, 0 where they are dry.

    Parameters
    ----------
    position : (n, 3) float64 [m]
    velocity : (n, 3) float64 [m/s]
    pressure : (n,) float64 [Pa]
    role : (n,) int8
    spacing : float
        Particle spacing [m].
    point : (3,) float
        The place [m].
    width : float, optional
        Period in y [m], 0 if there is none.

    Returns
    -------
    (4,) float64
        Pressure [Pa] and the velocity components u, v, w [m/s]; NaN where there is none.
    """
    reach = PROBE_RADIUS * spacing
    near = np.flatnonzero(np.abs(position[:, 0] - point[0]) < reach)
    offset = position[near] - point
    offset[:, 1] = _minimal_image(offset[:, 1], width)
    inside = np.einsum("ij,ij->i", offset, offset) < reach**2
    near, offset = near[inside], offset[inside] / spacing
    far = np.sqrt(np.einsum("ij,ij->i", offset, offset))
    wet = role[near] == FLUID
    loaded = carries_pressure(role[near])
    if not np.any(far[wet] <= WET):
        wet, loaded = np.zeros_like(wet), loaded & ~wet & (far <= ON_WALL)
    p = _least_squares(offset[loaded], pressure[near[loaded], None])
    return np.concatenate([p, _least_squares(offset[wet], velocity[near[wet]])])


def _least_squares(offset, values):
    """Value at the origin of the linear fields that fit (n, m) values at (n, 3) offsets best.

    The slope is zero along directions in which the neighbours hardly differ: y in 2-D, or the
    normal of a single layer of wall particles.
    """
    if not len(offset):
        return np.full(values.shape[1], np.nan)
    weight = (1.0 - np.sqrt(np.einsum("ij,ij->i", offset, offset)) / PROBE_RADIUS) ** 2
    weight /= weight.sum()
    centre, mean = weight @ offset, weight @ values
    offset, values = offset - centre, values - mean
    moment = (weight * offset.T) @ offset
    size, axes = np.linalg.eigh(moment)
    differ = size > max(LEAST_SPREAD * size[-1], ONE_PLACE)
    along = axes[:, differ]
    slope = along @ ((along.T @ (weight * offset.T) @ values) / size[differ, None])
    return mean - centre @ slope
