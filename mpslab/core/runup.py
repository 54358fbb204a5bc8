"""How thick the water lies on a slope, and where its tip is."""

import numpy as np

from mpslab.core import bed as beds

STEP = 0.5  # spacings between the stations along the slope
# Of the thickness that is asked for, so much above the bed is looked at: a jet that shoots over dry
# bed, and water deeper than that, are the same to the tip.
LOOKED_AT = 1.5
WIDE = 1.5  # spacings: half the width of the spline


def spline(distance):
    """Quadratic B-spline of distances [spacings]; over a lattice its values add up to one."""
    far = np.abs(distance)
    outer = 0.5 * np.maximum(WIDE - far, 0.0) ** 2
    return np.where(far < 0.5, 0.75 - far**2, outer)


def stations(foot, top, spacing):
    """Places along a slope, half a spacing apart, (m,) float64 [m]."""
    return foot + STEP * spacing * np.arange(int((top - foot) / (STEP * spacing)) + 1)


def above(bed, position):
    """Distance of places (n, 3) from the bed below them, at right angles to it, (n,) [m]."""
    x = position[:, 0]
    return (position[:, 2] - beds.elevation(bed, x)) / lean(bed, x)


def lean(bed, x):
    """Vertical distance over that at right angles to the bed, (n,) [-]."""
    return np.sqrt(1.0 + beds.slope(bed, x) ** 2)


def thickness(position, bed, x, spacing, least, y=None, width=0.0):
    r"""Thickness of the water on the bed, by the volume of its particles.

    .. math:: h(x) = d_0 \sum_j B(x_j - x)\, B(y_j - y) / \sqrt{1 + s^2}

    with the quadratic B-spline B of half width 1.5 spacings and the slope s, over the particles up
    to 1.5 times the `least` thickness above the bed.

    Parameters
    ----------
    position : (n, 3) float64 [m]
        Of water.
    bed : sequence of (x, z) [m]
    x : (m,) float64 [m]
        Of `stations`.
    spacing, least : float [m]
    y : float [m] or None
        Place across the tank; None in 2-D, where B(y_j - y) is one.
    width : float, optional
        Period in y [m], 0 if there is none.

    Returns
    -------
    (m,) float64 [m]
    """
    position = position[above(bed, position) < LOOKED_AT * least]
    across = np.ones(len(position))
    if y is not None:
        off = position[:, 1] - y
        across = spline((off - width * np.round(off / width) if width else off) / spacing)
    pitch = STEP * spacing
    first = np.ceil((position[:, 0] - x[0] - WIDE * spacing) / pitch).astype(int)
    total = np.zeros(len(x))
    for k in range(int(2.0 * WIDE / STEP) + 1):
        station = first + k
        inside = (station >= 0) & (station < len(x))
        weight = spline((position[:, 0] - x[0] - station * pitch) / spacing) * across
        total += np.bincount(station[inside], weight[inside], len(x))
    return spacing * total / lean(bed, x)


def tip(bed, x, thick, least):
    """The highest water that hangs together with that at the first station and is so thick.

    Parameters
    ----------
    bed : sequence of (x, z) [m]
    x, thick : (m,) float64 [m]
        Stations, and thickness there.
    least : float [m]

    Returns
    -------
    level, place : float [m]
        z of its surface where it is as thin as that, so still water reads its level; and x. NaN
        where the first station has less.
    """
    thin = np.flatnonzero(thick < least)
    if not len(thin):
        place = x[-1]
    elif thin[0] == 0:
        return np.nan, np.nan
    else:
        k = thin[0] - 1
        place = x[k] + (thick[k] - least) / (thick[k] - thick[k + 1]) * (x[k + 1] - x[k])
    return float(beds.elevation(bed, place) + least * lean(bed, place)), float(place)
