"""Many ranks, the same bits: what a step does does not depend on who owns what."""

import pytest
from ranks import alone, start

DT = 2e-4
LONG = {"tank.length": 0.16, "scheme.solver": "scg"}
PERIODIC = {**LONG, "tank.length": 0.08, "tank.width": 0.016, "tank.periodic": True,
            "particles.jitter": 0.01}  # fmt: skip
PISTON = {**LONG, "wavemaker.type": "linear", "wavemaker.height": 0.008, "wavemaker.period": 0.4}
PAPER = {**PISTON, "scheme.recipe": "paper"}
# Everything that the other cases leave out, among it the models that see furthest.
REST = {**LONG, "particles.jitter": 0.05, "scheme.gradient": "cmps", "scheme.source": "ecs",
        "scheme.stabiliser": ["collision", "shifting", "ds"], "fluid.viscosity": 1e-3}  # fmt: skip
MARKED = {**REST, "scheme.surface": "marked", "scheme.projection": "predicted",
          "scheme.gradient": "gc", "scheme.source": "mixed"}  # fmt: skip
CASES = {"periodic": PERIODIC, "piston": PISTON, "paper": PAPER, "rest": REST, "marked": MARKED}


@pytest.mark.parametrize("solver", ["scg", "piccg", "deflated"])
def test_steps_have_the_same_bytes_and_iterations_on_1_to_4_ranks(solver):
    changes = {**PISTON, "scheme.solver": solver}
    one = alone("steps", changes, 15, DT)
    assert min(one["iterations"]) > 3
    for ranks in (1, 2, 3, 4) if solver == "deflated" else (2, 3, 4):
        assert start("steps", ranks, changes, 15, DT) == one


@pytest.mark.parametrize("solver", ["scg", "piccg", "deflated"])
@pytest.mark.parametrize("name", ["periodic", "paper", "rest", "marked"])
def test_every_part_of_a_step_has_the_same_bytes_on_3_ranks(name, solver):
    changes = {**CASES[name], "scheme.solver": solver}
    assert start("steps", 3, changes, 10, DT) == alone("steps", changes, 10, DT)


def test_static_cuts_give_the_same_bytes_as_the_best_ones():
    static = {**PISTON, "parallel.balance": "static"}
    assert start("steps", 3, static, 10, DT) == start("steps", 3, PISTON, 10, DT)


@pytest.mark.parametrize("solver", ["scg", "piccg", "deflated"])
def test_ranks_without_water_leave_the_same_bytes(solver):
    box = {"from": [0.0, 0.0, 0.0], "to": [0.06, 0.0, 0.04]}
    changes = {"tank.length": 0.4, "tank.depth": 0.04, "water": [box], "scheme.solver": solver,
               "parallel.balance": "static"}  # fmt: skip
    assert 0 in start("water", 4, changes)
    assert start("steps", 4, changes, 10, DT) == alone("steps", changes, 10, DT)


def test_sums_are_added_slab_by_slab_on_any_number_of_ranks():
    one, other = alone("sums"), start("sums", 3)
    assert other["total"] == one["total"]
    assert other["sizes"] != one["sizes"]
    assert sum(other["sizes"]) == sum(one["sizes"])


def test_rank_0_alone_lays_the_tank_out():
    (one,) = start("laid_out", 1)
    found = start("laid_out", 3)
    assert [whole for whole, _ in found] == [one[0], 0, 0]
    assert sum(mine for _, mine in found) == one[1]
    assert all(0 < mine < one[1] for _, mine in found)


def test_particles_that_cross_several_slabs_at_once_arrive_and_ghosts_lie_beside():
    places = [[0, 0.039], [1, 0.021], [300, -0.004], [301, 5.0]]
    found = start("crossing", 4, places)
    assert found["total"] == sum(start("sums", 4)["sizes"])
    assert sorted(n for mine, *_ in found["ranks"] for n in mine) == [0, 1, 300, 301]
    assert 301 in found["ranks"][3][0]
    assert 300 in found["ranks"][0][0]
    last = found["ranks"][-1][3]
    for _, slabs, begin, end in found["ranks"]:
        assert slabs == list(range(max(begin - 1, 0), min(end + 1, last)))


def test_a_solver_for_one_rank_is_refused_on_two():
    with pytest.raises(AssertionError, match=r'scheme.solver = "iccg": runs on one rank only'):
        start("steps", 2, {"scheme.solver": "iccg"}, 1, DT)
