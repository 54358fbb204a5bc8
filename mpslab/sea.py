"""The waves of a run, as an engineer reads them off: ``python -m mpslab.sea RUN``.

At each gauge heights, periods and the spectrum; incident and reflected waves; run-up, overtopping
and the force on walls beside EurOtop and Goda; tables, pictures and a page. From Python:

>>> from mpslab import sea
>>> found = sea.look("results", start=20.0)
>>> found.gauges["Hm0"], sea.UNITS["Hm0"], found.reflection.kr_primary
"""

import io
import sys
from pathlib import Path

from mpslab.analysis import reflection, seastate, sheets
from mpslab.analysis.results import open_run
from mpslab.analysis.seastate import UNITS, Sea
from mpslab.core.files import FULL
from mpslab.terminal import Parser, unbroken

__all__ = ["UNITS", "Sea", "look", "write"]

BAD_INPUT, FAILED = 2, 3


def look(folder, **options):
    """The waves of a run, finished or not.

    Parameters
    ----------
    folder : str or Path
        A run folder.
    options
        As of `mpslab.analysis.seastate.analyse`: start, end, gauges, period, crossing, segment,
        band, weights.

    Returns
    -------
    mpslab.analysis.seastate.Sea

    Raises
    ------
    ValueError
        Of bad input, in one line.
    """
    return seastate.analyse(open_run(folder), **options)


def write(sea, folder=None):
    """Write tables, pictures and the page of a sea state.

    Parameters
    ----------
    sea : mpslab.analysis.seastate.Sea
    folder : str or Path, optional
        ``sea`` in the run folder by default; it is made.

    Returns
    -------
    list of Path
        ``page.html``, if jinja2 is there, comes last.
    """
    from mpslab.analysis import graphs, page

    folder = sea.run.folder / "sea" if folder is None else Path(folder)
    folder.mkdir(exist_ok=True)
    paths, pictures = sheets.write(sea, folder), {}
    for name, figure in graphs.draw(sea):
        content = io.BytesIO()
        figure.savefig(content, format="png")
        pictures[name] = content.getvalue()
        paths.append(folder / f"{name}.png")
        paths[-1].write_bytes(pictures[name])
    for name in set(graphs.NAMES) - set(pictures):
        (folder / f"{name}.png").unlink(missing_ok=True)
    html = folder / "page.html"
    html.unlink(missing_ok=True)
    if page.available():
        html.write_text(page.render(sea, pictures), encoding="utf-8")
        paths.append(html)
    return paths


def _parser():
    parser = Parser(
        prog="python -m mpslab.sea",
        description="Waves of a run, finished or not: heights, periods, spectra, reflection; "
        "run-up, overtopping and the force on walls.",
        epilog="Example: python -m mpslab.sea results --from 20 --gauges g1 g2 g3",
    )
    parser.add_argument("run", metavar="RUN", help="folder of a run")
    parser.add_argument("--from", type=float, dest="start", metavar="S",
                        help="start of the window [s] (when the waves have come)")  # fmt: skip
    parser.add_argument("--to", type=float, dest="end", metavar="S",
                        help="end of the window [s] (the last reading)")  # fmt: skip
    parser.add_argument("--gauges", nargs="+", metavar="NAME",
                        help="those that incident and reflected waves are taken from")  # fmt: skip
    parser.add_argument("--period", type=float, metavar="S",
                        help="take the waves as regular ones of this period")  # fmt: skip
    parser.add_argument("--crossing", default="down", choices=("down", "up"),
                        help="where a wave begins (down)")  # fmt: skip
    parser.add_argument("--segment", type=float, metavar="S", help="of the spectra [s]")
    parser.add_argument("--band", type=float, nargs=2, metavar=("F0", "F1"),
                        help="frequencies of heights and periods [Hz]")  # fmt: skip
    parser.add_argument("--weights", default="equal", choices=reflection.WEIGHTS,
                        help="of the gauges (equal); spacing: Zelt and Skjelbreia")  # fmt: skip
    parser.add_argument("--out", metavar="DIR", help="folder of the results (sea in RUN)")
    return parser


def main(arguments=None):
    """Run the command line; returns the exit status.

    0: done; 2: bad input, nothing done; 3: the results could not be written.
    """
    with unbroken():
        return _main(arguments)


def _main(arguments):
    try:
        options = vars(_parser().parse_args(arguments))
        folder, out = options.pop("run"), options.pop("out")
        if out and not Path(out).absolute().parent.is_dir():
            raise ValueError(f"--out {out}: there is no folder {Path(out).absolute().parent}")
        found = look(folder, **options)
    except ValueError as error:
        print(f"mpslab: {error}", file=sys.stderr)
        return BAD_INPUT
    print("\n".join(sheets.lines(found)))
    try:
        paths = write(found, out)
    except OSError as error:
        reason = FULL.get(error.errno) or " ".join(str(error).split())
        print(f"mpslab: the results were not written ({reason})", file=sys.stderr)
        return FAILED
    print("\n".join(map(str, paths)))
    if paths[-1].suffix != ".html":
        print("(no page.html: it needs jinja2, pip install jinja2)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
