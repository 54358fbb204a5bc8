"""Where a wave is steepest, and where it breaks: the surface seen from above and from below."""

from dataclasses import dataclass

import numpy as np
import scipy

# Columns of this width hold two particles in a layer, so that disorder leaves no gap in the water.
COLUMN = 2.0  # [spacings]
GAP = 2.0  # [spacings] between particles, as for the gauges
# In a jet each particle has this many others within REACH, in spray it has fewer.
COHERENT = 6
REACH = 2.1  # [spacings]
JET = 8
# Particles as near as this belong to one body of water.
LINK = 1.5  # [spacings]
# Behind a front this many columns hold higher water, and ahead of it as many hold lower water.
BEHIND, AHEAD = 5, 2
UPRIGHT = 3.5  # [spacings] between the water behind and ahead
BROAD = 3  # columns over which a jet hangs; a gap in the sheet of a run-up is narrower
APART = 4.2  # [spacings] between the parts of a jet


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
    """The jet of the water surface; if there is none, the place where it is steep and fast.

    Slope alone could just as well find the ragged edge of the water at a wall, and speed alone the
    thin sheet that runs up a slope.

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


@dataclass(frozen=True)
class Front:
    """A front of water that stands upright or has overturned.

    Attributes
    ----------
    x, z : float
        Middle of the jet, or where the upright front is [m].
    overturns : bool
        Whether a jet hangs over air.
    """

    x: float
    z: float
    overturns: bool


def find_front(x, z, along, spacing):
    """The front of a wave that breaks, in a slice x-z.

    It belongs to the largest body of connected water, without spray. The water behind it stands
    several spacings higher than the water ahead, over more columns than in the sheet of a run-up;
    and it moves faster than the water ahead, unlike the water of a column that collapses. It
    overturns where a broad jet hangs over air.

    Parameters
    ----------
    x, z : (n,) float [m]
        Fluid particles of a vertical slice, one spacing thick.
    along : (n,) float [m/s]
        Velocity along x.
    spacing : float
        Particle spacing [m].

    Returns
    -------
    Front, or None
    """
    body = _largest_body(x, z, LINK * spacing)
    x, z, along = x[body], z[body], along[body]
    if not len(x):
        return None
    column, top, hanging = _columns(x, z, spacing)
    crest = _highest(x, z, spacing)
    over, under = ((z[rows] / spacing, along[rows]) for rows in (crest, top))
    drop, k = max(_step(sign, column, over, under) for sign in (1, -1))
    if drop < UPRIGHT:
        return None
    jet = np.flatnonzero(hanging)
    jet = jet[_is_coherent(x[jet], z[jet], spacing)]
    jet = jet[_largest_body(x[jet], z[jet], APART * spacing)]
    over_columns = len(np.unique(np.floor(x[jet] / (COLUMN * spacing))))
    if len(jet) >= JET and over_columns >= BROAD:
        return Front(float(x[jet].mean()), float(z[jet].mean()), True)
    return Front(float(x[crest[k]]), float(z[crest[k]]), False)


def _highest(x, z, spacing):
    """Rows of the highest particle in each column, (c,) int."""
    number = np.floor(x / (COLUMN * spacing))
    order = np.lexsort((z, number))
    return order[np.append(np.diff(number[order]) > 0, True)]


def _step(sign, column, over, under):
    """Largest fall in a direction, +1 or -1, from the top of the water to the surface ahead.

    Parameters
    ----------
    sign : int
    column : (c,) float
        Places of the columns [spacings].
    over, under : pair of (c,) float
        Height [spacings] and velocity along x of the highest particle of each column, and of the
        one on top of its lowest water.

    Returns
    -------
    float [spacings], int
        The fall, and the number of the column before it; both 0 if there is none.
    """
    count = BEHIND + AHEAD
    if len(column) < count:
        return 0.0, 0
    order = np.arange(len(column))[::sign]
    windows = np.lib.stride_tricks.sliding_window_view(order, count)
    behind, ahead = windows[:, :BEHIND], windows[:, BEHIND:]
    drop = over[0][behind].min(axis=1) - under[0][ahead].max(axis=1)
    unbroken = np.abs(column[windows[:, -1]] - column[windows[:, 0]]) == COLUMN * (count - 1)
    overtakes = sign * (over[1][behind].mean(axis=1) - under[1][ahead].mean(axis=1)) > 0.0
    drop = np.where(unbroken & overtakes, drop, 0.0)
    best = int(np.argmax(drop))
    return float(drop[best]), int(behind[best, -1])


def _largest_body(x, z, reach):
    """Particles of the largest group in which each is within reach of another, (n,) bool."""
    if not len(x):
        return np.zeros(0, bool)
    pairs = scipy.spatial.cKDTree(np.column_stack([x, z])).query_pairs(reach, output_type="ndarray")
    graph = scipy.sparse.coo_array((np.ones(len(pairs)), pairs.T), shape=(len(x), len(x)))
    _, group = scipy.sparse.csgraph.connected_components(graph, directed=False)
    return group == np.bincount(group).argmax()


def _columns(x, z, spacing):
    """Columns with water, the particle on top of the lowest water in each, and what hangs over air.

    Returns (c,) places in spacings, (c,) int rows of particles, and a mask (n,) bool.
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
