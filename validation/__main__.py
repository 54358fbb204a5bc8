"""The command line: ``python -m validation``."""

import argparse
import sys
from pathlib import Path

from mpslab.parallel.communicator import cores
from validation import judge, report, result, suite
from validation.display import make_display
from validation.work import Task, Work

DONE, MISSED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130


def _parser():
    parser = argparse.ArgumentParser(
        prog="python -m validation",
        description="Hold mpslab against theory and experiment, and write a report.",
    )
    parser.add_argument("case", nargs="*", metavar="CASE", help="cases to look at; all if left out")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--quick", dest="suite", action="store_const", const="quick",
                       default="quick", help="minutes (the default)")  # fmt: skip
    which.add_argument("--full", dest="suite", action="store_const", const="full",
                       help="hours, for a release")  # fmt: skip
    parser.add_argument("--ranks", type=int, default=1, metavar="N", help="processes of each run")
    parser.add_argument("--jobs", type=int, default=0, metavar="N",
                        help="runs at a time; left out, as many as there are cores")  # fmt: skip
    parser.add_argument("--out", type=Path, metavar="DIR",
                        help="folder of the results; what has finished in it is kept")  # fmt: skip
    parser.add_argument("--known", action="store_true",
                        help="fail only where it differs from known_misses.toml")  # fmt: skip
    parser.add_argument("--list", action="store_true", help="list the cases")
    return parser


def main(arguments=None):
    """Run the command line; returns the exit status.

    0: no criterion missed (with --known: just the known ones); 1: some; 2: bad input; 130:
    stopped by Ctrl-C, what has finished is kept.
    """
    options = _parser().parse_args(arguments)
    try:
        cases = _chosen(options)
    except ValueError as error:
        print(f"validation: {error}", file=sys.stderr)
        return BAD_INPUT
    if options.list:
        for case in cases:
            where = "quick, full" if case.in_suite("quick") else "full"
            print(f"{case.name:<18} {where:<12} {case.title}")
        return DONE
    out = options.out or Path("runs") / "validation" / options.suite
    out.mkdir(parents=True, exist_ok=True)
    jobs = options.jobs or max(len(cores()) // options.ranks, 1)
    try:
        results = run(cases, options.suite, out, Work(jobs, options.ranks))
    except KeyboardInterrupt:
        print(f"Stopped; the same command with --out {out} goes on.", file=sys.stderr)
        return INTERRUPTED
    for path in report.write(results, out):
        print(f"Report: {path}")
    return _verdict(results, options.known)


def _chosen(options):
    for name in ("ranks", "jobs"):
        least, value = (1 if name == "ranks" else 0), getattr(options, name)
        if value < least:
            raise ValueError(f"--{name} {value}: must be a whole number >= {least}")
    cases = [suite.load(name) for name in options.case]
    for case in cases:
        if not case.in_suite(options.suite) and not options.list:
            raise ValueError(f"case {case.name}: not in the {options.suite} suite; add --full")
    return cases or [c for c in suite.load_all() if options.list or c.in_suite(options.suite)]


def run(cases, which, out, work):
    """Run a suite, and compare each case as soon as its last run has ended.

    Parameters
    ----------
    cases : list of validation.suite.ValidationCase
    which : str
        "quick" or "full".
    out : Path
        A JSON file for each case goes here, the runs into ``runs``.
    work : validation.work.Work

    Returns
    -------
    list of dict
        The results, in the order of the cases.
    """
    known = judge.known_misses()
    tasks = {
        case.name: [Task(case.name, plan, out / "runs" / case.name / plan.name)
                    for plan in case.runs_of(which)]
        for case in cases
    }  # fmt: skip
    ended = {case.name: {} for case in cases}
    results = {}

    def look(case):
        if case.name not in results and len(ended[case.name]) == len(tasks[case.name]):
            outcomes = [ended[case.name][task.plan.name] for task in tasks[case.name]]
            found, pictures = result.make(case, which, outcomes, known)
            result.write(out, found, pictures)
            results[case.name] = found
            print(_line(found), flush=True)

    everything = [task for several in tasks.values() for task in several]
    with make_display(everything) as display:
        for case in cases:
            look(case)
        for outcome in work.do(everything, display):
            display.end(outcome.task)
            ended[outcome.task.case][outcome.task.plan.name] = outcome
            for case in cases:
                look(case)
    return [results[case.name] for case in cases]


def _line(found):
    return f"{found['title']}: {_tally(found['metrics'])}"


def _tally(metrics):
    verdicts = [metric["verdict"] for metric in metrics]
    still = f", {verdicts.count(judge.OPEN)} open" if judge.OPEN in verdicts else ""
    return f"{verdicts.count(judge.MET)} of {len(verdicts)} criteria met{still}"


def _verdict(results, against_known):
    for word in (judge.OPEN, judge.MISSED):
        for case, metric in judge.with_verdict(results, word):
            cause = f" (known: {metric['known']})" if metric["known"] else ""
            print(f"{word.title()}: {case}.{metric['id']} = {judge.told(metric)}, allowed "
                  f"{metric['low']} to {metric['high']} {metric['unit']}{cause}")  # fmt: skip
    print(_tally([metric for found in results for metric in found["metrics"]]))
    if not against_known:
        return MISSED if judge.with_verdict(results, judge.MISSED) else DONE
    surprises = judge.unexpected(results)
    print("\n".join(surprises) or "Nothing but the known misses.")
    return MISSED if surprises else DONE


if __name__ == "__main__":
    sys.exit(main())
