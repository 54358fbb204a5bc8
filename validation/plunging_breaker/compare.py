"""Breaking, run-up and order of the waves in the tank of the paper."""

import matplotlib
import numpy as np

from mpslab import measures
from mpslab.analysis import scatter
from mpslab.analysis.pictures import STYLE
from mpslab.analysis.snapshots import draw_breaker, middle_slice
from mpslab.core import gauges
from mpslab.core.kinds import FLUID
from mpslab.theory import breaking, waves
from validation.comparison import Comparison
from validation.plunging_breaker.breakers import (
    DEEP_HEIGHT,
    FIRST,
    HEIGHT,
    SECOND,
    SLOPE,
    Waves,
    crests,
    moment,
)
from validation.plunging_breaker.expected import (
    Expected,
    at_equal_similarity,
    by_class,
    by_formulae,
)

LATER = 2.3  # [s]: the water of the first wave has run down
BEFORE = (0.3, 0.8)  # seconds before the first wave breaks
AROUND = 0.025  # [s] to either side of when a crest passes: it moves by 15 to 20 mm
TIP = 10.0  # [spacings] around the crest


def compare(runs):
    """The waves of `standard`, and the recipes beside each other."""
    result = Comparison()
    rows = {name: measures.measure(run) for name, run in runs.items()}
    paper = {n: r for n, r in runs.items() if r.case.wavemaker.height == HEIGHT}
    standard = {n: r for n, r in paper.items() if n.startswith("standard")}
    found = [Waves(name, run) for name, run in standard.items()]
    _measure_waves(result, found[0], thrice="standard-2mm-long" in runs)
    every = [run for name, run in runs.items() if name.startswith("standard")]
    result.measure("volume", max((_growth(run) for run in every), key=abs))
    result.measure("lost", sum(run.steps["lost"][-1] for run in every))
    _tell_waves(result, found)
    _compare_class(result, found)
    _draw_breaking(result, found)
    recipes = _recipes(runs)
    _compare_water(result, recipes, rows)
    _compare_tips(result, recipes)
    _show_particles(result, runs)
    return result


def _measure_waves(result, wave, thrice):
    """Criteria of the waves of one run; of the third wave where the run is long enough."""
    result.measure("height", wave.at_toe / HEIGHT)
    result.measure("first_depth", 1e3 * wave.first.depth)
    result.measure("jet", wave.second.jet)
    for name, breaker in (("second", wave.second), ("third", wave.third))[: 2 if thrice else 1]:
        result.measure(f"{name}_depth", 1e3 * breaker.depth if breaker.overturns else np.nan)
        result.measure(f"{name}_index", breaker.index if breaker.overturns else np.nan)
    if thrice:
        result.measure("runup", wave.runup(since=LATER) / _hunt(wave))


def _hunt(wave):
    """Run-up of a train of waves [m]."""
    return breaking.hunt_runup(DEEP_HEIGHT, wave.period, SLOPE, wave.run.gravity)


def _similarity(wave):
    """Surf similarity of a train of waves."""
    length = waves.deep_wavelength(wave.period, wave.run.gravity)
    return breaking.surf_similarity(SLOPE, DEEP_HEIGHT, length)


def _growth(run):
    """Change of the volume from its mean over the first tenth of the run [%]."""
    time, volume = run.steps["time"], run.steps["volume"]
    return 100.0 * (volume[-1] / volume[time < 0.1 * time[-1]].mean() - 1.0)


def _tell_waves(result, found):
    """Tables of where waves overturn, and of how far they run up."""
    columns = ["run", "wave", "t [s]", "x [m]", "depth [mm]", "height [mm]", "height / depth",
               "surf similarity", "type"]  # fmt: skip
    period, gravity = found[0].period, found[0].run.gravity
    similarity = _similarity(found[0])
    lines = [
        [w.name, label, b.time, b.x, 1e3 * b.depth, 1e3 * b.height, b.index, similarity, b.seen]
        for w in found
        for label, b in {"first": w.first, **w.later}.items()
    ]
    lines += [
        [e.name, "", "", "", 1e3 * e.depth, 1e3 * e.height, e.scaled[0], e.similarity, e.kind]
        for e in by_formulae(period, gravity) + by_class(gravity)
    ]
    result.table("Where waves overturn (class data: another depth and scale)", columns, lines)
    rises = [(w, w.runup()) for w in found]
    result.table("Highest run-up, of all waves", ["run", "run-up [mm]", "over Hunt's"],
                 [[w.name, 1e3 * rise, rise / _hunt(w)] for w, rise in rises])  # fmt: skip


def _compare_class(result, found):
    """The second and the third wave against the class data, without dimensions."""
    measured = by_class(found[0].run.gravity)
    length = waves.deep_wavelength(found[0].period, found[0].run.gravity)
    seen = [
        Expected(f"{w.name}, {label} wave", "", DEEP_HEIGHT, length, b.depth, b.height)
        for w in found
        for label, b in w.later.items()
    ]
    similarity = _similarity(found[0])
    equal = at_equal_similarity(similarity, measured)
    lines = [[e.name, e.similarity, *e.scaled] for e in measured]
    lines.append(["class data at the surf similarity of the paper's wave", similarity, *equal])
    lines += [[e.name, e.similarity, *e.scaled] for e in seen]
    columns = ["wave", "surf similarity", "H_b / h_b", "distance from the shoreline / L_0",
               "H_b / H_0"]  # fmt: skip
    result.table("Breaking without dimensions (subscript 0: in deep water)", columns, lines)
    ours = [e.scaled / equal for e in seen if e.name.startswith(f"{found[0].name},")]
    for k, name in enumerate(("class_index", "class_place")):
        ratios = [ratio[k] for ratio in ours]
        worst = max(ratios, key=lambda ratio: abs(np.log(ratio)), default=np.nan)
        result.measure(name, worst)


def _draw_breaking(result, found):
    for wave in found:
        if not wave.second.overturns:
            continue
        frame = wave.run.frames.at(wave.second.time + 0.025)
        piece = middle_slice(frame.time, frame, wave.run.spacing, wave.run.case.tank.width)
        near = np.abs(piece.x - wave.second.x) < 0.12
        title = f"{wave.name}: the second wave at t = {frame.time:.3f} s"
        figure = result.figure(title, "x [m]", "z [m]", equal=True)
        figure.points("water", piece.x[near & piece.fluid], piece.z[near & piece.fluid])
        x, z = np.array(wave.run.case.tank.bed).T
        bed = np.linspace(wave.second.x - 0.12, wave.second.x + 0.12, 50)
        figure.dashed("bed", bed, np.interp(bed, x, z))


def _recipes(runs):
    """Name and run of each recipe, at one spacing and with the same wave."""
    size = "4mm" if "mps-4mm" in runs else "2mm"
    names = {"mps": f"mps-{size}", "paper": f"paper-{size}",
             "standard": "standard-4mm" if size == "4mm" else "standard-2mm-long"}  # fmt: skip
    return {recipe: (name, runs[name]) for recipe, name in names.items()}


def _compare_water(result, recipes, rows):
    """Scatter of all water, against time."""
    rough = result.figure("Roughness of the velocity", "time [s]", "roughness [m/s]")
    alone = result.figure("Isolated particles", "time [s]", "share of the water [%]")
    before, lines = {}, []
    for recipe, (name, run) in recipes.items():
        time = np.array([row["time [s]"] for row in rows[name]])
        rough_of = np.array([row["roughness [m/s]"] for row in rows[name]])
        share = 100.0 * np.array([row["isolated_share"] for row in rows[name]])
        label = run.label
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
    result.table("Scatter of all water", columns, lines)


def _compare_tips(result, recipes):
    """Scatter around the crest, or the tip of the jet, where the wave of `standard` breaks."""
    _, run = recipes["standard"]
    found, times = crests(run), {"first": FIRST}
    if run.case.wavemaker.height == HEIGHT:
        times["second"] = SECOND
    places = {wave: moment(found, between, run.spacing)[1] for wave, between in times.items()}
    tips = {
        (wave, recipe): _tip(run, places[wave], between)
        for wave, between in times.items()
        for recipe, (_, run) in recipes.items()
    }
    for other in ("paper", "mps"):
        ratios = [tips[wave, "standard"][0] / tips[wave, other][0] for wave in times]
        result.measure(f"tip_{other}", np.max(ratios))
    result.measure("tip_isolated", max(tips[wave, "standard"][1] for wave in times))
    columns = ["run", "wave", "roughness [m/s]", "isolated [%]", "particles", "rms speed [m/s]",
               "crest at t [s]", "x [m]"]  # fmt: skip
    title = f"Scatter within {TIP:g} d0 of where the crest of standard breaks, while crests pass"
    result.table(title, columns, [
        [recipes[recipe][1].label, wave, *tip] for (wave, recipe), tip in tips.items()
    ])  # fmt: skip


def _tip(run, place, between):
    """Means over the frames in which the crest passes a place, of the water around: roughness
    [m/s], isolated [%], number of particles and rms speed [m/s]; and when it passes [s], and the
    place [m].

    Neighbours beyond the circle around the place do not count, for any recipe.
    """
    frames = [frame for frame in run.frames if between[0] < frame.time < between[1]]
    levels = [
        gauges.surface_elevation(frame.position.astype(float), frame.kind, run.spacing, place.x)
        for frame in frames
    ]
    if not np.isfinite(levels).any():
        return [np.nan] * 5 + [place.x]
    when = frames[np.nanargmax(levels)].time
    means = [_scatter(run, frame, place) for frame in frames if abs(frame.time - when) <= AROUND]
    return [*np.mean(means, axis=0), when, place.x]


def _scatter(run, frame, place):
    """Roughness [m/s], isolated share [%], number and rms speed [m/s] of the water near a place."""
    position, velocity = frame["position"].astype(float), frame["velocity"].astype(float)
    way = np.hypot(position[:, 0] - place.x, position[:, 2] - place.z)
    near = (frame["kind"] == FLUID) & (way < TIP * run.spacing)
    rough = scatter.roughness(position[near], velocity[near], run.spacing)
    alone = scatter.isolated_share(position[near], run.spacing)
    speed = np.sqrt(np.mean(np.sum(velocity[near] ** 2, axis=1)))
    return rough, 100.0 * alone, np.count_nonzero(near), speed


def _show_particles(result, runs):
    """Pictures of each run where a wave overturns first, or its front stands upright."""
    for name, run in runs.items():
        with matplotlib.rc_context(STYLE):
            drawn = draw_breaker(run.frames, run.tables)
        if drawn:
            result.picture(f"The particles of {name}", drawn)
