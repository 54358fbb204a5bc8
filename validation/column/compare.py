"""Energy and order of a column that hits a wall."""

import numpy as np
from scipy.spatial import cKDTree

from validation.comparison import Comparison


def compare(runs):
    """The worst of all runs."""
    result = Comparison()
    energy = result.figure("Energy of the water", "time [s]", "energy over that at the start")
    pairs = result.figure("Closest pair", "time [s]", "distance [d0]")
    rows = []
    for name, run in runs.items():
        steps = run.steps
        total = steps["kinetic_energy [J]"] + steps["potential_energy [J]"]
        change = 100.0 * np.diff(total) / total[0]
        time, closest, behind = _order(run)
        energy.line(name, steps["time [s]"], total / total[0])
        pairs.line(name, time, closest)
        rows.append(
            [name, change.max(), change.min(), total[-1] / total[0], closest.min(),
             behind.max(), steps["lost"][-1]]
        )  # fmt: skip
    result.measure("rise", np.max([row[1] for row in rows]))
    result.measure("closest", np.min([row[4] for row in rows]))
    result.measure("lost", np.sum([row[6] for row in rows]))
    columns = ["run", "largest rise in a step [%]", "largest fall [%]", "energy left",
               "closest pair [d0]", "deepest centre behind a wall [d0]", "lost"]  # fmt: skip
    result.table("Energy and order", columns, rows)
    return result


def _order(run):
    """Time [s], distance of the closest pair of water, and how far the foremost centre is behind
    bed or end walls, negative where all are in front [spacings], frame by frame.
    """
    length, rows = run.case["tank"]["length"], []
    for time, place, _ in run.water():
        closest = cKDTree(place).query(place, k=2)[0][:, 1].min()
        x, _, z = place.T
        behind = max(-x.min(), x.max() - length, -z.min())
        rows.append((time, closest / run.spacing, behind / run.spacing))
    return np.array(rows).T
