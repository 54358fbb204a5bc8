"""Energy and order of a column that hits a wall."""

import numpy as np
from scipy.spatial import cKDTree

from validation.comparison import Comparison


def compare(runs):
    """Largest rise of the energy, closest pair, and what was lost."""
    result, run = Comparison(), runs["column"]
    steps = run.steps
    total = steps["kinetic_energy"] + steps["potential_energy"]
    change = 100.0 * np.diff(total) / total[0]
    time, closest, behind = _order(run)
    result.measure("rise", change.max())
    result.measure("closest", closest.min())
    result.measure("lost", steps["lost"][-1])
    energy = result.figure("Energy of the water", "time [s]", "energy over that at the start")
    energy.line(run.label, steps["time"], total / total[0])
    pairs = result.figure("Closest pair", "time [s]", "distance [d0]")
    pairs.line(run.label, time, closest)
    columns = ["run", "largest rise in a step [%]", "largest fall [%]", "energy left",
               "closest pair [d0]", "deepest centre behind a wall [d0]", "lost"]  # fmt: skip
    row = [run.label, change.max(), change.min(), total[-1] / total[0], closest.min(),
           behind.max(), steps["lost"][-1]]  # fmt: skip
    result.table("Energy and order", columns, [row])
    return result


def _order(run):
    """Time [s], distance of the closest pair of water, and how far the foremost centre is behind
    bed or end walls, negative where all are in front [spacings], frame by frame.
    """
    length, rows = run.case.tank.length, []
    for time, place, _ in run.water():
        closest = cKDTree(place).query(place, k=2)[0][:, 1].min()
        x, _, z = place.T
        behind = max(-x.min(), x.max() - length, -z.min())
        rows.append((time, closest / run.spacing, behind / run.spacing))
    return np.array(rows).T
