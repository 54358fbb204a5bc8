"""The pressure of a step: assemble the Poisson equation and solve it."""

import numpy as np

from mpslab.kernels import poisson
from mpslab.parallel import slabs
from mpslab.pressure.blocks import Blocks
from mpslab.pressure.system import PressureSystem

FAR = 100_000  # cells; all places farther away are in the same one


def assemble(
    near, stencil, pair_terms, density, source, unknowns=None, surface_pull=None, domain=None
):
    """System of the particles that carry a pressure and are not at the surface.

    Parameters
    ----------
    near : Neighbourhood
        Of the places where the pressure acts, the surface of its particles marked.
    stencil : Stencil of the Laplacian
    pair_terms : tuple
        Of the Laplacian; see :mod:`mpslab.models.laplacians`.
    density : float [kg/m3]
    source : (n,) float64 [1/s2]
        Right-hand side for all particles.
    unknowns : (n,) bool, optional
        Particles whose pressure is in the equation, by default all that carry one; the others are
        left out, which means dp/dn = 0.
    surface_pull : (n,) float64, optional
        Added to the diagonal; with it, surface particles have rows as all others.
    domain : mpslab.parallel.domain.Domain, optional
        That of the particles; with it, the slabs are the system's blocks: rows are in the order of
        the particles, and so slab by slab.

    Returns
    -------
    system : PressureSystem
    rows : (m,) int
        Particle of each row.
    """
    particles = near.particles
    unknowns = particles.carries_pressure if unknowns is None else unknowns
    inner = particles.surface == 0 if surface_pull is None else True
    rows = np.flatnonzero(unknowns & inner).astype(np.int32)
    blocks = None
    if domain:
        slabs_ = np.arange(domain.slabs.count + 1)
        blocks = Blocks(np.searchsorted(domain.slab.take(rows), slabs_), domain)
    m, most = len(rows), len(near.other)
    unknown = np.where(unknowns, -1, -2).astype(np.int32)
    unknown[rows] = np.arange(m, dtype=np.int32)
    row, diagonal, excess = np.empty(m + 1, np.int32), np.empty(m), np.empty(m)
    column, value = np.empty(most, np.int32), np.empty(most, np.float32)
    entries = poisson.assemble(
        near.row, near.other, near.inverse, rows, unknown, stencil, pair_terms, 1.0 / density,
        row, column, value, diagonal, excess,
    )  # fmt: skip
    column, value = column[:entries], value[:entries]
    if surface_pull is not None:
        diagonal += surface_pull[rows]
        excess += surface_pull[rows]
    cell = cells(near.position.take(rows, 0)[:, 1:3], slabs.WIDTH * stencil.radius)
    system = PressureSystem(row, column, value, diagonal, source[rows], blocks, cell)
    system.blocks.refresh(diagonal)
    _hold_cut_off_rows(system, excess)
    return system, rows


def cells(place, width):
    """Cell of each place [m] in y or z; a place that is not a number has a cell as well."""
    return np.fmin(np.fmax(np.floor(place / width), -FAR), FAR).astype(np.int32)


def _hold_cut_off_rows(system, excess):
    """Make the diagonal larger in rows that no path ties to the surface, which would be singular.

    It is doubled; where it is 0, because no neighbour has a pressure, it becomes the largest of
    all.
    """
    alone = ~_reached(system, excess > 0.0)
    diagonal, collect = system.diagonal, system.blocks.from_all
    if any(collect(bool(alone.any()))):
        largest = max(collect(float(diagonal.max(initial=0.0)))) or 1.0
        diagonal[alone] = np.where(diagonal[alone] > 0.0, 2.0 * diagonal[alone], largest)


def _reached(system, tied):
    """Rows that a path leads to from those that are tied to the surface, (m,) bool.

    Each rank looks among its own rows and ghosts, until no path leads across a border any more.
    """
    reached, blocks = tied.astype(np.uint8), system.blocks
    blocks.refresh(reached)
    while True:
        poisson.reach(system.row, system.column, reached)
        found = reached.copy()
        blocks.refresh(reached)
        if not any(blocks.from_all(bool(np.any(reached != found)))):
            return reached.astype(bool)


def solve(system, rows, particles, solver, tolerance, max_iterations, clip, solution=None):
    """Solve for the pressure of particles, in place; zero at the surface and, with `clip`, where
    < 0.

    solution : (m,) float64 [Pa], optional
        Where to start, and what was found, in place; the last pressure unless given.
    """
    solution = particles.pressure[rows] if solution is None else solution
    report = solver.solve(system, solution, tolerance, max_iterations)
    particles.pressure[:] = 0.0
    particles.pressure[rows] = np.maximum(solution, 0.0) if clip else solution
    return report
