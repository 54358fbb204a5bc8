"""Measures of a finished run, from its folder: ``python -m mpslab.measures FOLDER``.

Writes ``measures.csv``, a row for each frame of particles, and prints what they come to: order of
the water, breaking, where the energy went, and the wave at the gauges.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np

from mpslab.analysis import scatter
from mpslab.analysis.overturning import JET, find_crest
from mpslab.analysis.results import open_run
from mpslab.analysis.snapshots import middle_slice
from mpslab.core.kinds import WALL
from mpslab.terminal import unbroken

BAD_INPUT = 2
SETTLED = 0.25  # share of the run after which means are taken
PERIODS = 2  # at the end of a record, over which its harmonics are taken


def measure(run):
    """Measures of every frame.

    Parameters
    ----------
    run : mpslab.analysis.results.Run

    Returns
    -------
    list of dict
        One for each frame, by the headings of ``measures.csv``.

    Raises
    ------
    ValueError
        If it has no frames with velocity, pressure and kind.
    """
    case = run.tables
    missing = {"velocity", "pressure", "kind"} - set(case["output"]["fields"])
    if missing:
        raise ValueError(
            f"output.fields = {case['output']['fields']}: must hold {', '.join(sorted(missing))}"
        )
    return [_frame(frame, case) for frame in run.frames.required()]


def _frame(frame, case):
    spacing, width = case["particles"]["spacing"], case["tank"]["width"]
    period = width if case["tank"]["periodic"] else 0.0
    x, u = (field[frame.fluid].astype(float) for field in (frame.position, frame.velocity))
    row = {
        "time [s]": frame.time,
        "particle_volume [m3]": len(x) * spacing ** (3 if width else 2),
        "rms_speed [m/s]": np.sqrt(np.mean(np.sum(u**2, axis=1))),
        "mean_z [m]": x[:, 2].mean(),
        "isolated_share": scatter.isolated_share(x, spacing, period),
        "roughness [m/s]": scatter.roughness(x, u, spacing, period),
    }
    return row | _crest(frame, spacing, width) | _of_flat_bed(frame, x, case)


def _crest(frame, spacing, width):
    piece = middle_slice(frame.time, frame, spacing, width)
    apart = piece.apart(spacing)
    wet = apart if apart.any() else piece.fluid
    crest = find_crest(piece.x[wet], piece.z[wet], piece.speed[wet], spacing)
    return {
        "crest_x [m]": crest.x,
        "crest_z [m]": crest.z,
        "jet": crest.jet,
        "steepness": crest.steepness,
    }


def _of_flat_bed(frame, x, case):
    """Pressure on a flat bed, half a spacing below it, and the first mode of a standing wave."""
    tank, row = case["tank"], {}
    if max(z for _, z in tank["bed"]) == 0.0:
        place = frame.position
        bed = (frame.kind == WALL) & (place[:, 2] < 0.0)
        bed &= (place[:, 0] > 0.0) & (place[:, 0] < tank["length"])
        row["bed_pressure [Pa]"] = frame.pressure[bed].mean()
    if case["initial"]["type"] == "standing_wave":
        k = case["initial"]["mode"] * np.pi / tank["length"]
        area = case["particles"]["spacing"] ** 2
        layers = max(round(tank["width"] / case["particles"]["spacing"]), 1)
        row["first_mode [m]"] = 2.0 * area / (tank["length"] * layers) * np.cos(k * x[:, 0]).sum()
    return row


def ledger(steps):
    """Where the energy went.

    Parameters
    ----------
    steps : structured array (steps,)
        As of `mpslab.analysis.results.Run` and of a Simulation.

    Returns
    -------
    dict of str to float
        Work of the piston, and the changes of kinetic and potential energy since the first step;
        what is left over was dissipated [J].
    """
    kinetic, potential = steps["kinetic_energy"], steps["potential_energy"]
    book = {
        "work of the piston": float(steps["piston_work"][1:].sum()),
        "kinetic energy": float(kinetic[-1] - kinetic[0]),
        "potential energy": float(potential[-1] - potential[0]),
    }
    gained = book["kinetic energy"] + book["potential energy"]
    return book | {"dissipated": book["work of the piston"] - gained}


def harmonics(gauges, period):
    """First harmonic and height of the wave at each gauge, over its last two periods.

    Parameters
    ----------
    gauges : structured array (n,)
        As of `mpslab.analysis.results.Run` and of a Simulation.
    period : float [s]

    Returns
    -------
    list of (name, amplitude, height)
        Amplitude of the first harmonic, and highest less lowest level [m]; empty for a record
        shorter than three periods.
    """
    time = gauges["time"]
    if time[-1] - time[0] < (PERIODS + 1) * period:
        return []
    last = time > time[-1] - PERIODS * period
    phase = 2.0 * np.pi / period * time[last]
    waves = [f(k * phase) for k in (1, 2, 3) for f in (np.cos, np.sin)]
    terms = np.stack([np.ones_like(phase), *waves], axis=1)
    found = []
    for name in gauges.dtype.names[1:]:
        eta = gauges[name][last]
        if np.isfinite(eta).all():
            fit = np.linalg.lstsq(terms, eta, rcond=None)[0]
            found.append((name, np.hypot(fit[1], fit[2]), np.ptp(eta)))
    return found


def summary(rows, steps, gauges, period):
    """The lines that the command prints."""
    settled = [row for row in rows if row["time [s]"] >= SETTLED * rows[-1]["time [s]"]]
    lines = [f"{len(rows)} frames; means from t = {settled[0]['time [s]']:.3g} s on"]
    for name in ("rms_speed [m/s]", "isolated_share", "roughness [m/s]", "bed_pressure [Pa]"):
        values = [row[name] for row in settled if name in row]
        if values:
            lines.append(f"  {name}: {np.mean(values):.4g} +- {np.std(values):.2g}")
    jets = [row for row in rows if row["jet"] >= JET]
    if jets:
        lines.append(
            f"  overturns first at t = {jets[0]['time [s]']:.3f} s, "
            f"x = {jets[0]['crest_x [m]']:.3f} m, z = {jets[0]['crest_z [m]']:.3f} m"
        )
    if len(steps):
        lines.append(f"Volume over that of its particles: {_volume_share(rows, steps):.4f}")
        lines.append("Energy [J] (2-D: of a slice 1 m wide)")
        lines += [f"  {name}: {value:.5g}" for name, value in ledger(steps).items()]
    if len(gauges) and period > 0.0:
        lines += [
            f"  gauge {name}: first harmonic {1e3 * amplitude:.2f} mm, height {1e3 * height:.2f} mm"
            for name, amplitude, height in harmonics(gauges, period)
        ]
    return lines


def _volume_share(rows, steps):
    """Volume in the last step over the volume of the particles in the last frame."""
    return steps["volume"][-1] / rows[-1]["particle_volume [m3]"]


def write(path, rows):
    """Write the rows as a CSV file."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, rows[0].keys())
        table.writeheader()
        table.writerows(rows)


def main(arguments=None):
    """Run the command line; returns the exit status, 0 or 2 for bad input."""
    with unbroken():
        return _main(arguments)


def _main(arguments):
    parser = argparse.ArgumentParser(prog="python -m mpslab.measures", description=__doc__)
    parser.add_argument("folder", type=Path, help="folder of a run")
    folder = parser.parse_args(arguments).folder
    try:
        run = open_run(folder)
        rows = measure(run)
    except ValueError as error:
        print(f"mpslab: {error}", file=sys.stderr)
        return BAD_INPUT
    write(folder / "measures.csv", rows)
    print("\n".join(summary(rows, run.steps, run.gauges, run.tables["wavemaker"]["period"])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
