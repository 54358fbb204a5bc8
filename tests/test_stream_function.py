"""Steep regular waves: against tables, limits and conservation, and the piston that makes them."""

import numpy as np
import pytest
from scipy.optimize import brentq

from mpslab.core import plugins
from mpslab.core.parameters import Wavemaker
from mpslab.theory import stream_function, waves

G = 9.81

# H/h, T sqrt(g/h), L/h and the harmonics k E_j of the surface, as Fenton's program FOURIER prints
# them for no mean current.
PUBLISHED = [
    (0.375, 9.9045, 9.7556,
     [1.0563897e-01, 3.8999027e-02, 1.3066154e-02, 4.5740107e-03]),
    (0.0971, 3.7971, 2.3152, [1.3079161e-01, 9.0857820e-03, 9.3650328e-04, 1.1486997e-04]),
    (0.1870, 4.7571, 3.5153, [1.6445405e-01, 1.7598905e-02, 2.5810681e-03, 4.5271375e-04]),
]  # fmt: skip


@pytest.mark.parametrize(("height", "period", "length", "harmonics"), PUBLISHED)
def test_wave_is_that_of_fentons_program(height, period, length, harmonics):
    wave = stream_function.solve(height, period * np.sqrt(1.0 / G), 1.0, G, closed=False)
    assert wave.length == pytest.approx(length, rel=1e-4)
    found = wave.surface[: len(harmonics)] * wave.number
    np.testing.assert_allclose(found, harmonics, rtol=2e-3)
    assert wave.current == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("ratio", "highest"), [(9.7556, 0.707), (2.3152, 0.323), (3.5153, 0.459), (2.1938, 0.307)]
)
def test_highest_wave_is_that_of_fentons_program(ratio, highest):
    assert stream_function.highest(ratio, 1.0) == pytest.approx(highest, abs=6e-4)


def test_highest_wave_has_its_limits():
    assert stream_function.highest(0.1, 1.0) == pytest.approx(0.0141, rel=0.01)
    assert stream_function.highest(1e4, 1.0) == pytest.approx(0.833, abs=1e-3)


def test_low_wave_is_linear():
    wave = stream_function.solve(1e-5, 1.0, 0.3, G)
    assert wave.length == pytest.approx(waves.wavelength(1.0, 0.3, G), rel=1e-7)
    assert wave.elevation(0.0) == pytest.approx(5e-6, rel=1e-3)


@pytest.mark.parametrize("steepness", [0.05, 0.2, 0.3])
def test_deep_wave_has_the_speed_of_stokes_fifth_order(steepness):
    """c^2 k / g = 1 + e^2 + e^4 / 2 ... with e = k H / 2 (Fenton 1985: c = 1 + e^2/2 + e^4/8)."""
    length, height = 1.0, steepness / np.pi
    k = 2.0 * np.pi / length
    speed = np.sqrt(G / k) * (1.0 + 0.5 * steepness**2 + 0.125 * steepness**4)
    wave = stream_function.solve(height, length / speed, 20.0, G, closed=False)
    assert wave.length == pytest.approx(length, rel=0.3 * steepness**6 + 1e-6)


def test_long_wave_tends_to_the_solitary_one():
    height, depth = 0.2, 1.0
    wave = stream_function.solve(height, 20.0, depth, G)
    trough = depth + wave.elevation(np.pi)
    e = height / trough  # Fenton (1972): c^2 / g h = 1 + e - e^2/20 - 3 e^3/70
    speed = np.sqrt(G * trough * (1.0 + e - e**2 / 20.0 - 3.0 * e**3 / 70.0))
    # The solitary wave runs through still water, this one against the current below its troughs.
    against = wave.celerity * wave.elevation(np.pi) / trough
    assert wave.celerity - against == pytest.approx(speed, rel=2e-3)


def test_both_conditions_hold_at_the_surface_between_the_points():
    wave = stream_function.solve(0.025, 0.777, 0.04, G)
    angle = np.linspace(0.0, np.pi, 301)
    z = wave.depth + wave.elevation(angle)
    order = np.arange(1, len(wave.speed) + 1)
    k = order * wave.number
    turned = np.outer(angle, order)
    rest = wave.current - wave.celerity
    u = (np.cosh(np.outer(z, k)) * np.cos(turned)) @ wave.speed + rest
    w = (np.sinh(np.outer(z, k)) * np.sin(turned)) @ wave.speed
    stream = (np.sinh(np.outer(z, k)) * np.cos(turned)) @ (wave.speed / k) + rest * z
    head = 0.5 * (u * u + w * w) + G * z
    assert np.ptp(stream) < 1e-3 * abs(stream.mean())
    assert np.ptp(head) < 2e-3 * G * wave.height
    # In a closed tank no water is carried on the whole.
    assert -stream.mean() == pytest.approx(wave.celerity * wave.depth, rel=1e-3)


def test_wave_that_is_too_high_is_refused_with_the_height_that_is_not():
    with pytest.raises(ValueError, match=r"must be up to about 0\.0285\d* m, 0\.97 of the highest"):
        stream_function.solve(0.03, 0.777, 0.04, G)


def test_wave_is_that_of_raschii():
    raschii = pytest.importorskip("raschii")
    other = raschii.FentonWave(height=0.2, depth=1.0, length=8.0, N=20)
    wave = stream_function.solve(0.2, 8.0 / other.c, 1.0, G, closed=False)
    assert wave.length == pytest.approx(8.0, rel=1e-6)
    x = np.linspace(0.0, 4.0, 9)
    found = 1.0 + wave.elevation(x * wave.number)
    np.testing.assert_allclose(found, other.surface_elevation(x), atol=1e-6)


# The piston


def make(**given):
    maker = Wavemaker(type="stream_function", **given)
    return plugins.load("wavemakers", "stream_function").make(maker, 0.04, G, 5.0)


@pytest.mark.parametrize("height", [0.002, 0.0196, 0.027])
def test_piston_follows_the_depth_mean_velocity_at_its_face(height):
    motion = make(height=height, period=0.777)
    wave = stream_function.solve(height, 0.777, 0.04, G)
    t = np.linspace(0.0, 1.6, 801)[1:]
    x = np.array([motion.displacement(s) for s in t])
    later, earlier = (np.array([motion.displacement(s + d) for s in t]) for d in (1e-6, -1e-6))
    v = (later - earlier) / 2e-6
    start = brentq(wave.elevation, 0.0, np.pi)
    eta = wave.elevation(start + wave.number * (x - wave.celerity * t))
    expected = wave.celerity * eta / (wave.depth + eta)
    np.testing.assert_allclose(v, expected, atol=2e-4 * np.abs(v).max())
    assert motion.displacement(0.777 * 40) == pytest.approx(0.0, abs=1e-9)


def test_piston_is_near_the_cnoidal_one_for_a_long_low_wave():
    other = plugins.load("wavemakers", "cnoidal").make(
        Wavemaker(type="cnoidal", height=0.004, period=1.5), 0.04, G, 5.0)  # fmt: skip
    assert make(height=0.004, period=1.5).stroke == pytest.approx(other.stroke, rel=0.03)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"height": 0.03}, r"^wavemaker\.height = 0\.03 m: must be up to about 0\.0285"),
        ({"height": 0.0}, r"^wavemaker\.height = 0 m: must be above 0"),
        ({"period": 0.0}, r"^wavemaker\.period = 0 s: must be above 0"),
        ({"stroke": 0.01}, r"^wavemaker\.stroke = 0\.01 m: must be 0"),
        ({"period": 500.0, "height": 0.02}, r"^wavemaker\.height = 0\.02 m: too long"),
    ],
)
def test_what_it_cannot_make_is_refused(changes, message):
    with pytest.raises(ValueError, match=message) as caught:
        make(**{"height": 0.01, "period": 0.777, **changes})
    assert "\n" not in str(caught.value)
