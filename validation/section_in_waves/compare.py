"""Force of waves on a ship section that is held, against an experiment and linear theory."""

from pathlib import Path

import numpy as np

from validation.comparison import Comparison
from validation.data import read_columns
from validation.floating import radiation
from validation.ship_section.compare import BREADTH, DRAFT, outline
from validation.wave_analysis import last_harmonic

MODES = "sway", "heave"
PERIODS = 4  # at the end of a run, that harmonics are taken over
MODEL = 0.586  # m, how long the model was
MEASURED = Path(__file__).parent / "data" / "sundsdal2025_fixed_forces.csv"


def compare(runs):
    """Each period is judged; `empty-NAME` is the run without the section."""
    result, rows = Comparison(), []
    for name, run in runs.items():
        if name.startswith("empty"):
            continue
        seen, right = _Seen(run, runs[f"empty-{name}"]), _measured(run)
        period, key = run.case.wavemaker.period, name.replace(".", "")
        row = [name, 1e3 * run.spacing, 1e3 * seen.amplitude]
        for mode in MODES:
            theory = radiation.wave_force(outline(), run.depth, run.gravity, period, mode)
            result.measure(f"{key}_{mode}", seen.force[mode] / right.force[mode])
            result.measure(f"{key}_{mode}_theory", seen.force[mode] / theory)
            row += [seen.force[mode], right.force[mode], theory, seen.leads[mode],
                    right.leads[mode]]  # fmt: skip
        rows.append(row)
        figure = result.figure(f"Force in waves of {period:.3g} s", "time [s]", "force [N/m]")
        figure.line("sway", seen.time, seen.push[0])
        figure.line("heave", seen.time, seen.push[1])
    columns = ["run", "spacing [mm]", "amplitude at the axis [mm]"]
    for mode in MODES:
        columns += [mode, "measured", "linear theory", f"{mode} leads [deg]", "measured"]
    result.table("First harmonics of the force over rho g B a", columns, rows)
    return result


class _Force:
    """First harmonics over rho g B a, and by how much they lead the crest at the axis [deg]."""

    def __init__(self, force, leads):
        self.force, self.leads = (dict(zip(MODES, what, strict=True)) for what in (force, leads))


class _Seen(_Force):
    """The force in a run, and the waves in that without the section."""

    def __init__(self, run, empty):
        period, end = run.case.wavemaker.period, run.case.time.end
        forces, unit = run.table("forces"), run.density * run.gravity * BREADTH
        self.time = forces["time"]
        self.push = forces["section fx"], forces["section fz"] - unit * DRAFT
        wave = last_harmonic(*empty.gauge("axis"), period, end, PERIODS)
        parts = [last_harmonic(self.time, push, period, end, PERIODS) / wave
                 for push in self.push]  # fmt: skip
        self.amplitude = abs(wave)
        super().__init__(np.abs(parts) / unit, np.degrees(np.angle(parts)))


def _measured(run):
    """The experiment with the waves of a run."""
    table = read_columns(MEASURED)
    row = int(np.argmin(np.abs(table["T_s"] - run.case.wavemaker.period)))
    unit = run.density * run.gravity * BREADTH * MODEL * table["a_inc_m"][row]
    names = [f"F{mode}" for mode in MODES]
    return _Force([table[f"{name}_amp_N"][row] / unit for name in names],
                  [table[f"{name}_phase_lead_deg"][row] for name in names])  # fmt: skip
