"""Solids, and parts of the tank, by the names that a case calls them."""

import numpy as np

from mpslab.core.lattice import effective_length, rows_across
from mpslab.core.particles import FIRST_SOLID, PISTON, TANK


def names(case):
    """Names of all solids of a case and of the parts of its tank, a tuple."""
    piston = () if case.wavemaker.type == "none" else ("piston",)
    return ("tank", "bed", "end_wall", *piston, *_solids(case))


def mask(case, particles, name):
    """Which particles a solid or a part of the tank consists of, (n,) bool.

    "tank" is the bed and all walls; "end_wall" is the part of it beyond the length of the tank, and
    "bed" the part that is neither behind nor beside a wall.
    """
    if name == "piston":
        return particles.body == PISTON
    if name not in ("tank", "bed", "end_wall"):
        return particles.body == FIRST_SOLID + _solids(case).index(name)
    tank, beyond = particles.body == TANK, particles.position[:, 0] > effective_length(case)
    if name == "tank":
        return tank
    return tank & beyond if name == "end_wall" else tank & ~beyond & _between(case, particles)


def _between(case, particles):
    """Which particles are between the wall at x = 0, if there is one, and the side walls."""
    x, y = particles.position[:, 0], particles.position[:, 1]
    inside = (x > 0.0) if case.wavemaker.type == "none" else np.ones(len(x), bool)
    if case.dim == 3 and not case.tank.periodic:
        inside &= (y > 0.0) & (y < rows_across(case) * case.particles.spacing)
    return inside


def _solids(case):
    """Names of the solids of a case beside tank and piston, in the order of their bodies."""
    return tuple(solid.name for solid in (*case.obstacle, *case.gate, *case.solid))
