"""The plunging breaker in 3-D: no bit depends on the ranks, or on where they are cut."""

import pytest
from ranks import tank
from test_parallel import assert_same_results, table

BREAKER = ["plunging_breaker", "--set", "particles.spacing=0.004"]
SOLVERS = ["scg", "piccg", "deflated"]
LONG = [*BREAKER, "--set", "output.pictures=[0.1]", "--until", "0.5"]
SHORT = [*BREAKER, "--set", "output.interval=0.005", "--set", "parallel.rebalance_every=5",
         "--set", "scheme.settling=20", "--until", "0.016", "--no-pictures"]  # fmt: skip
WAYS = [(2, "optimal"), (2, "static"), (3, "optimal"), (3, "static"), (4, "optimal"), (4, "static")]


def run(folder, line, solver, ranks, balance):
    process = tank(*line, "--out", str(folder), "--ranks", str(ranks), "--set",
                   f"scheme.solver={solver}", "--set", f"parallel.balance={balance}")  # fmt: skip
    text, _ = process.communicate(timeout=600.0)
    assert process.returncode == 0, text
    return folder


def test_20_steps_of_the_breaker_leave_the_same_files_on_1_and_2_ranks(tmp_path):
    alone, both = (run(tmp_path / str(n), SHORT, "deflated", n, "optimal") for n in (1, 2))
    assert len(table(alone)) >= 20
    assert len(table(both, "decomposition")) == len(table(alone)) // 5
    assert_same_results(alone, both)


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("solver", SOLVERS)
def test_200_steps_of_the_breaker_leave_the_same_files_on_1_to_4_ranks(tmp_path, solver):
    alone = run(tmp_path / "alone", LONG, solver, 1, "static")
    assert len(table(alone)) >= 200
    for ranks, balance in WAYS:
        other = run(tmp_path / f"{ranks}-{balance}", LONG, solver, ranks, balance)
        assert len(table(other, "decomposition")) == len(table(alone)) // 20
        assert_same_results(alone, other)
