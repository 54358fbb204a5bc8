"""Run-up, overtopping and walls of a run as tables, as JSON and as lines of text."""

import numpy as np


def tables(coast):
    """Headings and rows by the name of the table: "runups", "overtopping" and "walls".

    Parameters
    ----------
    coast : mpslab.analysis.coast.Coast
    """
    found = {}
    if coast.runups:
        found["runups"] = (
            ["runup", "time [s]", "level [m]"],
            [[one.name, *peak] for one in coast.runups for peak in one.peaks],
        )
    if coast.overtopped:
        headings = ["plane", "time [s]", "volume [m3/m]", "layer [m]", "speed [m/s]"]
        found["overtopping"] = (
            headings,
            [[one.name, *event] for one in coast.overtopped for event in one.events],
        )
    if coast.pushed:
        found["walls"] = (
            ["force", "time [s]", "largest [N/m]"],
            [[one.name, *peak] for one in coast.pushed for peak in one.peaks],
        )
    return found


def as_dict(coast):
    """Everything but the single waves, for JSON."""
    return {
        "shore window": {
            "start [s]": coast.window.start,
            "end [s]": coast.window.end,
            "reason": coast.window.reason,
        },
        "runup": [
            {
                "name": one.name, "thickness [m]": one.thickness, "waves": len(one.peaks),
                "mean [m]": one.mean, "highest [m]": one.highest, "R2% [m]": one.r2,
                "fitted": one.fitted, "crest": one.crest,
            }
            for one in coast.runups
        ],
        "Hunt [m]": coast.hunt,
        "overtopping": [
            {
                "name": one.name, "freeboard [m]": one.freeboard, "volume [m3/m]": one.volume,
                "q [m2/s]": one.discharge, "q of a particle [m2/s]": one.quantum,
                "events": len(one.events), "Vmax [m3/m]": one.largest, "share": one.share,
                "layer [spacings]": one.layer, "resolved": bool(one.resolved),
            }
            for one in coast.overtopped
        ],
        "walls": [
            {
                "name": one.name, "still [N/m]": one.still, "largest [N/m]": one.largest,
                "mean of the largest [N/m]": one.mean, "least [N/m]": one.least,
                "Goda": None if one.expected is None else vars(one.expected),
            }
            for one in coast.pushed
        ],
    }  # fmt: skip


def lines(coast):
    """Run-up, overtopping and walls in words, a line each."""
    told = [_runup(one, coast.hunt) for one in coast.runups]
    told += [line for one in coast.overtopped for line in _overtopped(one)]
    told += [_pushed(one) for one in coast.pushed]
    return [*told, f"shore: {coast.window}"] if told else []


def _runup(one, hunt):
    words = f"run-up '{one.name}' of water {1e3 * one.thickness:.3g} mm thick: "
    if not len(one.peaks):
        return words + "none"
    words += f"mean {1e3 * one.mean:.3g} mm, highest {1e3 * one.highest:.3g} mm above still water"
    if np.isfinite(one.r2):
        words += f", R2% = {1e3 * one.r2:.3g} mm"
    if np.isfinite(hunt):
        words += f"; Hunt's law: {1e3 * hunt:.3g} mm"
    return words


def _overtopped(one):
    yield (
        f"overtopping '{one.name}', {1e3 * one.freeboard:.3g} mm above still water: q = "
        f"{1e3 * one.discharge:.3g} l/s/m ({1e3 * one.volume:.3g} l/m; a particle is "
        f"{1e3 * one.quantum:.2g} l/s/m)"
    )
    if len(one.events):
        speed = np.nanmean(one.events["speed"])
        yield (
            f"{len(one.events)} events, {100.0 * one.share:.3g} % of the waves; Vmax = "
            f"{1e3 * one.largest:.3g} l/m; the layer is {one.layer:.2g} spacings thick and runs at "
            f"{speed:.2g} m/s"
        )


def _pushed(one):
    words = (
        f"force '{one.name}': {one.mean:.4g} N/m in the mean of the waves, {one.largest:.4g} N/m "
        f"at most, {one.least:.4g} N/m at least, beyond {one.still:.4g} N/m of still water"
    )
    if one.expected is None:
        return words
    load = one.expected
    kind = "impulsive, Takahashi" if load.breaking else "Goda"
    return words + f"; {kind}: {load.force:.4g} N/m (p1 = {load.p1:.4g}, p3 = {load.p3:.4g} Pa)"
