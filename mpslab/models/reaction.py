"""What the water and its solids give each other: impulses and their moments.

Whatever acts between particles in a step (viscosity, pressure, stabilisers) acts pair by pair. To
know what a solid gives the water, the same model is evaluated for the pairs of the water with this
solid alone; the solid gets the opposite. So action equals reaction to rounding, with every model,
and nothing is integrated over a face: the impulse that the water got is the impulse that the solids
gave.
"""

from dataclasses import replace

import numpy as np

from mpslab.kernels import reaction as kernels
from mpslab.solids import parts

AXES = 3


class Exchange:
    """What some solids have a part in, of all that changes the velocity of the water in a step."""

    def find(self, near, masks):
        """Find the pairs of the water with the solids of each mask, (n,) bool, among all pairs."""
        self.place = near.particles.position.copy()
        self.pairs = [_with_solids(near, mask) for mask in masks]
        self.changes = [np.zeros_like(near.particles.velocity) for _ in self.pairs]

    def add(self, near, act):
        """Note what the solids do to the water: what `act` gives for their pairs.

        near : Neighbourhood
        act : callable
            Takes a `Neighbourhood`, gives the change of velocity of its particles, (n, 3) [m/s].
        """
        for change, pairs in zip(self.changes, self.pairs, strict=True):
            change += act(near.only(*pairs))

    def stabilise(self, near, act):
        """As `add` for an `act` that changes the velocity of a `Neighbourhood`'s particles in
        place.
        """

        def change(some):
            start = near.particles.velocity
            tried = replace(
                near.particles, position=near.particles.position.copy(), velocity=start.copy()
            )
            act(some.of(tried))
            return tried.velocity - start

        self.add(near, change)

    def beside(self, number, particles, owned):
        """Rows of the water of this rank that has pairs with the solids of a mask."""
        water = np.zeros(len(particles), bool)
        water[owned] = particles.fluid[owned]
        return np.flatnonzero(water & (np.diff(self.pairs[number][0]) > 0))

    def on_solid(self, change, rows, about, width=0.0):
        """Velocity that the solids get from the rows of the water, less its sign, and its moment.

        Parameters
        ----------
        change : (m, 3) float64 [m/s]
            Of the velocity of these rows.
        about : (3,) float64 [m]
        width : float [m]
            Period across the tank, if an arm is to reach the nearest image.

        Returns
        -------
        (m, 6) float64 [m/s, m2/s]
        """
        arm = self.place.take(rows, 0) - about
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
        near = self.beside(0, particles, domain.owned)
        before = self._before.take(water, 0)
        by_all, *by_each = (change.take(near, 0) for change in self.changes)
        on = [self.on_solid(change, near, about)
              for (_, about), change in zip(self.wanted, by_each, strict=True)]  # fmt: skip
        mass = self.case.fluid.density * flow.stencil.spacing**flow.stencil.dim
        self.sums += mass * domain.totals(
            (water, particles.velocity.take(water, 0) - before),
            (water, self._pushed.take(water, 0) - before),
            (near, np.hstack([by_all, *on])),
        )
        self.span += dt


def _with_solids(near, wanted):
    """Rows and numbers of the pairs of water with the solids of a mask, as `only` takes them."""
    first, found = np.empty_like(near.row), np.empty(len(near.other) + 1, np.int32)
    count = kernels.with_solids(
        near.particles.role, near.row, near.solid, near.other, wanted.view(np.uint8), first, found
    )
    return first, found[:count].copy()
