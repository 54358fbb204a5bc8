"""Two impacts of a wave on the wall of a tank that rolls, against a record of SPHERIC test 10."""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import cumulative_trapezoid

from mpslab.analysis.pictures import STYLE
from mpslab.forcings.frame import make
from validation.comparison import Comparison
from validation.data import read_columns

DATA = Path(__file__).parent / "data"
JUDGED = "3mm"
PERIOD = 1.63  # [s] of the roll
SENSOR = "sensor 1"
HITS = {"first": 2.374, "second": 4.048}  # [s] when the water hits in the record
SOONEST = 0.5  # seconds before this, from when on the water may hit in a run
HIT = 500.0  # [Pa] a pressure that says the water has come
MEAN = 1e-3  # seconds over which a sensor's pressure is averaged for its peak
BLOW, RUN_UP = 0.1, 0.45  # seconds from the hit on
GENTLE = (0.3, 1.35)  # [s] the first rise, without an impact
BIN = 5e-3  # [s] of the record
ABOUT = 0.1  # seconds before and after a hit, between which energy is looked at
SPEED = 1.5  # [m/s] the brightest in the picture


def compare(runs):
    """Times, peaks and impulses of the two impacts, the rise before them, and energy."""
    result, record = Comparison(), Record()
    figures = {name: _figure(result, record, name) for name in (*HITS, "rise")}
    rows = [record.row()]
    for name, run in runs.items():
        found = Sensor(run)
        energy = [gain(run, found.hits[hit]) for hit in HITS]
        for part, figure in figures.items():
            figure.line(run.label, *found.part(part))
        rows.append([run.label, *found.row(), *energy])
        if name == JUDGED:
            _measure(result, record, found, energy)
            _hold(result, record, found)
            if np.isfinite(found.hits["first"]):
                result.picture("The first impact", _picture(run, found.hits["first"]))
    columns = ["run", "impact 1 [s]", "peak [kPa]", "0.1 s [Pa s]", "0.45 s [Pa s]", "impact 2 [s]",
               "peak [kPa]", "0.1 s [Pa s]", "rise before [Pa s]", "energy gained, impact 1",
               "impact 2"]  # fmt: skip
    result.table("Pressure at sensor 1: peaks (means over 1 ms) and impulses", columns, rows)
    return result


class Record:
    """The record of sensor 1: least and largest pressure in each bin of 5 ms, and their middle."""

    def __init__(self):
        columns = read_columns(DATA / "pressure_sensor1.csv")
        self.time, self.least, self.most = columns.values()
        self.middle = 0.5 * (self.least + self.most)

    def part(self, start, end):
        """Middle of the bins [s] that begin in a time, and in them the pressures, (3, n) [Pa]."""
        part = (self.time > start - 0.5 * BIN) & (self.time < end - 0.5 * BIN)
        pressures = np.stack([self.least, self.middle, self.most])
        return self.time[part] + 0.5 * BIN, pressures[:, part]

    def impulse(self, start, lasting):
        """Integral of the middles over bins without a gap [Pa s]."""
        return BIN * self.part(start, start + lasting)[1][1].sum()

    def rise(self):
        """Integral over the first rise [Pa s]; the bins are 0.05 s apart."""
        time, pressures = self.part(*GENTLE)
        return np.trapezoid(pressures[1], time)

    def row(self):
        """As that of a run, for the table."""
        peaks = [1e-3 * self.part(t - BIN, t + BLOW)[1].max() for t in HITS.values()]
        first, second = HITS.values()
        return ["record (peaks unsmoothed)", first, peaks[0], self.impulse(first, BLOW),
                self.impulse(first, RUN_UP), second, peaks[1], self.impulse(second, BLOW),
                self.rise(), np.nan, np.nan]  # fmt: skip


class Sensor:
    """What the sensor of a run reads, and when the water hits it."""

    def __init__(self, run):
        time, pressure = run.pressure(SENSOR)
        self.time, self.pressure = time, np.nan_to_num(pressure)
        self.sum = cumulative_trapezoid(self.pressure, time, initial=0.0)
        self.hits = {name: self._hit(at - SOONEST) for name, at in HITS.items()}

    def _impulse(self, start, end):
        return np.interp(end, self.time, self.sum) - np.interp(start, self.time, self.sum)

    def mean(self, time):
        """Pressure at times (n,) [s], mean over 1 ms [Pa]."""
        return self._impulse(time - 0.5 * MEAN, time + 0.5 * MEAN) / MEAN

    def _hit(self, start):
        time = np.arange(start, self.time[-1], 0.1 * MEAN)
        came = np.flatnonzero(self.mean(time) > HIT)
        return time[came[0]] if len(came) else np.nan

    def impulse(self, name, lasting):
        """Integral from a hit on [Pa s]; NaN where the run ends before."""
        start = self.hits[name]
        return self._impulse(start, start + lasting) if start + lasting <= self.time[-1] else np.nan

    def rise(self):
        """Integral over the first rise [Pa s]."""
        return self._impulse(*GENTLE)

    def peak(self, name):
        """Largest mean over 1 ms within 0.1 s of a hit [kPa]."""
        if np.isnan(self.hits[name]):
            return np.nan
        return 1e-3 * self.mean(self.hits[name] + np.arange(-MEAN, BLOW, 0.1 * MEAN)).max()

    def part(self, name):
        """Time from the hit, or in the rise, [s] and pressure [Pa], for a figure."""
        if name == "rise":
            time = np.arange(0.2, 1.5, 5e-3)
            return time, self.mean(time)
        time = np.arange(-0.01, RUN_UP if name == "first" else BLOW, MEAN)
        return time, self.mean(self.hits[name] + time)

    def row(self):
        """Times, peaks and impulses, for the table."""
        return [self.hits["first"], self.peak("first"), self.impulse("first", BLOW),
                self.impulse("first", RUN_UP), self.hits["second"], self.peak("second"),
                self.impulse("second", BLOW), self.rise()]  # fmt: skip


def _measure(result, record, found, energy):
    for name, at in HITS.items():
        result.measure(f"{name}_time", (found.hits[name] - at) / PERIOD)
        result.measure(f"{name}_peak", found.peak(name))
        result.measure(f"{name}_blow", found.impulse(name, BLOW) / record.impulse(at, BLOW))
    first = record.impulse(HITS["first"], RUN_UP)
    result.measure("run_up", found.impulse("first", RUN_UP) / first)
    result.measure("rise", found.rise() / record.rise())
    result.measure("energy", np.max(energy))


def _hold(result, record, found):
    time, pressures = record.part(*GENTLE)
    result.hold("pressure at sensor 1, first rise [Pa], [s]", found.time, found.pressure, time,
                pressures[1])  # fmt: skip
    at = HITS["first"]
    time, pressures = record.part(at + 0.02, at + RUN_UP)
    label = "pressure at sensor 1, 0.02 to 0.45 s from the first impact, aligned [Pa], [s]"
    result.hold(label, found.time - found.hits["first"], found.pressure, time - at, pressures[1])


def gain(run, hit):
    """Kinetic energy from nowhere about a hit, over what there was: gained, less what forces did.

    Forces are gravity and the inertia in the frame of the tank; its walls do no work.
    """
    inertia, rows = make(run.case), []
    for time, place, velocity in run.water():
        if abs(time - hit) <= ABOUT:
            force = inertia(place, velocity, time) - [0.0, 0.0, run.gravity]
            rows.append((time, (force * velocity).sum(), 0.5 * (velocity**2).sum()))
    if len(rows) < 2:
        return np.nan
    time, power, energy = np.array(rows).T
    return (energy[-1] - energy[0] - np.trapezoid(power, time)) / energy[0]


def _figure(result, record, name):
    if name == "rise":
        figure = result.figure("Sensor 1, first rise", "time [s]", "pressure [Pa]")
        time, pressures = record.part(*GENTLE)
        figure.points("record", time, pressures[1])
        return figure
    title = f"Sensor 1, {name} impact, means over 1 ms, impacts aligned"
    figure, at = result.figure(title, "time from the impact [s]", "pressure [Pa]"), HITS[name]
    time, pressures = record.part(at - 2 * BIN, at + (RUN_UP if name == "first" else BLOW))
    figure.band("record, least to largest in 5 ms", time - at, pressures[0], pressures[2])
    return figure


def _picture(run, hit):
    """Water by its speed, in three frames about a hit."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(9.0, 8.0))
        axes = figure.subplots(3, 1, sharex=True)
        for axis, time in zip(axes, hit + np.array([-0.1, 0.02, 0.14]), strict=True):
            frame = run.frames.at(time)
            place, speed = frame.position[frame.fluid], frame.velocity[frame.fluid]
            axis.scatter(place[:, 0], place[:, 2], 2.0, np.linalg.norm(speed, axis=1), vmin=0.0,
                         vmax=SPEED, linewidths=0.0)  # fmt: skip
            axis.set(aspect="equal", xlim=(0.0, run.case.tank.length), ylim=(0.0, 0.25),
                     ylabel="z [m]", title=f"t = {frame.time:.2f} s")  # fmt: skip
        axes[-1].set_xlabel("x [m]; colour: speed, 0 to 1.5 m/s")
    return figure
