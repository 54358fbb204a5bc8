"""What the figures and their claims measure in a frame of a run: the jet, the air, the fingers."""

import numpy as np
from scipy import ndimage

from mpslab.analysis import scatter
from mpslab.analysis.overturning import find_crest

STILL = 0.04  # [m] still water level of the tank
TIP = 10.0  # [spacings] around the jet within which it is judged
WINDOW = 0.12  # [m] to either side of the crest: three depths
CELL = 0.5  # [spacings] of the raster in which air is looked for
DISC = 0.8  # [spacings] radius that a particle covers: a little over half the diagonal of a lattice
LEAST_AIR = 4.0  # [spacings squared]: smaller gaps are not air
COLUMN = 2.0  # [spacings] width of the columns whose tops are the surface


def measure(time, position, velocity, spacing, width, bed):
    """The measures of one frame, a dict by the headings of ``series.csv``.

    Crest and jet are medians over the layers across the tank.

    Parameters
    ----------
    time : float [s]
    position, velocity : (n, 3) float [m], [m/s]
        Of the water.
    spacing, width : float [m]
        Particle spacing and width of the tank, which is periodic; 0 in 2-D.
    bed : (k, 2) float [m]
        Its points x, z.
    """
    layers = list(slices(position, spacing, width))
    speed = np.linalg.norm(velocity, axis=1)
    crests = [find_crest(*position[one][:, [0, 2]].T, speed[one], spacing) for one in layers]
    x, z, jet = np.median([(crest.x, crest.z, crest.jet) for crest in crests], axis=0)
    tip = np.hypot(position[:, 0] - x, position[:, 2] - z) < TIP * spacing
    near = np.abs(position[:, 0] - x) < WINDOW
    air = [enclosed_air(position[one & near], spacing, bed) for one in layers]
    rough = scatter.roughness(position[tip], velocity[tip], spacing, width)
    return {
        "time [s]": time,
        "crest x [m]": x,
        "crest z [m]": z,
        "jet": jet,
        "largest u [m/s]": float(np.quantile(velocity[:, 0], 0.999)),
        "roughness [m/s]": scatter.roughness(position[near], velocity[near], spacing, width),
        "roughness at the tip [-]": rough / float(np.sqrt(np.mean(speed[tip] ** 2))),
        "isolated share": scatter.isolated_share(position[near], spacing, width),
        "air [m2]": float(np.mean(air)),
        "splash [m]": splash(position[near], spacing, width, x),
        "share across the tank": share_across(position[near], spacing, width),
    }


def slices(position, spacing, width):
    """Masks of the layers x-z of the water, one spacing thick, side by side across the tank."""
    layer = np.floor(_across(position, width) / spacing).astype(int)
    for k in range(max(round(width / spacing), 1)):
        yield layer == k


def _across(position, width):
    """y within the width of the tank [m], (n,); 0 in 2-D."""
    return np.mod(position[:, 1], width) if width else np.zeros(len(position))


def enclosed_air(position, spacing, bed):
    """Area of the air that water encloses in a slice x-z [m2].

    The slice is drawn with discs that cover a lattice without gaps; what they leave free, and what
    cannot be reached from above, is air that is enclosed.
    """
    cell = CELL * spacing
    low = np.array([position[:, 0].min(), position[:, 2].min()]) - 4 * spacing
    index = np.floor((position[:, [0, 2]] - low) / cell).astype(int)
    shape = index.max(axis=0) + 9
    free = np.ones(shape, bool)
    free[index[:, 0], index[:, 1]] = False
    free = ndimage.distance_transform_edt(free) * CELL > DISC
    centre = low[:, None] + (np.arange(shape.max()) + 0.5) * cell
    ground = np.interp(centre[0, : shape[0]], *np.transpose(bed))
    free &= centre[1, : shape[1]] > ground[:, None] + DISC * spacing
    # Open to the sides and above: what is cut off at the sides of the window is not enclosed.
    free[[0, -1]] = True
    parts, count = ndimage.label(free)
    size = np.bincount(parts.ravel(), minlength=count + 1) * CELL**2
    enclosed = np.arange(count + 1) > 0
    enclosed[np.unique(parts[:, -1])] = False
    return float(size[enclosed & (size >= LEAST_AIR)].sum()) * spacing**2


def splash(position, spacing, width, x):
    """Height above still water of the highest water ahead of a place x [m], spray left out."""
    ahead = position[position[:, 0] > x]
    if len(ahead) < 2:
        return 0.0
    tops = np.sort(ahead[:, 2])
    return float(tops[-max(round(width / spacing), 1)] - STILL)


def share_across(position, spacing, width):
    """Share of the variance of the surface that is across the tank, 0 (2-D) to 1 [-].

    The surface is the top of columns two spacings wide.
    """
    column = COLUMN * spacing
    i = np.floor((position[:, 0] - position[:, 0].min()) / column).astype(int)
    j = np.floor(_across(position, width) / column).astype(int)
    top = np.full((i.max() + 1, max(round(width / column), 1)), -np.inf)
    np.maximum.at(top, (i, np.minimum(j, top.shape[1] - 1)), position[:, 2])
    top = top[np.isfinite(top).all(axis=1)]
    total = top.var()
    return float(top.var(axis=1).mean() / total) if total else 0.0
