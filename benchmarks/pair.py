"""``python -m benchmarks.pair``: how many times as fast are some ranks as one, on a noisy machine.

Both run in turn, several times, and each turn gives a ratio: what slows the machine for a while
slows both.  Printed are the medians, for the whole step and each phase.
"""

import argparse
import json

import numpy as np

from benchmarks import program
from mpslab.core.stopwatch import KINDS, PHASES
from mpslab.output.provenance import environment


def compare(ranks, changes, steps, turns, tell=print):
    """One rank and `ranks` in turn.

    Parameters
    ----------
    ranks, steps, turns : int
    changes : dict
        As for `benchmarks.program.time_steps`.
    tell : callable
        Called with a line of text after each turn.

    Returns
    -------
    list of (dict, dict)
        What `time_steps` returned for one rank and for `ranks`, a pair a turn.
    """
    pairs = []
    for turn in range(turns):
        # Every second turn the other way round: a machine may get slower as it warms.
        order = (1, ranks) if turn % 2 == 0 else (ranks, 1)
        found = {n: program.run(n, changes, steps=steps) for n in order}
        pairs.append((found[1], found[ranks]))
        ratio = np.mean(found[1]["seconds"]) / np.mean(found[ranks]["seconds"])
        tell(f"turn {turn + 1} of {turns}: {ratio:.2f} times as fast on {ranks} ranks")
    return pairs


def table(pairs):
    """Lines of a table: the whole step and each phase, their medians over the turns.

    Columns: seconds a step on one rank and on more, what of these was communication and waiting,
    the ratio of both, its least and largest value.
    """
    ranks = pairs[0][1]["ranks"]
    lines = [
        f"| phase | 1 rank, s | {ranks} ranks, s | communication | waiting | ratio | range |",
        "|---|---|---|---|---|---|---|",
    ]
    for name in ("step", *PHASES):
        one, many = (np.array([_seconds(found, name) for found in side])
                     for side in zip(*pairs, strict=True))  # fmt: skip
        ratio = one.sum(axis=1) / many.sum(axis=1)
        _, communication, waiting = np.median(many, axis=0)
        lines.append(
            f"| {name} | {np.median(one.sum(axis=1)):.4f} | {np.median(many.sum(axis=1)):.4f} "
            f"| {communication:.4f} | {waiting:.4f} | {np.median(ratio):.2f} "
            f"| {ratio.min():.2f} to {ratio.max():.2f} |"
        )
    return lines


def _seconds(found, name):
    """Seconds a step by kind (work, communication, waiting), of a phase or of the whole step."""
    rows = [found["phases"][phase] for phase in (PHASES if name == "step" else [name])]
    return [sum(row[kind] for row in rows) for kind in KINDS]


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pair", description=__doc__)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--spacing", type=float, default=0.004, metavar="D0", help="[m]")
    parser.add_argument("--solver", default="deflated")
    parser.add_argument("--steps", type=int, default=12, help="time steps of a run")
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--json", metavar="FILE", help="keep all that was measured")
    options = parser.parse_args(arguments)
    for name, least in (("ranks", 2), ("steps", 1), ("turns", 1)):
        if getattr(options, name) < least:
            parser.error(f"--{name} {getattr(options, name)}: must be >= {least}")
    changes = {"particles.spacing": options.spacing, "scheme.solver": options.solver}
    pairs = compare(options.ranks, changes, options.steps, options.turns)
    print("\n".join(table(pairs)))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({**environment(), "changes": changes, "pairs": pairs}, file, indent=1)


if __name__ == "__main__":
    main()
