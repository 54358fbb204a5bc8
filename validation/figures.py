"""Figures of the report, drawn from the numbers that the cases leave."""

import base64
import io

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator
from PIL import Image

from mpslab.analysis.pictures import COLOURS, STYLE

PAGE_STYLE = STYLE | {
    "font.size": 10,
    "axes.labelsize": 10,
    "axes.edgecolor": "0.35",
    "axes.labelcolor": "0.15",
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "0.92",
    "grid.linewidth": 0.7,
    "xtick.color": "0.35",
    "ytick.color": "0.35",
    "xtick.labelcolor": "0.15",
    "ytick.labelcolor": "0.15",
    "lines.linewidth": 1.5,
    "legend.fontsize": 9,
    "savefig.dpi": 200,
    "savefig.pad_inches": 0.04,
    "svg.hashsalt": "mpslab",  # the same bytes for the same numbers
}
# What is held against: never told by colour alone, black first.
INKS = ("#000000", "0.45", *COLOURS[1:6])
DASHES = ((0, (5, 2.5)), (0, (1.5, 1.5)), (0, (7, 2, 1.5, 2)), (0, (3, 5)))
MARKERS = "os^Dv"
BANDS = ("0.84", "#cfe3f1", "#f7dccb")
WIDTH, HEIGHT = 5.4, 3.5  # [inch]
WIDE = 7.8  # [inch], of a figure with equal scales
MANY = 80  # points of a series
LARGEST_SVG = 64_000  # bytes; a figure that takes more becomes a PNG


def draw(figure):
    """Draw a figure of the results.

    Parameters
    ----------
    figure : dict
        ``x`` and ``y``, the labels of the axes; ``equal``, whether a length is as long on both;
        and ``series``, each with ``label``, ``style`` ("line", "dashed", "points" or "band"),
        ``x``, ``y`` and, for a band, its upper edge ``y2``.

    Returns
    -------
    matplotlib Figure
    """
    with matplotlib.rc_context(PAGE_STYLE):
        drawn = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        ax = drawn.subplots()
        drawers = {"line": _line, "dashed": _dashed, "points": _points, "band": _band}
        count = dict.fromkeys(drawers, 0)
        for series in figure["series"]:
            style = series["style"]
            drawers[style](ax, series, count[style])
            count[style] += 1
        ax.set(xlabel=figure["x"], ylabel=figure["y"])
        if figure["equal"]:
            ax.set_aspect("equal", anchor="N")  # what is left over below is cut off
            ratio = np.ptp(ax.get_ylim()) / np.ptp(ax.get_xlim())
            drawn.set_size_inches(WIDE, np.clip((WIDE - 0.8) * ratio, 0.8, 6.0) + 1.2)
        if ax.get_legend_handles_labels()[1]:
            columns = 2 if figure["equal"] or len(figure["series"]) > 3 else 1
            drawn.legend(loc="outside upper left", ncols=columns)
    return drawn


def _numbers(series, *names):
    """Columns of a series, (n,) floats; what is missing is nan, which leaves a gap."""
    return [np.array(series[name], float) for name in names]


def _line(ax, series, k):
    colour = COLOURS[k % len(COLOURS)]
    ax.plot(*_numbers(series, "x", "y"), color=colour, label=series["label"], zorder=3)


def _dashed(ax, series, k):
    ax.plot(
        *_numbers(series, "x", "y"),
        color=INKS[k % len(INKS)],
        linestyle=DASHES[k % len(DASHES)],
        linewidth=1.3,
        label=series["label"],
        zorder=4,
    )


def _points(ax, series, k):
    """Few points stand before the lines; many are small, and stand behind them."""
    few = len(series["x"]) <= MANY
    ax.plot(
        *_numbers(series, "x", "y"),
        color=INKS[k % len(INKS)],
        marker=MARKERS[k % len(MARKERS)],
        markersize=5.0 if few else 2.5,
        markerfacecolor="white",
        markeredgewidth=1.0 if few else 0.5,
        linestyle="none",
        label=series["label"],
        zorder=5 if few else 2,
    )


def _band(ax, series, k):
    colour = BANDS[k % len(BANDS)]
    ax.fill_between(
        *_numbers(series, "x", "y", "y2"), color=colour, label=series["label"], linewidth=0
    )


def draw_convergence(entry):
    """Draw errors against the particle spacing, both logarithmic, and the line of their order.

    Parameters
    ----------
    entry : dict
        ``spacing`` [m] and ``error``, (n,) each, and ``order``, the slope that was found.

    Returns
    -------
    matplotlib Figure
    """
    spacing, error = 1e3 * np.array(entry["spacing"], float), np.abs(_numbers(entry, "error")[0])
    order, seen = np.array(entry["order"], float), error > 0.0
    with matplotlib.rc_context(PAGE_STYLE):
        drawn = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        ax = drawn.subplots()
        ax.loglog(spacing[seen], error[seen], "o", markersize=7, label="measured", zorder=3)
        if np.isfinite(order):
            middle, mean = (np.exp(np.log(a[seen]).mean()) for a in (spacing, error))
            along = np.array([spacing.min() / 1.15, spacing.max() * 1.15])
            line = mean * (along / middle) ** order
            label = f"order {order:.3g}"
            ax.plot(along, line, color="black", linestyle=DASHES[0], linewidth=1.2, label=label)
        ax.set(xlabel="particle spacing [mm]", ylabel="error")
        ax.set_xlim(spacing.min() / 1.3, spacing.max() * 1.3)
        low, high = ax.get_ylim()
        ax.set_ylim(low / 1.4, high * 1.4)
        plain = FuncFormatter(lambda value, _: f"{value:g}")
        ax.xaxis.set_major_locator(FixedLocator(spacing))
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(plain)
            axis.set_minor_locator(NullLocator())
        drawn.legend(loc="outside upper left", ncols=2)
    return drawn


def data_url(figure):
    """A figure as the source of an image: an SVG, or a PNG where the SVG would be large.

    Parameters
    ----------
    figure : matplotlib Figure

    Returns
    -------
    str
        A ``data:`` URL, the same for the same figure.
    """
    svg = _save(figure, "svg", {"Date": None, "Creator": None})
    if len(svg) <= LARGEST_SVG:
        return _embed(svg, "image/svg+xml")
    return picture_url(_save(figure, "png", {"Software": None}))


def _save(figure, kind, metadata):
    """Bytes of the figure in a file format."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(PAGE_STYLE):
        figure.savefig(buffer, format=kind, metadata=metadata)
    return buffer.getvalue()


def picture_url(content):
    """The bytes of a picture as a ``data:`` URL, of a PNG of few colours, which is small."""
    picture = Image.open(io.BytesIO(content)).convert("RGBA")
    sheet = Image.new("RGBA", picture.size, "white")
    sheet.alpha_composite(picture)
    buffer = io.BytesIO()
    few = sheet.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    few.save(buffer, "PNG", optimize=True)
    return _embed(buffer.getvalue(), "image/png")


def _embed(content, kind):
    """Bytes of a MIME type as a ``data:`` URL."""
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"
