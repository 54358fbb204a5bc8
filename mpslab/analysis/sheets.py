"""Sea states as tables: CSV and JSON files, and the lines that a command prints."""

import csv
import json

import numpy as np

from mpslab.analysis import currents, shoreside
from mpslab.analysis.seastate import UNITS

PRINTED = ("x", "mean", "Hm0", "Hm0 scatter", "Tp", "Tm-1,0", "N", "H1/3", "H1/10", "Hmax")
PRINTED_REGULAR = ("x", "mean", "Hmean", "Tmean", "N", "a1", "a2", "a3")
MILLIMETRES = ("mean", "Hm0", "Hmean", "H1/3", "H1/10", "Hmax", "a1", "a2", "a3")


def write(sea, folder):
    """Write the tables of a sea state into a folder.

    ``gauges.csv``; ``waves.csv``, the single waves; ``spectra.csv``, with 95 % bands unless the
    waves are regular; ``reflection.csv``, ``currents.csv`` (at the probes), ``runups.csv``,
    ``overtopping.csv`` (its events) and ``walls.csv``, if there is anything to write; and
    ``sea.json``, which has everything but single waves and spectra.

    Parameters
    ----------
    sea : mpslab.analysis.seastate.Sea
    folder : Path

    Returns
    -------
    list of Path
    """
    tables = {"gauges": _gauges(sea), "waves": _waves(sea), "spectra": _spectra(sea)}
    if sea.reflection is not None:
        tables["reflection"] = _reflection(sea.reflection)
    if len(sea.currents):
        tables["currents"] = currents.table(sea.currents)
    tables |= shoreside.tables(sea.coast)
    paths = []
    for name, (headings, rows) in tables.items():
        paths.append(folder / f"{name}.csv")
        with paths[-1].open("w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([headings, *map(_cells, rows)])
    paths.append(folder / "sea.json")
    text = json.dumps(plain(as_dict(sea)), indent=2, allow_nan=False)
    paths[-1].write_text(text + "\n", encoding="utf-8")
    for name in {"reflection", "currents", "runups", "overtopping", "walls"} - set(tables):
        (folder / f"{name}.csv").unlink(missing_ok=True)
    return paths


def _gauges(sea):
    names = sea.gauges.dtype.names
    headings = [f"{name} [{UNITS[name]}]" if name in UNITS else name for name in names]
    return headings, [list(row) for row in sea.gauges]


def _waves(sea):
    headings = ["gauge", "time [s]", "period [s]", "height [m]", "crest [m]", "trough [m]"]
    return headings, [[name, *wave] for name, waves in sea.waves.items() for wave in waves]


def _spectra(sea):
    headings, columns = ["frequency [Hz]"], []
    for name, spectrum in sea.spectra.items():
        columns = columns or [spectrum.frequency]
        headings.append(f"{name} [m2 s]")
        columns.append(spectrum.density)
        if not sea.regular:
            headings += [f"{name} low [m2 s]", f"{name} high [m2 s]"]
            columns += spectrum.band()
    return headings, [list(row) for row in zip(*columns, strict=True)]


def _reflection(found):
    unit = "m" if found.regular else "m2 s"
    headings = ["frequency [Hz]", *(f"{n} [{unit}]" for n in ("incident", "reflected", "residual"))]
    columns = found.frequency, found.incident, found.reflected, found.residual
    return headings, [list(row) for row in zip(*columns, strict=True)]


def _cells(row):
    """Entries of a row, empty in place of NaN."""
    return ["" if cell != cell else cell for cell in (_bare(c) for c in row)]


def _bare(value):
    return value.item() if isinstance(value, np.generic) else value


def as_dict(sea):
    """A sea state without its series, a dict: windows, gauges, reflection, notes."""
    found = sea.reflection
    return {
        "run": str(sea.run.folder),
        "case": sea.run.tables["name"],
        "outcome": sea.run.outcome,
        "waves": "regular" if sea.regular else "irregular",
        "period [s]": sea.period,
        "window": _window(sea.window),
        "band [Hz]": list(sea.band),
        "crossing": sea.crossing,
        "freedom": None if sea.regular else next(iter(sea.spectra.values())).freedom,
        "gauges": [
            {
                f"{name} [{UNITS[name]}]" if name in UNITS else name: row[name]
                for name in sea.gauges.dtype.names
            }
            for row in sea.gauges
        ],
        "reflection": None
        if found is None
        else {
            "gauges": list(sea.array),
            "window": _window(sea.back),
            "incident_height [m]": found.incident_height,
            "reflected_height [m]": found.reflected_height,
            "kr": found.kr,
            "kr_primary": found.kr_primary,
            "unexplained": found.unexplained,
            "floor": found.floor,
            "lost": found.lost,
        },
        "currents": [
            {"name": row["name"], **{f"{n} [{u}]": row[n] for n, u in currents.UNITS.items()}}
            for row in sea.currents
        ],
        **shoreside.as_dict(sea.coast),
        "expected": [dict(zip(sea.expected.dtype.names, row, strict=True)) for row in sea.expected],
        "notes": list(sea.notes),
    }


def _window(window):
    return {"start [s]": window.start, "end [s]": window.end, "reason": window.reason}


def plain(value):
    """Numbers, lists and dicts as JSON has them: None in place of NaN."""
    if isinstance(value, dict):
        return {name: plain(part) for name, part in value.items()}
    if isinstance(value, list | tuple):
        return [plain(part) for part in value]
    value = _bare(value)
    return None if isinstance(value, float) and not np.isfinite(value) else value


def lines(sea):
    """What the command prints."""
    kind = (
        f"regular waves, T = {sea.period:.4g} s"
        if sea.regular
        else f"irregular waves, zero-{sea.crossing}-crossing"
    )
    shown = [f"{kind}; {sea.window}; heights from {sea.band[0]:.3g} to {sea.band[1]:.3g} Hz"]
    shown += _table(*gauge_table(sea))
    shown += [f"  {line}" for line in reflection_lines(sea)]
    shown += [f"  {line}" for line in currents.lines(sea.currents)]
    shown += [f"  {line}" for line in shoreside.lines(sea.coast)]
    shown += [f"  {line}" for line in expected_lines(sea)]
    return shown + [f"  ({note})" for note in sea.notes]


def gauge_table(sea):
    """Headings and rows of text, of the gauges."""
    names = PRINTED_REGULAR if sea.regular else PRINTED
    headings = ["gauge", *(_heading(name) for name in names)]
    rows = [[row["name"], *(_text(name, row[name]) for name in names)] for row in sea.gauges]
    return headings, rows


def _heading(name):
    unit = {"Hm0 scatter": "%", "N": ""}.get(name, "mm" if name in MILLIMETRES else UNITS[name])
    name = {"Hm0 scatter": "+-"}.get(name, name)
    return f"{name} [{unit}]" if unit else name


def _text(name, value):
    if not np.isfinite(value):
        return "-"
    if name == "N":
        return str(int(value))
    factor = 1e3 if name in MILLIMETRES else 100.0 if name == "Hm0 scatter" else 1.0
    return f"{factor * value:.3g}" if name != "x" else f"{value:g}"


def _table(headings, rows):
    widths = [max(len(row[k]) for row in [headings, *rows]) for k in range(len(headings))]
    return [
        "  " + "  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])])
        for row in [headings, *rows]
    ]


def reflection_lines(sea):
    """Incident and reflected waves in words."""
    found = sea.reflection
    if found is None:
        return []
    height, first = ("H", "first harmonic") if sea.regular else ("Hm0", "0.5 to 1.5 fp")
    rest = "no residual of two gauges"
    if np.isfinite(found.unexplained):
        rest = (
            f"residual {100.0 * found.unexplained:.2g} %; of such noise alone Kr would be "
            f"{found.floor:.2g}"
        )
    return [
        f"incident {height} = {1e3 * found.incident_height:.3g} mm, reflected "
        f"{1e3 * found.reflected_height:.3g} mm: Kr = {found.kr_primary:.3f} ({first}; {rest}), "
        f"{found.kr:.3f} over all frequencies",
        f"by least squares over {', '.join(sea.array)}; {sea.back}",
    ]


def expected_lines(sea):
    """What EurOtop expects, in words."""
    return [
        f"EurOtop 2018 ({row['relation']}): {row['name']} = {row['mean']:.3g} {row['unit']}, "
        f"{row['low']:.3g} to {row['high']:.3g} in 90 of 100"
        + (_measured(row) if np.isfinite(row["measured"]) else "")
        + (f" (outside of its tests: {row['doubts']})" if row["doubts"] else "")
        for row in sea.expected
    ]


def _measured(row):
    where = "in" if row["inside"] else "below" if row["measured"] < row["low"] else "above"
    return f"; measured {row['measured']:.3g}, {where} the band"
