"""Where a wave is steepest, and where it overturns: the surface seen from above and from below."""

from dataclasses import dataclass

import numpy as np
import scipy

# Columns of this width hold two particles a layer, so that disorder leaves no gap in the water.
COLUMN = 2.0  # [spacings]
GAP = 2.0  # [spacings] between particles, as for the gauges
# A jet has this many particles within the reach of each of its own, spray has not.
COHERENT = 6
REACH = 2.1  # [spacings]
JET = 8


@dataclass(frozen=True)
class Crest:
    """The most striking place of a water surface, in a slice x-z.

    Attributes
    ----------
    x, z : float
        Where it is [m].
    jet : int
        Number of particles of the slice that hang over air, spray left out.
    steepness : float
        Slope of the surface [-] where the product of slope and speed is largest.
    speed : float
        Speed of the water at the surface there [m/s].
    """

    x: float
    z: float
    jet: int
    steepness: float
    speed: float

    @property
    def overturns(self):
        """Whether the surface is multi-valued in x: a jet hangs over air."""
        return self.jet >= JET


def find_crest(x, z, speed, spacing):
    """Jet of the water surface if there is one, else where it is steep and fast.

    Slope alone would as soon find the ragged edge of the water at a wall, and speed alone the thin
    sheet that runs up a slope.

    Parameters
    ----------
    x, z : (n,) float [m]
        Fluid particles of a vertical slice, one spacing thick.
    speed : (n,) float [m/s]
    spacing : float
        Particle spacing [m].

    Returns
    -------
    Crest
    """
    column, top, hanging = _columns(x, z, spacing)
    jet = np.flatnonzero(hanging)
    jet = jet[_is_coherent(x[jet], z[jet], spacing)]
    k, steepness = _steepest(column, z[top] / spacing, speed[top])
    place = (x[jet].mean(), z[jet].mean()) if len(jet) >= JET else (x[top[k]], z[top[k]])
    return Crest(*map(float, place), len(jet), steepness, float(speed[top[k]]))


def _columns(x, z, spacing):
    """Columns with water, the particle on top of the lowest water in each, what hangs over air.

    Returns (c,) places in spacings, (c,) int rows of particles, and (n,) bool.
    """
    number = np.floor(x / (COLUMN * spacing))
    order = np.lexsort((z, number))
    number, height = number[order], z[order]
    first = np.concatenate([[True], np.diff(number) > 0])
    gap = np.concatenate([[False], np.diff(height) > GAP * spacing]) & ~first
    gaps = np.cumsum(gap)
    begin = np.maximum.accumulate(np.where(first, np.arange(len(x)), 0))
    above_gap = gaps > gaps[begin]
    hanging = np.zeros(len(x), bool)
    hanging[order] = above_gap
    number, order = number[~above_gap], order[~above_gap]
    last = np.concatenate([np.diff(number) > 0, [True]])
    return COLUMN * number[last], order[last], hanging


def _is_coherent(x, z, spacing):
    """Whether a particle has enough others around it, (n,) bool."""
    if not len(x):
        return np.zeros(0, bool)
    tree = scipy.spatial.cKDTree(np.column_stack([x, z]))
    around = tree.query_ball_point(tree.data, REACH * spacing, return_length=True)
    return around >= COHERENT


def _steepest(column, height, speed):
    """Number of the column where slope times speed is largest, and the slope there.

    The slope is taken between the columns on either side; heights in spacings.
    """
    if len(column) < 3:
        return 0, 0.0
    slope = np.abs(height[2:] - height[:-2]) / (column[2:] - column[:-2])
    k = int(np.argmax(slope * speed[1:-1]))
    return k + 1, float(slope[k])
