"""What the water and its solids give each other: impulses and their moments.

Whatever acts between particles in a step (viscosity, pressure, stabilisers) acts pair by pair. To
know what a solid gives the water, the same model is evaluated for the pairs of the water with this
solid alone; the solid gets the opposite. So action equals reaction to rounding, with every model,
and nothing is integrated over a face: the impulse that the water got is the impulse that the solids
gave.
"""

import numpy as np

from mpslab.kernels import reaction as kernels
from mpslab.solids import parts

AXES = 3


class Exchange:
    """What some solids have a part in, of all that changes the velocity of the water in a step.

    Attributes
    ----------
    pairs : list of tuple
        For each of the solids its pairs with the water, as `Neighbourhood.only` takes them.
    beside : list of (m,) int
        Rows of the water that has such pairs.
    changes : list of (m, 3) float64 [m/s]
        How this water's velocity has changed by them.
    """

    def find(self, near, masks):
        """Find the pairs of the water with the solids of each mask, (n,) bool, among all pairs."""
        self.place = near.particles.position.copy()
        found = [_with_solids(near, mask) for mask in masks]
        self.beside, self.pairs = (list(part) for part in zip(*found, strict=True))
        self.changes = [np.zeros((len(rows), AXES)) for rows in self.beside]

    def add(self, near, act):
        """Note what the solids do to the water: what `act` gives for their pairs.

        near : Neighbourhood
        act : callable
            Takes a `Neighbourhood`, gives the change of velocity of its particles, (n, 3) [m/s].
        """
        for change, part in zip(self.changes, self.parts(near, act), strict=True):
            change += part

    def parts(self, near, act):
        """What `act` gives for the pairs of each of the solids, to the water beside it."""
        return [
            act(near.only(*pairs))[np.searchsorted(pairs[0], rows)]
            for rows, pairs in zip(self.beside, self.pairs, strict=True)
        ]

    def stabilise(self, near, act):
        """As `add` for an `act` that changes the velocity of a `Neighbourhood`'s particles in
        place.
        """

        def change(some):
            start = some.particles.velocity.copy()
            act(some)
            return some.particles.velocity - start

        self.add(near, change)

    def totals(self, domain, number, values):
        """What `Domain.totals` adds of values (m, k) of the water beside a solid: of its own."""
        rows = self.beside[number]
        mine = (domain.owned.start <= rows) & (rows < domain.owned.stop)
        return rows[mine], values[mine]

    def on_solid(self, number, change, about, width=0.0):
        """What the water beside a solid gives it, over the mass of a particle, and its moment.

        Parameters
        ----------
        number : int
            Of the solid.
        change : (m, 3) float64 [m/s]
            Of the velocity of the water beside it.
        about : (3,) float64 [m]
        width : float [m]
            Period across the tank, if an arm is to reach the nearest image.

        Returns
        -------
        (m, 6) float64 [m/s, m2/s]
        """
        arm = self.place.take(self.beside[number], 0) - about
        if width:
            arm[:, 1] -= width * np.round(arm[:, 1] / width)
        return -np.hstack([change, np.cross(arm, change)])


class Reaction(Exchange):
    """Adds up what solids give the water, from step to step.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    wanted : sequence of (str, (3,) float)
        Name of a solid (`mpslab.solids.parts`), and the point [m] about which its moment is taken.

    Attributes
    ----------
    span : float [s]
        Time that the sums are over.
    gained, pushed, given : (3,) float64 [kg m/s]
        Momentum that the water gained, and the parts of it from forcings and from all solids; in
        2-D for water 1 m wide.
    on : (k, 6) float64 [N s, N m s]
        Impulse on each solid that is wanted, and its moment.
    """

    def __init__(self, case, wanted):
        self.case, self.wanted = case, tuple(wanted)
        self.clear()

    def clear(self):
        """Begin to add up anew."""
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

    def find(self, near):
        """Find the pairs of the water with solids among those of the step."""
        particles = near.particles
        masks = [parts.mask(self.case, particles, name) for name, _ in self.wanted]
        super().find(near, [~particles.fluid, *masks])

    def end(self, flow, dt):
        """Add up the step, of all ranks, while its ghosts are still there."""
        particles, domain = flow.particles, flow.domain
        water = np.zeros(len(particles), bool)
        water[domain.owned] = particles.fluid[domain.owned]
        water = np.flatnonzero(water)
        before = self._before.take(water, 0)
        by_all = self.totals(domain, 0, self.changes[0])
        by_each = [self.totals(domain, k, self.on_solid(k, self.changes[k], about))
                   for k, (_, about) in enumerate(self.wanted, 1)]  # fmt: skip
        mass = self.case.fluid.density * flow.stencil.spacing**flow.stencil.dim
        self.sums += mass * domain.totals(
            (water, particles.velocity.take(water, 0) - before),
            (water, self._pushed.take(water, 0) - before),
            by_all,
            *by_each,
        )
        self.span += dt


def _with_solids(near, wanted):
    """Rows of the water that has pairs with the solids of a mask, and these pairs as
    `Neighbourhood.only` takes them.
    """
    first, found = np.empty_like(near.row), np.empty(len(near.other) + 1, np.int32)
    count = kernels.with_solids(
        near.particles.role, near.row, near.solid, near.other, wanted.view(np.uint8), first, found
    )
    pairs, each = found[:count].copy(), np.diff(first)
    water = np.flatnonzero(each)
    there = each > 0
    there[near.other.take(pairs)] = True
    members = np.flatnonzero(there)
    row = np.concatenate([[0], np.cumsum(each.take(members))]).astype(np.int32)
    return water, (members, row, pairs)
