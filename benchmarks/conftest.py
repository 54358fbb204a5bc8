"""Options of the benchmarks, and time steps as the rounds of pytest-benchmark."""

import pytest

from benchmarks import program
from benchmarks.replay import REPLAY


def pytest_addoption(parser):
    parser.addoption("--spacing", type=float, default=0.004, metavar="D0",
                     help="particle spacing of the benchmarks [m]")  # fmt: skip
    parser.addoption("--steps", type=int, default=12, help="time steps of a benchmark, >= 1")


def pytest_configure(config):
    steps = config.getoption("--steps")
    if steps < 1:
        raise pytest.UsageError(f"--steps {steps}: must be >= 1")


@pytest.fixture
def timed(benchmark, request):
    """Run the tank on so many ranks, with changes to the case; each time step is a round."""
    steps = request.config.getoption("--steps")

    def timed(ranks, changes=None):
        spacing = request.config.getoption("--spacing")
        found = program.run(ranks, {"particles.spacing": spacing, **(changes or {})}, steps=steps)
        REPLAY.seconds = iter(found.pop("seconds"))
        benchmark.extra_info.update(found, spacing=spacing, **(changes or {}))
        benchmark.pedantic(REPLAY.step, rounds=steps)
        return found

    return timed
