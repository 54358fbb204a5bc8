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
        time, closest = _closest(run)
        energy.line(name, steps["time [s]"], total / total[0])
        pairs.line(name, time, closest)
        rows.append(
            [name, change.max(), change.min(), total[-1] / total[0], closest.min(),
             steps["lost"][-1]]
        )  # fmt: skip
    result.measure("rise", max(row[1] for row in rows))
    result.measure("closest", min(row[4] for row in rows))
    result.measure("lost", sum(row[5] for row in rows))
    columns = ["run", "largest rise in a step [%]", "largest fall [%]", "energy left",
               "closest pair [d0]", "lost"]  # fmt: skip
    result.table("Energy and order", columns, rows)
    return result


def _closest(run):
    """Time [s] and distance of the closest pair of water [spacings], frame by frame."""
    rows = [
        (time, cKDTree(place).query(place, k=2)[0][:, 1].min() / run.spacing)
        for time, place, _ in run.water()
    ]
    return np.array(rows).T
