"""``python -m benchmarks.report``: one page on how fast this version is on this machine.

The loops over pairs beside their rooflines, whole steps phase by phase, and memory. It writes
``results/report-MACHINE.md``, ``.png`` and ``.json``: one set for each machine.
"""

import argparse
import json
import re
from pathlib import Path

import numpy as np

from benchmarks import against, passes
from mpslab.core.memory import keep_freed
from mpslab.core.stopwatch import PHASES
from mpslab.output.provenance import environment

HERE = Path(__file__).resolve().parent
SHORT = {"scheme.settling": 15}  # passes
# Of water that is well mixed nothing is left of the lattice: here random displacements see to that.
STATES = {"early": {}, "mixed": {"particles.jitter": 0.3}}
MEMORY = {"particles.spacing": 0.001, "tank.width": 0.053}  # about a million particles


def steps(spacings, count):
    """A step of the paper's tank in 3-D at each spacing and in each state: dicts by name."""
    return {
        f"{1e3 * spacing:g} mm, {state}": _stretch(
            {**SHORT, **changes, "particles.spacing": spacing}, count
        )
        for spacing in spacings
        for state, changes in STATES.items()
    }


def _stretch(changes, count):
    what = {"case": "plunging_breaker", "changes": changes, "start": 0.0, "steps": count,
            "until": 0.0, "files": False}  # fmt: skip
    return against.measure(HERE.parent, 1, what)


def phases_of(one):
    """Milliseconds of the processor a step by phase, from what a stretch of steps took.

    The shares are those by the clock: on a busy machine the clock goes on while others work.
    """
    each = 1e3 * one["cpu"] / one["seconds"] / one["steps"]
    return {phase: each * one["phases"][phase] for phase in PHASES}


def tables(found):
    """Lines of Markdown of what `measure` found."""
    lines = ["| pass | ns a pair | its roofline | share |", "|---|---|---|---|"]
    for name, spent, roof in found["passes"]:
        lines.append(f"| {name} | {spent:.2f} | {roof:.2f} | {roof / spent:.2f} |")
    lines += ["", "| a step, ms of the processor | particles | iterations "
              f"| {' | '.join(PHASES)} | all |",
              "|---" * (len(PHASES) + 4) + "|"]  # fmt: skip
    for name, one in found["steps"].items():
        phases = phases_of(one).values()
        cells = [f"{ms:.1f}" for ms in (*phases, sum(phases))]
        lines.append(f"| {name} | {one['particles']:,} | {one['iterations']:.1f} "
                     f"| {' | '.join(cells)} |")  # fmt: skip
    lines += ["", "| particles | memory at most, GB | kB a particle |", "|---|---|---|"]
    for one in found["memory"]:
        lines.append(f"| {one['particles']:,} | {one['memory'] / 1e9:.2f} "
                     f"| {one['memory'] / 1e3 / one['particles']:.2f} |")  # fmt: skip
    return lines


def draw(found, path):
    """Passes beside their rooflines, and steps phase by phase, as a picture."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    names, spent, roof = zip(*found["passes"], strict=True)
    place = np.arange(len(names))
    left.barh(place - 0.2, spent, 0.4, label="measured")
    left.barh(place + 0.2, roof, 0.4, color="0.7", label="roofline: a copy of the same bytes")
    left.set(yticks=place, yticklabels=names, xlabel="ns a pair")
    left.invert_yaxis()
    left.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2)
    begin = np.zeros(len(found["steps"]))
    for phase in PHASES:
        ms = np.array([phases_of(one)[phase] for one in found["steps"].values()])
        right.barh(list(found["steps"]), ms, 0.6, begin, label=phase)
        begin += ms
    right.set(xlabel="ms of the processor a step")
    right.invert_yaxis()
    right.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=4)
    figure.savefig(path, dpi=110)


def measure(spacings, count, turns, large):
    """All that the page tells, a dict."""
    keep_freed()
    found = {
        **environment(),
        "passes": passes.alone(passes.settled(spacings[0]), turns),
        "steps": steps(spacings, count),
    }
    found["memory"] = [one for name, one in found["steps"].items() if "early" in name]
    if large:
        found["memory"].append(_stretch({**MEMORY, "scheme.settling": 0}, 2))
    return found


def name_of(machine):
    """Name of a machine for a file, "amd-epyc-2": its processor and how many cores."""
    words = re.findall(r"[a-z0-9]+", re.sub(r"\(\w+\)", " ", f"{machine['cpu']}".lower()))
    return "-".join([*words, str(machine["cores"])])


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.report", description=__doc__)
    parser.add_argument("--spacings", type=float, nargs="+", default=[0.004, 0.002], metavar="D0",
                        help="[m]; the loops are timed at the first")  # fmt: skip
    parser.add_argument("--steps", type=int, default=12)
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--large", action="store_true",
                        help="memory with a million particles as well")  # fmt: skip
    parser.add_argument("--out", type=Path, default=HERE / "results")
    options = parser.parse_args(arguments)
    found = measure(options.spacings, options.steps, options.turns, options.large)
    path = options.out / f"report-{name_of(found['machine'])}"
    page = [f"# {found['machine']['cpu']}, {found['machine']['cores']} cores", "",
            f"`python -m benchmarks.report`, commit {found['commit']}.", "",
            *tables(found)]  # fmt: skip
    path.with_suffix(".md").write_text("\n".join(page) + "\n", encoding="utf-8")
    path.with_suffix(".json").write_text(json.dumps(found, indent=1), encoding="utf-8")
    draw(found, path.with_suffix(".png"))
    print("\n".join(page))


if __name__ == "__main__":
    main()
