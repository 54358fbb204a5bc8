"""The particles that a case starts with: its water and its solids.

Water particles stand half a spacing off every boundary, wall particles half a spacing behind it.
"""

import numpy as np

from mpslab.core.keys import CaseError
from mpslab.core.lattice import at_row, effective_length, rows_across
from mpslab.core.particles import FIRST_SOLID, FLUID, WATER, make_particles
from mpslab.forcings import forcings_of, total
from mpslab.later import scipy
from mpslab.solids import filling, obstacles, shaped
from mpslab.solids.collection import solids_of


def period(case):
    """Period across the tank [m], 0 when it is walled or 2-D."""
    periodic = case.tank.periodic and case.tank.width > 0.0
    return rows_across(case) * case.particles.spacing if periodic else 0.0


def extent(case, backmost=0.0):
    """Where the bed begins and ends in x, the layers behind the end walls included [m].

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    """
    spacing = case.particles.spacing
    beyond = case.particles.layers * spacing
    behind = np.ceil(-backmost / spacing) * spacing + beyond
    return -behind, effective_length(case) + beyond


def build_particles(case, backmost=0.0, own=()):
    """Particles of a case at rest, with hydrostatic pressure.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    backmost : float [m]
        Least displacement of the piston; the bed reaches that far behind it.
    own : sequence of solids
        The user's, in addition to those of the case.
    """
    spacing = case.particles.spacing
    wet = water(case, own)
    if not len(wet):
        raise CaseError("solid: must leave room for the water: where they stand there is none left")
    parts = [(wet, np.full(len(wet), FLUID), WATER)]
    for body, solid in solids_of(case, backmost=backmost, own=own).bodies.items():
        parts.append((*solid.particles(case), body))
    position = np.vstack([place for place, _, _ in parts])
    role = np.concatenate([role for _, role, _ in parts])
    body = np.concatenate([np.full(len(place), body) for place, _, body in parts])
    cell = np.floor(position / spacing + 1e-6)
    order = np.lexsort((position[:, 2], cell[:, 1], cell[:, 0]))
    particles = make_particles(position[order], role[order], body[order])
    _set_hydrostatic(case, particles)
    if np.any(body >= FIRST_SOLID):
        obstacles.press(case, particles)
    return particles


def water(case, own=()):
    """Water of all rows across the tank, each particle displaced a little at random: (n, 3) [m]."""
    spacing, flat = case.particles.spacing, case.dim == 2
    sections = [filling.section(case, row) for row in range(1 if flat else len(filling.PHASES))]
    rows = []
    for row in range(rows_across(case)):
        y, section = 0.0 if flat else (row + 0.5) * spacing, sections[row % len(sections)]
        wet = flat | ((section[:, 2] < y) & (y < section[:, 3]))
        rows.append(at_row(section[wet], y))
    place = np.vstack(rows)
    place += _jitter(case, len(place))
    for solid in own:
        place = place[~solid.holds(place)]
    return shaped.give_way(case, place)


def _jitter(case, n):
    random = np.random.default_rng(case.particles.seed)
    move = random.uniform(-1.0, 1.0, (n, 3)) * case.particles.jitter * case.particles.spacing
    if case.tank.width == 0.0:
        move[:, 1] = 0.0
    return move


def _set_hydrostatic(case, particles):
    """Start from the pressure of the water column above each particle."""
    fluid = particles.fluid
    if not fluid.any():
        return
    spacing = case.particles.spacing
    column = np.floor(particles.position[:, 0] / spacing).astype(int)
    column = np.clip(column, 0, round(effective_length(case) / spacing) - 1)
    top = np.full(column.max() + 1, -np.inf)
    np.maximum.at(top, column[fluid], particles.position[fluid, 2] + 0.5 * spacing)
    depth = np.maximum(top[column] - particles.position[:, 2], 0.0)
    down = -total(forcings_of(case), particles, 0.0)[..., 2]
    weight = case.fluid.density * np.maximum(down, 0.0)
    particles.pressure[:] = np.where(particles.carries_pressure, weight * depth, 0.0)
    if case.water:  # which may float above the bed
        off = scipy.spatial.cKDTree(particles.position[fluid]).query(particles.position)[0]
        particles.pressure[off > obstacles.NEAR * spacing] = 0.0
