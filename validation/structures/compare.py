"""Lift and moment of solids in still water, and what gets through plates."""

import numpy as np

from validation.comparison import Comparison

SETTLED = 0.2  # seconds after which means are taken
HALF = 0.05  # m, half the size of the solids
SHAPES = {"polygon": 4.0 * HALF**2, "cylinder": np.pi * HALF**2,
          "sphere": 4.0 / 3.0 * np.pi * HALF**3, "mesh": 8.0 * HALF**3}  # fmt: skip


def compare(runs):
    """Force and moment over the displaced water, and particles beyond the plates."""
    result, rows = Comparison(), []
    for name, volume in SHAPES.items():
        if name in runs:
            force, moment = _mean(runs[name], volume)
            result.measure(f"{name}_lift", force[2])
            result.measure(f"{name}_moment", moment[np.abs(moment).argmax()])
            rows.append([name, *force, *moment])
    columns = ["solid", *(f"{what} {axis}" for what in ("force", "moment") for axis in "xyz")]
    title = "Over the weight of the displaced water, moments over half the size"
    result.table(title, columns, rows)
    plates = {name: run for name, run in runs.items() if name.startswith("plate")}
    through = {name: _through(run) for name, run in plates.items()}
    result.table("Water through plates", ["plate", "particles", "until [s]"],
                 [[name, count, runs[name].steps["time"][-1]] for name, count in through.items()])
    result.measure("plate" if "plate-45" in runs else "plates", float(max(through.values())))
    return result


def _mean(run, volume):
    forces = run.table("forces")
    span, late = np.diff(forces["time"], prepend=0.0), forces["time"] > SETTLED
    unit = run.density * run.gravity * volume
    found = [np.average(forces[f"solid {what}{axis}"][late], weights=span[late]) / unit
             for what in "fm" for axis in "xyz"]  # fmt: skip
    return np.array(found[:3]), np.array(found[3:]) / HALF


def _through(run):
    """Particles beyond a plate in the frame that has the most, or lost until then."""
    (plate,) = run.case.solid
    corners = np.array(plate.points)
    below = corners[3] - corners[0]
    thick = np.hypot(*below)
    most = 0
    if run.case.name == "plate_0":
        thick, below, corners = 0.0, np.array([0.0, -1.0]), np.array([[0.0, 0.1]])
    for _, place, _ in run.water():
        off = (place[:, [0, 2]] - corners[0]) @ (below / np.hypot(*below))
        most = max(most, int(np.count_nonzero(off > thick)))
    return most + int(run.steps["lost"][-1])
