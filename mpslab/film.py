"""A film of a run, from its folder: ``python -m mpslab.film RUN``.

Each frame of particles becomes a picture of the film, 2-D from the side, 3-D from ahead of the
wave and above. A run that goes on can be filmed as far as it has come.
"""

import os
import sys
import time as clock
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from mpslab.analysis.results import open_run
from mpslab.analysis.scenes import reel, scene
from mpslab.analysis.scenes.stills import Shot, box_of
from mpslab.core.files import FULL
from mpslab.run.progress import LINE_EVERY, make_bar
from mpslab.terminal import Parser, unbroken

BAD_INPUT, FAILED, INTERRUPTED = 2, 3, 130
FIELDS = {"speed": "velocity", "along": "velocity", "pressure": "pressure", "none": None}
FPS, WIDTHS, NARROWEST = (1.0, 60.0), (240, 3840), 8  # 1/s, pixels, spacings
GLANCES = 5  # frames that tell how high the water goes


def make(
    folder, out=None, field="speed", fps=25.0, width=1280, start=None, end=None, window=None,
    surface=False, limit=None, progress=None,
):  # fmt: skip
    """Make a film of a run.

    Parameters
    ----------
    folder : str or Path
        A run folder.
    out : str or Path, optional
        The film, .mp4, .webp or .gif; ``film.mp4`` in the run folder by default, ``film.webp``
        where there is no ffmpeg.
    field : str
        What colours the water: "speed", "along" (velocity along the tank), "pressure" or "none".
    fps : float [1/s]
        Frames of the run that are shown in a second, 1 to 60.
    width : int [pixels]
        240 to 3840, made even.
    start, end : float [s], optional
        Times of the run at which the film begins and ends.
    window : (float, float) [m], optional
        What part of the tank is shown along x.
    surface : bool
        Of a 3-D run: show the surface of the water in place of its particles.
    limit : float [MB], optional
        Quality and size are lowered until the file is as small, or cannot be lowered further.
    progress : function (done, total), optional
        Called before the first frame is drawn and after each.

    Returns
    -------
    path : Path
    size : int [bytes]
    rung : int
        How many times quality or size were lowered for the limit.

    Raises
    ------
    ValueError
        Of bad input, in one line.
    RuntimeError
        If ffmpeg fails.
    OSError
        If the film cannot be written.
    """
    run = open_run(folder)
    out = Path(out) if out else run.folder / f"film{default_suffix()}"
    case, frames = run.tables, run.frames
    _check_options(out, fps, width, limit)
    times = frames.required().times
    picked = _picked(times, start, end)
    _check_field(field, case, frames)
    if surface and not case["tank"]["width"]:
        raise ValueError("--surface: is of a run in 3-D; this one is in 2-D")
    window = _clipped(window, case)
    glances = picked[np.unique(np.linspace(0, len(picked) - 1, GLANCES).astype(int))]
    box = box_of((frames[k] for k in glances), case, window)
    interval = float(np.median(np.diff(times[picked])))
    shot = Shot(case, box, field, 2 * round(0.5 * width), pace(fps * interval), surface)
    draw, progress = shot.painter(), progress or (lambda done, total: None)
    with reel.Reel() as pictures:
        progress(0, len(picked))
        for done, index in enumerate(picked):
            pictures.append(draw(times[index], frames[index]))
            progress(done + 1, len(picked))
        return out, *reel.write(pictures, out, fps, limit)


def default_suffix():
    """Format of a film that is not told: ".mp4" where there is ffmpeg, or else ".webp"."""
    return ".mp4" if reel.find_ffmpeg() else ".webp"


def pace(speed):
    """How fast a film plays, in words; `speed` is seconds of the run in a second of the film."""
    if abs(speed - 1.0) < 0.02:
        return "real speed"
    return f"1/{1.0 / speed:.2g} of real speed" if speed < 1.0 else f"{speed:.2g} x real speed"


def _check_options(out, fps, width, limit):
    reel.check_path(out)
    if not out.parent.is_dir():
        raise ValueError(f"--out {out}: there is no folder {out.parent}")
    if not os.access(out.parent, os.W_OK):
        raise ValueError(f"--out {out}: the folder {out.parent} cannot be written to")
    if not FPS[0] <= fps <= FPS[1]:
        raise ValueError(f"--fps {fps:g}: must be from {FPS[0]:g} to {FPS[1]:g}")
    if not WIDTHS[0] <= width <= WIDTHS[1]:
        raise ValueError(f"--width {width}: must be from {WIDTHS[0]} to {WIDTHS[1]} pixels")
    if limit is not None and not 0.0 < limit < np.inf:
        raise ValueError(f"--limit {limit:g}: must be above 0 MB")


def _picked(times, start, end):
    """Numbers of the frames between two times."""
    first, last = times[0], times[-1]
    begin, stop = (first if start is None else start), (last if end is None else end)
    picked = np.flatnonzero((times >= begin - 1e-9) & (times <= stop + 1e-9))
    if len(picked) < 2:
        raise ValueError(
            f"--from {begin:g} --to {stop:g}: {len(picked)} of the frames lie there, a film needs "
            f"2; the run has {len(times)} from {first:.4g} to {last:.4g} s"
        )
    return picked


def _check_field(field, case, frames):
    if field not in FIELDS:
        raise ValueError(f"--field {field}: must be out of {', '.join(FIELDS)}")
    wanted, held = FIELDS[field], frames[0]
    if wanted and wanted not in held:
        raise ValueError(f"--field {field}: the frames hold no {wanted}; allowed: --field none")
    if field == "pressure" and not case["fluid"]["gravity"]:
        raise ValueError("--field pressure: has no scale without gravity; allowed: --field speed")
    if not held.fluid.any():
        raise ValueError(f"'{frames.path}': the first frame holds no water")


def _clipped(window, case):
    """The part of a window that lies in the tank."""
    if window is None:
        return None
    length, spacing = case["tank"]["length"], case["particles"]["spacing"]
    left, right = max(window[0], 0.0), min(window[1], length)
    if not right - left >= NARROWEST * spacing:
        raise ValueError(
            f"--window {window[0]:g} {window[1]:g}: must hold {NARROWEST} particle spacings or "
            f"more, from left to right, of the tank, which reaches from 0 to {length:g} m"
        )
    return left, right


def _parser():
    parser = Parser(
        prog="python -m mpslab.film",
        description="Make a film of a run, 2-D or 3-D, finished or not.",
        epilog="Example: python -m mpslab.film results --window 0.4 0.7 --from 1.2 --surface",
    )
    parser.add_argument("run", metavar="RUN", help="folder of a run")
    parser.add_argument("--out", metavar="FILE",
                        help=".mp4, .webp or .gif; by default film.mp4 in the folder of the run, "
                        "film.webp where there is no ffmpeg")  # fmt: skip
    parser.add_argument("--field", default="speed", metavar="NAME",
                        help=f"what colours the water: {', '.join(FIELDS)}")  # fmt: skip
    parser.add_argument("--fps", type=float, default=25.0, metavar="N",
                        help="frames of the run in a second of the film (25)")  # fmt: skip
    parser.add_argument("--width", type=int, default=1280, metavar="PX",
                        help="of the film (1280)")  # fmt: skip
    parser.add_argument("--from", type=float, dest="start", metavar="S", help="first time [s]")
    parser.add_argument("--to", type=float, dest="end", metavar="S", help="last time [s]")
    parser.add_argument("--window", type=float, nargs=2, metavar=("X0", "X1"),
                        help="show the tank between these places [m]")  # fmt: skip
    parser.add_argument("--surface", action="store_true",
                        help="3-D: show the surface of the water, not its particles")  # fmt: skip
    parser.add_argument("--limit", type=float, metavar="MB",
                        help="lower quality, then size, until the file is as small")  # fmt: skip
    return parser


def main(arguments=None):
    """Run the command line; returns the exit status.

    0: done; 2: bad input, nothing done; 3: the film could not be written, or is larger than the
    limit at the lowest quality; 130: stopped by Ctrl-C.
    """
    with unbroken():
        return _main(arguments)


def _main(arguments):
    try:
        options = vars(_parser().parse_args(arguments))
        folder = options.pop("run")
        with _progress() as progress:
            path, size, rung = make(folder, progress=progress, **options)
    except ValueError as error:
        print(f"mpslab: {error}", file=sys.stderr)
        return BAD_INPUT
    except (OSError, RuntimeError) as error:
        reason = FULL.get(getattr(error, "errno", None)) or " ".join(str(error).split())
        print(f"mpslab: the film was not written ({reason})", file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        print("mpslab: stopped, no film was written", file=sys.stderr)
        return INTERRUPTED
    if options["out"] is None and path.suffix == ".webp":
        print("There is no ffmpeg for .mp4 (pip install 'mpslab[film]'): the film is a .webp")
    if scene.available() == "plain":
        print("(3-D is drawn without pyvista, which draws faster: pip install 'mpslab[viz]')")
    limit = options["limit"]
    print(reel.told(path, size, rung, limit))
    return FAILED if limit is not None and size > limit * reel.MEGABYTE else 0


@contextmanager
def _progress():
    """A bar on a terminal, lines in a log; a function (done, total)."""
    from rich.console import Console

    console = Console()
    if not console.is_terminal:
        yield _Lines()
        return
    with make_bar(console) as bar:
        task = bar.add_task("starting", total=None)

        def show(done, total):
            bar.update(task, completed=done, total=total, description=f"frame {done} of {total}")

        yield show


class _Lines:
    """A line every few seconds."""

    def __init__(self):
        self.began = self.printed = clock.monotonic()

    def __call__(self, done, total):
        now = clock.monotonic()
        if done and now - self.printed >= LINE_EVERY:
            self.printed = now
            left = (now - self.began) * (total - done) / done
            print(f"frame {done} of {total}, {left:.0f} s left", flush=True)


if __name__ == "__main__":
    sys.exit(main())
