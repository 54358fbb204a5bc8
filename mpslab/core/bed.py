"""The bed as a line of points, and the layers of particles along it."""

from functools import lru_cache
from itertools import pairwise

import numpy as np

CLOSEST = 0.7  # spacings: a solid particle nearer to the bed layers than this is left out


def _points(bed):
    """Points of a bed, (n, 2) float64 [m]; those of a case, which are tuples, are kept."""
    return _kept(bed) if isinstance(bed, tuple) else np.asarray(bed, float)


@lru_cache(maxsize=4)
def _kept(bed):
    points = np.array(bed, float)
    points.flags.writeable = False
    return points


def elevation(bed, x):
    """Elevation of the bed at x, both ends carried on with the slope they have [m].

    Parameters
    ----------
    bed : sequence of (x, z) [m], x ascending
    x : array_like [m]
    """
    points = _points(bed)
    x = np.asarray(x, float)
    z = np.interp(x, points[:, 0], points[:, 1])
    last = _slope(points[-2], points[-1])
    return z + np.where(x > points[-1, 0], last * (x - points[-1, 0]), 0.0)


def lowest(bed, start, end):
    """Lowest elevation of the bed between two places [m]."""
    points = _points(bed)
    inside = points[(points[:, 0] >= start) & (points[:, 0] <= end), 1]
    return float(min(*elevation(points, (start, end)), inside.min(initial=np.inf)))


def slope(bed, x):
    """Slope dz/dx of the bed at x [-]."""
    points = _points(bed)
    inside = np.searchsorted(points[:, 0], x, side="right") - 1
    inside = np.clip(inside, 0, len(points) - 2)
    steep = np.diff(points[:, 1]) / np.diff(points[:, 0])
    return np.where(np.asarray(x) < points[0, 0], 0.0, steep[inside])


def shore(bed, level):
    """The slope on which a level meets the bed.

    Parameters
    ----------
    bed : sequence of (x, z) [m], x ascending
    level : float [m]
        Of the still water.

    Returns
    -------
    foot, top : float [m]
        x from where the bed rises all the way, and of the landward end of its crest, behind which
        it falls or ends; None where the bed does not rise out of the water.
    """
    x, z = _points(bed).T
    dry = np.flatnonzero(z > level)
    if not len(dry) or dry[0] == 0:
        return None
    foot = top = dry[0]
    while foot > 0 and z[foot - 1] <= z[foot]:
        foot -= 1
    while z[foot + 1] == z[foot]:
        foot += 1
    while top < len(z) - 1 and z[top + 1] >= z[top]:
        top += 1
    return float(x[foot]), float(x[top])


def extended(bed, before, after):
    """The bed carried on: level before the first point, with its slope after the last."""
    points = _points(bed)
    ahead = points[-1] + after * np.array([1.0, _slope(points[-2], points[-1])])
    behind = points[0] - [before, 0.0]
    return np.vstack([behind, points, ahead])


def layer(points, depth, spacing):
    """Particles at equal distances along the line `depth` below the bed, (n, 2) [m].

    The line is offset along the normals, with mitred corners; each straight piece is divided
    into intervals as close to the spacing as they can be, a particle in the middle of each.
    """
    line = _offset(points, depth)
    pieces = []
    for start, end in pairwise(line):
        n = max(round(float(np.hypot(*(end - start))) / spacing), 1)
        pieces.append(start + np.outer((np.arange(n) + 0.5) / n, end - start))
    return np.vstack(pieces)


def count(points, depth, spacing):
    """How many particles `layer` puts along the line `depth` below the bed."""
    pieces = np.diff(_offset(points, depth), axis=0)
    return float(np.maximum(np.round(np.hypot(*pieces.T) / spacing), 1.0).sum())


def _slope(a, b):
    return (b[1] - a[1]) / (b[0] - a[0])


def _offset(points, depth):
    """The line of points moved `depth` downwards along its normals."""
    step = np.diff(points, axis=0)
    normal = np.column_stack([step[:, 1], -step[:, 0]]) / np.hypot(*step.T)[:, None]
    mitre = np.vstack([normal[:1], normal[:-1] + normal[1:], normal[-1:]])
    before = np.vstack([normal[:1], normal])
    mitre /= np.sum(mitre * before, axis=1)[:, None]
    return points + depth * mitre
