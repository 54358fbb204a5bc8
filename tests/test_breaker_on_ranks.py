"""The plunging breaker in 3-D, 200 steps: no bit depends on the ranks, or on where they are cut."""

import pytest
from ranks import tank
from test_parallel import assert_same_results, table

RUN = ["plunging_breaker", "--set", "particles.spacing=0.004", "--set", "output.pictures=[0.1]",
       "--until", "0.24"]  # fmt: skip
WAYS = [(2, "optimal"), (2, "static"), (3, "optimal"), (3, "static"), (4, "optimal"), (4, "static")]


def run(folder, solver, ranks, balance):
    process = tank(*RUN, "--out", str(folder), "--ranks", str(ranks), "--set",
                   f"scheme.solver={solver}", "--set", f"parallel.balance={balance}")  # fmt: skip
    text, _ = process.communicate(timeout=600.0)
    assert process.returncode == 0, text
    return folder


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("solver", ["scg", "piccg", "deflated"])
def test_200_steps_of_the_breaker_leave_the_same_files_on_1_to_4_ranks(tmp_path, solver):
    alone = run(tmp_path / "alone", solver, 1, "static")
    assert len(table(alone)) >= 200
    for ranks, balance in WAYS:
        other = run(tmp_path / f"{ranks}-{balance}", solver, ranks, balance)
        assert len(table(other, "decomposition")) == len(table(alone)) // 20
        assert_same_results(alone, other)
