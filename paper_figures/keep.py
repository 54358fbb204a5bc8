"""What is kept of a run: its case and record, its steps, measures, and the water near the wave."""

import csv
import json
import shutil

import numpy as np

from mpslab import load_case
from mpslab.core.kinds import FLUID
from mpslab.output import vtkhdf
from mpslab.output.tables import read_table
from mpslab.parallel import balance
from mpslab.parallel.rebalance import load
from mpslab.run.flow import slabs_of
from mpslab.solids.piston import make_paddle
from paper_figures.measures import measure

TIMES = (1.0, 1.04, 1.09, 1.12, 1.16, 1.2)  # [s] of the snapshots, where the wave is not late
CUTS = (0.0, 0.88, 1.12)  # [s] of figure 4
SPEED = 0.6  # [m/s] of the wave: so much farther a late one breaks
RANKS = 8  # of figure 4
METHODS = ("static", "centroid", "optimal")
WINDOW = (0.22, 0.50)  # [m] along the tank, of the snapshots: where a wave breaks that is not late
FIRST = 0.57  # share of the run, 0.8 s, from which measures are taken: the first crest is steep
STEPS = {"step": "{:.0f}", "time [s]": "{:.6f}", "iterations": "{:.0f}", "seconds": "{:.4f}"}
RECORD = ("versions", "machine", "commit", "started", "ended", "wall_time [s]", "resumed",
          "particles")  # fmt: skip
LEVELS = 65535  # of a coordinate in a snapshot
MILLIMETRE = 1e-3  # velocities are kept in mm/s


def keep(folder, target, run):
    """Write the small files of a finished run.

    Parameters
    ----------
    folder : Path
        The run.
    target : Path
        Folder of the small files: ``case.toml``, ``run.json``, ``steps.csv``, ``series.csv``
        and ``water.npz`` (see `paper_figures.kept`).
    run : paper_figures.runs.Run
    """
    target.mkdir(parents=True, exist_ok=True)
    shutil.copy(folder / "case.toml", target)
    keep_record(folder, target, ranks=run.ranks, late=run.late)
    _keep_steps(folder, target)
    _keep_water(folder, target, run.late)


def keep_record(folder, target, **more):
    """Write ``run.json``: what is kept of the record of a run, and more."""
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    record = more | {name: record[name] for name in RECORD}
    (target / "run.json").write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def _keep_steps(folder, target):
    steps = read_table(folder / "steps.csv")
    rows = zip(*(map(form.format, steps[name]) for name, form in STEPS.items()), strict=True)
    write_table(target / "steps.csv", STEPS, rows)


def write_table(path, header, rows):
    """Write rows of texts as CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)


def _keep_water(folder, target, late):
    """Measures of the frames, snapshots of some, and who would own what in three."""
    case = load_case(folder / "case.toml")
    slabs = slabs_of(case, make_paddle(case))
    spacing, width = case.particles.spacing, case.tank.width
    path = folder / "particles.vtkhdf"
    frames = vtkhdf.read_times(path)
    near, tank = _nearest(frames, TIMES, late), _nearest(frames, CUTS)
    rows, arrays = [], {}
    for index, (time, frame) in enumerate(vtkhdf.read_frames(path)):
        wet = frame["kind"] == FLUID
        place, velocity = frame["position"][wet].astype(float), frame["velocity"][wet].astype(float)
        if time > FIRST * case.time.end:
            rows.append(measure(time, place, velocity, spacing, width, case.tank.bed))
        for name in near[index]:
            along = place[:, 0] - SPEED * late
            seen = (along > WINDOW[0]) & (along < WINDOW[1])
            _pack(arrays, f"near {name}", time, place[seen], velocity[seen, 0])
        for name in tank[index]:
            middle = np.abs(place[:, 1] - 0.5 * width + 0.25 * spacing) < 0.5 * spacing
            _pack(arrays, f"tank {name}", time, place[middle], velocity[middle, 0])
            arrays |= _cuts(name, frame, slabs)
    texts = [[f"{value:.6g}" for value in row.values()] for row in rows]
    write_table(target / "series.csv", rows[0], texts)
    np.savez_compressed(target / "water.npz", **arrays)


def _nearest(frames, times, late=0.0):
    """Which of the times [s], as texts, each frame is next to, all so much later [s].

    A frame is taken after the step that reaches its time.
    """
    near = [[] for _ in frames]
    for time in times:
        near[np.argmin(np.abs(frames - time - late))].append(f"{time:.2f}")
    return near


def _pack(arrays, name, time, position, u):
    """Positions as whole numbers between their least and largest, u in whole mm/s."""
    low, high = position.min(axis=0), position.max(axis=0)
    extent = np.where(high > low, high - low, 1.0)
    whole = np.round((position - low) / extent * LEVELS).astype(np.uint16)
    # Along x one after the other: so the file is smaller.
    order = np.argsort(whole[:, 0], kind="stable")
    arrays[f"{name} time"] = np.array(time)
    arrays[f"{name} box"] = np.array([low, high])
    arrays[f"{name} position"] = whole[order].T.copy()
    arrays[f"{name} u"] = np.round(u[order] / MILLIMETRE).astype(np.int16)


def _cuts(time, frame, slabs):
    """Where each method cuts the tank [m], and the share of particles and work of each rank."""
    wet, slab = frame["kind"] == FLUID, slabs.of(frame["position"][:, 0])
    count, work = (load(by, wet, slab, slabs.count) for by in ("centroid", "optimal"))
    found = {}
    for method in METHODS:
        cuts = balance.cut(method, count if method == "centroid" else work, RANKS)
        found[f"cuts {time} {method}"] = slabs.lower + slabs.width * cuts
        for what, of in (("share", count), ("work", work)):
            found[f"{what} {time} {method}"] = np.add.reduceat(of, cuts[:-1]) / of.sum()
    return found
