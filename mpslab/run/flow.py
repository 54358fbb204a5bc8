"""What a run works on from step to step: the particles, and the models that a case names."""

import json
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np

from mpslab.core import plugins
from mpslab.core.cells import make_cells
from mpslab.core.neighbors import NeighborList
from mpslab.core.neighbourhood import Neighbourhood
from mpslab.core.particles import ParticleSet
from mpslab.core.stencil import Stencil, make_stencil
from mpslab.forcings import forcings_of
from mpslab.parallel.domain import Domain
from mpslab.parallel.slabs import make_slabs
from mpslab.run.coupling import coupling_of
from mpslab.solids import layout
from mpslab.solids.collection import Solids


@dataclass
class Flow:
    """All that a time step works on.

    Attributes
    ----------
    case : mpslab.core.parameters.Case
    particles : ParticleSet
        Those that this rank owns; within a step also its ghosts.
    solids : Solids
    stencil, laplacian_stencil : Stencil
        Of the number density and of the Laplacian.
    domain : Domain
    forcings : tuple
        Of the case, and the user's own.
    neighbors : NeighborList
        Where the pressure acted last.
    near, near_gradient : Neighbourhood
        The same pairs with their geometry, and with the radius of the gradient.
    time : float [s]
    done : dict
        What the loop says of the last step, for the table of steps; empty before the first.
    readings : dict of str to float
        What the gauges read last, by name [m], for a paddle that goes by it.
    reaction : mpslab.models.reaction.Reaction or None
        Adds up what solids give the water, where the case asks for forces.
    coupling : mpslab.run.coupling.Coupling or None
        Finds how the water moves free bodies, where there are some.
    compression : float [1/s]
        Largest rate at which the water of this rank ran together in the last step, before the
        pressure acted.
    """

    case: object
    particles: ParticleSet
    solids: Solids
    stencil: Stencil
    laplacian_stencil: Stencil
    domain: Domain
    gradient: ModuleType
    source: ModuleType
    solver: ModuleType
    pair_terms: tuple
    stabilisers: tuple
    forcings: tuple
    near: Neighbourhood
    near_gradient: Neighbourhood
    neighbors: NeighborList = field(default_factory=NeighborList)
    time: float = 0.0
    done: dict = field(default_factory=dict)
    readings: dict = field(default_factory=dict)
    reaction: object = None
    coupling: object = None
    compression: float = 0.0

    @property
    def stopwatch(self):
        """That of the domain, which counts communication and waiting."""
        return self.domain.stopwatch

    @property
    def exchanges(self):
        """Who is to be told what solids have a part in, in a step."""
        return [one for one in (self.reaction, self.coupling) if one]

    @property
    def extrapolates(self):
        """Whether the walls take their pressure from the water in front of them."""
        return self.case.scheme.walls == "extrapolated"

    @property
    def copies(self):
        """Whether the layers behind the first one of a wall have a copy of its pressure."""
        return self.case.scheme.walls == "copied"

    @property
    def unknowns(self):
        """Mask of the particles whose pressure is an unknown of the equation, (n,) bool."""
        return self.particles.fluid if self.extrapolates else self.particles.carries_pressure

    def idle(self, particles):
        """Mask of the solids' particles that are too far from the water to be seen by it.

        None where a solid's pressure is an unknown, or where the water moves on before its
        neighbours are found.
        """
        if not self.extrapolates or self.case.scheme.projection == "predicted":
            return np.zeros(len(particles), bool)
        still = self.solids.still(particles)
        return still & ~self.domain.cells.near(particles.position, still, particles.fluid)

    def state(self):
        """What a checkpoint keeps beside the particles: names to numbers and strings.

        All ranks call it, and get the same.
        """
        return {
            "time": self.time,
            "compression": max(self.domain.from_all(self.compression)),
            "readings": json.dumps(self.readings),
            **self.solids.state(),
        }

    def restore(self, state):
        """Take back what `state` gave."""
        self.time, self.compression = state["time"], state.get("compression", 0.0)
        self.readings.update(json.loads(state["readings"]))
        self.solids.restore(state)


def make_flow(case, particles, solids, width, forcings=(), comm=None):
    """Load the models that a case names.

    Parameters
    ----------
    particles : ParticleSet
        All particles of the tank, on rank 0; the flow keeps those of this rank.
    solids : Solids
        Of this tank; on rank 0 they look at all particles before these are shared out.
    width : float [m]
        Period across the tank, 0 when not periodic.
    forcings : sequence of forcings
        Beside those of the case.
    comm : communicator, optional
        As for `mpslab.parallel.domain.Domain`.

    Raises
    ------
    ValueError
        If the models, or the tank, cannot be shared out among so many ranks.
    """
    scheme, spacing = case.scheme, case.particles.spacing
    dim = 2 if case.tank.width == 0.0 else 3
    stencil, gradient_stencil, laplacian_stencil = (
        make_stencil(dim, spacing, radius, width)
        for radius in (scheme.effective_radius, scheme.radius_of_gradient, scheme.laplacian_radius)
    )
    slabs = slabs_of(case, solids.piston.paddle if solids.piston else None)
    domain = Domain(slabs, comm, cells_of(case, slabs, width))
    solver = solver_of(case, domain.size)
    solids.begin(particles, domain.comm)
    near, forcings = Neighbourhood(stencil), forcings_of(case, forcings)
    return Flow(
        case=case,
        particles=domain.take_part(particles, case.parallel.balance),
        solids=solids,
        stencil=stencil,
        laplacian_stencil=laplacian_stencil,
        domain=domain,
        gradient=plugins.load("gradients", scheme.gradient),
        source=plugins.load("sources", scheme.source),
        solver=solver,
        pair_terms=plugins.load("laplacians", scheme.laplacian).pair_terms(laplacian_stencil),
        stabilisers=tuple(plugins.load("stabilisers", name) for name in scheme.stabiliser),
        forcings=forcings,
        coupling=coupling_of(case, solids, forcings),
        near=near,
        near_gradient=near if gradient_stencil == stencil else Neighbourhood(gradient_stencil),
    )


def slabs_of(case, paddle):
    """The slabs of the tank of a case with a paddle, None for a fixed wall."""
    extent = layout.extent(case, paddle.backmost if paddle else 0.0)
    return make_slabs(*extent, case.scheme.reach * case.particles.spacing)


def cells_of(case, slabs, width):
    """The cells of the tank of a case; `width` is its period [m], 0 when not periodic."""
    tank, spacing = case.tank, case.particles.spacing
    beyond = case.particles.layers * spacing
    lower = np.array([slabs.lower, 0.0, 0.0]) - beyond
    upper = np.array([slabs.lower, tank.width, tank.height]) + beyond
    return make_cells(lower, upper, case.scheme.reach * spacing, width, slabs)


def solver_of(case, ranks):
    """The solver that a case names; ValueError if it cannot work on so many ranks."""
    solver = plugins.load("solvers", case.scheme.solver)
    if ranks > 1 and not solver.BY_SLAB:
        raise ValueError(
            f'scheme.solver = "{case.scheme.solver}": runs on one rank only; on {ranks} ranks '
            'choose "deflated", "piccg" or "scg"'
        )
    return solver
