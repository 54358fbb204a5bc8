"""Discharge over a crest against EurOtop, and the count against what is missing."""

import numpy as np

from mpslab.analysis import eurotop
from validation.comparison import Comparison
from validation.wave_analysis import separate, travel

PERIODS, INCIDENT = 5, 3  # that the discharge and the incident wave are taken over
SETTLE = 1.5  # periods after the soft start until the wave is steady where it has come
CREST = "crest"
FINE = 0.0025  # m: coarser, the layer on the crest is not resolved


def compare(runs):
    """Discharge, layer and count of each run; the finest is judged."""
    result = Comparison()
    found = {name: _Overtopped(run) for name, run in runs.items()}
    finest = found[min(found, key=lambda name: found[name].run.spacing)]
    wrong = [one.counted - one.missing for one in found.values()]
    result.measure("missing", max(wrong, key=abs))
    result.measure("discharge_coarse", found["d5"].ratio)
    if finest.run.spacing < FINE:
        result.measure("discharge", finest.ratio)
        result.measure("layer", finest.layer)
    columns = ["run", "incident H [mm]", "q [l/s/m]", "EurOtop", "low", "high", "ratio",
               "layer [spacings]", "run-up of 2 spacings [mm]", "counted", "missing"]  # fmt: skip
    result.table("Overtopping", columns, [
        [one.run.label, 1e3 * one.height, 1e3 * one.discharge,
         *(1e3 * number for number in (one.expected.mean, one.expected.low, one.expected.high)),
         one.ratio, one.layer, 1e3 * one.runup, one.counted, one.missing]
        for one in found.values()
    ])  # fmt: skip
    figure = result.figure("Volume that has passed the crest", "time [s]", "volume [l/m]")
    for one in found.values():
        table = one.run.table("overtopping")
        figure.line(one.run.label, table["time"], 1e3 * table[f"{CREST} onwards"])
    start = finest.start
    end = start + PERIODS * finest.period
    figure.points("window", [start, end], [0.0, 0.0])
    if len(found) > 1:
        rows = sorted(found.values(), key=lambda one: -one.run.spacing)
        spacings, errors = zip(*((one.run.spacing, one.ratio - 1.0) for one in rows), strict=True)
        result.converge("Discharge over EurOtop, less one", spacings, errors)
    return result


class _Overtopped:
    """What a run brought over its crest.

    Attributes
    ----------
    discharge : float [m2/s]
    expected : mpslab.analysis.eurotop.Expected
    ratio : float
    layer : float [spacings]
    height, runup : float [m]
        Of the incident waves, and the highest water two spacings thick, above still water.
    counted, missing : int
        Particles that passed, and those that are missing in front.
    """

    def __init__(self, run):
        self.run, maker = run, run.case.wavemaker
        self.period = maker.period
        self.start = maker.start + SETTLE * self.period + travel(run)
        end = self.start + PERIODS * self.period
        table = run.table("overtopping")
        time, passed = table["time"], table[f"{CREST} onwards"]
        volume = np.interp([self.start, end], time, passed)
        self.discharge = (volume[1] - volume[0]) / (end - self.start)
        self.height = self._incident()
        (plane,) = run.case.overtopping
        freeboard = float(run.case.tank.bed_height(plane.x)) - run.depth
        slope = float(run.case.tank.bed[2][1] / (run.case.tank.bed[2][0] - run.case.tank.bed[1][0]))
        self.expected = eurotop.overtopping_of_slope(
            np.sqrt(2.0) * self.height, self.period, slope, freeboard, run.gravity
        )
        self.ratio = self.discharge / self.expected.mean
        steps = np.diff(passed)
        within = (time[1:] > self.start) & (time[1:] <= end)
        layer = table[f"{CREST} layer"][1:][within]
        self.layer = np.sum(layer * steps[within]) / np.sum(steps[within]) / run.spacing
        edge = run.table("runup")
        inside = (edge["time"] > self.start) & (edge["time"] <= end)
        self.runup = np.nanmax(edge["edge level"][inside]) - run.depth
        self._count()

    def _incident(self):
        """Height of the incident waves, twice the first harmonic [m]."""
        run, gauges = self.run, [g for g in self.run.case.gauge if g.name.startswith("G")]
        start = self.start + travel(run) - travel(run, min(gauge.x for gauge in gauges))
        return separate(run, gauges, start, INCIDENT).incident_height

    def _count(self):
        """Particles that the plane had counted by the last frame, and those that lacked there."""
        run, table = self.run, self.run.table("overtopping")
        first, last = run.frames[0], run.frames[-1]
        row = int(np.argmin(np.abs(table["time"] - last.time)))
        lost = run.lost[run.lost["time"] <= last.time]
        strays = np.count_nonzero(~np.char.startswith(lost["reason"], "drained"))
        self.counted = round(table[f"{CREST} onwards"][row] / run.spacing**2)
        self.missing = int(first.fluid.sum()) - int(last.fluid.sum()) - int(strays)
