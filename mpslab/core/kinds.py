"""Kinds of particles, by which people tell them apart: in frames, pictures and counts.

The equations know roles, motion knows bodies (`mpslab.core.particles`); a kind says both in one
number.
"""

import numpy as np

from mpslab.core import particles as bodies
from mpslab.core.particles import FACE, FIRST_SOLID, TANK

FLUID, WALL, DUMMY, PISTON, PISTON_DUMMY, GATE, GATE_DUMMY = range(7)
KIND_NAMES = ("fluid", "wall", "dummy", "piston", "piston dummy", "gate",
              "gate dummy")  # fmt: skip


def kinds_of(case, particles):
    """Kinds of the particles of a case, (n,) int8."""
    table = _table(case)
    return table[np.minimum(particles.body, len(table) - 1), particles.role]


def _table(case):
    """Kind by body and role, (bodies, 3) int8; the last row is that of the user's own solids."""
    gates = FIRST_SOLID + len(case.obstacle)
    after = gates + len(case.gate)
    table = np.full((after + 1, 3), FLUID, np.int8)
    table[TANK:, FACE:] = WALL, DUMMY
    table[bodies.PISTON, FACE:] = PISTON, PISTON_DUMMY
    table[gates:after, FACE:] = GATE, GATE_DUMMY
    return table
