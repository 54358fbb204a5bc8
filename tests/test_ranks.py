"""Many ranks, the same bits: what a step does does not depend on who owns what."""

import json
from functools import cache

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
SEA = {**PISTON, "wavemaker.type": "irregular", "wavemaker.height": 0.006, "wavemaker.order": 2}
SHAPES = {**LONG, "force": [{"name": "mound", "on": "solid-1"}], "solid": [
    {"shape": "polygon", "points": [[0.03, 0.0], [0.05, 0.014], [0.06, 0.014], [0.08, 0.0]]},
    {"shape": "cylinder", "center": [0.12, 0.0, 0.012], "radius": 0.007,
     "motion": "sway", "amplitude": 0.01, "period": 0.1},
]}  # fmt: skip
CASES = {"sea": SEA, "periodic": PERIODIC, "paper": PAPER, "rest": REST, "marked": MARKED}
SOLVERS = ["scg", "piccg", "deflated"]
DRY = {"tank.length": 0.4, "tank.depth": 0.04, "parallel.balance": "static",
       "water": [{"from": [0.0, 0.0, 0.0], "to": [0.06, 0.0, 0.04]}]}  # fmt: skip
STATIC = {**PISTON, "parallel.balance": "static"}
PLACES = [[0, 0.039], [1, 0.021], [300, -0.004], [301, 5.0]]


def steps(changes, solver="scg", count=10):
    return ["steps", {**changes, "scheme.solver": solver}, count, DT]


NESTED = ["nested", PERIODIC, 10, DT]
TOWER = {"tank.length": 0.2, "tank.depth": 0.01, "tank.height": 0.2,
         "water": [{"from": [0.0, 0.0, 0.0], "to": [0.2, 0.0, 0.01]},
                   {"from": [0.08, 0.0, 0.01], "to": [0.11, 0.0, 0.15]}]}  # fmt: skip
# Work a row: the usual numbers of the groups need 27, the narrow ones 7.4.
NARROW = ["nested", TOWER, 5, DT, 10.0]
EVERYWHERE = [steps(PISTON, solver, 15) for solver in SOLVERS]
CALLS = {
    1: EVERYWHERE,
    2: EVERYWHERE,
    3: [
        *EVERYWHERE,
        *(steps(changes, solver) for changes in CASES.values() for solver in SOLVERS),
        steps(PISTON), steps(STATIC), steps(SHAPES), ["sums"], NESTED, NARROW,
    ],
    4: [
        *EVERYWHERE,
        *(steps(DRY, solver) for solver in SOLVERS),
        *(["water", {**DRY, "scheme.solver": solver}] for solver in SOLVERS),
        ["crossing", PLACES], ["sums"],
    ],
}  # fmt: skip


@cache
def outputs(ranks):
    """Of all calls on so many ranks, which take one start."""
    return dict(zip(map(json.dumps, CALLS[ranks]), start("each", ranks, CALLS[ranks]), strict=True))


def on(ranks, call):
    return outputs(ranks)[json.dumps(call)]


@pytest.mark.parametrize("solver", SOLVERS)
def test_steps_have_the_same_bytes_and_iterations_on_1_to_4_ranks(solver):
    call = steps(PISTON, solver, 15)
    one = alone(*call)
    assert min(one["iterations"]) > 3
    for ranks in (1, 2, 3, 4):
        assert on(ranks, call) == one


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", CASES)
def test_every_part_of_a_step_has_the_same_bytes_on_3_ranks(name, solver):
    call = steps(CASES[name], solver)
    assert on(3, call) == alone(*call)


def test_solids_of_any_shape_have_the_same_bytes_on_3_ranks():
    assert on(3, steps(SHAPES)) == alone(*steps(SHAPES))


def test_nested_deflation_has_the_same_bytes_and_as_many_iterations_on_3_ranks():
    one, direct = alone(*NESTED), alone(*steps(PERIODIC, "deflated"))
    assert on(3, NESTED) == one
    assert one["position"] != direct["position"]
    assert all(abs(a - b) <= 1 for a, b in
               zip(one["iterations"], direct["iterations"], strict=True))  # fmt: skip


def test_groups_that_a_tower_of_water_makes_narrow_give_the_same_bytes_on_3_ranks():
    one, usual = alone(*NARROW), alone(*steps(TOWER, "deflated", 5))
    assert on(3, NARROW) == one
    assert one["position"] != usual["position"]  # another order of the same sums
    assert one["position"] != alone(*NARROW[:-1], 5.0)["position"]  # solved by iterations
    assert one["iterations"] == usual["iterations"]


def test_static_cuts_give_the_same_bytes_as_the_best_ones():
    assert on(3, steps(STATIC)) == on(3, steps(PISTON))


@pytest.mark.parametrize("solver", SOLVERS)
def test_ranks_without_water_leave_the_same_bytes(solver):
    call = steps(DRY, solver)
    assert 0 in on(4, ["water", call[1]])
    assert on(4, call) == alone(*call)


def test_sums_are_added_slab_by_slab_on_any_number_of_ranks():
    one, other = alone("sums"), on(3, ["sums"])
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
    found = on(4, ["crossing", PLACES])
    assert found["total"] == sum(on(4, ["sums"])["sizes"])
    assert sorted(n for mine, *_ in found["ranks"] for n in mine) == [0, 1, 300, 301]
    assert 301 in found["ranks"][3][0]
    assert 300 in found["ranks"][0][0]
    last = found["ranks"][-1][3]
    for _, slabs, begin, end in found["ranks"]:
        assert slabs == list(range(max(begin - 1, 0), min(end + 1, last)))


def test_a_solver_for_one_rank_is_refused_on_two():
    with pytest.raises(AssertionError, match=r'scheme.solver = "iccg": runs on one rank only'):
        start("steps", 2, {"scheme.solver": "iccg"}, 1, DT)
