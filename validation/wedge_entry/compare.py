"""Force and pressure on a wedge driven into water, and the speed of one that falls."""

from pathlib import Path

import numpy as np

from mpslab.core.kinds import WALL
from validation.comparison import Comparison
from validation.data import read_curves

DATA = Path(__file__).parent / "data" / "yettou2006_wedge_entry_velocity.csv"
# Dobrovol'skaya's similarity solution for a deadrise of 30 degrees, as in the table of Zhao &
# Faltinsen (1993): force over rho V^3 t, and largest pressure over rho V^2/2.
FORCE, PEAK = 14.139, 6.927
SPEED = 1.0  # m/s, of the driven wedge
DEPTHS = 0.03, 0.08  # m that its edge is under water, between which it is looked at
BINS = np.arange(0.0, 2.0, 0.1)  # heights over the edge, over its depth
LAST = 0.020  # s after contact, up to which the falling wedge is looked at


def compare(runs):
    """The finest run of each wedge is measured, all are drawn."""
    result = Comparison()
    _compare_falling(result, [run for name, run in runs.items() if name.startswith("falling")])
    _compare_steady(result, [run for name, run in runs.items() if name.startswith("steady")])
    return result


def _compare_falling(result, runs):
    figure = result.figure("Speed of a falling wedge", "time since contact [ms]", "speed [m/s]")
    found = {name: (1e-3 * time, speed) for name, (time, speed) in read_curves(DATA).items()}
    for name, (time, speed) in found.items():
        draw = figure.points if name == "experiment" else figure.dashed
        draw(f"{name} (Yettou et al. 2006)" if name == "experiment" else name, 1e3 * time, speed)
    for run in sorted(runs, key=lambda run: -run.spacing):
        bodies, (given,) = run.table("bodies"), run.case.solid
        edge = min(z for _, z in given.points) + bodies["wedge z"] - bodies["wedge z"][0]
        touch = np.interp(-run.depth, -edge, bodies["time"])
        time, speed = bodies["time"] - touch, -bodies["wedge w"]
        figure.line(run.label, 1e3 * time, speed)
        off = {}
        for name, (at, right) in found.items():
            part = at < LAST
            off[name] = np.abs(np.interp(at[part], time, speed) / right[part] - 1.0).max()
            result.hold(f"{name}, {run.label} [m/s], [s]", time, speed, at[part], right[part])
    result.measure("speed", off["BEM"])
    result.measure("speed_measured", off["experiment"])


def _compare_steady(result, runs):
    force = result.figure("Force on the driven wedge", "depth of its edge [m]", "force [N/m]")
    pressure = result.figure("Pressure on the driven wedge", "height over its edge / its depth",
                             "pressure / (rho V²/2)")  # fmt: skip
    runs, rows = sorted(runs, key=lambda run: -run.spacing), []
    for run in runs:
        depth, push = _force(run)
        seen = (depth > DEPTHS[0]) & (depth < DEPTHS[1])
        share = (push[seen] @ depth[seen]) / (depth[seen] @ depth[seen]) / (run.density * SPEED**2)
        profile = _profile(run)
        rows.append([run.label, share / FORCE, np.nanmax(profile) / PEAK])
        force.line(run.label, depth[depth > 0.0], push[depth > 0.0])
        pressure.line(run.label, 0.5 * (BINS[1:] + BINS[:-1]), profile)
    force.dashed("similarity solution", DEPTHS, FORCE * run.density * SPEED**2 * np.array(DEPTHS))
    pressure.dashed("its largest", BINS[[0, -1]], [PEAK, PEAK])
    result.measure("force", rows[-1][1])
    if len(runs) > 1:
        result.measure("peak", rows[-1][2])  # the quick suite is too coarse for it
    columns = ["run", "force over the similarity solution's", "largest pressure over its"]
    result.table("Driven wedge", columns, rows)
    if len(runs) > 1:
        spacings = [run.spacing for run in runs]
        result.converge("Force", spacings, [row[1] - 1.0 for row in rows])
        result.converge("Largest pressure", spacings, [row[2] - 1.0 for row in rows])


def _depth(run, time):
    """How deep the edge of the driven wedge is under still water [m]."""
    return run.depth - min(z for _, z in run.case.solid[0].points) + SPEED * time


def _force(run):
    """Depth of the edge [m] and force [N/m], (n,) each."""
    forces = run.table("forces")
    return _depth(run, forces["time"]), forces["wedge fz"]


def _profile(run):
    """Mean of all frames of the pressure on the wedge over rho V^2/2, by height, (bins,)."""
    edge, found = min(z for _, z in run.case.solid[0].points), []
    (middle,) = {x for x, z in run.case.solid[0].points if z == edge}
    for frame in run.frames:
        depth = _depth(run, frame.time)
        if not DEPTHS[0] < depth < DEPTHS[1]:
            continue
        x, _, z = frame.position.T
        height = z - (run.depth - depth)
        mine = (frame.kind == WALL) & (np.abs(x - middle) < height / np.tan(np.radians(20.0)))
        found.append((height[mine] / depth, frame.pressure[mine]))
    height, value = np.concatenate(found, axis=1)
    count, _ = np.histogram(height, BINS)
    total, _ = np.histogram(height, BINS, weights=value)
    with np.errstate(invalid="ignore", divide="ignore"):
        return total / count / (0.5 * run.density * SPEED**2)
