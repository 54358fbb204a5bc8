"""Draft, rest, momentum, first acceleration and heave of bodies that the water moves."""

import numpy as np

from validation.comparison import Comparison
from validation.floating import radiation
from validation.swing import first_swing

LAST = 1.0  # seconds of a run on still water that means are taken over
IMAGES = 12  # of a body in bed, walls and surface, that its added mass is summed over
EXTREME = 0.02  # s before and after an extreme of the heave, over which it is fitted
START = 2e-3  # seconds after a body is let go, from which on its speed is looked at


def compare(runs):
    """All bodies that were run; the quick suite has one, afloat."""
    result = Comparison()
    _compare_draft(result, {name: runs[name] for name in ("box", "light") if name in runs})
    result.measure("momentum", _lack(runs["box"]))
    for name, metric in (("cylinder", "start"), ("sphere", "start_sphere")):
        if name in runs:
            result.measure(metric, _start(result, runs[name]))
    heaves = {name: run for name, run in runs.items() if name.startswith("heave")}
    if heaves:
        _compare_heave(result, heaves)
    return result


def _compare_draft(result, runs):
    figure = result.figure("Boxes afloat", "time [s]", "height over theory [spacings]")
    rows = []
    for name, run in runs.items():
        bodies, (given,) = run.table("bodies"), run.case.solid
        corners = np.array(given.points)
        long, high = np.ptp(corners, axis=0)
        # The level falls where the box rises: the water is what it was, around the box as laid out.
        wet = run.depth - corners[:, 1].min()
        draft = high * given.density / run.density
        level = run.depth + long * (draft - wet) / run.case.tank.length
        off = (bodies["box z"] - (level - draft + 0.5 * high)) / run.spacing
        late = bodies["time"] > run.case.time.end - LAST
        mean, rms = off[late].mean(), off[late].std()
        rows.append([name, mean, rms, np.abs(bodies["box roll"][late]).max()])
        figure.line(run.label + f", {given.density:g} kg/m3", bodies["time"], off)
        result.measure("draft" if name == "box" else "draft_light", mean)
        if name == "light":
            result.measure("jitter", rms)
    columns = ["run", "height over theory [d0]", "its rms [d0]", "largest roll [deg]"]
    result.table("Boxes afloat, the last second", columns, rows)


def _lack(run):
    """What the balance of momentum lacks, largest of all rows and axes, over the weight."""
    forces = run.table("forces")
    lacks = [forces[f"box f{axis}"] + forces[f"tank f{axis}"]
             - forces[f"water weight {axis}"] - forces[f"water -dP/dt {axis}"]
             for axis in "xyz"]  # fmt: skip
    return np.abs(lacks).max() / np.abs(forces["water weight z"]).max()


def added(case):
    """Added mass of a cylinder or sphere in its tank over the water that it displaces.

    It and its images in walls, bed and surface are dipoles: those in walls and bed move as what
    they are images of, those in the surface against it.
    """
    (given,), tank = case.solid, case.tank
    count = np.arange(-IMAGES, IMAGES + 1)
    z, sign = _upward(given.center[2], tank.depth, count)
    if given.shape == "cylinder":
        row = np.pi / tank.length
        own = row**2 / 3.0
        others = z != 0.0
        sums = own - np.sum(sign[others] * row**2 / np.sinh(row * z[others]) ** 2)
        share = given.radius**2 * sums
        return (1.0 + share) / (1.0 - share)
    x, y = (side * count for side in (tank.length, tank.width))
    x, y, height = np.meshgrid(x, y, z, indexing="ij")
    square = x**2 + y**2 + height**2
    square[square == 0.0] = np.inf  # the body itself
    sums = np.sum(sign * (square**-1.5 - 3.0 * height**2 * square**-2.5))
    strength = 0.5 / (1.0 - 0.5 * given.radius**3 * sums)
    return 3.0 * strength - 1.0


def _upward(height, depth, count):
    """Offsets in z of the images of a body at a height over the bed, and their signs."""
    turns, odd = np.divmod(count, 2)
    z = np.where(odd == 1, 2.0 * (depth - height), 0.0) + 2.0 * depth * turns
    sign = np.where(turns % 2 == 0, 1.0, -1.0)
    return z, sign


def _start(result, run):
    """Acceleration of a body that is let go, over that of theory."""
    bodies, (given,) = run.table("bodies"), run.case.solid
    time = bodies["time"] - given.release
    part = time > START
    speed = bodies["ball w"]
    slope = np.polyfit(time[part], speed[part], 1)[0]
    own = given.density / run.density
    theory = run.gravity * (1.0 - own) / (own + added(run.case))
    figure = result.figure(f"A {given.shape} let go under water", "time since [s]", "speed [m/s]")
    figure.line(run.label, time[time > 0.0], speed[time > 0.0])
    figure.dashed("theory", [0.0, time[-1]], [0.0, theory * time[-1]])
    return slope / theory


def _compare_heave(result, runs):
    figure = result.figure("Heave of a half-immersed cylinder", "time [s]", "height / first height")
    rows = []
    for name, run in runs.items():
        bodies, (given,) = run.table("bodies"), run.case.solid
        lift = given.center[2] - run.depth
        time, height = bodies["time"], (bodies["cylinder z"] - run.depth) / lift
        outline, mass = radiation.cylinder(given.radius), given.density * np.pi * given.radius**2
        theory = radiation.heave(outline, run.depth, run.gravity, mass, run.density, time)
        seen, right = (first_swing(time, place, EXTREME) for place in (height, theory))
        period = seen.crest_at / right.crest_at
        rows.append([name, period, height.min(), theory.min()])
        figure.line(run.label, time, height)
        result.measure("period", period)
    figure.dashed("linear theory", time, theory)
    columns = ["run", "period over linear theory", "first trough", "that of linear theory"]
    result.table("Heave of a half-immersed cylinder", columns, rows)
