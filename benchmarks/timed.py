"""A stretch of a run, timed: the program that `benchmarks.against` starts in either checkout.

It uses what users use of mpslab, so that it can time any version.  ``python timed.py JSON``.
"""

import json
import resource
import sys
import tempfile
import time

import mpslab


def stretch(case, changes, start, steps, until, files):
    """Time part of a run.

    Parameters
    ----------
    case : str
    changes : dict
        Keys of the case and their values.
    start : float [s]
        Time of the run at which the clock starts; three steps are made in any case.
    steps : int
        Steps that are timed; 0 for all up to `until`.
    until : float [s]
        Time of the run at which the clock stops.
    files : bool
        Whether the run writes its files.

    Returns
    -------
    dict
        ``steps``, ``seconds`` of this rank and ``cpu`` [s] of all, ``iterations`` a step,
        ``particles``, ``phases`` [s] of each phase on this rank, and ``memory``, the most that
        the process held [bytes].
    """
    case = mpslab.load_case(case, changes)
    with tempfile.TemporaryDirectory() as folder:
        run = mpslab.Simulation(case, folder) if files else mpslab.Simulation(case)
        while run.time < start or run.step < 3:
            run.advance()
        before, first = dict(run.stopwatch.spent), run.step
        began, cpu = time.perf_counter(), time.process_time()
        while run.step < first + steps if steps else run.time < until:
            run.advance()
        seconds, cpu = time.perf_counter() - began, time.process_time() - cpu
        phases = {}
        for (phase, kind), spent in run.stopwatch.spent.items():
            spent -= before.get((phase, kind), 0.0)
            phases[phase] = phases.get(phase, 0.0) + spent
        return {
            "steps": run.step - first, "seconds": seconds, "phases": phases,
            "cpu": sum(run.domain.from_all(cpu)),
            "iterations": float(run.steps["iterations"][first:].mean()),
            "particles": sum(run.domain.from_all(len(run.particles))),
            "memory": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
            "rank": run.domain.rank,
        }  # fmt: skip


if __name__ == "__main__":
    found = stretch(**json.loads(sys.argv[1]))
    if found.pop("rank") == 0:
        print(json.dumps(found))
