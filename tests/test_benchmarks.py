"""The benchmarks measure what they say."""

import json
import sys

import pytest
from ranks import ROOT

from mpslab.core.stopwatch import PHASES

sys.path.append(str(ROOT))  # last: the package under test goes first

from benchmarks import against, pair, passes, program, report, solvers, timed
from benchmarks.replay import Replay

SMALL = {"tank.width": 0.0, "particles.spacing": 0.006}


@pytest.fixture(scope="module")
def small():
    """The small tank on one rank and on two."""
    return [program.run(ranks, SMALL, warm=1, steps=3) for ranks in (1, 2)]


def test_ranks_time_the_same_steps_of_the_same_tank(small):
    one, two = small
    assert (one["ranks"], two["ranks"]) == (1, 2)
    for key in ("particles", "water", "iterations"):
        assert one[key] == two[key] > 0
    assert one["imbalance"] == 1.0 < two["imbalance"] < 1.5


def test_phases_add_up_to_the_step(small):
    for found in small:
        assert list(found["phases"]) == list(PHASES)
        parts = sum(sum(kinds.values()) for kinds in found["phases"].values())
        assert parts == pytest.approx(sum(found["seconds"]) / 3, rel=0.05)


def test_messages_of_every_size_are_timed():
    process = program.start(2, "time_messages", slabs=8, rows=[10, 1000], repeats=5)
    found = program.result(process)
    assert found["sum"] > 0.0
    assert len(found["exchange"]) == 2
    assert min(found["exchange"]) > 0.0


def test_a_program_that_fails_says_why():
    with pytest.raises(RuntimeError, match=r"tank\.depth = -1"):
        program.run(1, {"tank.depth": -1})


def test_a_table_of_pairs_has_the_median_of_the_ratios(small):
    one, two = small
    slow = {**two, "phases": {p: {k: 4.0 * s for k, s in kinds.items()}
                              for p, kinds in one["phases"].items()}}  # fmt: skip
    lines = pair.table([(one, one), (one, slow), (one, slow)])
    step = next(line for line in lines if line.startswith("| step "))
    assert "| 0.25 | 0.25 to 1.00 |" in step
    assert len(lines) == 2 + 1 + len(PHASES)


def test_steps_pass_again_with_the_times_they_took():
    clock = Replay()
    clock.seconds = iter([0.5, 0.25])
    clock.step()
    assert clock() == 0.5
    clock.step()
    assert clock() == 0.75


def test_solvers_all_solve_the_system_that_was_taken():
    system = solvers.take_system(0.006)
    found = solvers.measure(system, 1e-8, 1)
    assert {"deflated", "scg", "piccg", "iccg", "scipy, Jacobi"} <= set(found)
    assert all(f["residual"] <= 1e-8 and f["iterations"] > 0 for f in found.values())
    assert solvers.table({len(system): found})[2].startswith("| deflated | ")


def test_stretch_of_a_run_is_timed_by_phase():
    found = timed.stretch("dam_break", {"particles.spacing": 0.03}, 0.0, 4, 0.0, True)
    assert found["steps"] == 4 and found["iterations"] > 0
    assert sum(found["phases"].values()) == pytest.approx(found["seconds"], rel=0.3)
    lines = against.table([(found, {**found, "cpu": 0.5 * found["cpu"]})])
    assert next(line for line in lines if "processor" in line).endswith("| 2.00 | 2.00 to 2.00 |")


def test_passes_are_timed_and_agree_with_their_plain_forms():
    rows = passes.compare(passes.settled(0.006, warm=1), turns=1)
    assert [row[0] for row in rows] == list(passes.BYTES)
    for _, fast, slow, off, share in rows:
        assert fast > 0.0 and slow > 0.0
        assert off < 1e-4
        assert share > 0.0


def test_report_tells_of_passes_steps_and_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(report, "SHORT", {"scheme.settling": 0})
    line = ["--spacings", "0.006", "--steps", "2", "--turns", "1", "--out", str(tmp_path)]
    report.main(line)
    files = sorted(tmp_path.iterdir())
    assert [file.suffix for file in files] == [".json", ".md", ".png"]
    found = json.loads(files[0].read_text())
    assert {name for name, *_ in found["passes"]} == set(passes.BYTES) | set(passes.ALONE)
    assert all(spent > 0.0 and roof > 0.0 for _, spent, roof in found["passes"])
    assert list(found["steps"]) == ["6 mm, early", "6 mm, mixed"]
    page = files[1].read_text()
    assert "| gradient |" in page and "| 6 mm, mixed |" in page and "| kB a particle |" in page


def test_a_machine_has_a_name_that_a_file_can_have():
    assert report.name_of({"cpu": "Intel(R) Xeon(R) E-2", "cores": 4}) == "intel-xeon-e-2-4"
