"""Breaking, run-up and order of the waves in the tank of the paper."""

import csv
from pathlib import Path

import matplotlib
import numpy as np

from mpslab import breaking, gauges, measures
from mpslab.overturning import JET
from mpslab.pictures import STYLE
from mpslab.snapshots import draw_breaker, middle_slice
from validation.comparison import Comparison
from validation.data import foremost

DATA = Path(__file__).parent / "data" / "cornell_lab_slope1to10_breakers.csv"
HEIGHT, DEEP_HEIGHT = 0.0196, 0.0186  # [m] of the paper, and unshoaled
SLOPE, TOE, BEACH = 0.1, 0.2, 0.55  # [-], [m], [m]: water beyond runs up
SECOND, THIRD = (1.2, 1.75), (1.9, 2.6)  # seconds in which these waves break
LATER = 2.3  # [s]: the water of the first wave has run down
BEFORE = (0.3, 0.8)  # seconds before the first wave breaks
COMPANY = 1  # others within two spacings: the tip of a row has one or two, spray has none


def compare(runs):
    """The waves of `standard`, and the recipes beside each other."""
    result = Comparison()
    rows = {name: measures.measure(run.folder) for name, run in runs.items()}
    paper = {n: r for n, r in runs.items() if r.case["wavemaker"]["height"] == HEIGHT}
    standard = {n: r for n, r in paper.items() if n.startswith("standard")}
    waves = [_Waves(name, run, rows[name]) for name, run in standard.items()]
    first = waves[0]
    result.measure("height", first.at_toe / HEIGHT)
    result.measure("second_depth", 1e3 * first.second.depth)
    result.measure("second_index", first.second.index)
    if "standard-2mm-long" in runs:
        result.measure("third_depth", 1e3 * first.third.depth)
        result.measure("runup", first.runup(since=LATER) / _hunt(first))
    every = [run for name, run in runs.items() if name.startswith("standard")]
    result.measure("volume", max((_growth(run) for run in every), key=abs))
    result.measure("lost", sum(run.steps["lost"][-1] for run in every))
    _tell_waves(result, waves)
    _draw_breaking(result, waves)
    _compare_recipes(result, runs, rows)
    _show_particles(result, runs)
    return result


class _Breaker:
    """Where and how high a wave is when it overturns; all NaN if it does not."""

    def __init__(self, run, rows, between):
        jets = [
            row for row in rows if row["jet"] >= JET and between[0] < row["time [s]"] < between[1]
        ]
        self.time = self.x = self.depth = self.height = np.nan
        if jets:
            self.time, self.x = jets[0]["time [s]"], jets[0]["crest_x [m]"]
            self.depth = run.depth - SLOPE * max(self.x - TOE, 0.0)
            self.height = _range(run, self.x, self.time)

    @property
    def index(self):
        """Height over depth."""
        return self.height / self.depth


def _range(run, x, time):
    """Range of the level at a place over the period before a time [m]."""
    period, levels = run.case["wavemaker"]["period"], []
    for moment, frame in run.frames():
        if time - period < moment <= time:
            place = frame["position"].astype(float)
            levels.append(gauges.surface_elevation(
                place, frame["kind"], run.spacing, x, 0.5 * run.case["tank"]["width"],
                run.case["tank"]["width"],
            ))  # fmt: skip
    return np.nanmax(levels) - np.nanmin(levels)


class _Waves:
    """What the waves of a run do."""

    def __init__(self, name, run, rows):
        self.name, self.run = name, run
        self.period = run.case["wavemaker"]["period"]
        time, level = run.gauge("toe")
        crest = np.argmax(np.where(time < self.period, level, -np.inf))
        trough = level[crest:][time[crest:] < time[crest] + self.period].min()
        self.at_toe = level[crest] - trough
        self.second = _Breaker(run, rows, SECOND)
        self.third = _Breaker(run, rows, THIRD)

    def runup(self, since=0.0):
        """Highest place that water with others around it reached on the slope after a time [m]."""
        x = max(
            foremost(position[position[:, 0] > BEACH], self.run.spacing, COMPANY)
            for time, position, _ in self.run.water()
            if time >= since
        )
        return SLOPE * (x - TOE) - self.run.depth


def _hunt(wave):
    """Run-up of a train of waves [m]."""
    return breaking.hunt_runup(DEEP_HEIGHT, wave.period, SLOPE, wave.run.gravity)


def _growth(run):
    """Change of the volume from its mean over the first tenth of the run [%]."""
    time, volume = run.steps["time [s]"], run.steps["volume [m3]"]
    return 100.0 * (volume[-1] / volume[time < 0.1 * time[-1]].mean() - 1.0)


def _tell_waves(result, waves):
    columns = ["run", "wave", "t [s]", "x [m]", "depth [mm]", "height [mm]", "height / depth"]
    lines = [
        [w.name, label, b.time, b.x, 1e3 * b.depth, 1e3 * b.height, b.index]
        for w in waves
        for label, b in (("second", w.second), ("third", w.third))
        if np.isfinite(b.time)
    ]
    rises = [(w, w.runup()) for w in waves]
    result.table("Highest run-up, of all waves", ["run", "run-up [mm]", "over Hunt's"],
                 [[w.name, 1e3 * rise, rise / _hunt(w)] for w, rise in rises])  # fmt: skip
    period, gravity = waves[0].period, waves[0].run.gravity
    depth, height = breaking.breaking_point(DEEP_HEIGHT, period, SLOPE, gravity)
    lines.append(["Goda 2010", "regular", "", "", 1e3 * depth, 1e3 * height, height / depth])
    with DATA.open() as file:
        for row in csv.DictReader(file):
            lines.append([f"class data {row['case']}", row["observed breaker type"], "", "",
                          1e3 * float(row["h_b [m]"]), 1e3 * float(row["H_b [m]"]),
                          float(row["H_b/h_b [-]"])])  # fmt: skip
    result.table("Where waves overturn (class data: another depth and scale)", columns, lines)


def _draw_breaking(result, waves):
    for wave in waves:
        if not np.isfinite(wave.second.time):
            continue
        time, frame = wave.run.frame_at(wave.second.time + 0.025)
        piece = middle_slice(time, frame, wave.run.spacing, wave.run.case["tank"]["width"])
        near = np.abs(piece.x - wave.second.x) < 0.12
        title = f"{wave.name}: the second wave at t = {time:.3f} s"
        figure = result.figure(title, "x [m]", "z [m]", equal=True)
        figure.points("water", piece.x[near & piece.fluid], piece.z[near & piece.fluid])
        x, z = np.array(wave.run.case["tank"]["bed"]).T
        bed = np.linspace(wave.second.x - 0.12, wave.second.x + 0.12, 50)
        figure.dashed("bed", bed, np.interp(bed, x, z))


def _compare_recipes(result, runs, rows):
    """Scatter of the three recipes at one spacing, with the same wave."""
    size = "4mm" if "mps-4mm" in runs else "2mm"
    names = {"mps": f"mps-{size}", "paper": f"paper-{size}",
             "standard": "standard-4mm" if size == "4mm" else "standard-2mm-long"}  # fmt: skip
    rough = result.figure("Roughness of the velocity", "time [s]", "roughness [m/s]")
    alone = result.figure("Isolated particles", "time [s]", "share of the water [%]")
    before, lines = {}, []
    for recipe, name in names.items():
        time = np.array([row["time [s]"] for row in rows[name]])
        rough_of = np.array([row["roughness [m/s]"] for row in rows[name]])
        share = 100.0 * np.array([row["isolated_share"] for row in rows[name]])
        label = f"{recipe}, d0 = {1e3 * runs[name].spacing:.3g} mm"
        rough.line(label, time, rough_of)
        alone.line(label, time, share)
        part = (time >= BEFORE[0]) & (time <= BEFORE[1])
        late = time > BEFORE[1]
        before[recipe] = rough_of[part].mean()
        lines.append([label, before[recipe], rough_of[late].mean(), share[late].mean(),
                      max(row["jet"] for row in rows[name])])  # fmt: skip
    result.measure("smoother", before["standard"] / before["mps"])
    result.measure("cmps", before["paper"] / before["mps"])
    columns = ["run", "roughness before breaking [m/s]", "after [m/s]", "isolated after [%]",
               "most particles over air"]  # fmt: skip
    result.table("Scatter", columns, lines)


def _show_particles(result, runs):
    """Pictures of each run where a wave overturns first, or is steep and fast."""
    for name, run in runs.items():
        with matplotlib.rc_context(STYLE):
            drawn = draw_breaker(run.folder / "particles.vtkhdf", run.case)
        if drawn:
            result.picture(f"The particles of {name}", drawn)
