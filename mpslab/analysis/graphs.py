"""Pictures of a sea state: levels with their waves, spectra, incident and reflected waves."""

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from mpslab.analysis import shore_graphs
from mpslab.analysis.headings import heading
from mpslab.analysis.pictures import COLOURS, STYLE
from mpslab.analysis.seastate import AMPLITUDES

MOST = 12  # gauges in a picture
HIGHEST = 2.0  # times the largest density: a band is drawn up to there
NAMES = ("levels", "spectra", "harmonics", "reflection", *shore_graphs.NAMES)
SHOWN = 4.0  # times the peak frequency: a spectrum is drawn up to there


def draw(sea):
    """Draw the pictures that a sea state has numbers for.

    Parameters
    ----------
    sea : mpslab.analysis.seastate.Sea

    Yields
    ------
    str, matplotlib Figure
        "levels"; "spectra", or for regular waves "harmonics"; "reflection"; "runup", "overtopping"
        and "walls".
    """
    with matplotlib.rc_context(STYLE):
        yield "levels", draw_levels(sea)
        if sea.regular:
            yield "harmonics", draw_harmonics(sea)
        else:
            yield "spectra", draw_spectra(sea)
        if sea.reflection is not None:
            yield "reflection", draw_reflection(sea)
        yield from shore_graphs.draw(sea)


def _shown(sea):
    """Names of the gauges in a picture: all, or 12 spread over them; and what the title says."""
    names = list(sea.spectra)
    if len(names) <= MOST:
        return names, ""
    picked = np.unique(np.linspace(0, len(names) - 1, MOST).round().astype(int))
    return [names[k] for k in picked], f"; {MOST} of {len(names)} gauges"


def draw_levels(sea):
    """Elevation at the gauges against time, with the window, crests and troughs."""
    names, part = _shown(sea)
    figure = Figure(figsize=(10.0, 1.8 + 1.5 * len(names)), layout="constrained")
    axes = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    case = sea.run.tables
    zero = 0.0 if case.get("water") else case["tank"]["depth"]
    for ax, name in zip(axes, names, strict=True):
        ax.axhline(0.0, color="0.6", linewidth=0.8)
        ax.axvspan(sea.window.start, sea.window.end, color="0.94", linewidth=0)
        ax.plot(sea.run.gauges["time"], 1e3 * (sea.run.gauges[name] - zero), linewidth=0.8)
        _mark(ax, sea, name)
        ax.set_title(name, loc="left")
        ax.set_ylabel("[mm]")
    axes[-1].set_xlabel("time [s]")
    title = f"Elevation, and crest and trough of each wave in the window{part}"
    figure.suptitle(heading(case, title))
    return figure


def _mark(ax, sea, name):
    """Dots at the crests and troughs of a gauge."""
    time = sea.readings.time
    level = 1e3 * sea.readings.elevation[:, sea.readings.names.index(name)]
    ends = []
    for wave in sea.waves[name]:
        rows = np.flatnonzero((time >= wave["time"]) & (time <= wave["time"] + wave["period"]))
        if len(rows):
            ends += [rows[np.argmax(level[rows])], rows[np.argmin(level[rows])]]
    ax.plot(time[ends], level[ends], "o", color=COLOURS[1], markersize=3, linestyle="")


def draw_spectra(sea):
    """Variance density at the gauges with its 95 % band."""
    names, part = _shown(sea)
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure = Figure(figsize=(3.6 * columns + 1.0, 2.6 * rows + 1.4), layout="constrained")
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for ax in grid.flat[len(names) :]:
        ax.set_visible(False)
    for ax, name in zip(grid.flat, names, strict=False):
        spectrum = sea.spectra[name]
        low, high = spectrum.band()
        ax.fill_between(spectrum.frequency, 1e6 * low, 1e6 * high, color="0.85", linewidth=0)
        ax.plot(spectrum.frequency, 1e6 * spectrum.density)
        ax.axvspan(0.0, sea.band[0], color="0.94", linewidth=0, zorder=0)
        ax.set_xlim(0.0, min(SHOWN / sea.period, spectrum.frequency[-1]))
        ax.set_title(name, loc="left")
    highest = max(sea.spectra[name].density.max() for name in names)
    top = max(sea.spectra[name].band()[1].max() for name in names)
    grid[0, 0].set_ylim(0.0, 1e6 * min(1.05 * top, HIGHEST * highest))
    for ax in grid.flat[max(len(names) - columns, 0) : len(names)]:  # the lowest of each column
        ax.set_xlabel("frequency [Hz]")
        ax.tick_params(labelbottom=True)
    for ax in grid[:, 0]:
        ax.set_ylabel("density [mm$^2$ s]")
    freedom = sea.spectra[names[0]].freedom
    title = f"Spectra with 95 % band, {freedom:.3g} degrees of freedom{part}"
    figure.suptitle(heading(sea.run.tables, title, 80))
    return figure


def draw_harmonics(sea):
    """Amplitudes of the harmonics of regular waves along the tank."""
    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    ax = figure.subplots()
    order = np.argsort(sea.gauges["x"])
    for number, (name, marker) in enumerate(zip(AMPLITUDES, "osD^", strict=True)):
        ax.plot(sea.gauges["x"][order], 1e3 * sea.gauges[name][order], marker, markersize=4,
                linestyle="-", linewidth=0.8, label=f"harmonic {number + 1}")  # fmt: skip
    ax.set(xlabel="x [m]", ylabel="amplitude [mm]")
    ax.set_ylim(bottom=0.0)
    ax.legend()
    figure.suptitle(heading(sea.run.tables, "Harmonics at the gauges"))
    return figure


def draw_reflection(sea):
    """Incident and reflected waves against frequency."""
    found = sea.reflection
    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    ax = figure.subplots()
    factor, unit = (1e3, "amplitude [mm]") if found.regular else (1e6, "density [mm$^2$ s]")
    style = {"marker": "o", "linestyle": ""} if found.regular else {}
    series = {"incident": found.incident, "reflected": found.reflected, "residual": found.residual}
    colours = (*COLOURS[:2], "0.5")
    for (name, values), colour in zip(series.items(), colours, strict=True):
        ax.plot(found.frequency, factor * values, color=colour, label=name, **style)
    if not found.regular:
        ax.set_xlim(0.0, min(SHOWN / sea.period, found.frequency[-1]))
    ax.set_ylim(bottom=0.0)
    ax.set(xlabel="frequency [Hz]", ylabel=unit)
    ax.legend()
    what = "first harmonic" if found.regular else "0.5 to 1.5 fp"
    title = f"Incident and reflected waves: Kr = {found.kr_primary:.3f} ({what})"
    figure.suptitle(heading(sea.run.tables, title))
    return figure
