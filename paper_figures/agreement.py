"""What agrees with the paper and what does not: ``agreement.json``.

The bands were set before the runs were made.
"""

import json
from dataclasses import asdict, dataclass

import numpy as np

from mpslab.analysis.overturning import JET
from paper_figures.fig_5 import smooth
from paper_figures.keep import RANKS
from paper_figures.table_1 import each, total

TIP = (0.95, 1.10)  # [s]: from the first steep crest to the touch-down
AFTER = 1.12  # [s]: after the touch-down
COLUMN = 2.0  # [spacings] width of the columns whose tops are compared


@dataclass(frozen=True)
class Verdict:
    """One claim of the paper, judged.

    Attributes
    ----------
    claim, paper, ours : str
        What the paper says, its number or words, and what the runs here give.
    agrees : bool
    note : str
        By which measure and band it is judged, and what else is known.
    """

    claim: str
    paper: str
    ours: str
    agrees: bool
    note: str


CLAIMS = []


def claim(*runs, until=0.0):
    """Register a claim that is judged from these runs, which must reach a time [s].

    The function takes what is kept of the runs and returns a Verdict.
    """
    return lambda judge: CLAIMS.append((runs, until, judge)) or judge


def verdicts(found):
    """The verdicts on all claims whose runs are there, and long enough."""
    return [
        judge(*(found[name] for name in runs))
        for runs, until, judge in CLAIMS
        if all(name in found and found[name].end >= until for name in runs)
    ]


def write(found, out):
    """Write ``agreement.json`` into a folder; returns its path."""
    path = out / "agreement.json"
    rows = [asdict(one) | {"agrees": bool(one.agrees)} for one in verdicts(found)]
    path.write_text(json.dumps(rows, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return path


def _between(run, column, start, end):
    time = run.series["time [s]"]
    return run.series[column][(time >= start) & (time <= end)]


@claim("mps", "scg", "standard")
def tip(mps, cmps, standard):
    """Scatter at the tip of the jet."""
    rough = [
        float(np.mean(_between(run, "roughness at the tip [-]", *TIP)))
        for run in (mps, cmps, standard)
    ]
    return Verdict(
        "CMPS scatters less than MPS at the tip of the jet",
        "seen in figure 1",
        "roughness over speed: MPS {:.2f}, CMPS {:.2f}, standard {:.2f}".format(*rough),
        rough[1] < 0.9 * rough[0],
        "rms of u less its mean over the neighbours, over the rms speed, within 10 spacings of the "
        f"tip, mean from {TIP[0]} to {TIP[1]} s; agrees below 0.9 of MPS",
    )


@claim("mps", "scg", "standard")
def jet(mps, cmps, standard):
    """Whether a jet overturns."""
    found = [int(run.series["jet"].max()) for run in (mps, cmps, standard)]
    return Verdict(
        "the wave plunges: a jet overturns",
        "figures 1 to 3",
        "particles that hang over air: MPS {}, CMPS {}, standard {}".format(*found),
        found[1] >= JET,
        f"median over the layers across the tank, most at any time; agrees from {JET} on",
    )


@claim("mps", "scg", "standard")
def chamber(mps, cmps, standard):
    """The air that the jet encloses."""
    air = [1e6 * run.series["air [m2]"].max() for run in (mps, cmps, standard)]
    least = 10.0 * (1e3 * cmps.spacing) ** 2
    return Verdict(
        "CMPS shows the air chamber more clearly than MPS",
        "seen in figure 2",
        "air enclosed, mm2: MPS {:.0f}, CMPS {:.0f}, standard {:.0f}".format(*air),
        air[1] > max(1.1 * air[0], least),
        "largest area of air enclosed in a slice, mean over the layers; agrees above 1.1 of MPS "
        "and ten particles",
    )


@claim("scg", "standard")
def second_jet(cmps, standard):
    """The secondary jet."""
    height = 1e3 * cmps.case["wavemaker"]["height"]
    splash = [1e3 * _between(run, "splash [m]", AFTER, 1.25).max() for run in (cmps, standard)]
    return Verdict(
        "after the touch-down a secondary jet goes up",
        "seen in figure 2",
        "highest water ahead of the crest, mm: CMPS {:.1f}, standard {:.1f}".format(*splash),
        splash[0] > 0.25 * height,
        f"above still water, from {AFTER} s on; agrees above a quarter of the wave height",
    )


@claim("scg", "standard")
def fingers(cmps, standard):
    """The surface across the tank."""
    share = [(float(np.mean(_between(run, "share across the tank", 1.07, 1.11))),
              float(_between(run, "share across the tank", AFTER, 1.25).max()))
             for run in (cmps, standard)]  # fmt: skip
    return Verdict(
        "the jet is almost uniform across the tank at 1.09 s; after the touch-down fingers appear",
        "seen in figure 3",
        "share of the variance across the tank before and after: CMPS {:.3f}, {:.3f}; standard "
        "{:.3f}, {:.3f}".format(*share[0], *share[1]),
        share[0][0] < 0.02 and share[0][1] > 3.0 * share[0][0],
        "of the tops of columns two spacings wide, within three depths of the crest; agrees below "
        "0.02 at first, and more than three times as much afterwards",
    )


@claim("iccg", "piccg", "scg", until=1.12)
def one_surface(iccg, piccg, scg):
    """Three solvers, one surface."""
    far = [max(_surface_apart(iccg, run, time) for run in (piccg, scg)) for time in (0.88, 1.12)]
    return Verdict(
        "ICCG, PICCG-RP and SCG give nearly the same surface",
        "nearly identical",
        "rms difference of the surface at 0.88 and 1.12 s: {:.2f} and {:.2f} spacings".format(*far),
        max(far) < 1.0,
        "tops of columns two spacings wide in the middle layer, the larger of PICCG-RP and SCG "
        "against ICCG; agrees below one spacing: the particles themselves part, as the water is "
        "chaotic",
    )


def _surface_apart(first, second, time):
    tops = [_tops(run, time) for run in (first, second)]
    both = np.isfinite(tops[0]) & np.isfinite(tops[1])
    return float(np.sqrt(np.mean((tops[0] - tops[1])[both] ** 2))) / first.spacing


def _tops(run, time):
    place = run.tank(time).position
    column = np.floor((place[:, 0] + 0.1) / (COLUMN * run.spacing)).astype(int)
    top = np.full(round(1.0 / (COLUMN * run.spacing)), np.nan)
    np.fmax.at(top, column, place[:, 2])
    return top


@claim("piccg", "scg")
def iterations(piccg, scg):
    """Iterations of SCG over those of PICCG-RP."""
    mean = [float(run.steps["iterations"].mean()) for run in (scg, piccg)]
    return Verdict(
        "SCG needs several times the iterations of PICCG-RP",
        "several times (figure 5b)",
        f"{mean[0]:.0f} over {mean[1]:.0f}: {mean[0] / mean[1]:.1f} times",
        mean[0] > 2.0 * mean[1],
        "mean over all steps; agrees above 2",
    )


@claim("piccg", "scg")
def time_of_solvers(piccg, scg):
    """Time of SCG over that of PICCG-RP."""
    ratio = each(scg) / each(piccg)
    return Verdict(
        "SCG takes about the time of PICCG-RP",
        "1.00 (21.03 s over 20.98 s a step)",
        f"{ratio:.2f} ({each(scg):.3f} s over {each(piccg):.3f} s)",
        0.8 < ratio < 1.25,
        "agrees from 0.8 to 1.25",
    )


@claim("piccg", "ddd")
def flat(static, dynamic):
    """Whether the time of a step wanders."""
    range_ = [_wander(smooth(run.steps["seconds"])) for run in (static, dynamic)]
    uneven = [run.decomposition["imbalance after"].astype(float) for run in (static, dynamic)]
    return Verdict(
        "the time of a step wanders with static cuts and is nearly constant with dynamic ones",
        "seen in figure 5a",
        "range of the time of a step over its median: static {:.2f}, dynamic {:.2f}; largest over "
        "mean work of a rank: {:.2f} to {:.2f} and {:.2f} to {:.2f}".format(
            *range_, uneven[0].min(), uneven[0].max(), uneven[1].min(), uneven[1].max()
        ),
        range_[1] < 0.7 * range_[0],
        "from the 5th to the 95th percentile of medians over 21 steps; agrees below 0.7 of static",
    )


def _wander(seconds):
    low, middle, high = np.percentile(seconds, [5, 50, 95])
    return float((high - low) / middle)


@claim("piccg", "ddd")
def saved(static, dynamic):
    """What dynamic cuts save."""
    ratio = total(dynamic) / total(static)
    return Verdict(
        "dynamic decomposition saves about 10 % of the time",
        "12 % (79,272 s against 90,010 s)",
        f"{100 * (1 - ratio):.0f} % ({total(dynamic):,.0f} s against {total(static):,.0f} s)",
        0.8 < ratio < 0.95,
        "agrees from 5 to 20 %",
    )


@claim("piccg", "ddd")
def fewer(static, dynamic):
    """Steps that dynamic cuts save."""
    steps = [len(run.steps["step"]) for run in (static, dynamic)]
    return Verdict(
        "dynamic decomposition saves about 100 time steps",
        "121 (4170 against 4291)",
        f"{steps[0] - steps[1]} ({steps[1]} against {steps[0]})",
        steps[1] < 0.99 * steps[0],
        "agrees from 1 % on; here the answer is the same to the bit however the tank is cut, so "
        "that it cannot",
    )


@claim("iccg", "ddd")
def speedup(single, parallel):
    """Parallel against one CPU."""
    ratio, ranks = each(single) / each(parallel), parallel.record["ranks"]
    return Verdict(
        "parallel runs are about 3 times as fast as one CPU",
        "3.1 (58.67 s against 19.01 s a step; the number of CPUs is not stated)",
        f"{ratio:.2f} on {ranks} ranks ({each(single):.3f} s against {each(parallel):.3f} s)",
        ratio > 0.7 * ranks,
        "agrees above 0.7 times the ranks; "
        f"{parallel.record['machine']['cores']} cores of {parallel.record['machine']['cpu']}",
    )


@claim("standard")
def shares(run):
    """Shares of the ranks in figure 4."""
    worst = [RANKS * run.cuts(time, method)[1].max()
             for method in ("static", "centroid") for time in (0.88, 1.12)]  # fmt: skip
    return Verdict(
        "with dynamic decomposition the ranks have nearly equal shares of the particles",
        "nearly equal at 0.88 and 1.12 s (figure 4)",
        "largest over mean at 0.88 and 1.12 s: static {:.2f}, {:.2f}; dynamic {:.2f}, "
        "{:.2f}".format(*worst),
        max(worst[2:]) < 1.3 and max(worst[2:]) < min(worst[:2]),
        f"on {RANKS} ranks, cut by the paper's bisection; agrees below 1.3",
    )


@claim("standard")
def particles(run):
    """Particles in the tank."""
    count = sum(run.record["particles"].values())
    return Verdict(
        "about 96,000 particles at 2 mm",
        "96,000",
        f"{count:,} at {1e3 * run.spacing:g} mm",
        abs(count / 96_000 - 1.0) < 0.15,
        "within 15 %; the paper states neither the width of the tank nor the layers of its walls",
    )
