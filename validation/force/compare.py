"""Forces of still water and of a standing wave, and the balance of momentum."""

import numpy as np

from validation.comparison import Comparison

SETTLED = 0.2  # seconds after which means are taken in still water
PERIODS = 2.0  # of the wave that the harmonics are fitted to
HARMONICS = 3


def compare(runs):
    """Hydrostatic force, lift of a box, first harmonic under a wave, and the balance."""
    result = Comparison()
    still = {name: _still(run) for name, run in runs.items() if name.startswith("still")}
    result.measure("hydrostatic", still["still-20"]["walls"])
    columns = ["run", "wall at x = length", "wall at x = 0", "both", "bed, over the weight"]
    result.table("Still water: force over rho g h^2/2", columns,
                 [[name, f["end"], f["start"], f["walls"], f["bed"]]
                  for name, f in still.items()])  # fmt: skip
    lift, sideways = _box(runs["box"])
    result.measure("lift", lift)
    result.measure("sideways", sideways)
    _compare_waves(result, {n: r for n, r in runs.items() if n.startswith("wave")})
    result.measure("balance", max(_residual(run) for run in runs.values()))
    return result


def _mean(run, *names):
    """Means of columns of forces.csv from the time on when the water has settled."""
    forces = run.table("forces")
    span = np.diff(forces["time"], prepend=0.0)
    late = forces["time"] > SETTLED
    return [np.average(forces[name][late], weights=span[late]) for name in names]


def _still(run):
    """Forces on the walls over rho g h^2/2, and that on the bed over the weight."""
    wall, bed, along, down = _mean(run, "wall fx", "bed fx", "tank fx", "bed fz")
    unit = 0.5 * run.density * run.gravity * run.depth**2
    weight = run.density * run.gravity * run.depth * run.case.tank.length
    end, start = wall / unit, -(along - bed - wall) / unit
    return {"end": end, "start": start, "walls": 0.5 * (end + start), "bed": -down / weight}


def _box(run):
    """Lift and sideways force over the weight of the water that the box displaces."""
    (box,) = run.case.obstacle
    weight = run.density * run.gravity
    weight *= (box.end[0] - box.start[0]) * (box.end[2] - box.start[2])
    lift, sideways = _mean(run, "box fz", "box fx")
    return lift / weight, sideways / weight


def _compare_waves(result, waves):
    figure = result.figure("Force on the end wall under a standing wave", "time / period",
                           "(F - rho g h^2/2) / linear amplitude")  # fmt: skip
    rows = []
    for name, run in waves.items():
        wave = _Wave(run)
        first, phase, mean = wave.first()
        rows.append([name, first, phase, mean])
        figure.line(run.label, wave.time / wave.period, wave.force / wave.linear)
        result.measure("harmonic" if name == "wave" else "harmonic_fine", first)
    time = np.linspace(0.0, PERIODS, 200)
    figure.dashed("linear theory", time, -np.sin(2.0 * np.pi * time))
    columns = ["run", "first harmonic over linear theory", "its phase [deg]",
               "mean over rho g h^2/2"]  # fmt: skip
    result.table("Standing wave: force on the end wall", columns, rows)


class _Wave:
    """The force on the end wall under a standing wave of the first mode.

    Attributes
    ----------
    period : float [s]
    linear : float [N/m]
        Amplitude of linear theory, rho g a tanh(kh)/k.
    time, force : (n,) float64
        Middle of each step [s], and the force less that of still water [N/m].
    """

    def __init__(self, run):
        k = np.pi * run.case.initial.mode / run.case.tank.length
        depth, forces = run.depth, run.table("forces")
        self.period = 2.0 * np.pi / np.sqrt(run.gravity * k * np.tanh(k * depth))
        weight = run.density * run.gravity
        self.linear = weight * run.case.initial.amplitude * np.tanh(k * depth) / k
        self.still = 0.5 * weight * depth**2
        span = np.diff(forces["time"], prepend=0.0)
        self.time = forces["time"] - 0.5 * span
        part = self.time <= PERIODS * self.period
        self.time, self.span = self.time[part], span[part]
        self.force = forces["wall fx"][part] - self.still

    def first(self):
        """First harmonic over linear theory, its phase [deg], and the mean over still water."""
        angle = 2.0 * np.pi * self.time / self.period
        terms = [np.ones(len(angle))]
        for m in range(1, HARMONICS + 1):
            terms += [np.cos(m * angle), np.sin(m * angle)]
        root = np.sqrt(self.span)
        found = np.linalg.lstsq(np.array(terms).T * root[:, None], self.force * root, rcond=None)[0]
        mean, cosine, sine = found[:3]
        phase = np.degrees(np.arctan2(-cosine, -sine))
        return np.hypot(cosine, sine) / self.linear, phase, 1.0 + mean / self.still


def _residual(run):
    """What the balance of momentum lacks, largest of all rows and axes, over the weight."""
    forces = run.table("forces")
    lacks = [forces[f"water on solids {axis}"] - forces[f"water weight {axis}"]
             - forces[f"water -dP/dt {axis}"] for axis in "xyz"]  # fmt: skip
    return np.abs(lacks).max() / np.abs(forces["water weight z"]).max()
