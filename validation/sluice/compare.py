"""Contraction and discharge of the jet under a gate, and the force on the gate."""

import numpy as np

from validation.comparison import Comparison

# Contraction of the jet under a sharp upright gate by opening over head (Henderson 1966).
OPENING, CONTRACTION = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5), (0.611, 0.606, 0.602, 0.600, 0.598, 0.598)
STEADY = 0.9, 1.4  # s


def compare(runs):
    """The finest run is judged."""
    result = Comparison()
    jets = [_Jet(run) for run in sorted(runs.values(), key=lambda run: -run.spacing)]
    finest = jets[-1]
    result.measure("jet", finest.thickness / finest.thin)
    result.measure("discharge", finest.discharge / finest.rate)
    result.measure("force", finest.force / finest.push)
    levels = result.figure("Levels", "time [s]", "level [m]")
    volume = result.figure("Volume that has run out", "time [s]", "volume [m3/m]")
    for jet in jets:
        gauges, passed = jet.run.table("gauges"), jet.run.table("overtopping")
        levels.line(f"reservoir, {jet.run.label}", gauges["time"], gauges["reservoir"])
        levels.line(f"jet, {jet.run.label}", gauges["time"], gauges["jet"])
        volume.line(jet.run.label, passed["time"], passed["outflow onwards"])
    levels.dashed("jet, potential flow", STEADY, [finest.thin] * 2)
    start = np.interp(STEADY[0], passed["time"], passed["outflow onwards"])
    volume.dashed("potential flow", STEADY, start + finest.rate * np.subtract(STEADY, STEADY[0]))
    columns = ["run", "reservoir [m]", "jet [m]", "by theory", "discharge [m2/s]", "by theory",
               "force [N/m]", "by theory"]  # fmt: skip
    result.table("Means of the steady flow", columns, [
        [jet.run.label, jet.depth, jet.thickness, jet.thin, jet.discharge, jet.rate, jet.force,
         jet.push] for jet in jets
    ])  # fmt: skip
    return result


class _Jet:
    """Means of a run while its flow is steady, and what theory makes of the reservoir's depth."""

    def __init__(self, run):
        (gate,), gravity, self.run = run.case.gate, run.gravity, run
        self.depth, self.thickness = _mean(run, "gauges", "reservoir"), _mean(run, "gauges", "jet")
        self.force = _mean(run, "forces", "gate fx")
        passed = run.table("overtopping")
        steady = _steady(passed["time"])
        line = np.polyfit(passed["time"][steady], passed["outflow onwards"][steady], 1)
        self.discharge, head = line[0], self.depth
        for _ in range(20):
            self.thin = gate.lift * np.interp(gate.lift / head, OPENING, CONTRACTION)
            drop = 2.0 * gravity * (self.depth - self.thin)
            self.rate = np.sqrt(drop / (self.thin**-2 - self.depth**-2))
            head = self.depth + 0.5 * (self.rate / self.depth) ** 2 / gravity
        still = 0.5 * gravity * (self.depth**2 - self.thin**2)
        turned = self.rate**2 * (1.0 / self.thin - 1.0 / self.depth)
        self.push = run.density * (still - turned)


def _steady(time):
    return (time > STEADY[0]) & (time < STEADY[1])


def _mean(run, table, column):
    found = run.table(table)
    return float(np.nanmean(found[column][_steady(found["time"])]))
