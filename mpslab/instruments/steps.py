"""The steps: what each step took, and what the water holds after it."""

from functools import partial

import numpy as np

from mpslab.core import diagnostics
from mpslab.core.columns import STEP_COLUMNS
from mpslab.instruments import Instrument


def make(case):
    """The table of steps."""
    return Steps()


class Steps(Instrument):
    """Time step, solver, energies and volume of the water, force and work of the piston.

    Attributes
    ----------
    last : dict
        The last row, by the keys of `mpslab.core.columns.STEP_COLUMNS`.
    """

    name = "steps"
    columns = tuple(STEP_COLUMNS.values())
    words = {"dt_limit": 16}  # noqa: RUF012

    def __init__(self):
        self.last = {}

    def read(self, flow):
        """The row of the step that is done; none before the first."""
        if not flow.done:
            return []
        found = {**flow.done, "time": flow.time, **integrals(flow, flow.done["before"])}
        self.last = {key: found[key] for key in STEP_COLUMNS}
        return [tuple(self.last.values())]


def integrals(flow, before):
    """What the water holds now and what the piston did since `before` [s], a dict by column."""
    p, stencil, fluid = flow.particles, flow.stencil, flow.case.fluid
    water, total = _part(flow, p.fluid)
    piston, total_of_piston = _part(flow, p.moves_with_piston)
    force = diagnostics.piston_force(piston, stencil, total_of_piston)
    stroke = flow.solids.face(flow.time) - flow.solids.face(before)
    return {
        "max_speed": max(flow.domain.from_all(diagnostics.max_speed(p))),
        "kinetic_energy": diagnostics.kinetic_energy(water, stencil, fluid.density, total),
        "potential_energy": diagnostics.potential_energy(
            water, stencil, fluid.density, fluid.gravity, total
        ),
        "volume": diagnostics.volume(water, stencil, total),
        "piston_force": force,
        "piston_work": force * stroke,
    }


def _part(flow, mask):
    """The particles of a mask (n,), and a function that adds values of these over all ranks."""
    rows = np.flatnonzero(mask)
    return flow.particles.take(rows), partial(flow.domain.total, rows=rows)
