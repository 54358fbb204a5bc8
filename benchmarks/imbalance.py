"""``python -m benchmarks.imbalance FOLDER``: how even the ways to cut share out a finished run.

For each frame of particles the tank is cut anew by each method, and the largest over the mean work
of a rank is taken; printed are the mean over the frames and, in brackets, the largest.
"""

import argparse
from pathlib import Path

import numpy as np

from mpslab import open_run
from mpslab.parallel import balance
from mpslab.parallel.rebalance import load
from mpslab.run.flow import slabs_of
from mpslab.solids.piston import make_paddle

METHODS = ("static", "centroid", "optimal")
COLUMNS = (*METHODS, "centroid, of particles")


def of_frames(folder, ranks, until=np.inf):
    """Imbalance in each frame of a run.

    Parameters
    ----------
    folder : Path
        A run folder.
    ranks : int
    until : float [s]

    Returns
    -------
    (frames, 4) float64
        Of the work with each method, and of the particles with "centroid", which evens those out.
    """
    run = open_run(folder)
    slabs = slabs_of(run.case, make_paddle(run.case))
    rows = []
    for frame in run.frames:
        if frame.time > until:
            break
        slab, water = slabs.of(frame.position[:, 0]), frame.fluid
        work, particles = (load(by, water, slab, slabs.count) for by in ("optimal", "centroid"))
        cuts = {m: balance.cut(m, particles if m == "centroid" else work, ranks) for m in METHODS}
        rows.append([*(balance.imbalance(work, cuts[m]) for m in METHODS),
                     balance.imbalance(particles, cuts["centroid"])])  # fmt: skip
    return np.array(rows)


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.imbalance", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder of a run")
    parser.add_argument("--ranks", type=int, nargs="+", default=[4, 8])
    parser.add_argument("--until", type=float, default=np.inf, metavar="SECONDS")
    options = parser.parse_args(arguments)
    print(f"| ranks | {' | '.join(COLUMNS)} |\n|{'---|' * (len(COLUMNS) + 1)}")
    for ranks in options.ranks:
        found = of_frames(options.folder, ranks, options.until)
        cells = (f"{m:.2f} ({h:.2f})" for m, h in zip(found.mean(0), found.max(0), strict=True))
        print(f"| {ranks} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
