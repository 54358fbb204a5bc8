"""Makes the pictures of the tank in docs again: ``python docs/pictures.py [NAME ...]``.

Runs what is not there yet, in runs/docs, and writes a PNG of each. The film of README,
breaker.webp, is made only if it is named, for its run takes half an hour or more; docs/scaling.png
comes from ``python -m benchmarks.model``.
"""

import subprocess
import sys
from pathlib import Path

import matplotlib

from mpslab import film, open_run
from mpslab.analysis.pictures import STYLE, save_small
from mpslab.analysis.snapshots import draw_breaker, draw_tank

DOCS = Path(__file__).parent
RUNS = DOCS.parent / "runs" / "docs"
LARGEST = 300_000  # bytes

# The paper's height. Times are those at which the waves break, and some between.
PAPER = {"wavemaker.height": 0.0196, "particles.spacing": 0.002, "output.interval": 0.0125}
SLICE = PAPER | {"tank.width": 0.0}
THREE_WAVES = {"time.end": 2.3, "output.pictures": [0.9, 1.0375, 1.4125, 1.4375, 1.5, 2.2125]}
TWO_WAVES = {"time.end": 1.6, "output.pictures": [0.6, 0.9, 1.0375, 1.125, 1.4375, 1.5]}
# What stands around the gradient of MPS, and of CMPS as printed; and the jet of CMPS.
CLASSIC = {"scheme.recipe": "paper", "scheme.gradient_radius": 0.0, "scheme.walls": "solved"}
JET = {"wavemaker.first": "backward", "time.end": 1.3, "output.interval": 0.01}
CHANGES = {
    "standard": SLICE | THREE_WAVES,
    "standard-3d": PAPER | THREE_WAVES,
    "printed": SLICE | TWO_WAVES | CLASSIC | {"scheme.gradient": "cmps"},
    "mps": SLICE | TWO_WAVES | CLASSIC | {"scheme.gradient": "mps"},
    "paper": SLICE | JET | {"scheme.recipe": "paper"},
    "film": PAPER | {"wavemaker.first": "backward", "time.end": 1.4, "output.interval": 0.01},
}
# Name of the picture, its run, and what draws it.
PICTURES = {
    "tank-196": ("standard", draw_tank),
    "tank-paper": ("printed", draw_tank),
    "tank-mps": ("mps", draw_tank),
    "tank": ("standard-3d", draw_tank),
    "breaker": ("standard", draw_breaker),
    "cmps": ("paper", draw_breaker),
}
FILM = "breaker.webp"
SHOT = {"start": 0.92, "window": (0.22, 0.54), "surface": True, "fps": 12.5, "width": 1200}


def run(name):
    """Folder of a finished run; goes on with one that has begun."""
    folder = RUNS / name
    line = [sys.executable, "-m", "mpslab.tank", "--no-pictures"]
    if (folder / "checkpoint.h5").exists():
        line += ["--resume", folder]
    else:
        line += ["plunging_breaker", "--out", folder]
        line += [f"--set={key}={value}" for key, value in CHANGES[name].items()]
    subprocess.run(line, check=True)
    return folder


def draw(name):
    """Draw a picture, or the film; returns its path."""
    if name == FILM:
        return film.make(run("film"), DOCS / FILM, **SHOT)[0]
    source, figure_of = PICTURES[name]
    found, path = open_run(run(source)), DOCS / f"{name}.png"
    with matplotlib.rc_context(STYLE):
        figure = figure_of(found.frames, found.tables)
        if figure is None:
            raise SystemExit(f"{name}: no wave breaks in {found.folder}")
        save_small(figure, path, LARGEST)
    return path


def main(names):
    """Make what these names name, or all pictures."""
    every = (*PICTURES, FILM)
    unknown = set(names) - set(every)
    if unknown:
        raise SystemExit(f"{', '.join(sorted(unknown))}: must be out of {', '.join(every)}")
    for name in names or PICTURES:
        print(draw(name))


if __name__ == "__main__":
    main(sys.argv[1:])
