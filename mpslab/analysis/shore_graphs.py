"""Pictures of run-up, overtopping and the force on walls."""

from matplotlib.figure import Figure

from mpslab.analysis.headings import heading
from mpslab.analysis.pictures import COLOURS

NAMES = ("runup", "overtopping", "walls")


def draw(sea):
    """Draw what there are numbers for, within the style of `mpslab.analysis.graphs`.

    Yields
    ------
    str, matplotlib Figure
        "runup", "overtopping", "walls".
    """
    if sea.coast.runups:
        yield "runup", draw_runup(sea)
    if sea.coast.overtopped:
        yield "overtopping", draw_overtopping(sea)
    if sea.coast.pushed:
        yield "walls", draw_walls(sea)


def _axes(sea, count, title):
    """A figure with a row for each series, and their axes with the window."""
    figure = Figure(figsize=(10.0, 1.8 + 2.4 * count), layout="constrained")
    axes = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
    for ax in axes:
        ax.axvspan(sea.coast.window.start, sea.coast.window.end, color="0.94", linewidth=0)
        ax.axhline(0.0, color="0.6", linewidth=0.8)
    axes[-1].set_xlabel("time [s]")
    figure.suptitle(heading(sea.run.tables, title))
    return figure, axes


def draw_runup(sea):
    """The water's edge against time, with each run-up."""
    figure, axes = _axes(sea, len(sea.coast.runups), "Run-up above still water")
    table, zero = sea.run.table("runup"), sea.coast.level
    for ax, one in zip(axes, sea.coast.runups, strict=True):
        ax.plot(table["time"], 1e3 * (table[f"{one.name} level"] - zero), linewidth=0.8)
        ax.plot(one.peaks["time"], 1e3 * one.peaks["level"], "o", color=COLOURS[1], markersize=3)
        ax.set_title(f"{one.name}, {1e3 * one.thickness:.3g} mm thick", loc="left")
        ax.set_ylabel("[mm]")
    return figure


def draw_overtopping(sea):
    """What has passed each plane against time, with the peak of each event."""
    figure, axes = _axes(sea, len(sea.coast.overtopped), "Volume that has passed")
    table, width = sea.run.table("overtopping"), sea.run.tables["tank"]["width"] or 1.0
    for ax, one in zip(axes, sea.coast.overtopped, strict=True):
        onwards, back = (table[f"{one.name} {way}"] / width for way in ("onwards", "back"))
        ax.plot(table["time"], 1e3 * (onwards - back))
        for moment in one.events["time"]:
            ax.axvline(moment, color=COLOURS[1], linewidth=0.8, linestyle=":")
        ax.set_title(one.name, loc="left")
        ax.set_ylabel("[l/m]")
    return figure


def draw_walls(sea):
    """The force of the waves on each wall against time, with that of Goda."""
    figure, axes = _axes(sea, len(sea.coast.pushed), "Force of the waves on upright walls")
    table = sea.run.table("forces")
    for ax, one in zip(axes, sea.coast.pushed, strict=True):
        force = table[f"{one.name} fx"] / one.across - one.still
        ax.plot(table["time"], force, linewidth=0.8)
        ax.plot(one.peaks["time"], one.peaks["force"], "o", color=COLOURS[1], markersize=3)
        if one.expected is not None:
            ax.axhline(one.expected.force, color=COLOURS[1], linestyle="--", label="Goda")
            ax.legend()
        ax.set_title(one.name, loc="left")
        ax.set_ylabel("[N/m]")
    return figure
