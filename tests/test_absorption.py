"""A piston that absorbs: its law against theory, its bits, and what it does to a wave."""

import numpy as np
import pytest
from ranks import alone, digest, start
from tanks import make_case

from mpslab import Simulation
from mpslab.solids.absorption import EXPECTED, LEVEL, Absorber
from mpslab.solids.piston import make_paddle
from mpslab.theory import absorption, waves
from mpslab.theory.absorption import Gauge, Law, Memory
from mpslab.theory.dispersion import biesel, wave_numbers

G, DEPTH = 9.81, 0.4
TINY = 1e-6 * DEPTH


def rate_of(kh, depth=DEPTH):
    """Angular frequency [rad/s], (n,)."""
    kh = np.atleast_1d(kh)
    return np.sqrt(G * kh / depth * np.tanh(kh))


def spectrum(kh, low=0.5, high=3.0):
    """Frequencies about that of a kh, and amplitudes of a JONSWAP-like sea."""
    f = np.linspace(low, high, 200)
    return f * rate_of(kh), np.sqrt(f**-5 * np.exp(-1.25 * f**-4))


def shallow(rate):
    """The law of long waves, without lag or washout."""
    return np.full(len(rate), np.sqrt(G / DEPTH)) + 0j


@pytest.mark.parametrize(
    ("kh", "ratio", "swell", "reflected"),
    [(0.314, 0.314, 0.001, 0.008), (0.54, 0.540, 0.006, 0.023), (1.0, 0.982, 0.057, 0.066),
     (1.25, 1.200, 0.120, 0.093), (2.0, 1.682, 0.43, 0.17), (2.5, 1.849, 0.66, 0.21)],
)  # fmt: skip
def test_law_of_long_waves_reflects_what_the_closed_form_says(kh, ratio, swell, reflected):
    """|R|^2 = ((1 - G c0)^2 + (G C)^2) / ((1 + G c0)^2 + (G C)^2), worked out by hand."""
    gauge = Gauge(rate_of(kh), DEPTH, G, TINY)
    assert gauge.out.real == pytest.approx(ratio, abs=2e-3)
    assert gauge.swell == pytest.approx(swell, abs=2e-2)
    assert np.abs(gauge.reflection(shallow)) == pytest.approx(reflected, abs=6e-3)


@pytest.mark.parametrize("kh", [0.3, 0.5, 1.0, 1.5, 2.5, 4.0])
@pytest.mark.parametrize("reach", [0.05, 0.15, 0.3])
def test_tuned_law_reflects_nothing_of_its_wave_and_never_much_more_than_all(kh, reach):
    gauge = Gauge(rate_of(kh), DEPTH, G, reach * DEPTH)
    law = absorption.tuned(gauge, 0.002)
    assert np.abs(gauge.reflection(law)) < 1e-12
    wide = Gauge(np.geomspace(0.01, 30.0, 500) * gauge.rate, DEPTH, G, reach * DEPTH)
    assert np.abs(wide.reflection(law)).max() < 1.35


@pytest.mark.parametrize("kh", [0.5, 1.0, 1.5, 2.5])
def test_fitted_law_reflects_less_of_a_sea_than_one_tuned_to_its_peak(kh):
    rate, amplitude = spectrum(kh)
    gauge = Gauge(rate, DEPTH, G, 0.1 * DEPTH)
    fitted = absorption.fitted(gauge, amplitude, 0.002)
    tuned = absorption.tuned(Gauge(rate_of(kh), DEPTH, G, 0.1 * DEPTH), 0.002)
    least = absorption.over(gauge.reflection(fitted), amplitude)
    assert least < 0.05
    assert least < 0.75 * absorption.over(gauge.reflection(tuned), amplitude)


def test_sea_that_no_lag_absorbs_safely_has_the_law_of_its_peak():
    """A gauge so wide that the short waves of the sea go through it twice."""
    rate, amplitude = spectrum(2.5)
    law = absorption.fitted(Gauge(rate, DEPTH, G, 0.5 * DEPTH), amplitude, 0.002)
    assert len(law.lags) == 1


@pytest.mark.parametrize("kh", [0.2, 0.5, 1.0, 2.5, 5.0])
def test_memory_of_the_moves_gives_the_level_of_theory(kh):
    (rate,), reach = rate_of(kh), 0.1 * DEPTH
    level = Memory(DEPTH, G, reach)
    (wanted,) = Gauge(np.array([rate]), DEPTH, G, reach).level
    found = [level(lambda t, s=shift: np.cos(rate * t + s), 0.0) for shift in (0.0, -0.5 * np.pi)]
    assert complex(*found) == pytest.approx(wanted, rel=3e-3)


def absorb(law, rate, reach, dt, periods=30.0):
    """R of an absorber with a gauge that follows linear theory, step by step."""
    level, seen = Memory(DEPTH, G, reach), absorption.seen(wave_numbers(rate, DEPTH, G), reach)
    absorber = Absorber(law, None, 10.0, 0.0, 100.0, 1000.0)
    times = np.arange(int(periods * 2.0 * np.pi / rate[0] / dt)) * dt
    path = np.zeros(len(times) + 1)
    standing = 2.0 * np.real(np.real(seen) * np.exp(1j * rate * times))
    for i, time in enumerate(times):
        read = standing[i] + level(lambda t: np.interp(t, times, path[:-1], 0.0), time)
        absorber.advance(time, dt, {LEVEL: read, EXPECTED: 0.0})
        path[i + 1] = absorber.at(time + dt)
    last = times > times[-1] - 10.0 * 2.0 * np.pi / rate[0]
    turned = np.exp(-1j * rate * times[last])
    moved = 2.0 * np.mean((path[:-1][last] - path[:-1][last].mean()) * turned)
    return abs(1.0 + 1j * biesel(wave_numbers(rate, DEPTH, G) * DEPTH)[0] * moved)


@pytest.mark.parametrize(("kh", "share"), [(0.5, 1.0), (1.0, 0.7), (2.5, 1.0), (2.5, 1.5)])
def test_absorber_reflects_what_its_law_does_step_by_step(kh, share):
    """The formula of the reflection against a direct calculation in time."""
    reach, peak = 0.1 * DEPTH, rate_of(kh)
    dt = 0.01
    law = absorption.tuned(Gauge(peak, DEPTH, G, reach), 0.5 * dt)
    rate = share * peak
    (wanted,) = np.abs(Gauge(rate, DEPTH, G, reach).reflection(law))
    assert absorb(law, rate, reach, dt) == pytest.approx(wanted, abs=0.012)


def test_fitted_absorber_reflects_what_its_law_does():
    reach, (rate, amplitude), dt = 0.1 * DEPTH, spectrum(1.0), 0.01
    law = absorption.fitted(Gauge(rate, DEPTH, G, reach), amplitude, 0.5 * dt)
    one = 1.6 * rate_of(1.0)
    (wanted,) = np.abs(Gauge(one, DEPTH, G, reach).reflection(law))
    assert absorb(law, one, reach, dt) == pytest.approx(wanted, abs=0.012)


def test_piston_stays_in_its_room_and_within_its_limits_whatever_it_reads():
    law = Law(np.array([5.0]), np.array([0.01]), 2.0, 0.0)
    absorber, random = Absorber(law, None, 0.05, 1.0, 0.3, 5.0), np.random.default_rng(1)
    time, speeds, dt = 0.0, [0.0], 0.003
    for _ in range(3000):
        read = 1.0 + 3.0 * np.sin(time) + random.normal()
        absorber.advance(time, dt, {LEVEL: read, EXPECTED: 0.0})
        time += dt
        assert abs(absorber.at(time)) <= 0.05
        speeds.append(absorber.speed)
    assert np.abs(speeds).max() <= 0.3
    assert np.abs(np.diff(speeds)).max() > 0.0


def test_a_level_that_is_wrong_all_the_time_does_not_move_the_piston_in_the_end():
    """The bias of the gauge is forgotten, and so is the way that the piston has gone for it."""
    law = absorption.tuned(Gauge(rate_of(1.0), DEPTH, G, 0.04), 0.001)
    absorber, dt = Absorber(law, None, 1.0, 0.0, 1.0, 5.0), 0.01
    for i in range(int(20.0 * law.washout / dt)):
        absorber.advance(i * dt, dt, {LEVEL: 0.01, EXPECTED: 0.0})
    assert abs(absorber.new) < 1e-4


SMALL = {
    "tank.length": 1.2, "tank.depth": 0.1, "particles.spacing": 0.01,
    "wavemaker.absorption": True, "time.end": 20.0,
}  # fmt: skip


def expected(reach=0.002, samples=64, **maker):
    """First two harmonics of the level that a piston expects of its own wave [m]."""
    spacing = reach / 3.0
    case = make_case({**SMALL, "tank.length": 6.0, "particles.spacing": spacing,
                      "wavemaker": {"absorption": True, **maker}})  # fmt: skip
    paddle = make_paddle(case)
    period = case.wavemaker.period
    times = 12.0 * period + period * np.arange(samples) / samples
    level = [paddle.absorber.expected(time) for time in times]
    return 2.0 / samples * np.abs(np.fft.rfft(level))[1:3]


def test_expected_level_is_that_of_the_wave_with_its_bound_harmonic():
    """Where second-order theory and stream function theory hold, they agree.

    The gauge goes with the piston, up the slope of the wave: X d eta/dx takes some of the bound
    harmonic away.
    """
    wave = {"height": 0.005, "period": 1.4}
    k = waves.wave_number(1.4, 0.1, G)
    tanh = np.tanh(k * 0.1)
    second = 0.0025**2 * k * (3.0 - tanh**2) / (4.0 * tanh**3)  # Stokes
    one, two = expected(type="second_order", **wave)
    assert one == pytest.approx(0.0025, rel=0.01)
    carried = 0.5 * 0.0025**2 * k / biesel(k * 0.1)
    assert two == pytest.approx(second - carried, rel=0.05)
    assert expected(type="stream_function", **wave) == pytest.approx([one, two], rel=0.03)


def test_long_wave_is_expected_with_its_sharp_crest():
    wave = {"height": 0.03, "period": 1.4}
    long, steep = (expected(type=kind, **wave) for kind in ("cnoidal", "stream_function"))
    assert long == pytest.approx(steep, rel=0.1)
    assert steep[1] > 0.25 * steep[0]


@pytest.mark.parametrize(
    "maker",
    [
        {"type": "linear", "height": 0.01, "period": 0.7},
        {"type": "solitary", "height": 0.03},
        {"type": "irregular", "height": 0.01, "period": 0.7, "order": 2},
        {"type": "focused", "height": 0.01, "period": 0.7, "place": 1.0},
        {"type": "bichromatic", "height": 0.01, "period": 0.7, "second_period": 0.8},
        {"type": "still", "period": 0.7, "room": 0.03},
    ],
)
def test_every_theory_knows_what_it_absorbs(maker):
    case = make_case({**SMALL, "tank.length": 3.0, "wavemaker": {"absorption": True, **maker}})
    paddle = make_paddle(case)
    assert paddle.facts["reflection_at_peak"] < 0.03
    assert paddle.facts["absorption"] in ("tuned", "fitted")
    assert paddle.farthest - paddle.backmost > paddle.stroke


@pytest.mark.parametrize(
    ("keys", "part"),
    [
        ({"type": "none"}, "wavemaker.absorption = true: must be false"),
        ({"type": "still", "room": 0.1}, "wavemaker.period = 0.0: must be > 0 s"),
        ({"type": "still", "period": 0.7}, "wavemaker.room = 0.0: must be > 0 m"),
        ({"type": "linear", "height": 0.01, "period": 0.7, "room": 9.0},
         "wavemaker.room = 9.0: must be < tank.length"),
        ({"type": "function", "function": "test_wavemaker_function:Follows", "stroke": 0.01},
         "wavemaker.absorption = true: must be false for an object"),
    ],
)  # fmt: skip
def test_absorption_that_cannot_be_is_refused_in_one_line(keys, part):
    with pytest.raises(ValueError, match="wavemaker") as refused:
        make_paddle(make_case({**SMALL, "wavemaker": {"absorption": True, **keys}}))
    assert part in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1


RUN = {
    "tank.length": 0.16, "tank.depth": 0.02, "particles.jitter": 0.01,
    "wavemaker": {"type": "linear", "height": 0.004, "period": 0.3, "absorption": True},
    "gauge": [{"name": "g", "x": 0.08}],
}  # fmt: skip
IRREGULAR = {
    **RUN, "tank.width": 0.016, "tank.periodic": True, "wavemaker.seed": 1,
    "wavemaker": {"type": "irregular", "height": 0.004, "period": 0.3, "absorption": True},
}  # fmt: skip
ENDS = (0.03, 0.01)


@pytest.mark.parametrize("ranks", [2, 3])
def test_absorbing_piston_moves_by_the_same_bits_on_many_ranks(ranks):
    calls = [["absorbed", RUN, ENDS[0]], ["absorbed", IRREGULAR, ENDS[1]]]
    one = alone("each", calls)
    assert start("each", ranks, calls) == one
    assert max(abs(row[2]) for row in one[0]["piston"]) > 0.0


def test_absorbing_piston_goes_on_after_a_restart_to_the_same_bits(tmp_path):
    whole = Simulation(make_case(RUN)).run(until=0.05)
    Simulation(make_case({**RUN, "time.end": 0.5}), tmp_path / "run").run(until=0.025)
    again = Simulation.resume(tmp_path / "run", {"time.end": 1.0}).run(until=0.05)
    assert digest(again.particles) == digest(whole.particles)
    rows = again.table("piston").tolist()
    assert len(rows) > 10
    assert rows == whole.table("piston").tolist()[-len(rows) :]


def test_standing_wave_dies_at_a_piston_that_absorbs():
    """After the time in which all of it has gone past the piston, little of it is left."""
    length = 0.6
    period = 2.0 * np.pi / np.sqrt(G * np.pi / length * np.tanh(np.pi / 6.0))
    wave = {
        "tank.length": length, "tank.depth": 0.1, "particles.spacing": 0.01, "time.end": 3.0,
        "initial": {"type": "standing_wave", "amplitude": 0.012, "mode": 1},
        "gauge": [{"name": "end", "x": length}],
    }  # fmt: skip
    absorbs = {"type": "still", "period": period, "room": 0.1, "absorption": True}
    late = {}
    for name, maker in (("wall", {"type": "none"}), ("absorbs", absorbs)):
        run = Simulation(make_case({**wave, "wavemaker": maker})).run(until=2.5 * period)
        level = run.gauges["end"][run.gauges["time"] > 1.4 * period]
        late[name] = np.ptp(level)
    assert late["wall"] > 0.016
    assert late["absorbs"] < 0.15 * late["wall"]
