"""Force of waves on a ship section that is held, against an experiment and linear theory."""

from functools import cache
from pathlib import Path

import numpy as np

from mpslab.analysis.harmonics import harmonics
from mpslab.theory.waves import group_celerity
from validation.comparison import Comparison
from validation.data import read_columns
from validation.floating import radiation
from validation.ship_section.compare import BREADTH, DRAFT, outline

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
        period = run.case.wavemaker.period
        heave = heave_force(period, run.depth, run.gravity)
        rows.append([name, 1e3 * run.spacing, 1e3 * seen.amplitude, seen.sway, right.sway,
                     seen.heave, right.heave, heave, seen.sway_leads, right.sway_leads,
                     seen.heave_leads, right.heave_leads])  # fmt: skip
        key = name.replace(".", "")
        result.measure(f"{key}_sway", seen.sway / right.sway)
        result.measure(f"{key}_heave", seen.heave / right.heave)
        result.measure(f"{key}_theory", seen.heave / heave)
        figure = result.figure(f"Force in waves of {period:.3g} s", "time [s]", "force [N/m]")
        figure.line("sway", seen.time, seen.push[0])
        figure.line("heave", seen.time, seen.push[1])
    columns = ["run", "spacing [mm]", "amplitude at the axis [mm]", "sway", "measured", "heave",
               "measured", "linear theory", "sway leads [deg]", "measured", "heave leads [deg]",
               "measured"]  # fmt: skip
    result.table("First harmonics of the force over rho g B a", columns, rows)
    return result


class _Force:
    """First harmonics over rho g B a, and by how much they lead the crest at the axis [deg]."""

    def __init__(self, sway, heave, sway_leads, heave_leads):
        self.sway, self.heave = sway, heave
        self.sway_leads, self.heave_leads = sway_leads, heave_leads


class _Seen(_Force):
    """The force in a run, and the waves in that without the section."""

    def __init__(self, run, empty):
        period, end = run.case.wavemaker.period, run.case.time.end
        forces, unit = run.table("forces"), run.density * run.gravity * BREADTH
        still = unit * DRAFT
        self.time = forces["time"]
        self.push = forces["section fx"], forces["section fz"] - still
        wave = _first(*empty.gauge("axis"), period, end)
        sway, heave = (_first(self.time, push, period, end) / wave for push in self.push)
        self.amplitude = abs(wave)
        super().__init__(abs(sway) / unit, abs(heave) / unit,
                         np.degrees(np.angle(sway)), np.degrees(np.angle(heave)))  # fmt: skip


def _first(time, signal, period, end):
    """First harmonic of the last periods before a time, with exp(i w t)."""
    return harmonics(time, signal, period, end - PERIODS * period, PERIODS)[1]


def _measured(run):
    """The experiment with the waves of a run."""
    table = read_columns(MEASURED)
    row = int(np.argmin(np.abs(table["T_s"] - run.case.wavemaker.period)))
    unit = run.density * run.gravity * BREADTH * MODEL * table["a_inc_m"][row]
    return _Force(
        table["Fsway_amp_N"][row] / unit, table["Fheave_amp_N"][row] / unit,
        table["Fsway_phase_lead_deg"][row], table["Fheave_phase_lead_deg"][row],
    )  # fmt: skip


@cache
def heave_force(period, depth, gravity):
    """Heave force of waves over rho g B a in linear theory.

    A body gets the force X of waves of amplitude a that, heaving, makes waves: X^2 = 2 rho g c_g b
    a^2, b being its damping (Haskind 1957; Newman 1977, section 6.18).
    """
    w, speed = 2.0 * np.pi / period, group_celerity(period, depth, gravity)
    frequency, _, damping = radiation.coefficients(outline(), depth, gravity)
    damping = w * np.interp(w, frequency, damping)  # of unit density
    return float(np.sqrt(2.0 * gravity * speed * damping) / (gravity * BREADTH))
