"""What agrees with the paper and what does not: ``agreement.json``.

The bands were set before the runs were made.
"""

import json
from dataclasses import asdict, dataclass

import numpy as np

from mpslab.analysis.overturning import JET
from paper_figures.keep import RANKS
from paper_figures.table_1 import cost

TIP = (0.95, 1.10)  # [s]: from the first steep crest to the touch-down
AFTER, LAST = 1.12, 1.25  # [s]: after the touch-down


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


def claim(*runs):
    """Register a claim that is judged from these runs and methods.

    The function takes what is kept of them and returns a Verdict.
    """
    return lambda judge: CLAIMS.append((runs, judge)) or judge


def verdicts(found):
    """The verdicts on all claims whose runs and methods are there."""
    return [
        judge(*(found[name] for name in names))
        for names, judge in CLAIMS
        if all(name in found for name in names)
    ]


def write(found, out):
    """Write ``agreement.json`` into a folder; returns its path."""
    path = out / "agreement.json"
    rows = [asdict(one) | {"agrees": bool(one.agrees)} for one in verdicts(found)]
    path.write_text(json.dumps(rows, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return path


def _between(run, column, start, end):
    """A column of the measures between two times [s] of a wave that is not late."""
    time = run.series["time [s]"] - run.late
    return run.series[column][(time >= start) & (time <= end)]


@claim("mps", "cmps", "standard")
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


@claim("mps", "cmps", "standard")
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


@claim("mps", "cmps", "standard")
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


@claim("cmps", "standard")
def second_jet(cmps, standard):
    """The secondary jet."""
    height = 1e3 * cmps.case["wavemaker"]["height"]
    splash = [1e3 * _between(run, "splash [m]", AFTER, LAST).max() for run in (cmps, standard)]
    return Verdict(
        "after the touch-down a secondary jet goes up",
        "seen in figure 2",
        "highest water ahead of the crest, mm: CMPS {:.1f}, standard {:.1f}".format(*splash),
        splash[0] > 0.25 * height,
        f"above still water, from {AFTER} s on; agrees above a quarter of the wave height",
    )


@claim("cmps", "standard")
def fingers(cmps, standard):
    """The surface across the tank."""
    share = [(float(np.mean(_between(run, "share across the tank", 1.07, 1.11))),
              float(_between(run, "share across the tank", AFTER, LAST).max()))
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


@claim("iccg", "piccg", "scg")
def one_surface(iccg, piccg, scg):
    """Three solvers, one surface."""
    far = [_apart(iccg.tops, one.tops) / iccg.record["spacing [m]"] for one in (piccg, scg)]
    steps = len(iccg.steps["step"]) // len(iccg.states)
    return Verdict(
        "ICCG, PICCG-RP and SCG give nearly the same surface",
        "nearly identical at the end of the runs",
        f"rms difference from ICCG {steps} steps after the same state: PICCG-RP {far[0]:.1e}, SCG "
        f"{far[1]:.1e} spacings",
        max(far) < 0.1,
        "tops of columns two spacings wide, the state in which they differ most; agrees below a "
        "tenth of a spacing. Over whole runs the particles part, as the water is chaotic",
    )


def _apart(first, second):
    """Largest rms difference of the tops of columns (k, n) in a state [m]."""
    square = np.nanmean((first - second) ** 2, axis=1)
    return float(np.sqrt(square.max()))


@claim("piccg", "scg", "cmps")
def iterations(piccg, scg, run):
    """Iterations of SCG over those of PICCG-RP."""
    mean = [float(one.over("iterations", run.steps["step"]).mean()) for one in (scg, piccg)]
    return Verdict(
        "SCG needs several times the iterations of PICCG-RP",
        "several times (figure 5b)",
        f"{mean[0]:.0f} over {mean[1]:.0f}: {mean[0] / mean[1]:.1f} times",
        mean[0] > 2.0 * mean[1],
        "mean over all steps; agrees above 2",
    )


@claim("piccg", "scg", "cmps")
def time_of_solvers(piccg, scg, run):
    """Time of SCG over that of PICCG-RP."""
    each = [cost(one, run).step for one in (scg, piccg)]
    ratio = each[0] / each[1]
    return Verdict(
        "SCG takes about the time of PICCG-RP",
        "1.00 (21.03 s over 20.98 s a step)",
        f"{ratio:.2f} ({each[0]:.3f} s over {each[1]:.3f} s)",
        0.8 < ratio < 1.25,
        "agrees from 0.8 to 1.25",
    )


@claim("piccg", "ddd")
def flat(static, dynamic):
    """Whether the time of a step wanders."""
    range_ = [float(np.ptp(seconds) / np.median(seconds))
              for seconds in (one.middle("seconds") for one in (static, dynamic))]  # fmt: skip
    return Verdict(
        "the time of a step wanders with static cuts and is nearly constant with dynamic ones",
        "seen in figure 5a",
        f"range of the time of a step over its median: static {range_[0]:.2f}, dynamic "
        f"{range_[1]:.2f}",
        range_[1] < 0.7 * range_[0],
        "of the medians from each state on; agrees below 0.7 of static",
    )


@claim("piccg", "ddd", "cmps")
def saved(static, dynamic, run):
    """What dynamic cuts save."""
    net = [cost(one, run).net for one in (static, dynamic)]
    ratio = net[1] / net[0]
    return Verdict(
        "dynamic decomposition saves about 10 % of the time",
        "12 % (79,272 s against 90,010 s)",
        f"{100 * (1 - ratio):.0f} % ({net[1]:,.0f} s against {net[0]:,.0f} s)",
        0.8 < ratio < 0.95,
        "agrees from 5 to 20 %",
    )


@claim("piccg", "ddd")
def fewer(static, dynamic):
    """Steps that dynamic cuts save."""
    same = np.array_equal(static.tops, dynamic.tops, equal_nan=True)
    return Verdict(
        "dynamic decomposition saves about 100 time steps",
        "121 (4170 against 4291)",
        "0: from the same state the surfaces are "
        + ("the same to the last bit" if same else "different"),
        not same,
        "here the answer is the same however the tank is cut, so that it cannot",
    )


@claim("iccg", "ddd", "cmps")
def speedup(single, parallel, run):
    """Parallel against one CPU."""
    each = [cost(one, run).step for one in (single, parallel)]
    ratio, ranks = each[0] / each[1], parallel.record["ranks"]
    return Verdict(
        "parallel runs are about 3 times as fast as one CPU",
        "3.1 (58.67 s against 19.01 s a step; the number of CPUs is not stated)",
        f"{ratio:.2f} on {ranks} ranks ({each[0]:.3f} s against {each[1]:.3f} s)",
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
