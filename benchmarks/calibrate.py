"""``python -m benchmarks.calibrate``: measure the constants of the model on a quiet machine.

Writes machine.toml: what work costs on one rank, how much slower it gets where two runs share the
machine, what messages cost between two ranks, and whole steps to hold the model against.
"""

import argparse
from datetime import UTC, datetime

import numpy as np

from benchmarks import program
from benchmarks.model import HERE, ROW_BYTES, coarse_work, make_tank, share_out
from mpslab.provenance import environment

ROWS = (10, 100, 1_000, 10_000, 100_000)  # values in the messages that are timed
REPEATS = 500
# The band that is timed, about that of the finest tank; a wider one costs less a multiplication.
BAND = {"groups": 4_000, "half": 40, "repeats": 50}
PER_WATER = ("neighbours", "operators", "assembly")
PER_PARTICLE = ("record", "rest")


def measure(spacing, steps, turns):
    """Time the runs that the constants follow from, in turn.

    Returns
    -------
    dict of str to list
        "one" and "two" ranks, and "shared": one rank beside a second run of its kind; in each what
        `benchmarks.program.time_steps` returned, an entry a turn.
    """
    changes = {"particles.spacing": spacing, "scheme.settling": 0}  # as the iterations of the model
    job = {"changes": changes, "warm": 3, "steps": steps}
    found = {"one": [], "two": [], "shared": []}
    for _ in range(turns):
        found["one"].append(program.result(program.start(1, "time_steps", **job)))
        found["two"].append(program.result(program.start(2, "time_steps", **job)))
        both = [program.start(1, "time_steps", **job) for _ in range(2)]
        found["shared"] += [program.result(process) for process in both]
    return found


def work_of(found, coarse, spacing):
    """Seconds of work by phase: a water particle, a row and iteration, or a particle.

    Parameters
    ----------
    found : dict
        From `measure`.
    coarse : dict
        From `benchmarks.program.time_coarse`; what is left of the solve goes by rows.
    spacing : float [m]
    """
    first, tank = found["one"][0], make_tank(spacing)
    rows = _phase(found["one"], "solve") - coarse_work(coarse, tank, first["iterations"])
    work = {
        **{phase: _phase(found["one"], phase) / first["water"] for phase in PER_WATER},
        "solve": rows / (first["water"] * first["iterations"]),
        **coarse,
        **{phase: _phase(found["one"], phase) / first["particles"] for phase in PER_PARTICLE},
    }
    share = share_out(tank, 2)
    held = (share.particles + share.ghosts).mean()
    busy = _phase(found["two"], "ghosts", ("work", "communication"))
    work["ghosts"] = busy / held / sharing_of(found)
    return work


def sharing_of(found):
    """How many times as long a step takes where two runs share the machine, 1 at least."""
    return max(_step(found["shared"]) / _step(found["one"]), 1.0)


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


def text(found, timed, coarse, spacing, provisional):
    """The file machine.toml."""
    machine = environment()["machine"]
    lines = [
        "# The constants of benchmarks/model.py, written by `python -m benchmarks.calibrate`:",
        f"# {machine['cpu']}, {machine['cores']} cores, {datetime.now(UTC):%Y-%m-%d}.",
        "# All in s, but bandwidth in B/s; what of, stands in calibrate.py.",
        "",
        f"provisional = {str(provisional).lower()}",
        f"sharing = {sharing_of(found):.3g}",
        *_table("[work]", work_of(found, coarse, spacing)),
        *_table("[message]", messages_of(timed)),
    ]
    for ranks, runs in ((1, found["one"]), (2, found["two"])):
        one = {"spacing": spacing, "ranks": ranks, "seconds": _step(runs)}
        lines += _table("[[measured]]", one)
    return "\n".join(lines) + "\n"


def _table(head, values):
    return ["", head, *(f"{name} = {value:.4g}" for name, value in values.items())]


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.calibrate", description=__doc__)
    parser.add_argument("--spacing", type=float, default=0.002, metavar="D0", help="[m]")
    parser.add_argument("--steps", type=int, default=12, help="time steps of a run")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--provisional", action="store_true", help="the machine is not quiet")
    options = parser.parse_args(arguments)
    for name in ("steps", "turns"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} {getattr(options, name)}: must be >= 1")
    found = measure(options.spacing, options.steps, options.turns)
    slabs = len(make_tank(options.spacing).water)
    timed = program.result(
        program.start(2, "time_messages", slabs=slabs, rows=ROWS, repeats=REPEATS)
    )
    coarse = program.time_coarse(**BAND)
    file = HERE / "machine.toml"
    page = text(found, timed, coarse, options.spacing, options.provisional)
    file.write_text(page, encoding="utf-8")
    print(file.read_text())


if __name__ == "__main__":
    main()
