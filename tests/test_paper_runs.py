"""The runs behind the paper's figures: which there are, how they are made, what is kept."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

from mpslab import Simulation, load_case
from paper_figures import __main__ as command
from paper_figures import fig_2, kept, runs, samples
from paper_figures.keep import CUTS, METHODS, RANKS, TIMES, keep


@pytest.mark.parametrize("size", runs.SIZES)
def test_all_runs_are_cases_of_the_papers_tank(size):
    table = runs.read_runs(size)
    assert set(table) == {"cmps", "mps", "standard", "fine"}
    for run in table.values():
        case = run.case
        assert (case.tank.length, case.tank.depth) == (0.8, 0.04)
        early = size == "quick" and case.scheme.recipe == "standard"  # as the paper's runs
        assert case.time.end == (1.25 if early else 1.4)
        assert case.time.end >= fig_2.SPLASH_UP + run.late
        assert (case.wavemaker.height, case.wavemaker.period) == (0.0196, 0.777)
    assert table["mps"].case.scheme.gradient == "mps"
    assert table["cmps"].case.scheme.recipe == "paper"
    # Each state of the run that is sampled is one that it comes by.
    assert max(table[runs.SAMPLED].stops) < table[runs.SAMPLED].case.time.end
    assert not any(run.stops for name, run in table.items() if name != runs.SAMPLED)


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """A run of three steps of the paper's tank, far too coarse, and what is kept of it."""
    folder = tmp_path_factory.mktemp("tiny")
    changes = {"particles.spacing": 0.01, "tank.width": 0.06, "time.end": 0.004,
               "output.interval": 0.001, "scheme.settling": 0}  # fmt: skip
    simulation = Simulation(load_case("plunging_breaker", changes), folder / "run")
    simulation.run()
    keep(folder / "run", folder / "kept", runs.Run("tiny", "tiny", 1, changes))
    return simulation, kept.Kept(folder / "kept", "tiny"), folder / "run"


def test_what_is_kept_is_the_run(tiny):
    simulation, run, _ = tiny
    assert np.array_equal(run.steps["step"], simulation.steps["step"])
    np.testing.assert_allclose(run.steps["seconds"], simulation.steps["seconds"], atol=6e-5)
    assert sum(run.record["particles"].values()) == len(simulation.particles)
    water = run.near(TIMES[-1])
    assert water.time == pytest.approx(simulation.time, rel=1e-6)
    fluid = simulation.particles.position[simulation.particles.fluid]
    fluid = fluid[(fluid[:, 0] > 0.22) & (fluid[:, 0] < 0.5)]
    assert len(water.position) == len(fluid)
    for axis in range(3):
        np.testing.assert_allclose(np.sort(water.position[:, axis]), np.sort(fluid[:, axis]),
                                   atol=1e-3 * run.spacing)  # fmt: skip
    for time in CUTS:
        for method in METHODS:
            borders, share, work = run.cuts(time, method)
            assert len(borders) == RANKS + 1 and np.all(np.diff(borders) > 0.0)
            assert share.sum() == pytest.approx(1.0) and work.sum() == pytest.approx(1.0)


def test_runs_on_one_rank_are_made_side_by_side(monkeypatch, tmp_path, capfd):
    changes = {"particles.spacing": 0.01, "tank.width": 0.0, "time.end": 0.004}
    one, two, three = (runs.Run(name, name, 1, changes) for name in ("one", "two", "three"))
    wide = runs.Run("wide", "wide", 2, changes)
    monkeypatch.setattr(runs, "cores", lambda: {0, 1})
    rows = [one, two, three, wide, wide]
    assert list(runs.batches(rows)) == [[one, two], [three], [wide], [wide]]
    out = tmp_path / "out"
    runs.make_all([one, two], out)
    assert runs.is_done(one, out / "one") and runs.is_done(two, out / "two")
    assert capfd.readouterr().out.count("Done:") == 1
    assert (out / "two.log").read_text().count("Done:") == 1


def test_a_run_that_stops_is_named_after_the_one_beside_it_has_ended(tmp_path):
    changes = {"particles.spacing": 0.01, "tank.width": 0.0, "time.end": 0.004}
    bad, good = runs.Run("bad", "bad", 1, {"time.end": -1.0}), runs.Run("good", "good", 1, changes)
    with pytest.raises(runs.Failed, match="bad"):
        runs.make_all([bad, good], tmp_path)
    assert runs.is_done(good, tmp_path / "good")


def test_a_folder_with_another_run_is_refused(tiny):
    folder = tiny[2]
    with pytest.raises(runs.Failed, match="holds another run than 'cmps'"):
        runs.is_done(runs.read_runs("full")["cmps"], folder)


def test_run_makes_what_is_missing_and_nothing_twice(tmp_path, monkeypatch, tiny):
    made = []
    monkeypatch.setattr(runs, "make", lambda run, folder, log: made.append(run.name))
    monkeypatch.setattr(command, "keep", lambda folder, target, run: shutil.copytree(
        tiny[1].folder, target))  # fmt: skip
    line = ["--out", str(tmp_path), "--run", "--quick", "--only", "mps", "--only", "fine"]
    assert command.main(line) == 0 and made == ["mps", "fine"]
    assert command.main(line) == 0 and made == ["mps", "fine"]


def test_a_state_that_is_missing_is_named_before_any_work(tmp_path):
    methods, plan = list(samples.read_methods().values()), {"at": [0.1, 0.4], "steps": 3}
    runs.state_of(tmp_path / "cmps", 0.1).mkdir()
    with pytest.raises(runs.Failed, match=r"cmps at 0\.40: missing; remove .*results/cmps"):
        samples.take(methods, plan, tmp_path, tmp_path / "results")
    assert not (tmp_path / "results").exists()


def test_methods_go_on_from_the_states_of_a_run_and_are_kept(tmp_path):
    changes = {"particles.spacing": 0.01, "tank.width": 0.08, "time.end": 0.04,
               "output.interval": 0.02, "scheme.recipe": "paper"}  # fmt: skip
    run = runs.Run("cmps", "CMPS", 1, changes, stops=(0.01, 0.02))
    runs.make(run, tmp_path / "cmps")
    assert runs.is_done(run, tmp_path / "cmps")
    methods = [samples.read_methods()[name] for name in ("iccg", "deflated")]
    methods = [replace(method, ranks=1) for method in methods]
    samples.take(methods, {"at": run.stops, "steps": 3}, tmp_path, tmp_path / "results")
    found = kept.read(tmp_path / "results", {}, {one.name: one for one in methods})
    for method in found.values():
        assert method.states.tolist() == [0.01, 0.02]
        assert len(method.steps["step"]) >= 6 and method.steps["iterations"].min() >= 1
    # The solver changes the answer by no more than its tolerance.
    far = np.nanmax(np.abs(found["iccg"].tops - found["deflated"].tops))
    assert far < 1e-3 * 0.01
