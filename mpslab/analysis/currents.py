"""Mean currents: what the velocities at the probes of a run are in the mean of the waves."""

import numpy as np

WHOLE = 3  # waves, from which on a mean is taken over whole ones only

UNITS = {"x": "m", "y": "m", "z": "m", "u": "m/s", "v": "m/s", "w": "m/s",
         "u rms": "m/s", "w rms": "m/s", "wet": "-"}  # fmt: skip


def look(run, window, period):
    """The mean current at each probe, while it is under water.

    Parameters
    ----------
    run : mpslab.analysis.results.Run
    window : mpslab.analysis.windows.Window
        Of the time that the means are taken over.
    period : float [s]
        Of the waves: as many whole periods as there is room for, at the end of the window; if that
        is fewer than `WHOLE`, all of the window.

    Returns
    -------
    (probes,) structured array
        "name" and the fields of `UNITS`, in these units: the place; means of the velocity over the
        time for which the probe is wet, and the root mean squares of what they vary by; and the
        share of the time that this is.
    """
    probes = run.tables.get("probe", ())
    kind = [("name", f"U{max([len(p['name']) for p in probes], default=1)}")]
    found = np.full(len(probes), np.nan, kind + [(name, float) for name in UNITS])
    if not len(probes):
        return found
    time = run.probes["time"]
    start, waves = window.start, np.floor((window.end - window.start) / period + 1e-6)
    if waves >= WHOLE:
        start = window.end - waves * period
    seen = (time >= start) & (time <= window.end)
    for row, probe in zip(found, probes, strict=True):
        row["name"] = probe["name"]
        for axis in "xyz":
            row[axis] = probe.get(axis, np.nan)
        u, v, w = (run.probes[f"{probe['name']} {part}"][seen] for part in "uvw")
        wet = np.isfinite(u)
        row["wet"] = wet.mean() if len(wet) else 0.0
        if wet.any():
            for name, part in zip("uvw", (u, v, w), strict=True):
                row[name] = part[wet].mean()
            row["u rms"], row["w rms"] = u[wet].std(), w[wet].std()
    return found


def lines(found):
    """In words, a line for each probe that was ever wet."""
    for row in found:
        if row["wet"] > 0.0:
            part = "" if row["wet"] > 0.999 else f", under water for {100.0 * row['wet']:.0f} %"
            yield (
                f"current '{row['name']}', x = {row['x']:g} m, z = {row['z']:g} m: "
                f"u = {1e3 * row['u']:.3g} mm/s, w = {1e3 * row['w']:.3g} mm/s in the mean, rms "
                f"{1e3 * row['u rms']:.3g} and {1e3 * row['w rms']:.3g} mm/s about it{part}"
            )


def table(found):
    """Headings and rows of ``currents.csv``."""
    headings = ["probe", *(f"{name} [{unit}]" for name, unit in UNITS.items())]
    return headings, [list(row) for row in found]
