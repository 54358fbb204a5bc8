"""Headings of the tables of a run, and the names of the same series in memory."""

import re

from mpslab.core.stopwatch import COMMUNICATION, PHASES, WAITING

STEP_COLUMNS = {
    "step": "step",
    "time": "time [s]",
    "dt": "dt [s]",
    "dt_limit": "dt_limit",
    "iterations": "iterations",
    "residual": "residual",
    "seconds": "seconds",
    "max_speed": "max_speed [m/s]",
    "kinetic_energy": "kinetic_energy [J]",
    "potential_energy": "potential_energy [J]",
    "volume": "volume [m3]",
    "piston_force": "piston_force [N]",
    "piston_work": "piston_work [J]",
    "lost": "lost",
}
DECOMPOSITION_COLUMNS = {
    "step": "step",
    "time": "time [s]",
    "particles": "particles of each rank",
    "seconds": "work of each rank [s]",
    "waiting": "waiting of each rank [s]",
    "imbalance_before": "imbalance before",
    "imbalance_after": "imbalance after",
    "migrated": "migrated",
    "ghosts": "ghosts",
}
PHASE_COLUMNS = (
    "step",
    "time [s]",
    *(f"{phase}{part} [s/step]"
      for phase in PHASES for part in ("", f" {COMMUNICATION}", f" {WAITING}")),
)  # fmt: skip
LOST_COLUMNS = ("step", "time [s]", "gid", "x [m]", "y [m]", "z [m]", "reason")
PROBE_QUANTITIES = ("pressure [Pa]", "u [m/s]", "v [m/s]", "w [m/s]")
UNIT = re.compile(r" \[[^\[\]]*\]$")


def name_of(heading):
    """Name of the series of a column: "time" of "time [s]"."""
    return UNIT.sub("", heading)
