"""The command line: ``python -m paper_figures``."""

import argparse
import importlib
import sys
from pathlib import Path

import matplotlib

from mpslab.analysis.pictures import STYLE
from paper_figures import agreement, kept, runs, samples
from paper_figures.keep import keep

DONE, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
FIGURES = ("fig_1", "fig_2", "fig_3", "fig_4", "fig_5", "table_1")
HERE = Path(__file__).parent
DPI = 110  # of a picture


def _parser():
    parser = argparse.ArgumentParser(
        prog="python -m paper_figures",
        description="Draw every figure and table of the paper from kept results of mpslab.",
    )
    # fmt: off
    parser.add_argument("--out", type=Path, metavar="DIR",
                        help="folder of the pictures; left out, runs/paper_figures/SIZE")
    parser.add_argument("--run", action="store_true",
                        help="make the runs that are missing first, in the folder of the "
                        "pictures; an interrupted one goes on")
    parser.add_argument("--quick", dest="size", action="store_const", const="quick", default="full",
                        help="at twice the particle spacing of the paper")
    parser.add_argument("--only", action="append", metavar="NAME",
                        help="a figure, with the runs that it needs, or a run; may be given "
                        f"several times: {', '.join(FIGURES)}, "
                        f"{', '.join((*runs.read_runs('full'), *samples.read_methods()))}")
    parser.add_argument("--results", type=Path, metavar="DIR",
                        help="folder of the kept results; those of the repository if left out, "
                        "with --run OUT/results")
    # fmt: on
    return parser


def main(arguments=None):
    """Run the command line; returns the exit status.

    0: done; 1: a run has stopped before its end; 2: bad input; 130: Ctrl-C.
    """
    options = _parser().parse_args(arguments)
    table, methods = runs.read_runs(options.size), samples.read_methods()
    names = (*FIGURES, *table, *methods)
    unknown = set(options.only or ()) - set(names)
    if unknown:
        return _refuse(f"--only {', '.join(sorted(unknown))}: must be out of {', '.join(names)}")
    figures = [name for name in FIGURES if not options.only or name in options.only]
    out = options.out or Path("runs") / "paper_figures" / options.size
    results = options.results or (out if options.run else HERE) / "results"
    if not (options.results or options.run):
        results /= options.size
    try:
        if options.run:
            wanted = {name for figure in figures for name in _needs(figure)}
            wanted |= set(options.only or ())
            plan = runs.read_table()["samples"][options.size]
            _make(wanted, table, methods, plan, out, results)
        return _draw(figures, kept.read(results, table, methods), out)
    except runs.Failed as error:
        print(f"paper_figures: {error}", file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        print("Stopped; the same command goes on.", file=sys.stderr)
        return INTERRUPTED


def _refuse(message):
    print(f"paper_figures: {message}", file=sys.stderr)
    return BAD_INPUT


def _needs(name):
    """Names of the runs that a figure is drawn from."""
    return importlib.import_module(f"paper_figures.{name}").RUNS


def _make(wanted, table, methods, plan, out, results):
    """Make the runs that are missing, then the samples, and keep what the figures need of each."""
    new = [m for name, m in methods.items()
           if name in wanted and not (results / name / samples.TABLE).exists()]  # fmt: skip
    if new:
        wanted = wanted | {runs.SAMPLED}
    missing = [run for name, run in table.items()
               if name in wanted and not (results / name / "water.npz").exists()]  # fmt: skip
    for batch in runs.batches(missing):
        names = " and ".join(f"{run.name}, {run.title}" for run in batch)
        beside = f"; progress of the last in {out / batch[-1].name}.log" if batch[1:] else ""
        print(f"\nRun {names}{beside}", flush=True)
        runs.make_all(batch, out)
        for run in batch:
            keep(out / run.name, results / run.name, run)
    if new:
        samples.take(new, plan, out, results)


def _draw(figures, found, out):
    """Draw what can be drawn; says what is missing for the others."""
    out.mkdir(parents=True, exist_ok=True)
    status = DONE
    for name in figures:
        missing = [run for run in _needs(name) if run not in found]
        if missing:
            print(f"{name}: not drawn, no results of {', '.join(missing)} (--run makes them)")
            status = FAILED
            continue
        with matplotlib.rc_context(STYLE):
            figure = importlib.import_module(f"paper_figures.{name}").draw(found)
            figure.savefig(out / f"{name}.png", dpi=DPI)
        print(out / f"{name}.png")
    print(agreement.write(found, out))
    return status


if __name__ == "__main__":
    sys.exit(main())
