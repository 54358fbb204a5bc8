"""The model of many ranks at its limits."""

import sys
from itertools import pairwise

import numpy as np
import pytest
from ranks import ROOT

from mpslab import Simulation, load_case

sys.path.append(str(ROOT))  # last: the package under test goes first

from benchmarks import calibrate, model

MACHINE = {
    "provisional": False,
    "sharing": 1.25,
    "work": {"neighbours": 1e-6, "operators": 2e-6, "assembly": 1e-6, "solve": 1e-7,
             "ghosts": 1e-6, "record": 1e-7, "rest": 1e-7},
    "message": {"latency": 1e-5, "bandwidth": 1e9, "sum": 1e-5},
    "measured": [],
}  # fmt: skip
SPACING = 0.004


@pytest.fixture(scope="module")
def tank():
    return model.make_tank(SPACING)


def step(tank, ranks):
    return model.predict(MACHINE, tank.spacing, model.share_out(tank, ranks))


def test_the_tank_has_the_particles_and_the_slabs_of_the_program(tank):
    run = Simulation(load_case("plunging_breaker", {"particles.spacing": SPACING}))
    domain, particles = run.domain, run.particles
    count = domain.slabs.count
    assert model.slabs_run_out(tank) == count
    np.testing.assert_array_equal(tank.particles, np.bincount(domain.slab, minlength=count))
    water = domain.slab[particles.fluid]
    np.testing.assert_array_equal(tank.water, np.bincount(water, minlength=count))


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
    found = {"one": [one], "two": [one], "shared": [one]}
    machine = {**MACHINE, "work": calibrate.work_of(found, SPACING), "sharing": 1.0}
    predicted = model.predict(machine, SPACING, model.share_out(tank, 1))
    assert predicted.pop("messages") == 0.0
    assert predicted == pytest.approx(seconds)


def test_with_more_ranks_work_falls_and_messages_grow(tank):
    steps = [step(tank, ranks) for ranks in (2, 4, 8, 16)]
    for fewer, more in pairwise(steps):
        assert more["messages"] > fewer["messages"] > 0.0
        for phase in ("neighbours", "solve", "record"):
            assert more[phase] < fewer[phase]


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
    assert 32.0 < model.iterations(0.0025) < 52.8


def test_the_file_of_constants_has_what_the_model_takes(tank):
    machine = model.read_machine()
    assert machine.keys() == MACHINE.keys()
    for name in ("work", "message"):
        assert machine[name].keys() == MACHINE[name].keys()
    assert sum(model.predict(machine, SPACING, model.share_out(tank, 2)).values()) > 0.0


def test_what_the_calibration_writes_can_be_read(tank, tmp_path):
    one = {
        "water": 10, "particles": 20, "iterations": 2.0, "seconds": [0.5],
        "phases": {p: dict.fromkeys(("work", "communication", "waiting"), 0.5)
                   for p in (*MACHINE["work"],)},
    }  # fmt: skip
    found = {"one": [one], "two": [one], "shared": [{**one, "seconds": [0.75]}]}
    timed = {"sum": 1e-5, "exchange": [1e-5, 2e-5]}
    path = tmp_path / "machine.toml"
    path.write_text(calibrate.text(found, timed, SPACING, provisional=True))
    machine = model.read_machine(path)
    assert machine.keys() == MACHINE.keys()
    assert (machine["provisional"], machine["sharing"]) == (True, 1.5)
    assert machine["work"].keys() == MACHINE["work"].keys()
    assert [one["ranks"] for one in machine["measured"]] == [1, 2]


def test_a_page_keeps_what_stands_around_the_tables():
    page = "before\n<a>\nold\n<b>\nafter\n"
    assert model.put_between(page, "<a>", "<b>", ["new"]) == "before\n<a>\nnew\n<b>\nafter\n"
    with pytest.raises(ValueError, match="has no <a>"):
        model.put_between("nothing", "<a>", "<b>", [])
