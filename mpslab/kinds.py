"""Kinds of particles, by which people tell them apart: in frames, pictures and counts.

The equations know roles, motion knows bodies (`mpslab.particles`); a kind says both in one number.
"""

import numpy as np

from mpslab import particles as bodies
from mpslab.particles import FACE, FIRST_SOLID, TANK

FLUID, WALL, DUMMY, PISTON, PISTON_DUMMY, GATE, GATE_DUMMY = range(7)
KIND_NAMES = ("fluid", "wall", "dummy", "piston", "piston dummy", "gate",
              "gate dummy")  # fmt: skip


def kinds_of(case, particles):
    """Kinds of the particles of a case, (n,) int8."""
    return _table(case)[particles.body, particles.role]


def _table(case):
    """Kind by body and role, (bodies, 3) int8."""
    table = np.full((FIRST_SOLID + len(case.obstacle) + len(case.gate), 3), FLUID, np.int8)
    table[TANK:, FACE:] = WALL, DUMMY
    table[bodies.PISTON, FACE:] = PISTON, PISTON_DUMMY
    table[FIRST_SOLID + len(case.obstacle) :, FACE:] = GATE, GATE_DUMMY
    return table
