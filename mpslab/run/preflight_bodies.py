"""What a free body is like before the first step: its mass, how it floats, and what is near it."""

import numpy as np

from mpslab.cases.bodies import gaps_of
from mpslab.solids import mass
from mpslab.solids.floating import weigh
from mpslab.solids.shaped import shapes
from mpslab.solids.shapes import samples

SAMPLES = {2: 400, 3: 100}  # along an axis, of the box around a body


def bodies(case, notes):
    """Findings "bodies" about free bodies by name, none where there are none.

    In 2-D those of a slice 1 m wide. "draft [m]", the z "floats_at [m]" of the centre of mass and
    the "metacentric_height [m]" of roll are of a body that floats, upright and in open water. What
    may trouble a body is added to the notes.
    """
    free = [i for i, given in enumerate(case.solid) if given.motion == "free"]
    found = {}
    for i, gaps in zip(free, gaps_of(case) if free else (), strict=True):
        given = case.solid[i]
        weight, center, inertia = weigh(case, i)
        bulk = mass.bulk(shapes(case)[i], case.dim)
        near = min(gaps, key=gaps.get)
        found[given.name] = {
            "mass [kg]": weight,
            "volume [m3]": bulk.volume,
            "density [kg/m3]": weight / bulk.volume,
            "center_of_mass [m]": center.tolist(),
            "inertia [kg m2]": [inertia[1, 1]] if case.dim == 2 else np.diag(inertia).tolist(),
            "smallest_gap [m]": gaps[near],
            "nearest": near,
            **_afloat(case, shapes(case)[i], weight, center),
        }
        height = found[given.name].get("metacentric_height [m]")
        if height is not None and height < 0.0:
            notes.append(
                f"{given.name}: its metacentre is {-1e3 * height:.3g} mm below its centre of mass, "
                "upright it is not stable and turns over"
            )
    return {"bodies": found} if found else {}


def _afloat(case, shape, weight, center):
    """How the body floats upright in deep water: draft, and its metacentric height for roll.

    Nothing of a body that sinks.
    """
    axes = [0, 1, 2] if case.dim == 3 else [0, 2]
    count, low, sides = SAMPLES[case.dim], shape.low[axes], (shape.high - shape.low)[axes]
    share = (np.arange(count) + 0.5) / count
    places = samples(shape.low, shape.high, axes, count)
    inside = (shape.distance(places) < 0.0).reshape((count,) * len(axes))
    cell = float(np.prod(sides) / count ** len(axes))
    layers = cell * inside.sum(axis=tuple(range(len(axes) - 1)))  # volume of each, from below
    needed = weight / case.fluid.density
    below = np.concatenate([[0.0], np.cumsum(layers)])
    if needed >= below[-1] or case.fluid.gravity == 0.0:
        return {}
    draft = float(np.interp(needed, below, sides[-1] * np.arange(count + 1) / count))
    level = min(int(draft / sides[-1] * count), count - 1)
    z = low[-1] + sides[-1] * share
    part = np.clip(draft / sides[-1] * count - np.arange(count), 0.0, 1.0) * layers
    if not part.any():
        return {}  # so light that it dips no more than its tip into the water
    buoyancy = float(np.sum(part * z) / np.sum(part))
    x = low[0] + sides[0] * share
    plane = inside[..., level].sum(axis=1) if case.dim == 3 else inside[..., level].astype(float)
    area = cell * count / sides[-1]
    middle = np.sum(plane * x) / np.sum(plane)
    second = area * float(np.sum(plane * ((x - middle) ** 2 + (sides[0] / count) ** 2 / 12.0)))
    return {
        "draft [m]": draft,
        "floats_at [m]": case.tank.depth - draft + float(center[2] - shape.low[2]),
        "metacentric_height [m]": second / needed - (float(center[2]) - buoyancy),
    }
