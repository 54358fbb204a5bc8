"""The model of many ranks at its limits."""

import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from ranks import ROOT

from mpslab import Simulation, load_case
from mpslab.parallel.domain import Domain
from mpslab.pressure import deflation
from mpslab.pressure.solvers import deflated

sys.path.append(str(ROOT))  # last: the package under test goes first

from benchmarks import calibrate, model, program

MACHINE = {
    "provisional": False,
    "cores": 2,
    "sharing": 1.25,
    "work": {"neighbours": 1e-6, "operators": 2e-6, "assembly": 1e-6, "solve": 1e-7,
             "factor": 3e-10, "substitution": 1e-9, "ghosts": 1e-6, "record": 1e-7, "rest": 1e-7},
    "message": {"latency": 1e-5, "bandwidth": 1e9, "sum": 1e-5},
    "measured": [],
}  # fmt: skip
COARSE = {name: MACHINE["work"][name] for name in ("factor", "substitution")}
SPACING = 0.004
LATTICE = {"particles.spacing": SPACING, "scheme.settling": 0}


@pytest.fixture(scope="module")
def tank():
    return model.make_tank(SPACING)


def step(tank, ranks):
    return model.predict(MACHINE, tank, model.share_out(tank, ranks))


def test_the_tank_has_the_particles_and_the_slabs_of_the_program(tank):
    run = Simulation(load_case("plunging_breaker", LATTICE))
    domain, particles = run.domain, run.particles
    count = domain.slabs.count
    assert model.slabs_run_out(tank) == count
    np.testing.assert_array_equal(tank.particles, np.bincount(domain.slab, minlength=count))
    water = domain.slab[particles.fluid]
    np.testing.assert_array_equal(tank.water, np.bincount(water, minlength=count))


def test_the_tank_has_the_groups_of_a_step(monkeypatch):
    made = []

    def keep(system, tolerance):
        made.append(deflation.Deflation(system, tolerance))
        return made[-1]

    monkeypatch.setattr(deflated, "Deflation", keep)
    tank = model.make_tank(SPACING)
    Simulation(load_case("plunging_breaker", LATTICE)).advance()
    (real,) = made
    first = real.system.blocks.first
    groups = [len(set(real.group[a:b].tolist())) for a, b in pairwise(first.tolist())]
    assert tank.groups.tolist() == groups
    assert max(groups) == 6
    assert tank.half == real.coarse.band.shape[1] - 1


def test_one_rank_costs_what_was_measured_on_one(tank):
    water, particles = tank.water.sum(), tank.particles.sum()
    seconds = {"neighbours": 0.1, "operators": 0.2, "assembly": 0.3, "solve": 0.4, "record": 0.05,
               "rest": 0.01, "ghosts": 0.0}  # fmt: skip
    one = {
        "water": int(water), "particles": int(particles), "iterations": model.iterations(SPACING),
        "phases": {p: {"work": s, "communication": 0.0, "waiting": 0.0}
                   for p, s in seconds.items()},
        "seconds": [1.06],
    }  # fmt: skip
    work = calibrate.work_of({1: [one], 2: [one]}, COARSE, SPACING)
    machine = {**MACHINE, "work": work, "sharing": 1.0}
    predicted = model.predict(machine, tank, model.share_out(tank, 1))
    assert predicted.pop("messages") == 0.0
    assert 0.0 < predicted["coarse"] < predicted["solve"]
    predicted["solve"] += predicted.pop("coarse")
    assert predicted == pytest.approx(seconds)


def test_ranks_slow_one_another_the_more_the_more_cores_are_busy(tank):
    share, machine = model.share_out(tank, 1), {**MACHINE, "cores": 5}
    coarse = [model.predict(machine, tank, model.share_out(tank, n))["coarse"] for n in (3, 5, 8)]
    alone = model.predict(machine, tank, share)["coarse"]
    assert coarse == pytest.approx([1.125 * alone, 1.25 * alone, 1.25 * alone])


def test_with_more_ranks_work_falls_and_messages_grow(tank):
    steps = [step(tank, ranks) for ranks in (2, 4, 8, 16)]
    for fewer, more in pairwise(steps):
        assert more["messages"] > fewer["messages"] > 0.0
        for phase in ("neighbours", "solve", "record"):
            assert more[phase] < fewer[phase]


def test_every_rank_does_all_the_work_for_the_groups(tank):
    alone, *others = [step(tank, ranks)["coarse"] for ranks in (1, 2, 8)]
    assert alone > 0.0
    assert others == pytest.approx([MACHINE["sharing"] * alone] * 2)


def test_messages_are_those_of_a_step(monkeypatch):
    """As far as one rank goes through them: it sends no particles, three times in a step."""
    small = {**LATTICE, "tank.width": 0.0, "particles.spacing": 0.006}
    run = Simulation(load_case("plunging_breaker", small))
    sums, told, arrays = [], [], []

    def count(name, note):
        method = getattr(Domain, name)

        def act(domain, *given):
            note(given)
            return method(domain, *given)

        monkeypatch.setattr(Domain, name, act)

    count("collect", lambda given: sums.append(given[0].shape))
    count("from_all", told.extend)
    count("exchange", lambda given: arrays.extend(given[1:]))
    run.advance()
    iterations, slabs = run.last_row["iterations"], run.domain.slabs.count
    assert len(sums) + 2 * len(told) + 2 * 3 == model.SUMS * iterations + model.STEP_SUMS
    band = max(sums, key=np.prod)
    groups, solves = band[0], iterations + model.STEP_SOLVES
    assert sums.count((groups,)) == model.STEP_SOLVES
    assert sums.count((groups + slabs,)) == sums.count((2, slabs)) - 2 == iterations
    by_slab = sum(map(np.prod, sums)) - np.prod(band) - groups * solves
    told_apart = len(sums) - model.SUMS * iterations - model.STEP_SOLVES - 1
    assert by_slab == slabs * (model.DOTS * iterations + told_apart + 2)
    assert len(arrays) == model.EXCHANGES * iterations + model.STEP_EXCHANGES


def test_sums_take_their_latency_and_their_bytes_in_each_round(tank):
    def messages(tank, **changes):
        machine = {**MACHINE, "message": {**MACHINE["message"], "latency": 0.0, **changes}}
        return model.predict(machine, tank, model.share_out(tank, 16))["messages"]

    count, solves = model.iterations(SPACING), model.iterations(SPACING) + model.STEP_SOLVES
    number = model.SUMS * count + model.STEP_SUMS
    assert messages(tank, bandwidth=np.inf) == pytest.approx(4 * 1e-5 * number)
    more = messages(tank) - messages(replace(tank, groups=0 * tank.groups))
    values = tank.groups.sum() * (solves + tank.half + 1)
    assert more == pytest.approx(4 * 8 * values / 1e9)


def test_no_rank_works_less_than_the_fullest_slab_asks_for(tank):
    most = model.slabs_run_out(tank)
    least = MACHINE["sharing"] * MACHINE["work"]["solve"] * tank.water.max()
    assert step(tank, most)["solve"] == pytest.approx(least * model.iterations(SPACING))


def test_more_ranks_than_slabs_are_refused(tank):
    most = model.slabs_run_out(tank)
    with pytest.raises(ValueError, match=f"ranks = {most + 1}: must be from 1 to {most}"):
        model.share_out(tank, most + 1)
    assert [ranks for ranks, _, _ in model.scaling(MACHINE, tank)] == [1, 2, 4, 8, 16, 32, most]


def test_ranks_own_all_and_see_what_is_beside(tank):
    share = model.share_out(tank, 5)
    assert share.water.sum() == tank.water.sum()
    assert share.particles.sum() == tank.particles.sum()
    alone = model.share_out(tank, 1)
    assert alone.ghosts.tolist() == [0]
    each = model.share_out(tank, model.slabs_run_out(tank))
    np.testing.assert_array_equal(each.ghosts[1:-1], tank.particles[:-2] + tank.particles[2:])


def test_ghosts_outweigh_from_a_number_of_ranks_on(tank):
    ranks, water = model.ghosts_outweigh(tank), tank.water.sum()
    assert 2 < ranks < model.slabs_run_out(tank)
    assert model.share_out(tank, ranks).ghost_water.sum() >= water
    assert model.share_out(tank, ranks - 1).ghost_water.sum() < water


def test_iterations_are_the_measured_ones_and_grow_as_the_spacing_falls_beyond():
    for spacing, count in model.ITERATIONS.items():
        assert model.iterations(spacing) == pytest.approx(count)
    finest = min(model.ITERATIONS)
    assert model.iterations(finest / 2.0) == pytest.approx(2.0 * model.ITERATIONS[finest])
    assert 11.3 < model.iterations(0.00125) < 13.0


def test_the_file_of_constants_has_what_the_model_takes(tank):
    machine = model.read_machine()
    assert machine.keys() == MACHINE.keys()
    for name in ("work", "message"):
        assert machine[name].keys() == MACHINE[name].keys()
    assert sum(model.predict(machine, tank, model.share_out(tank, 2)).values()) > 0.0


def test_what_the_calibration_writes_can_be_read(tank, tmp_path):
    one = {
        "water": 10, "particles": 20, "iterations": 2.0, "seconds": [0.5],
        "phases": {p: dict.fromkeys(("work", "communication", "waiting"), 0.5)
                   for p in MACHINE["work"].keys() - COARSE.keys()},
    }  # fmt: skip
    runs, shared = {1: [one], 2: [one]}, [[one, {**one, "seconds": [0.75]}, one, one]]
    timed = {"sum": 1e-5, "exchange": [1e-5, 2e-5]}
    constants = calibrate.constants_of(runs, shared, timed, COARSE, SPACING)
    measured = [(SPACING, ranks, found) for ranks, found in runs.items()]
    path = tmp_path / "machine.toml"
    path.write_text(calibrate.text(constants, measured, provisional=True))
    machine = model.read_machine(path)
    assert machine.keys() == MACHINE.keys()
    assert (machine["provisional"], machine["cores"], machine["sharing"]) == (True, 4, 1.5)
    assert machine["work"].keys() == MACHINE["work"].keys()
    assert {name: machine["work"][name] for name in COARSE} == COARSE
    assert [one["ranks"] for one in machine["measured"]] == [1, 2]


def test_work_for_the_groups_is_timed():
    found = program.time_coarse(groups=200, half=10, repeats=3)
    assert found.keys() == COARSE.keys()
    assert min(found.values()) > 0.0


def test_a_page_keeps_what_stands_around_the_tables():
    page = "before\n<a>\nold\n<b>\nafter\n"
    assert model.put_between(page, "<a>", "<b>", ["new"]) == "before\n<a>\nnew\n<b>\nafter\n"
    with pytest.raises(ValueError, match="has no <a>"):
        model.put_between("nothing", "<a>", "<b>", [])
