"""The program that is timed: some steps of the paper's tank, in memory, on any number of ranks.

``mpiexec -n N python -m benchmarks.program JSON`` prints what `time_steps` returns; `start` and
`run` do that from Python.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from mpslab import Simulation, load_case
from mpslab.core.stopwatch import KINDS, PHASES
from mpslab.kernels import coarse
from mpslab.parallel import launch
from mpslab.parallel.balance import imbalance
from mpslab.parallel.domain import world
from mpslab.parallel.rebalance import load

ROOT = Path(__file__).parent.parent
TIMEOUT = 1800.0  # seconds


def time_steps(changes, warm, steps):
    """Time some steps of the plunging breaker on the ranks that are there.

    Parameters
    ----------
    changes : dict
        Keys of the case and their values, such as ``{"particles.spacing": 0.002}``.
    warm, steps : int
        Steps before the clock starts, and those timed.

    Returns
    -------
    dict
        ``ranks``; ``particles``, ``water``, ``iterations`` a step, ``imbalance`` of the work;
        ``seconds`` of each step (steps,), the mean over the ranks; ``phases``: of each phase
        seconds a step by kind (work, communication, waiting), the mean over the ranks.
    """
    run = Simulation(load_case("plunging_breaker", changes))
    for _ in range(warm):
        run.advance()
    before, seconds = dict(run.stopwatch.spent), []
    for _ in range(steps):
        began = time.perf_counter()
        run.advance()
        seconds.append(time.perf_counter() - began)
    spent = {at: s - before.get(at, 0.0) for at, s in run.stopwatch.spent.items()}
    return _report(run, seconds, spent)


def _report(run, seconds, spent):
    domain, particles, steps = run.domain, run.particles, len(seconds)
    table = [[spent.get((phase, kind), 0.0) / steps for kind in KINDS] for phase in PHASES]
    mean = np.mean(domain.from_all(table), axis=0)
    work = domain.collect(load("optimal", particles.fluid, domain.slab, domain.slabs.count))
    return {
        "ranks": domain.size,
        "particles": sum(domain.from_all(len(particles))),
        "water": sum(domain.from_all(int(np.count_nonzero(particles.fluid)))),
        "iterations": float(run.steps["iterations"][-steps:].mean()),
        "imbalance": imbalance(work, domain.cuts),
        "seconds": np.mean(domain.from_all(seconds), axis=0).tolist(),
        "phases": {
            phase: dict(zip(KINDS, row.tolist(), strict=True))
            for phase, row in zip(PHASES, mean, strict=True)
        },
    }


def time_messages(slabs, rows, repeats):
    """Time a sum over all ranks, and a message to either neighbour and back.

    Parameters
    ----------
    slabs : int
        Values in the sum.
    rows : list of int
        Float64 values in the messages, one size after another.
    repeats : int

    Returns
    -------
    dict
        ``sum`` [s], and ``exchange`` [s], one for each size; medians.
    """
    from mpslab.parallel.domain import Domain
    from mpslab.parallel.slabs import Slabs

    domain = Domain(Slabs(0.0, 1.0, slabs))
    sums = np.zeros(slabs)
    exchange = []
    for count in rows:
        halo = domain.halo(np.arange(slabs + 1) * count)
        x = np.zeros(slabs * count)
        exchange.append(_median(lambda x=x, halo=halo: domain.exchange(halo, x), repeats))
    return {"sum": _median(lambda: domain.add(sums), repeats), "exchange": exchange}


def time_coarse(groups, half, repeats):
    """Time what a rank does for the groups of the deflation, on a band of made-up couplings.

    Parameters
    ----------
    groups, half : int
        Groups, and how many before it each is coupled to.
    repeats : int

    Returns
    -------
    dict
        ``factor`` [s] of groups * half^2, ``substitution`` [s] of groups * half; medians.
    """
    bands = np.full((repeats, groups, half + 1), -1.0)
    bands[:, :, half] = 2.0 * half + 1.0
    inverse, y, each = np.empty(groups), np.ones(groups), iter(bands)
    factor = _median(lambda: coarse.factorise(next(each), inverse), repeats)
    substitution = _median(lambda: coarse.substitute(bands[-1], inverse, y), repeats)
    return {"factor": factor / (groups * half**2), "substitution": substitution / (groups * half)}


def _median(act, repeats):
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        act()
        times.append(time.perf_counter() - began)
    return float(np.median(times))


def start(ranks, function, **arguments):
    """Start a function above on so many ranks; `result` waits for it."""
    line = launch.command(ranks, "-m", "benchmarks.program", function, json.dumps(arguments))
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    return subprocess.Popen(
        line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT,
        env={**os.environ, "PYTHONPATH": path},
    )  # fmt: skip


def result(process):
    """What the started function returned; RuntimeError with its last words if it failed."""
    output, errors = process.communicate(timeout=TIMEOUT)
    if process.returncode:
        raise RuntimeError(f"the timed program failed:\n{errors[-2000:]}")
    return json.loads(output)


def run(ranks, changes, warm=3, steps=12):
    """`time_steps` on so many ranks."""
    return result(start(ranks, "time_steps", changes=changes, warm=warm, steps=steps))


if __name__ == "__main__":
    functions = {"time_steps": time_steps, "time_messages": time_messages}
    found = functions[sys.argv[1]](**json.loads(sys.argv[2]))
    if world().rank == 0:
        print(json.dumps(found))
