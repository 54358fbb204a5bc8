"""``python -m benchmarks.against CHECKOUT``: how many times as fast as another version.

Both versions run in turn, several times, and each turn gives a ratio: what slows the machine for a
while slows both.  The other version lies in a folder of its own, its kernels built in place
(``python setup.py build_ext --inplace``); so must those of this one.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent


def measure(root, ranks, arguments):
    """What `benchmarks.timed.stretch` returns with the mpslab of a checkout, a Path."""
    line = [sys.executable, str(HERE / "timed.py"), json.dumps(arguments)]
    if ranks > 1:
        line = ["mpiexec", "-n", str(ranks), *line]
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    done = subprocess.run(
        line, cwd=root, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(root), "PATH": path},
    )  # fmt: skip
    if done.returncode:
        raise SystemExit(f"the run in {root} failed:\n{done.stderr[-2000:]}")
    return json.loads(done.stdout)


def compare(other, ranks, arguments, turns, tell=print):
    """The other version and this one in turn: a list of (dict, dict)."""
    roots, pairs = (other, HERE.parent), []
    for turn in range(turns):
        # Every second turn the other way round: a machine may get slower as it warms.
        order = (0, 1) if turn % 2 == 0 else (1, 0)
        found = {k: measure(roots[k], ranks, arguments) for k in order}
        pairs.append((found[0], found[1]))
        tell(f"turn {turn + 1} of {turns}: {found[0]['cpu'] / found[1]['cpu']:.2f} times as fast "
             f"({found[0]['cpu']:.1f} s, {found[1]['cpu']:.1f} s of processor)")  # fmt: skip
    return pairs


def table(pairs):
    """Lines of a table: medians over the turns of the whole and of a step by phase."""
    lines = ["| | before | now | ratio | range |", "|---|---|---|---|---|"]
    rows = {
        "steps": lambda found: found["steps"],
        "iterations a step": lambda found: found["iterations"],
        "processor, s": lambda found: found["cpu"],
        "clock, s": lambda found: found["seconds"],
        "clock a step, ms": lambda found: 1e3 * found["seconds"] / found["steps"],
    }
    for phase in pairs[0][1]["phases"]:
        rows[f"{phase}, ms a step"] = lambda found, phase=phase: (
            1e3 * found["phases"].get(phase, np.nan) / found["steps"]
        )
    for name, of in rows.items():
        before, now = np.array([[of(one), of(two)] for one, two in pairs]).T
        ratio = before / now
        lines.append(
            f"| {name} | {np.median(before):.4g} | {np.median(now):.4g} "
            f"| {np.median(ratio):.2f} | {ratio.min():.2f} to {ratio.max():.2f} |"
        )
    return lines


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.against", description=__doc__)
    parser.add_argument("checkout", type=Path, help="folder of the other version")
    parser.add_argument("--case", default="dam_break")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="changes",
                        help='of the case, as JSON: "tank.width=0"')  # fmt: skip
    parser.add_argument("--from", type=float, default=0.0, metavar="T", dest="start",
                        help="time of the run at which the clock starts [s]")  # fmt: skip
    parser.add_argument("--steps", type=int, default=20, help="steps that are timed; 0: to --until")
    parser.add_argument("--until", type=float, default=1.0, metavar="T", help="[s]")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--files", action="store_true", help="with the files of the run")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all that was measured")
    options = parser.parse_args(arguments)
    changes = {key: json.loads(value) for key, _, value in
               (change.partition("=") for change in options.changes)}  # fmt: skip
    what = {"case": options.case, "changes": changes, "start": options.start,
            "steps": options.steps, "until": options.until, "files": options.files}  # fmt: skip
    pairs = compare(options.checkout.resolve(), options.ranks, what, options.turns)
    print("\n".join(table(pairs)))
    if options.json:
        kept = {**what, "ranks": options.ranks, "pairs": pairs}
        options.json.write_text(json.dumps(kept, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
