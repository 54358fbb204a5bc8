"""Motion of the paddle: a contract for every wavemaker, then each theory by itself."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from mpslab import cases
from mpslab.core import plugins
from mpslab.core.keys import CaseError
from mpslab.solids import paddle
from mpslab.theory import waves

G = 9.81
DEPTH = 0.040
PERIOD, HEIGHT = 0.777, 0.0196  # the paper's wave
END = 3.0


def settings(**given):
    blank = {"type": "", "height": 0.0, "period": 0.0, "stroke": 0.0, "first": "forward",
             "start": 0.0, "file": "", "offset": 0.0, "smoothing": 0.0, "second_height": 0.0,
             "second_period": 0.8 * PERIOD, "spectrum": "jonswap", "gamma": 3.3, "band": (0.5, 3.0),
             "record": 0.0, "amplitudes": "deterministic", "seed": 0, "order": 1, "place": 0.0,
             "time": 0.0, "amplitude": 0.0, "largest_of": 1000, "phase": 0.0,
             "quantity": "displacement"}  # fmt: skip
    return SimpleNamespace(**{**blank, **given})


def make(name, end=END, **given):
    return plugins.load("wavemakers", name).make(settings(type=name, **given), DEPTH, G, end)


def path(motion, times):
    return np.array([motion.displacement(t) for t in times])


def velocity(motion, times, dt=1e-6):
    return (path(motion, times + dt) - path(motion, times - dt)) / (2 * dt)


@pytest.fixture
def record(tmp_path):
    """A recorded motion that starts away from zero and at full speed."""
    t = np.arange(0.0, 2.5, 0.1)
    name = tmp_path / "record.csv"
    rows = np.column_stack([t, 0.1 + 0.005 * np.sin(2 * np.pi * t / PERIOD)])
    np.savetxt(name, rows, delimiter=",", header="time [s],displacement [m]", comments="")
    return name


# Contract. The wave is one that every theory takes (H L^2/h^3 = 20, L/h = 12).


# So short that all of the motion lies within the 9 s that the contract looks at.
SHORT = {
    "irregular": {"record": 6.0},
    "bichromatic": {"second_period": 0.5 * PERIOD},
    "focused": {"place": 0.2, "time": 3.0, "band": (0.5, 2.0)},
}


@pytest.fixture(params=[name for name in plugins.names("wavemakers") if name != "function"])
def build(request, record):
    def build(**given):
        wave = {"height": 0.006, "period": PERIOD, "file": record, **SHORT.get(request.param, {})}
        return make(request.param, **{**wave, **given})

    return build


def test_contract_starts_at_rest_at_zero(build):
    motion = build()
    assert motion.displacement(0.0) == 0.0
    assert motion.displacement(-1.0) == 0.0
    assert abs(motion.displacement(1e-7)) / 1e-7 < 1e-5  # m/s


@pytest.mark.parametrize("start", [0.0, 1.5])
def test_contract_is_smooth_everywhere(build, start):
    motion, times = build(start=start), np.linspace(-0.01, END + 0.5, 7001)
    x = path(motion, times)
    v = np.diff(x) / np.diff(times)
    assert np.all(np.isfinite(x))
    assert np.max(np.abs(np.diff(v))) <= 0.02 * np.max(np.abs(v))


def test_contract_states_its_extremes(build):
    motion = build()
    x = path(motion, np.linspace(0.0, END, 10001))
    tolerance = 1e-3 * motion.stroke + 1e-15
    assert motion.backmost == pytest.approx(np.min(x), abs=tolerance)
    assert motion.foremost == pytest.approx(np.max(x), abs=tolerance)
    assert motion.stroke == pytest.approx(motion.foremost - motion.backmost, rel=1e-9)
    assert motion.backmost <= 0.0 <= motion.foremost


def test_contract_extremes_are_those_until_the_end_of_the_run(build):
    motion = build(end=0.1)
    assert motion.foremost == pytest.approx(max(path(motion, np.linspace(0, 0.1, 2001))), abs=1e-8)


@pytest.mark.parametrize("start", [0.0, 1.5])
def test_contract_extremes_of_the_whole_motion_do_not_depend_on_the_end_of_the_run(build, start):
    early, late = build(start=start, end=0.1), build(start=start, end=9.0)
    assert (early.backmost, early.farthest) == (late.backmost, late.farthest)
    x = path(early, np.linspace(0.0, 9.0, 20001))
    tolerance = 1e-3 * late.stroke + 1e-15
    assert early.backmost == pytest.approx(np.min(x), abs=tolerance)
    assert early.farthest == pytest.approx(np.max(x), abs=tolerance)


def test_contract_is_the_same_each_time_and_whatever_the_end(build):
    times = np.linspace(0.0, 2.0, 501)
    first = path(build(), times)
    assert np.array_equal(path(build(), times), first)
    assert np.array_equal(path(build(end=5.0), times), first)
    assert np.array_equal(path(build(), times[::-1])[::-1], first)


def test_contract_soft_start_fades_the_same_motion_in(build):
    hard, soft = build(), build(start=1.5)
    assert path(soft, [1.5, 2.0]) == pytest.approx(path(hard, [1.5, 2.0]), rel=1e-12)
    assert soft.displacement(0.75) == pytest.approx(0.5 * hard.displacement(0.75), rel=1e-12)


def test_contract_has_a_plain_note(build):
    motion = build()
    assert motion.note and "\n" not in motion.note
    assert motion.height in (0.0, pytest.approx(0.006))


# Soft start


def test_soft_start_rises_from_zero_to_one_with_level_ends():
    t = np.array([0.0, 1e-4, 0.5, 1.0, 1.5, 2.0, 3.0])
    expected = [0.0, 0.0, 0.15625, 0.5, 0.84375, 1.0, 1.0]
    np.testing.assert_allclose(paddle.soft_start(t, 2.0), expected, atol=1e-8)
    np.testing.assert_array_equal(paddle.soft_start(t, 0.0), 1.0)


# Linear


def test_linear_is_a_cosine_of_the_biesel_stroke():
    motion, t = make("linear", height=HEIGHT, period=PERIOD), np.linspace(0.0, END, 301)
    assert motion.stroke == pytest.approx(36.3e-3, abs=5e-5)
    expected = 0.5 * motion.stroke * (1 - np.cos(2 * np.pi * t / PERIOD))
    np.testing.assert_allclose(path(motion, t), expected, atol=1e-6)
    assert np.max(velocity(motion, t)) == pytest.approx(0.147, abs=5e-4)
    assert motion.height == HEIGHT


@pytest.mark.parametrize(("name", "height"), [("linear", HEIGHT), ("second_order", 0.006)])
def test_a_piston_that_goes_backward_first_does_later_what_the_other_did(name, height):
    forward = make(name, height=height, period=PERIOD)
    back = make(name, height=height, period=PERIOD, first="backward")
    t = np.linspace(0.0, 2.0, 401)
    moved = path(back, t)
    assert back.foremost == pytest.approx(0.0, abs=1e-12)
    assert back.backmost == pytest.approx(-forward.stroke, rel=1e-3)
    assert np.all(np.diff(moved[t < 0.4 * PERIOD]) < 0.0)
    # The same cycle, from the place where it turns back.
    turn = minimize_scalar(lambda t: -forward.displacement(t), bounds=(0.0, PERIOD)).x
    late = path(forward, t + turn)
    np.testing.assert_allclose(moved - moved[0], late - late[0], atol=2e-4 * forward.stroke)


@pytest.mark.parametrize("name", ["cnoidal", "solitary", "still"])
def test_backward_first_is_refused_where_a_theory_has_no_such_motion(name):
    changes = {"wavemaker.type": name, "wavemaker.first": "backward"}
    with pytest.raises(CaseError, match=r"wavemaker\.first = 'backward': must be 'forward' for"):
        cases.load_case("plunging_breaker", changes)


def test_linear_stroke_overrides_the_height():
    motion = make("linear", height=HEIGHT, stroke=0.055, period=PERIOD)
    assert motion.stroke == pytest.approx(0.055, rel=1e-4)
    assert motion.height == pytest.approx(0.5395 * 0.055, rel=1e-4)


def test_linear_note_says_when_the_wave_is_too_long():
    assert "secondary crests" in make("linear", height=HEIGHT, period=PERIOD).note
    assert "secondary crests" not in make("linear", height=0.006, period=PERIOD).note


# Second order


def test_second_order_adds_the_harmonic_of_madsen():
    height = 0.007
    motion = make("second_order", height=height, period=PERIOD)
    kh = waves.wave_number(PERIOD, DEPTH, G) * DEPTH
    ratio = waves.biesel_stroke_ratio(kh)
    second = height**2 / (32 * DEPTH) * (3 * np.cosh(kh) / np.sinh(kh) ** 3 - 2 / ratio)
    harmonics = 2 * np.abs(np.fft.rfft(path(motion, PERIOD * (1 + np.arange(64) / 64)))) / 64
    assert harmonics[1] == pytest.approx(0.5 * height / ratio, rel=1e-9)
    assert harmonics[2] == pytest.approx(second, rel=1e-9)
    assert harmonics[3] < 1e-12


def test_second_order_pushes_faster_than_it_draws_back():
    motion = make("second_order", height=0.007, period=PERIOD)
    v = velocity(motion, np.linspace(0.01, PERIOD, 400))
    assert np.max(v) > 1.2 * -np.min(v)


def test_second_order_takes_its_first_order_stroke_from_the_case():
    from_height = make("second_order", height=0.006, period=PERIOD)
    ratio = waves.biesel_stroke_ratio(waves.wave_number(PERIOD, DEPTH, G) * DEPTH)
    from_stroke = make("second_order", stroke=0.006 / ratio, period=PERIOD)
    t = np.linspace(0.0, 2.0, 101)
    np.testing.assert_allclose(path(from_stroke, t), path(from_height, t), atol=1e-15)


def test_second_order_is_refused_for_the_paper_wave():
    message = r"^wavemaker\.height = 0\.0196 m: must be below 0\.007789 m .* = 66\.2, .* 26\.3"
    with pytest.raises(ValueError, match=message):
        make("second_order", height=HEIGHT, period=PERIOD)
    with pytest.raises(ValueError, match=r"^wavemaker\.stroke = 0\.03 m: must be below 0\.01444"):
        make("second_order", stroke=0.03, period=PERIOD)


# Cnoidal


@pytest.fixture(scope="module")
def cnoidal():
    return make("cnoidal", height=HEIGHT, period=PERIOD)


def paddle_speed(wave, place, t):
    eta = wave.eta(wave.rising_phase + place / wave.length - t / wave.period)
    return wave.celerity * eta / (wave.depth + eta)


def test_cnoidal_numbers_of_the_paper_wave(cnoidal):
    assert cnoidal.stroke == pytest.approx(3.42e-2, abs=6e-5)
    v = velocity(cnoidal, np.linspace(0.01, PERIOD, 2000))
    assert np.max(v) == pytest.approx(0.177, abs=5e-4)
    assert np.min(v) == pytest.approx(-0.094, abs=5e-4)


def test_cnoidal_follows_the_water_at_the_moving_face(cnoidal):
    wave = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G)
    solution = solve_ivp(
        lambda t, x: paddle_speed(wave, x, t), (0, END), [0.0], "DOP853", rtol=1e-12, atol=1e-14,
        t_eval=np.linspace(0, END, 200),
    )  # fmt: skip
    np.testing.assert_allclose(path(cnoidal, solution.t), solution.y[0], atol=1e-9)


def test_cnoidal_paddle_does_not_drift_but_would_if_it_ignored_its_own_motion(cnoidal):
    wave = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G)
    np.testing.assert_allclose(path(cnoidal, PERIOD * np.arange(1, 4)), 0.0, atol=1e-10)
    drift = PERIOD * np.mean(paddle_speed(wave, 0.0, PERIOD * np.arange(1000) / 1000))
    assert drift == pytest.approx(-11e-3, abs=5e-4)


def test_cnoidal_moves_forward_first(cnoidal):
    assert np.all(np.diff(path(cnoidal, np.linspace(0.0, 0.2, 50))) > 0.0)
    assert cnoidal.backmost == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("period", [0.4, 10.0])
def test_cnoidal_refuses_a_period_outside_its_theory(period):
    with pytest.raises(ValueError, match=rf"^wavemaker\.period = {period:g} s: must be from 0\.53"):
        make("cnoidal", height=HEIGHT, period=period)


# Solitary


def test_solitary_stroke_and_speed_are_those_of_goring():
    motion = make("solitary", height=HEIGHT)
    k = waves.solitary_wave_number(HEIGHT, DEPTH)
    c = waves.solitary_celerity(HEIGHT, DEPTH, G)
    assert motion.stroke == pytest.approx(2 * HEIGHT / (k * DEPTH), rel=1e-3)
    v = velocity(motion, np.linspace(0.0, 1.0, 4001))
    assert np.max(v) == pytest.approx(c * HEIGHT / (DEPTH + HEIGHT), rel=1e-5)
    assert np.min(v) >= 0.0


@pytest.mark.parametrize("height", [0.002, 0.0196, 0.031])
def test_solitary_follows_the_water_at_the_moving_face(height):
    motion = make("solitary", height=height)
    k = waves.solitary_wave_number(height, DEPTH)
    c = waves.solitary_celerity(height, DEPTH, G)
    t = np.linspace(1.0 / (k * c), END, 500)  # from the end of the fade on
    x, v = path(motion, t), velocity(motion, t)
    crest = t[np.argmax(v)] - x[np.argmax(v)] / c  # phase time at which the crest is at the face
    from_centre = x - 0.5 * motion.stroke
    origin = crest + 0.5 * motion.stroke / c
    eta = waves.solitary_elevation(from_centre - c * (t - origin), height, DEPTH)
    np.testing.assert_allclose(v, c * eta / (DEPTH + eta), atol=2e-2 * np.max(v))


def test_solitary_paddle_is_still_after_the_wave():
    motion = make("solitary", height=HEIGHT)
    assert motion.displacement(END) == pytest.approx(motion.displacement(END + 5.0), abs=1e-9)


# Ranges


@pytest.mark.parametrize("name", ["linear", "second_order", "cnoidal"])
@pytest.mark.parametrize("key", ["height", "period"])
@pytest.mark.parametrize("value", [0.0, -0.01, np.nan, np.inf])
def test_height_and_period_must_be_positive(name, key, value):
    with pytest.raises(ValueError, match=rf"^wavemaker\.{key} = .*: must be above 0"):
        make(name, **{"height": 0.006, "period": PERIOD, key: value})


def test_solitary_height_must_be_positive():
    with pytest.raises(ValueError, match=r"^wavemaker\.height = 0 m: must be above 0 m"):
        make("solitary")


@pytest.mark.parametrize(
    ("name", "limit"), [("linear", 0.03258), ("cnoidal", 0.0312), ("solitary", 0.0312)]
)
def test_wave_that_breaks_at_the_maker_is_refused(name, limit):
    make(name, height=0.999 * limit, period=PERIOD)
    with pytest.raises(ValueError, match=rf"^wavemaker\.height = .* below {limit} m .* breaks at"):
        make(name, height=1.001 * limit, period=PERIOD)


def test_stroke_that_breaks_the_wave_is_refused():
    with pytest.raises(ValueError, match=r"^wavemaker\.stroke = 0\.2 m: must be below 0\.06038 m"):
        make("linear", stroke=0.2, period=PERIOD)


@pytest.mark.parametrize("name", ["cnoidal", "solitary"])
def test_stroke_is_refused_where_the_theory_has_its_own(name):
    with pytest.raises(ValueError, match=r"^wavemaker\.stroke = 0\.03 m: must be 0"):
        make(name, height=HEIGHT, period=PERIOD, stroke=0.03)
