"""One page about a sea state, in HTML; it loads nothing, because it holds its pictures."""

import base64
from pathlib import Path

from mpslab.analysis import currents, sheets, shoreside


def available():
    """Whether jinja2, which draws the page, is installed."""
    try:
        import jinja2  # noqa: F401
    except ImportError:
        return False
    return True


def render(sea, pictures):
    """The page as text.

    Parameters
    ----------
    sea : mpslab.analysis.seastate.Sea
    pictures : dict of str to bytes
        PNG files by their names.

    Returns
    -------
    str
    """
    headings, rows = sheets.gauge_table(sea)
    return templates(Path(__file__).parent).get_template("page.html.j2").render(
        case=sea.run.tables,
        sea=sea,
        outcome=sea.run.outcome or "unknown",
        headings=headings,
        rows=rows,
        reflection=sheets.reflection_lines(sea),
        currents=[*currents.lines(sea.currents)],
        shore=shoreside.lines(sea.coast),
        expected=sheets.expected_lines(sea),
        pictures={name: _url(content) for name, content in pictures.items()},
    )


def templates(folder):
    """The templates in a folder, as a jinja2 environment in which an undefined name is an error."""
    import jinja2

    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _url(png):
    return f"data:image/png;base64,{base64.b64encode(png).decode('ascii')}"
