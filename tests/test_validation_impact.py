"""How the case `impact` reads a sensor, its record and the balance of energy."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpslab.forcings.frame import make
from validation import suite
from validation.impact import compare as impact

RAMP = 3e-3  # seconds of a blow's rise and of its fall


def blows(time):
    """Two triangles of 3 and 2 kPa, 6 ms at the foot, and then 0.8 kPa."""
    tops = ((2.40, 3e3), (4.00, 2e3))
    blow = sum(top * np.clip(1.0 - np.abs(time - t) / RAMP, 0.0, None) for t, top in tops)
    return blow + 800.0 * ((time > 2.45) & (time < 2.80))


@pytest.fixture
def sensor():
    time = np.sort(np.random.default_rng(1).uniform(0.0, 4.15, 200_000))
    return impact.Sensor(SimpleNamespace(pressure=lambda name: (time, blows(time))))


def test_a_blow_is_found_with_its_peak_and_impulse(sensor):
    assert sensor.hits == pytest.approx({"first": 2.3975, "second": 3.99775}, abs=2e-4)
    smoothed = 3.0 * (1.0 - 0.25 * impact.MEAN / RAMP)
    assert sensor.peak("first") == pytest.approx(smoothed, rel=1e-3)
    assert sensor.impulse("second", impact.BLOW) == pytest.approx(2e3 * RAMP, rel=0.05)
    assert sensor.impulse("first", impact.RUN_UP) == pytest.approx(3e3 * RAMP + 280.0, rel=0.01)


def test_a_run_that_ends_before_the_water_hits_has_no_value():
    time = np.linspace(0.0, 2.0, 100)
    sensor = impact.Sensor(SimpleNamespace(pressure=lambda name: (time, 0.0 * time)))
    assert np.isnan(sensor.row()[:-1]).all()


def test_the_record_has_bins_without_a_gap_where_impulses_are_taken():
    record = impact.Record()
    for start, lasting in ((2.374, impact.RUN_UP), (4.048, impact.BLOW)):
        time, pressures = record.part(start, start + lasting)
        assert np.diff(time) == pytest.approx(impact.BIN)
        assert len(time) * impact.BIN == pytest.approx(lasting)
        assert np.all(pressures[0] <= pressures[2])


@pytest.mark.parametrize("kick", [0.0, 0.1])
def test_free_flight_in_a_tank_that_rolls_gains_what_a_kick_gives(kick):
    (run, *_) = suite.load("impact").runs
    inertia, weight = make(run.resolved), np.array([0.0, 0.0, -9.81])
    place, velocity = np.array([[0.1, 0.0, 0.3], [0.7, 0.0, 0.2]]), np.array([[1.0, 0.0, 2.0]] * 2)
    frames, step = [], 1e-3
    for time in np.arange(2.0, 2.2005, step):
        if len(frames) == 100:
            velocity = velocity * (1.0 + kick)
        frames.append((time, place, velocity))
        force = inertia(place + 0.5 * step * velocity, velocity, time + 0.5 * step) + weight
        place, velocity = place + step * (velocity + 0.5 * step * force), velocity + step * force
    flight = SimpleNamespace(case=run.resolved, gravity=9.81, water=lambda: frames)
    before = np.square(frames[0][2]).sum()
    kicked = np.square(frames[100][2]).sum() * (1.0 - 1.0 / (1.0 + kick) ** 2)
    assert impact.gain(flight, 2.1) == pytest.approx(kicked / before, abs=2e-3)
