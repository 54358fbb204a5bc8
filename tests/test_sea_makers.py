"""Pistons for a sea: what their motion makes, to first and second order, and what they refuse."""

import numpy as np
import pytest

from mpslab.core import plugins
from mpslab.core.parameters import Wavemaker
from mpslab.solids.wavemakers import _sea, _table, irregular
from mpslab.theory import dispersion, schaffer, spectra, waves

G, DEPTH, HEIGHT, PERIOD = 9.81, 0.3, 0.03, 1.2
END = 150 * PERIOD


def make(name, end=END, depth=DEPTH, **given):
    maker = Wavemaker(**{"type": name, "height": HEIGHT, "period": PERIOD, **given})
    return plugins.load("wavemakers", name).make(maker, depth, G, end)


def sea_of(**given):
    maker = Wavemaker(**{"type": "irregular", "height": HEIGHT, "period": PERIOD, **given})
    return maker, _sea.of_wavemaker(maker, DEPTH, G, maker.record)


def series_of(motion, record, count):
    """Complex amplitudes of a motion at multiples of 1 / record, from one record of it."""
    t = 2.0 * record + record * np.arange(count) / count
    x = np.array([motion.displacement(s) for s in t])
    return 2.0 * np.fft.rfft(x) / count


def refusal(name, **given):
    with pytest.raises(ValueError) as caught:
        make(name, **given)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# Tables


@pytest.mark.parametrize("cyclic", [True, False])
def test_table_has_the_derivatives_of_what_it_gives(cyclic):
    step, t = 0.05, 0.05 * np.arange(40)
    table = _table.Table(step, np.sin(t), np.cos(t), -np.sin(t), cyclic)
    times = np.linspace(0.0, 1.5, 400)
    np.testing.assert_allclose(table(times), np.sin(times), atol=1e-11)
    np.testing.assert_allclose(table(times, 1), np.cos(times), atol=1e-9)
    np.testing.assert_allclose(table(times, 2), -np.sin(times), atol=1e-6)
    at = step * np.arange(1, 30)
    for order in (0, 1, 2):
        left, right = table(at - 1e-10, order), table(at + 1e-10, order)
        np.testing.assert_allclose(left, right, atol=1e-8)


def test_table_of_waves_is_their_sum_again_and_again():
    rng = np.random.default_rng(0)
    series = rng.standard_normal(30) + 1j * rng.standard_normal(30)
    table, rate = _table.of_series(series, 0.2), 0.2 * np.arange(1, 30)
    near = (1e-7, 1e-5, 1e-3)
    for t in (0.0, 0.3, 7.77, 100.1, 10 * table.length + 0.3):
        for order in (0, 1, 2):
            terms = series[1:] * (1j * rate) ** order * np.exp(1j * rate * t)
            scale = np.sum(np.abs(series[1:]) * rate**order)
            assert table(t, order) == pytest.approx(terms.sum().real, abs=near[order] * scale)
    assert float(table(0.3)) == float(table(np.array([0.1, 0.3]))[1])


def test_fading_in_and_out_is_smooth():
    def motion(t, n=0):
        return np.sin(3.0 * t + 0.5 * np.pi * n) * 3.0**n

    faded = _table.Faded(motion, 2.0, 1.0, 9.0, 1.5)
    t = np.linspace(-1.0, 11.0, 4001)
    x, dt = faded(t), t[1] - t[0]
    np.testing.assert_allclose(faded(t, 1)[1:-1], (x[2:] - x[:-2]) / (2 * dt), atol=1e-3)
    bend = (x[2:] - 2 * x[1:-1] + x[:-2]) / dt**2
    assert np.mean(np.abs(faded(t, 2)[1:-1] - bend)) < 1e-2
    assert np.all(x[(t < 1.0) | (t > 9.0)] == 0.0)
    slow = _table.Faded(motion, 20.0, 1.0, 9.0, 1.5)  # it ends before it is whole
    assert np.all(slow(t)[t > 9.0] == 0.0)
    assert np.max(np.abs(np.diff(slow(t)))) < 0.02


# Irregular


@pytest.mark.parametrize("spectrum", ["jonswap", "pierson_moskowitz", "tma"])
def test_variance_of_the_waves_is_that_of_the_height(spectrum):
    _, sea = sea_of(spectrum=spectrum, band=(0.6, 2.0))
    amplitude = irregular.draw(sea, "deterministic", 3)
    assert 0.5 * np.sum(np.abs(amplitude) ** 2) == pytest.approx(HEIGHT**2 / 16.0, rel=1e-12)
    eta = _sea.surface(sea, amplitude)(np.arange(0.0, sea.record, 0.05))
    assert 4.0 * np.std(eta) == pytest.approx(HEIGHT, rel=1e-3)


def test_spectrum_comes_back_from_the_motion_of_the_piston():
    record = 60.0
    motion = make("irregular", record=record)
    found = series_of(motion, record, 2048)
    rate = 2.0 * np.pi * np.arange(1, 1025) / record
    ratio = dispersion.biesel(dispersion.wave_numbers(rate, DEPTH, G) * DEPTH)
    variance = 0.5 * np.abs(found[1:] * ratio) ** 2
    f = rate / (2.0 * np.pi)
    band = (f * PERIOD >= 0.5) & (f * PERIOD <= 3.0)
    expected = spectra.density("jonswap", f, HEIGHT, PERIOD, 3.3, DEPTH, G) / record
    scale = HEIGHT**2 / 16.0 / expected[band].sum()
    np.testing.assert_allclose(variance[band], scale * expected[band], rtol=1e-4)
    assert np.max(variance[~band]) < 1e-9 * variance.sum()


def test_random_amplitudes_have_the_height_in_the_mean_and_scatter_as_they_must():
    """cov of m0 is sqrt(sum v^2) / sum v for Gaussian parts."""
    _, sea = sea_of(record=40.0)
    drawn = np.array([0.5 * np.sum(np.abs(irregular.draw(sea, "random", s)) ** 2)
                      for s in range(400)])  # fmt: skip
    total = sea.variance.sum()
    scatter = np.sqrt(np.sum(sea.variance**2)) / total
    assert drawn.mean() / total == pytest.approx(1.0, abs=4.0 * scatter / 20.0)
    assert drawn.std() / total == pytest.approx(scatter, rel=0.2)


def test_seed_makes_the_sea_and_the_same_seed_the_same():
    t = np.linspace(0.0, 20.0, 101)
    one, other, third = (
        np.array([m.displacement(s) for s in t])
        for m in (make("irregular", seed=4), make("irregular", seed=4), make("irregular", seed=5))
    )
    assert np.array_equal(one, other)
    assert not np.allclose(one, third, atol=1e-4)


def test_second_order_adds_what_schaffer_says_and_a_narrow_sea_gets_its_long_waves():
    given = {"record": 40.0, "height": 0.01}
    one, two = (make("irregular", order=order, **given) for order in (1, 2))
    added = series_of(two, 40.0, 2048) - series_of(one, 40.0, 2048)
    maker, sea = sea_of(**given)
    amplitude = irregular.draw(sea, maker.amplitudes, maker.seed)
    lowest = 0.05 * 2.0 * np.pi / PERIOD
    expected = schaffer.motion(amplitude, sea.first, sea.step, DEPTH, G, lowest)
    np.testing.assert_allclose(
        added[1 : len(expected)], expected[1:], atol=1e-4 * np.abs(expected).max()
    )
    slow = added[2:10]
    assert np.abs(slow).max() > 0.02 * np.abs(series_of(one, 40.0, 2048)).max()


def test_numbers_for_people():
    motion = make("irregular")
    facts = motion.facts
    assert motion.height == HEIGHT
    assert facts["significant_height [m]"] == pytest.approx(HEIGHT)
    assert 140 <= facts["waves"] <= 220
    assert 1.5 * HEIGHT < facts["largest_height [m]"] < 2.3 * HEIGHT
    assert 0.005 < facts["spectrum_left_out"] < 0.02
    shortest = waves.wavelength(PERIOD / 3.0, DEPTH, G)
    assert facts["shortest_wavelength [m]"] == pytest.approx(shortest, rel=0.01)
    assert motion.doubts == ()


def test_doubts():
    (line,) = make("irregular", record=50.0).doubts
    assert "comes again before time.end" in line
    (line,) = make("irregular", band=(0.8, 1.5)).doubts
    assert "leaves out" in line
    lines = make("irregular", height=0.14).doubts
    assert any("it breaks at the maker" in line for line in lines)
    (line,) = make("irregular", height=0.06, depth=0.2, order=2, end=20.0).doubts
    assert "waves of 2 Hm0 are beyond second-order theory" in line


def test_spectrum_of_a_file_has_its_own_height_and_period_unless_others_are_given(tmp_path):
    f = np.linspace(0.1, 3.0, 200)
    path = tmp_path / "sea.csv"
    density = spectra.pierson_moskowitz(f, 0.02, 1.0)
    np.savetxt(path, np.column_stack([f, density]), delimiter=",", header="f [Hz],S [m2/Hz]")
    given = {"spectrum": "file", "file": str(path)}
    own = make("irregular", height=0.0, period=0.0, **given)
    assert own.height == pytest.approx(0.02, rel=0.01)
    assert own.facts["peak_period [s]"] == pytest.approx(1.0, rel=0.02)
    raised = make("irregular", height=0.03, period=1.0, **given)
    assert raised.height == 0.03
    with pytest.raises(ValueError, match=r"says rad"):
        path.write_text("omega [rad/s],S\n1,2\n2,3\n")
        make("irregular", **given)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"height": 0.0}, "wavemaker.height = 0 m: must be above 0"),
        ({"period": 0.0}, "wavemaker.period = 0 s: must be above 0"),
        ({"stroke": 0.1}, "wavemaker.stroke = 0.1 m: must be 0"),
        ({"height": 0.25}, "wavemaker.height = 0.25 m: must be below 0.198 m"),
        ({"band": (1.2, 2.0)}, "wavemaker.band = [1.2, 2.0]: must be two numbers"),
        ({"band": (0.5,)}, "wavemaker.band = [0.5]: must be two numbers"),
        ({"record": 1.0}, "wavemaker.record = 1 s: must be from 2.4 to 2400 s"),
        ({"record": 1e5}, "wavemaker.record = 100000 s: must be from 2.4 to 2400 s"),
        ({"order": 2, "period": 3.0}, "wavemaker.order = 2: must be 1 for so long a sea: Hm0"),
    ],
)
def test_irregular_refuses(changes, message):
    assert refusal("irregular", **changes).startswith(message)


# Focused


def elevation_at(maker_motion, place, time, record, count=4096):
    """First-order elevation that a motion makes at a place and a time, from its series."""
    t = record * np.arange(count) / count
    x = np.array([maker_motion.displacement(s) for s in t])
    series = 2.0 * np.fft.rfft(x) / count
    rate = 2.0 * np.pi * np.arange(1, len(series)) / record
    k = dispersion.wave_numbers(rate, DEPTH, G)
    waves_ = 1j * series[1:] * dispersion.biesel(k * DEPTH)
    waves_[rate > 2.0 * np.pi * 4.0 / PERIOD] = 0.0
    return (waves_ * np.exp(1j * (rate * np.atleast_1d(time)[:, None] - k * place))).sum(1).real


@pytest.mark.parametrize(("phase", "sign"), [(0.0, 1.0), (180.0, -1.0)])
def test_focused_wave_has_its_crest_at_its_place_and_time(phase, sign):
    motion = make("focused", place=4.0, amplitude=0.03, band=(0.5, 2.0), phase=phase)
    focus = motion.facts["focus_time [s]"]
    assert motion.doubts == ()
    t = focus + np.linspace(-2.0, 2.0, 401)
    eta = sign * elevation_at(motion, 4.0, t, 60.0)
    assert eta.max() == pytest.approx(0.03, rel=0.01)
    assert t[np.argmax(eta)] == pytest.approx(focus, abs=0.01 * PERIOD)
    assert np.abs(elevation_at(motion, 2.0, t, 60.0)).max() < 0.028


def test_four_phases_separate_the_orders():
    """The mean of two motions in opposite phase is of second order."""
    given = {"place": 3.0, "amplitude": 0.03, "order": 2, "band": (0.5, 2.0)}
    up, down = (make("focused", phase=p, **given) for p in (0.0, 180.0))
    half, less = (make("focused", **{**given, "amplitude": 0.015}, phase=p) for p in (0.0, 180.0))
    t = np.linspace(0.0, 20.0, 400)
    even, small = (
        np.array([a.displacement(s) + b.displacement(s) for s in t])
        for a, b in ((up, down), (half, less))
    )
    np.testing.assert_allclose(even, 4.0 * small, atol=1e-9)
    assert np.abs(even).max() > 1e-4


def test_focused_wave_is_the_highest_of_so_many():
    motion = make("focused", place=4.0, largest_of=1000)
    assert motion.facts["crest [m]"] == pytest.approx(HEIGHT / 4 * np.sqrt(2 * np.log(1000)))


def test_focused_wave_that_comes_too_soon_or_too_late_brings_a_warning():
    (line,) = make("focused", place=4.0, time=3.0, band=(0.5, 2.0)).doubts
    assert "before it has begun to move" in line
    long = make("focused", place=4.0, band=(0.5, 2.0), start=1e12).doubts
    assert any("100 % of the paddle's motion lies before" in line for line in long)
    (line,) = make("focused", place=4.0, band=(0.5, 2.0), end=5.0).doubts
    assert "after time.end" in line


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"place": 0.0}, "wavemaker.place = 0 m: must be above 0"),
        ({"amplitude": 0.2}, "wavemaker.amplitude = 0.2 m: must be below 0.09898"),
        ({"height": 0.12}, "wavemaker.height = 0.12 m: must be below 0.1065"),
    ],
)
def test_focused_refuses(changes, message):
    assert refusal("focused", **{"place": 4.0, **changes}).startswith(message)


# Bichromatic


def test_bichromatic_motion_has_two_waves_and_to_second_order_six():
    given = {"period": 1.2, "second_period": 1.0, "second_height": 0.02, "height": 0.03}
    for order, numbers in ((1, {5: 0.03, 6: 0.02}), (2, {1: None, 10: None, 11: None, 12: None})):
        found = series_of(make("bichromatic", order=order, **given), 6.0, 512)
        for number, height in numbers.items():
            rate = 2.0 * np.pi * number / 6.0
            ratio = dispersion.biesel(dispersion.wave_numbers(np.array([rate]), DEPTH, G) * DEPTH)
            if height:
                assert abs(found[number]) == pytest.approx(0.5 * height / ratio[0], rel=1e-9)
            else:
                assert abs(found[number]) > 1e-5
        others = [i for i in range(1, 250) if i not in (1, 5, 6, 10, 11, 12)]
        assert np.abs(found[others]).max() < 1e-12
    rates = 2.0 * np.pi * np.array([1.0, 1.0 / 1.2])
    slow = schaffer.transfer(rates[:1], rates[1:], -1, DEPTH, G)[0] * 0.01 * 0.015
    assert found[1] == pytest.approx(slow, rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"second_period": 0.0}, "wavemaker.second_period = 0 s: must be above 0"),
        ({"second_period": 8.0}, "wavemaker.second_period = 8 s: must be from 0.24 to 6 s"),
        ({"second_period": 1.21}, "wavemaker.second_period = 1.21 s: must differ"),
        ({"height": 0.1}, "wavemaker.height = 0.1 m: must be below 0.0"),
        ({"order": 2, "period": 4.0}, "wavemaker.order = 2: must be 1 for so long a wave"),
    ],
)
def test_bichromatic_refuses(changes, message):
    assert refusal("bichromatic", **{"second_period": 1.0, **changes}).startswith(message)


# A recorded elevation


def record_of(path, times, eta):
    np.savetxt(path, np.column_stack([times, eta]), delimiter=",", header="t [s],eta [m]",
               comments="")  # fmt: skip
    return {"file": str(path), "quantity": "elevation", "height": 0.0, "period": 0.0}


def test_recorded_elevation_is_made_by_linear_theory(tmp_path):
    rng = np.random.default_rng(2)
    times = 0.025 * (np.arange(2401) + np.append(0.0, rng.uniform(-0.4, 0.4, 2400)))
    rate = 2.0 * np.pi / PERIOD
    eta = 0.4 + 0.015 * np.cos(rate * times)
    motion = make("file", end=60.0, **record_of(tmp_path / "eta.csv", times, eta))
    ratio = waves.biesel_stroke_ratio(waves.wave_number(PERIOD, DEPTH, G) * DEPTH)
    t = np.linspace(10.0, 50.0, 500)
    x = np.array([motion.displacement(s) for s in t])
    np.testing.assert_allclose(x, 0.015 / ratio * np.sin(rate * t), atol=0.02 * 0.015 / ratio)
    assert motion.displacement(0.0) == 0.0
    assert motion.displacement(61.0) == 0.0


def test_run_may_begin_within_a_recorded_elevation(tmp_path):
    times = np.arange(0.0, 60.0, 0.02)
    eta = 0.015 * np.cos(2.0 * np.pi / PERIOD * times)
    given = record_of(tmp_path / "eta.csv", times, eta)
    whole, late = make("file", end=60.0, **given), make("file", end=60.0, offset=12.0, **given)
    assert late.displacement(0.0) == 0.0 and abs(late.displacement(1e-6)) < 1e-9
    for t in (20.0, 33.3):
        assert late.displacement(t - 12.0) == pytest.approx(whole.displacement(t), abs=1e-12)


def test_recorded_elevation_that_breaks_or_is_to_be_smoothed_is_refused(tmp_path):
    times = np.arange(0.0, 10.0, 0.05)
    given = record_of(tmp_path / "eta.csv", times, 0.2 * np.cos(times))
    with pytest.raises(ValueError, match=r"eta\.csv': its elevation goes through 0\.4 m: must be"):
        make("file", **given)
    given = record_of(tmp_path / "eta.csv", times, 0.02 * np.cos(times))
    with pytest.raises(ValueError, match=r"^wavemaker\.smoothing = 1 s: must be 0 for"):
        make("file", smoothing=1.0, **given)
