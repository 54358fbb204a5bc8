"""The stopwatch: each moment counts once, for the innermost phase and kind."""

import pytest

from mpslab.core import stopwatch
from mpslab.core.stopwatch import COMMUNICATION, WAITING, WORK, Stopwatch


@pytest.fixture
def wait(monkeypatch):
    """Lets the clock go on by so many seconds."""
    clock = [0.0]
    monkeypatch.setattr(stopwatch, "perf_counter", lambda: clock[0])

    def wait(seconds):
        clock[0] += seconds

    return wait


def test_time_counts_for_the_innermost_phase_and_kind_alone(wait):
    watch = Stopwatch()
    wait(1.0)
    with watch.phase("rest"):
        wait(2.0)
        with watch.phase("solve"):
            wait(4.0)
            with watch.kind(COMMUNICATION):
                wait(8.0)
                with watch.kind(WAITING):
                    wait(16.0)
        wait(32.0)
    wait(64.0)
    assert watch.spent == {
        ("rest", WORK): 34.0,
        ("solve", WORK): 4.0,
        ("solve", COMMUNICATION): 8.0,
        ("solve", WAITING): 16.0,
    }
    assert watch.seconds == {"rest": 34.0, "solve": 28.0}


def test_an_error_closes_what_was_open(wait):
    watch = Stopwatch()
    with pytest.raises(OSError), watch.phase("record"), watch.kind(WAITING):
        raise OSError
    wait(1.0)
    assert sum(watch.seconds.values()) == 0.0


def test_waiting_outside_of_a_step_is_not_counted(wait):
    watch = Stopwatch()
    with watch.kind(WAITING):
        wait(1.0)
    assert watch.seconds == {}


def test_laps_add_up_even_amid_a_phase(wait):
    watch = Stopwatch()
    with watch.phase("rest"):
        wait(1.0)
        assert watch.lap() == {("rest", WORK): 1.0}
        wait(2.0)
    with watch.phase("solve"):
        wait(4.0)
    assert watch.lap() == {("rest", WORK): 2.0, ("solve", WORK): 4.0}
    assert watch.lap() == {("rest", WORK): 0.0, ("solve", WORK): 0.0}
