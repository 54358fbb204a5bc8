"""Pressure, motion and level of water at rest."""

import numpy as np

from mpslab.particles import FLUID, WALL
from validation.comparison import Comparison

SETTLED = 0.5  # seconds after which means are taken in the box
FLAT = (0.05, 0.15)  # metres of the paper's tank where the profile is taken


def compare(runs):
    """Pressure on the bed, profile, spurious motion and drift."""
    result = Comparison()
    boxes = {name: _Box(run) for name, run in runs.items() if not name.startswith("tank")}
    box = boxes["box"]
    result.measure("pressure", box.pressure.mean())
    result.measure("noise", 100.0 * box.pressure.std())
    result.measure("motion", 1e3 * box.speed.mean())
    result.measure("level", box.rise)
    if "box-3d" in boxes:
        result.measure("pressure_3d", boxes["box-3d"].pressure.mean())
        result.measure("motion_3d", 1e3 * boxes["box-3d"].speed.mean())
        result.measure("level_3d", boxes["box-3d"].rise)
    _draw(result, boxes)
    _compare_tank(result, next(run for name, run in runs.items() if name.startswith("tank")))
    return result


class _Box:
    """Bed pressure over the water's weight, rms speed [m/s] and rise of the level [%] of a box."""

    def __init__(self, run):
        weight = run.density * run.gravity * run.depth
        extra = 0.5 * run.density * run.gravity * run.spacing
        rows = []
        for time, frame in run.frames():
            place, wet = frame["position"], frame["kind"] == FLUID
            bed = (frame["kind"] == WALL) & (place[:, 2] < 0.0) & (place[:, 0] > 0.0)
            bed &= place[:, 0] < run.case["tank"]["length"]
            speed = np.sqrt(np.mean(np.sum(frame["velocity"][wet].astype(float) ** 2, axis=1)))
            pressure = (frame["pressure"][bed].mean() - extra) / weight
            rows.append((time, pressure, speed, place[wet, 2].mean()))
        self.time, self.all_pressure, self.all_speed, height = np.array(rows).T
        settled = self.time >= SETTLED
        self.pressure, self.speed = self.all_pressure[settled], self.all_speed[settled]
        self.rise = 100.0 * (height[settled].mean() / height[0] - 1.0) if settled.any() else np.nan


def _draw(result, boxes):
    pressure = result.figure("Pressure on the bed of the box", "time [s]", "p / (rho g h)")
    speed = result.figure("Rms speed in the box", "time [s]", "speed [mm/s]")
    for name, box in boxes.items():
        label = {"box": "standard", "box-3d": "standard, 3-D"}.get(name, name)
        pressure.line(label, box.time, box.all_pressure)
        speed.line(label, box.time, 1e3 * box.all_speed)
    pressure.dashed("hydrostatic", [0.0, boxes["box"].time[-1]], [1.0, 1.0])
    columns = ["run", "p / (rho g h)", "its deviation [%]", "rms speed [mm/s]", "level [%]"]
    result.table("Boxes, means from 0.5 s on", columns, [
        [name, box.pressure.mean(), 100.0 * box.pressure.std(), 1e3 * box.speed.mean(), box.rise]
        for name, box in boxes.items() if len(box.pressure)
    ])  # fmt: skip


def _compare_tank(result, run):
    weight = run.density * run.gravity * run.depth
    z, pressure, speed = _profile(run)
    exact = run.density * run.gravity * (run.depth - z)
    result.measure("profile", 100.0 * np.sqrt(np.mean((pressure - exact) ** 2)) / weight)
    result.measure("tank_motion", 1e3 * speed)
    drifts = {gauge["name"]: _drift(run, gauge["name"]) for gauge in run.case["gauge"]}
    result.measure("drift", max(drifts.values(), key=abs))
    figure = result.figure("Pressure over the flat part", "p / (rho g h)", "z / h")
    figure.points("standard, mean by layers", pressure / weight, z / run.depth)
    figure.dashed("hydrostatic", exact / weight, z / run.depth)
    result.table("Drift of the level in the paper's tank", ["gauge", "spacings"],
                 [list(item) for item in drifts.items()])  # fmt: skip


def _profile(run):
    """Layers z [m], their mean pressure [Pa], and the rms speed [m/s], second half of the run."""
    end, layers = run.case["time"]["end"], round(run.depth / run.spacing)
    total, count, squares = np.zeros(layers), np.zeros(layers), []
    height = np.zeros(layers)
    for time, frame in run.frames():
        if time < 0.5 * end:
            continue
        place, wet = frame["position"].astype(float), frame["kind"] == FLUID
        squares.append(np.mean(np.sum(frame["velocity"][wet].astype(float) ** 2, axis=1)))
        wet &= (place[:, 0] > FLAT[0]) & (place[:, 0] < FLAT[1])
        layer = np.clip((place[wet, 2] / run.spacing).astype(int), 0, layers - 1)
        total += np.bincount(layer, frame["pressure"][wet], minlength=layers)
        height += np.bincount(layer, place[wet, 2], minlength=layers)
        count += np.bincount(layer, minlength=layers)
    return height / count, total / count, np.sqrt(np.mean(squares))


def _drift(run, gauge):
    """Change of the level at a gauge, first to last tenth of the run [spacings]."""
    time, level = run.gauge(gauge)
    end = time[-1]
    first, last = level[time < 0.1 * end], level[time > 0.9 * end]
    return (last.mean() - first.mean()) / run.spacing
