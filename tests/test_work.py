"""How much a step does, counted and not timed: what makes it slower shows here on any machine."""

import tracemalloc
from collections import Counter
from importlib import import_module
from pkgutil import iter_modules

import pytest

from mpslab import Simulation, kernels, load_case
from mpslab.core import plugins
from mpslab.parallel.domain import Domain

CASES = {
    "dam_break": {"particles.spacing": 0.04, "scheme.settling": 0},
    "regular_waves": {"particles.spacing": 0.02, "scheme.settling": 0},
}
WARM, STEPS = 6, 4
COMPILED = ("cython_function_or_method", "fused_cython_function")
# Calls of compiled loops a step with the recipe "standard": over all pairs,
PAIRS = {
    "neighbors.search": 1, "measure.measure": 1, "divergence.adjoint": 1, "walls.flux": 1,
    "poisson.assemble": 1, "walls.extrapolate": 1, "corrected.gradient": 1,
    "unevenness.unevenness": 1, "unevenness.transposed": 1, "divergence.largest_together": 1,
}  # fmt: skip
# over the entries of the matrix,
ENTRIES = {"poisson.reach": 1, "coarse.by_group": 1, "coarse.couple": 1, "coarse.factorise": 1}
# over all particles, or over few pairs,
PARTICLES = {
    "cells.assign": 2, "cells.count": 2, "cells.sort": 1, "cells.ascend": 1, "cells.mark": 1,
    "cells.marked": 1, "vectors.take": 5,
    "vectors.pad": 3, "vectors.add": 3, "vectors.put": 1, "moments.invert": 1,
    "moments.disorder": 1, "density.thin_or_lopsided": 1, "density.beside": 1,
    "repulsion.shift": 1, "repulsion.gone": 3,
    "repulsion.part": 4, "tank.outside": 1, "column.beside": 2, "coarse.spread": 1,
}  # fmt: skip
# and what else a case asks for: eddies, or 13 gauges.
ASKED = {
    "dam_break": {
        "viscosity.strain_rate": 1, "viscosity.acceleration": 1, "column.around": 4,
        "column.spread": 1, "column.top": 1,
    },
    "regular_waves": {
        "viscosity.acceleration": 1, "column.around": 13, "column.spread": 13,
        "column.top": 13,
    },
}  # fmt: skip
# Other loops, and meetings of the ranks: at most so many a step, and more an iteration.
AT_MOST = {
    "sparse.multiply": (2, 1), "coarse.gather": (2, 1), "coarse.substitute": (2, 1),
    "coarse.take_off": (1, 1), "sparse.slab_dots": (4, 3), "sparse.dot": (0, 1),
    "repulsion.moved": (4, 0), "repulsion.reached": (2, 0), "repulsion.closer": (4, 0),
    "collect": (9, 2), "refresh": (9, 0), "share_out": (1, 0), "from_all": (12, 0),
}  # fmt: skip
NEIGHBOURS = {"dam_break": 40, "regular_waves": 15}  # a row has at most, in the mean
BYTES = {"dam_break": 1000, "regular_waves": 1200}  # a particle takes at most within a step


class Counted:
    """Calls of all compiled loops, and of what ranks do together, counted by name."""

    def __init__(self, monkeypatch):
        self.calls, self._patch = Counter(), monkeypatch
        for name in (module.name for module in iter_modules(kernels.__path__)):
            module = import_module(f"mpslab.kernels.{name}")
            for function, what in list(vars(module).items()):
                if type(what).__name__ in COMPILED:
                    self._watch(module, function, f"{name}.{function}")
        self._watch(plugins.load("gradients", "corrected"), "gradient", "corrected.gradient")
        for function in ("share_out", "refresh", "collect", "from_all"):
            self._watch(Domain, function, function)

    def _watch(self, owner, name, called):
        function = getattr(owner, name)

        def counting(*arguments, **options):
            self.calls[called] += 1
            return function(*arguments, **options)

        self._patch.setattr(owner, name, counting)


@pytest.fixture(scope="module", params=CASES)
def run(request):
    simulation = Simulation(load_case(request.param, CASES[request.param]))
    while simulation.step < WARM:
        simulation.advance()
    return simulation


@pytest.fixture
def counted(run, monkeypatch):
    """Calls in STEPS steps by name, and the iterations in them."""
    counted = Counted(monkeypatch)
    for _ in range(STEPS):
        run.advance()
    return counted.calls, int(run.steps["iterations"][-STEPS:].sum())


def test_a_step_calls_the_loops_that_are_stated_and_no_others(run, counted):
    stated = {**PAIRS, **ENTRIES, **PARTICLES, **ASKED[run.case.name]}
    found = {name: calls / STEPS for name, calls in counted[0].items() if name not in AT_MOST}
    assert found == stated


def test_the_solver_and_the_ranks_do_no_more_than_stated(counted):
    calls, iterations = counted
    most = {name: STEPS * step + iterations * each for name, (step, each) in AT_MOST.items()}
    assert {name: calls[name] for name in most if calls[name] > most[name]} == {}


def test_rows_have_no_more_neighbours_than_stated(run):
    near = run._flow.near
    rows = (near.row[1:] > near.row[:-1]).sum()
    assert near.row[-1] / rows < NEIGHBOURS[run.case.name]


@pytest.mark.parametrize("name", CASES)
def test_a_run_takes_no_more_memory_than_stated(name):
    tracemalloc.start()
    try:
        simulation = Simulation(load_case(name, CASES[name]))
        simulation.advance()
        tracemalloc.reset_peak()
        for _ in range(STEPS):
            simulation.advance()
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < BYTES[name] * len(simulation.particles)
