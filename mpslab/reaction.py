"""What the water and its solids give each other: impulses and their moments.

Whatever acts between particles in a step (viscosity, pressure, stabilisers) acts pair by pair. What
a solid gives the water is what the same model makes of the pairs of the water with this solid
alone, and the solid gets the opposite. So action is reaction to rounding, with every model, and
nothing is integrated over a face: impulse that the water got is impulse that a solid gave.
"""

from dataclasses import replace

import numpy as np

from mpslab import parts
from mpslab.kernels import reaction as kernels
from mpslab.neighbors import NeighborList

AXES = 3


class Reaction:
    """Adds up what solids give the water, from step to step.

    Parameters
    ----------
    case : mpslab.parameters.Case
    wanted : sequence of (str, (3,) float)
        Name of a solid (`mpslab.parts`), and the point [m] about which its moment is taken.

    Attributes
    ----------
    span : float [s]
        Time over which was added up.
    gained, pushed, given : (3,) float64 [kg m/s]
        What momentum the water gained, and what of it from gravity and from all solids; in 2-D of
        water 1 m wide.
    on : (k, 6) float64 [N s, N m s]
        Impulse on each solid that is wanted, and its moment.
    """

    def __init__(self, case, wanted):
        self.case, self.wanted = case, tuple(wanted)
        self.clear()

    def clear(self):
        """Begin anew to add up."""
        self.take(0.0, np.zeros(AXES * (3 + 2 * len(self.wanted))))

    def take(self, span, sums):
        """Go on from what was added up before, as `span` and `sums` were."""
        self.span, self.sums = span, np.array(sums)
        self.gained, self.pushed, self.given = self.sums[: 3 * AXES].reshape(3, AXES)
        self.on = self.sums[3 * AXES :].reshape(-1, 2 * AXES)

    def begin(self, particles, before):
        """The particles of a step, ghosts among them, after what acts on each alone.

        before : (n, 3) float64 [m/s], their velocities at the start of the step
        """
        self._before, self._pushed = before, particles.velocity.copy()
        self._place = particles.position.copy()

    def find(self, particles, neighbors):
        """Find the pairs of the water with solids in the neighbour list of the step."""
        solids = _with_solids(particles.role, neighbors)
        masks = [parts.mask(self.case, particles, name) for name, _ in self.wanted]
        self._lists = [solids, *(_with(solids, mask) for mask in masks)]
        self._changes = [np.zeros_like(particles.velocity) for _ in self._lists]

    def add(self, act):
        """Note what solids do to the water, by what `act` makes of their pairs.

        act : callable
            Gives the change of velocity of the particles, (n, 3) [m/s], by a `NeighborList`.
        """
        for change, pairs in zip(self._changes, self._lists, strict=True):
            change += act(pairs)

    def stabilise(self, act, particles):
        """As `add` for what `act`, of a set of particles and a list, does to their velocity."""

        def change(pairs):
            tried = replace(
                particles, position=particles.position.copy(), velocity=particles.velocity.copy()
            )
            act(tried, pairs)
            return tried.velocity - particles.velocity

        self.add(change)

    def end(self, flow, dt):
        """Add up the step, of all ranks, while its ghosts are still there."""
        particles, domain = flow.particles, flow.domain
        water = np.flatnonzero(particles.fluid & domain.owned)
        near = water[np.diff(self._lists[0].indptr)[water] > 0]
        before = self._before.take(water, 0)
        by_all, *by_each = (change.take(near, 0) for change in self._changes)
        place = self._place.take(near, 0)
        moments = [np.cross(place - about, change)
                   for (_, about), change in zip(self.wanted, by_each, strict=True)]  # fmt: skip
        on = [-part for pair in zip(by_each, moments, strict=True) for part in pair]
        mass = self.case.fluid.density * flow.stencil.spacing**flow.stencil.dim
        self.sums += mass * domain.totals(
            (water, particles.velocity.take(water, 0) - before),
            (water, self._pushed.take(water, 0) - before),
            (near, np.hstack([by_all, *on])),
        )
        self.span += dt


def _with_solids(role, neighbors):
    """The pairs of water with solids of a neighbour list, as such a list."""
    first, found = np.empty_like(neighbors.indptr), np.empty_like(neighbors.indices)
    count = kernels.with_solids(role, neighbors.indptr, neighbors.indices, first, found)
    return NeighborList(first, found[:count].copy())


def _with(solids, mask):
    """What of such a list are pairs with the particles of a mask."""
    kept = mask[solids.indices]
    first = np.append(0, np.cumsum(kept))[solids.indptr].astype(np.int32)
    return NeighborList(first, solids.indices[kept])
