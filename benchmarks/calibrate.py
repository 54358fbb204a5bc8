"""``python -m benchmarks.calibrate``: measure the constants of the model on a quiet machine.

Writes machine.toml: what work costs on one rank, how much slower it is on the slowest core where a
run on each shares the machine, what messages cost between two ranks, and whole steps to hold the
model against.
"""

import argparse
import json
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from benchmarks import program
from benchmarks.model import HERE, ROW_BYTES, coarse_work, make_tank, share_out, slowdown
from mpslab.output.provenance import environment
from mpslab.parallel import communicator

ROWS = (10, 100, 1_000, 10_000, 100_000)  # values in the messages that are timed
REPEATS = 500
# The band that is timed, about that of the finest tank; a wider one costs less a multiplication.
BAND = {"groups": 4_000, "half": 40, "repeats": 50}
PER_WATER = ("neighbours", "operators", "assembly")
PER_PARTICLE = ("record", "rest")


def measure(job, ranks, cores, turns):
    """Time the runs that the constants follow from, in turn.

    Parameters
    ----------
    job : dict
        Of `benchmarks.program.time_steps`.
    ranks : list of int
        1 and 2 are among them.
    cores : int
        Runs that share the machine.
    turns : int

    Returns
    -------
    dict of int to list
        Of each number of ranks what `benchmarks.program.time_steps` returned, an entry a turn.
    list of list
        The same of one rank beside others of its kind, one on each core, a list a turn.
    """
    runs, shared = {n: [] for n in ranks}, []
    for _ in range(turns):
        for n, found in runs.items():
            found.append(program.result(program.start(n, "time_steps", **job)))
        together = [program.start(1, "time_steps", **job) for _ in range(cores)]
        shared.append([program.result(process) for process in together])
    return runs, shared


def work_of(runs, coarse, spacing, slowdown=1.0):
    """Seconds of work by phase: a water particle, a row and iteration, or a particle.

    Parameters
    ----------
    runs : dict
        From `measure`.
    coarse : dict
        From `benchmarks.program.time_coarse`; what is left of the solve goes by rows.
    spacing : float [m]
    slowdown : float
        Of two ranks against one, for what only two ranks do.
    """
    one, first, tank = runs[1], runs[1][0], make_tank(spacing)
    rows = _phase(one, "solve") - coarse_work(coarse, tank, first["iterations"])
    work = {
        **{phase: _phase(one, phase) / first["water"] for phase in PER_WATER},
        "solve": rows / (first["water"] * first["iterations"]),
        **coarse,
        **{phase: _phase(one, phase) / first["particles"] for phase in PER_PARTICLE},
    }
    share = share_out(tank, 2)
    held = (share.particles + share.ghosts).mean()
    work["ghosts"] = _phase(runs[2], "ghosts", ("work", "communication")) / held / slowdown
    return work


def sharing_of(runs, shared):
    """How many times as long a step takes with a run on each core, 1 at least.

    On the slowest core, for which all ranks wait; the median over the turns.
    """
    slowest = [max(np.mean(run["seconds"]) for run in turn) for turn in shared]
    return max(float(np.median(slowest)) / _step(runs[1]), 1.0)


def messages_of(timed):
    """Latency [s], bandwidth [B/s] and sum [s] from `benchmarks.program.time_messages`.

    The latency is that of the smallest message, the bandwidth that of the largest.
    """
    small, large = timed["exchange"][0], timed["exchange"][-1]
    size = ROW_BYTES * (ROWS[-1] - ROWS[0])
    return {"latency": small, "bandwidth": size / max(large - small, 1e-9), "sum": timed["sum"]}


def _phase(runs, phase, kinds=("work", "communication", "waiting")):
    return float(np.median([sum(run["phases"][phase][kind] for kind in kinds) for run in runs]))


def _step(runs):
    return float(np.median([np.mean(run["seconds"]) for run in runs]))


def text(constants, measured, provisional):
    """The file machine.toml.

    Parameters
    ----------
    constants : dict
        See `constants_of`.
    measured : list of (float, int, list)
        Spacing [m], ranks, and what `benchmarks.program.time_steps` returned.
    provisional : bool
    """
    cpu, cores = environment()["machine"]["cpu"], constants["cores"]
    lines = [
        "# The constants of benchmarks/model.py, written by `python -m benchmarks.calibrate`:",
        f"# {cpu}, {cores} cores, {datetime.now(UTC):%Y-%m-%d}.",
        "# All in s, but bandwidth in B/s; what of, stands in calibrate.py.",
        "",
        f"provisional = {str(provisional).lower()}",
        f"cores = {cores}",
        f"sharing = {constants['sharing']:.3g}",
        *_table("[work]", constants["work"]),
        *_table("[message]", constants["message"]),
    ]
    for spacing, ranks, runs in measured:
        one = {"spacing": spacing, "ranks": ranks, "seconds": _step(runs)}
        lines += _table("[[measured]]", one)
    return "\n".join(lines) + "\n"


def constants_of(runs, shared, timed, coarse, spacing):
    """``cores``, ``sharing``, ``work`` and ``message`` of the model, from what was timed."""
    machine = {"cores": len(shared[0]), "sharing": sharing_of(runs, shared)}
    return {
        **machine,
        "work": work_of(runs, coarse, spacing, slowdown(machine, 2)),
        "message": messages_of(timed),
    }


def _table(head, values):
    return ["", head, *(f"{name} = {value:.4g}" for name, value in values.items())]


def _ranks_up_to(most):
    return [*(2**k for k in range(most.bit_length()) if 2**k < most), most]


def _also(text):
    spacing, _, ranks = text.partition(":")
    return float(spacing), int(ranks)


def _parser():
    parser = argparse.ArgumentParser(prog="python -m benchmarks.calibrate", description=__doc__)
    parser.add_argument("--spacing", type=float, default=0.002, metavar="D0", help="[m]")
    parser.add_argument("--steps", type=int, default=12, help="time steps of a run")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--also", type=_also, nargs="*", default=[], metavar="D0:RANKS",
                        help="more steps to hold the model against, timed once")  # fmt: skip
    parser.add_argument("--file", type=Path, default=HERE / "machine.toml")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all that was measured")
    parser.add_argument("--provisional", action="store_true", help="the machine is not quiet")
    return parser


def main(arguments=None):
    """Run the command line."""
    parser = _parser()
    options = parser.parse_args(arguments)
    for name in ("steps", "turns"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} {getattr(options, name)}: must be >= 1")
    cores, spacing = max(len(communicator.cores()), 2), options.spacing
    job = {"changes": {"particles.spacing": spacing}, "warm": 3, "steps": options.steps}
    runs, shared = measure(job, _ranks_up_to(cores), cores, options.turns)
    slabs = len(make_tank(spacing).water)
    timed = program.result(
        program.start(2, "time_messages", slabs=slabs, rows=ROWS, repeats=REPEATS)
    )
    coarse = program.time_coarse(**BAND)
    measured = [(spacing, ranks, found) for ranks, found in runs.items()]

    def keep():
        constants = constants_of(runs, shared, timed, coarse, spacing)
        options.file.write_text(text(constants, measured, options.provisional), "utf-8")
        if options.json:
            everything = {**environment(), "shared": shared, "timed": timed, "coarse": coarse,
                          "measured": measured}  # fmt: skip
            options.json.write_text(json.dumps(everything, indent=1), "utf-8")

    keep()
    for spacing_also, ranks in options.also:
        found = program.run(ranks, {"particles.spacing": spacing_also}, steps=options.steps)
        measured.append((spacing_also, ranks, [found]))
        keep()
    print(options.file.read_text())


if __name__ == "__main__":
    main()
