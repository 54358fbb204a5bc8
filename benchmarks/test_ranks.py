"""Time steps of the paper's tank in 3-D: how they scale, with each solver and each way to cut.

4 ranks are there for function on a machine with fewer cores; their times say nothing there.
"""

import pytest

from benchmarks.replay import REPLAY

WIDTH = 0.032  # m


def group(name):
    """Mark of a benchmark: the table it stands in, and the clock of its time steps."""
    return pytest.mark.benchmark(group=name, timer=REPLAY)


@group("strong scaling: the same tank")
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_strong_scaling(timed, ranks):
    timed(ranks)


@group("weak scaling: a tank as wide as there are ranks")
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_weak_scaling(timed, ranks):
    timed(ranks, {"tank.width": WIDTH * ranks})


@group("solvers")
@pytest.mark.parametrize("solver, ranks", [("deflated", 1), ("deflated", 2), ("iccg", 1),
                                           ("piccg", 1), ("piccg", 2), ("scg", 1),
                                           ("scg", 2)])  # fmt: skip
def test_solvers(timed, solver, ranks):
    timed(ranks, {"scheme.solver": solver})


# Above what was found at d0 = 4 mm on 4 ranks (largest over mean work): 1.87, 1.55 and 1.05.
@group("balance")
@pytest.mark.parametrize("balance, most", [("static", 2.5), ("centroid", 1.7), ("optimal", 1.2)])
@pytest.mark.parametrize("ranks", [2, 4])
def test_balance(timed, ranks, balance, most):
    found = timed(ranks, {"parallel.balance": balance, "parallel.rebalance_every": 5})
    assert found["imbalance"] < most
