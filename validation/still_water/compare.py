"""Pressure, motion and level of water at rest."""

import numpy as np

from mpslab.core.kinds import FLUID, WALL
from validation.comparison import Comparison

SETTLED = 0.5  # seconds after which means are taken in the box
LAST = 0.9  # share of a run after which its level is compared with the start
FLAT = (0.05, 0.15)  # metres of the paper's tank where the profile is taken
BOXES = ("box-4mm", "box-2.7mm", "box")  # of the recipe `standard` in 2-D, the last is judged
TANKS = ("tank-4mm", "tank-2mm")  # of the recipe `standard`, the finest is judged


def compare(runs):
    """Pressure on the bed, profile, noise, spurious motion and drift."""
    result = Comparison()
    _compare_boxes(result, {n: _Box(r) for n, r in runs.items() if not n.startswith("tank")})
    _compare_tanks(result, {n: _Tank(r) for n, r in runs.items() if n.startswith("tank")})
    return result


def _noise(run, start):
    """Standard deviation of the pressure at each probe from a time [s] on, by its name, in per
    cent of the weight of the water over the bed; NaN if the run ended before.
    """
    found = {}
    for name in (probe.name for probe in run.case.probe):
        time, pressure = run.pressure(name)
        part = pressure[time >= start]
        found[name] = 100.0 * part.std() / _weight(run) if len(part) else np.nan
    return found


def _weight(run):
    """Pressure of the water's weight on the bed [Pa]."""
    return run.density * run.gravity * run.depth


class _Box:
    """A box, frame by frame.

    Attributes
    ----------
    run : validation.run.Run
    time, pressure, speed, height : (n,) float64
        [s], mean on the bed over the water's weight, rms [m/s], mean of the water [m].
    settled : (n,) bool
        Frames that means are taken over.
    noise : dict of str to float
        At the probes [%].
    """

    def __init__(self, run):
        self.run, rows = run, []
        extra = 0.5 * run.density * run.gravity * run.spacing
        for frame in run.frames:
            place, wet = frame["position"], frame["kind"] == FLUID
            bed = (frame["kind"] == WALL) & (place[:, 2] < 0.0) & (place[:, 0] > 0.0)
            bed &= place[:, 0] < run.case.tank.length
            speed = np.sqrt(np.mean(np.sum(frame["velocity"][wet].astype(float) ** 2, axis=1)))
            pressure = (frame["pressure"][bed].mean() - extra) / _weight(run)
            rows.append((frame.time, pressure, speed, place[wet, 2].mean()))
        self.time, self.pressure, self.speed, self.height = np.array(rows).T
        self.settled = self.time >= SETTLED
        self.noise = _noise(run, SETTLED)

    def figures(self):
        """Mean pressure, its deviation [%], that at the worse probe [%], rms speed [mm/s], and
        rise of the level from the start to the last tenth [%]; NaN if the run ended before.
        """
        end = self.run.case.time.end
        last = self.time > LAST * end
        if not last.any():
            return (np.nan,) * 5
        pressure, speed = self.pressure[self.settled], self.speed[self.settled]
        rise = self.height[last].mean() / self.height[0] - 1.0
        return (pressure.mean(), 100.0 * pressure.std(), max(self.noise.values()),
                1e3 * speed.mean(), 100.0 * rise)  # fmt: skip


def _compare_boxes(result, boxes):
    pressure, noise, point, speed, level = boxes["box"].figures()
    result.measure("pressure", pressure)
    result.measure("noise", noise)
    result.measure("noise_point", point)
    result.measure("motion", speed)
    result.measure("level", level)
    if "box-3d" in boxes:
        pressure, _, _, speed, level = boxes["box-3d"].figures()
        result.measure("pressure_3d", pressure)
        result.measure("motion_3d", speed)
        result.measure("level_3d", level)
    _draw_boxes(result, boxes)
    columns = ["run", "p / (rho g h)", "its deviation [%]", "deviation at the worse probe [%]",
               "rms speed [mm/s]", "rise of the level [%]"]  # fmt: skip
    result.table("Boxes, from 0.5 s on; the level from the start to the last tenth", columns,
                 [[name, *box.figures()] for name, box in boxes.items()])  # fmt: skip
    if all(name in boxes for name in BOXES):
        _converge(result, [boxes[name] for name in BOXES])


def _converge(result, boxes):
    """Orders in which the pressure and the motion come to what they must be."""
    spacing, figures = [box.run.spacing for box in boxes], [box.figures() for box in boxes]
    result.converge("Mean pressure on the bed of the box, error [%]", spacing,
                    [100.0 * (pressure - 1.0) for pressure, *_ in figures])  # fmt: skip
    result.converge("Rms speed in the box [mm/s]", spacing, [row[3] for row in figures])
    result.note(
        "Rms speed and error of the pressure in the box differ from seed to seed of the first "
        "displacement by as much as from spacing to spacing: their orders say little."
    )


def _draw_boxes(result, boxes):
    pressure = result.figure("Pressure on the bed of the box", "time [s]", "p / (rho g h)")
    speed = result.figure("Rms speed in the box", "time [s]", "speed [mm/s]")
    for box in boxes.values():
        pressure.line(box.run.label, box.time, box.pressure)
        speed.line(box.run.label, box.time, 1e3 * box.speed)
    pressure.dashed("hydrostatic", [0.0, boxes["box"].time[-1]], [1.0, 1.0])
    run = boxes["box"].run
    probes = result.figure("Pressure at the probes of the box", "time [s]", "p / (rho g h)")
    for probe in run.case.probe:
        time, seen = run.pressure(probe.name)
        probes.line(run.label + f", z = {probe.z / run.depth:g} h", time,
                    seen / _weight(run))  # fmt: skip
        probes.dashed("hydrostatic", [0.0, time[-1]], [1.0 - probe.z / run.depth] * 2)


class _Tank:
    """The paper's tank: what it shows in the second half of the run.

    Attributes
    ----------
    run : validation.run.Run
    z, pressure : (n,) float64
        Mean height [m] and pressure [Pa] of the layers over the flat part.
    error, speed : float
        Rms error of that profile in per cent of the water's weight, and rms speed [mm/s].
    drift : dict of str to float
        Of the level at the gauges [spacings].
    noise : dict of str to float
        At the probes [%].

    NaN where the run ended before.
    """

    def __init__(self, run):
        self.run = run
        self.z, self.pressure, self.speed = _profile(run)
        miss = self.pressure - run.density * run.gravity * (run.depth - self.z)
        self.error = 100.0 * np.sqrt(np.mean(miss**2)) / _weight(run)
        self.drift = {gauge.name: _drift(run, gauge.name) for gauge in run.case.gauge}
        self.noise = _noise(run, 0.5 * run.case.time.end)

    def figures(self):
        """Error, speed, drifts and noises."""
        return self.error, self.speed, *self.drift.values(), *self.noise.values()


def _compare_tanks(result, tanks):
    judged = min((tanks[name] for name in TANKS if name in tanks), key=lambda t: t.run.spacing)
    result.measure("profile", judged.error)
    result.measure("tank_motion", judged.speed)
    result.measure("tank_noise", max(judged.noise.values()))
    result.measure("drift", max(judged.drift.values(), key=abs))
    figure = result.figure("Pressure over the flat part", "p / (rho g h)", "z / h")
    for tank in tanks.values():
        label = f"{tank.run.label}, mean by layers"
        figure.points(label, tank.pressure / _weight(tank.run), tank.z / tank.run.depth)
    figure.dashed("hydrostatic", [1.0, 0.0], [0.0, 1.0])
    columns = ["run", "rms of the profile [%]", "rms speed [mm/s]",
               *(f"drift at {name} [d0]" for name in judged.drift),
               *(f"deviation at {name} [%]" for name in judged.noise)]  # fmt: skip
    result.table("The paper's tank; the profile, the speed and the deviation of the pressure in "
                 "time from the second half of the run", columns,
                 [[name, *tank.figures()] for name, tank in tanks.items()])  # fmt: skip


def _profile(run):
    """Layers z [m], their mean pressure [Pa], and the rms speed [mm/s], second half of the run."""
    end, layers = run.case.time.end, round(run.depth / run.spacing)
    total, count, squares = np.zeros(layers), np.zeros(layers), []
    height = np.zeros(layers)
    for frame in run.frames:
        if frame.time < 0.5 * end:
            continue
        place, wet = frame["position"].astype(float), frame["kind"] == FLUID
        squares.append(np.mean(np.sum(frame["velocity"][wet].astype(float) ** 2, axis=1)))
        wet &= (place[:, 0] > FLAT[0]) & (place[:, 0] < FLAT[1])
        layer = np.clip((place[wet, 2] / run.spacing).astype(int), 0, layers - 1)
        total += np.bincount(layer, frame["pressure"][wet], minlength=layers)
        height += np.bincount(layer, place[wet, 2], minlength=layers)
        count += np.bincount(layer, minlength=layers)
    count[count == 0.0] = np.nan
    speed = 1e3 * np.sqrt(np.mean(squares)) if squares else np.nan
    return height / count, total / count, speed


def _drift(run, gauge):
    """Change of the level at a gauge, first to last tenth of the run [spacings]; NaN if it ended
    before.
    """
    (time, level), end = run.gauge(gauge), run.case.time.end
    first, last = level[time < 0.1 * end], level[time > LAST * end]
    return (last.mean() - first.mean()) / run.spacing if len(last) else np.nan
