"""What a preflight says of the solids of any shape: what they cover, and the gaps between them."""

from itertools import combinations

import numpy as np

from mpslab.core import bed as beds
from mpslab.core.lattice import effective_length, rows_across
from mpslab.solids import shaped, surfaces

NARROW, TOUCHING = 4.0, 0.5  # spacings: water in a gap, and solids that meet


def solids(case):
    """Of the solids, by name: what they cover, how thin they are, and what was mended."""
    axes = [0, 1, 2] if case.dim == 3 else [0, 2]
    return {
        given.name: {
            "shape": given.shape,
            **{f"{'xyz'[k]} [m]": [_end(shape.low[k]), _end(shape.high[k])] for k in axes},
            "thinnest [m]": _end(shape.thinnest),
            "volume [m3]" if case.dim == 3 else "area [m2]": float(shape.volume),
            **_mended(given, f"solid.{number}.file"),
        }
        for number, (given, shape) in enumerate(zip(case.solid, shaped.shapes(case), strict=True))
    }


def gaps(case):
    """A warning for each gap, between solids or to a wall or the bed, that is narrow for water."""
    spacing, faces = case.particles.spacing, [shaped.faces(case, k) for k in range(len(case.solid))]
    found = []
    for i, j in combinations(range(len(faces)), 2):
        one, two = shaped.shapes(case)[i], shaped.shapes(case)[j]
        gap = min(_least(two.distance(faces[i])), _least(one.distance(faces[j])))
        found.append((f"solid.{i} and solid.{j}", gap))
    for i, places in enumerate(faces):
        found += [(f"solid.{i} and {name}", _least(far)) for name, far in _walls(case, places)]
    for name, gap in found:
        if TOUCHING * spacing < gap < NARROW * spacing * (1.0 - 1e-9):
            yield (
                f"{name}: the gap between them is {gap / spacing:.2g} spacings at the narrowest; "
                f"water wants {NARROW:g} or more to flow there"
            )


def _walls(case, places):
    """Names of bed and walls, and how far from them places (n, 3) are [m]."""
    x, y, z = places.T
    yield "the bed", z - beds.elevation(case.tank.bed, x)
    if case.wavemaker.type == "none":
        yield "the wall at x = 0", x
    yield "the end wall", effective_length(case) - x
    if case.dim == 3 and not case.tank.periodic:
        yield "a side wall", np.minimum(y, rows_across(case) * case.particles.spacing - y)


def _least(far):
    return float(far.min(initial=np.inf))


def _mended(given, key):
    notes = surfaces.read(given.file, key).notes if given.shape == "mesh" else ()
    return {"mended": list(notes)} if notes else {}


def _end(place):
    """A place as JSON can hold it: None where there is no end."""
    return float(place) if np.isfinite(place) else None
