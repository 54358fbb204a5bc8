"""Wave theory against the paper's wave, limits and identities."""

import math

import numpy as np
import pytest
from scipy.special import ellipk

from mpslab.theory import breaking, waves

G = 9.81
# The paper's wave: T = 0.777 s, h = 0.040 m, H = 0.0196 m, slope 1:10.
PERIOD, DEPTH, HEIGHT, SLOPE = 0.777, 0.040, 0.0196, 0.1
LENGTH = waves.wavelength(PERIOD, DEPTH, G)
DEEP_LENGTH = waves.deep_wavelength(PERIOD, G)
DEEP_HEIGHT = HEIGHT / waves.shoaling_coefficient(PERIOD, DEPTH, G)


# Linear waves


def test_linear_numbers_of_the_paper_wave():
    k = waves.wave_number(PERIOD, DEPTH, G)
    assert k == pytest.approx(13.512, abs=5e-4)
    assert k * DEPTH == pytest.approx(0.5405, abs=5e-5)
    assert pytest.approx(0.4650, abs=5e-5) == LENGTH
    assert pytest.approx(0.9426, abs=5e-5) == DEEP_LENGTH
    assert waves.celerity(PERIOD, DEPTH, G) == pytest.approx(0.5985, abs=5e-5)
    assert waves.group_celerity(PERIOD, DEPTH, G) == pytest.approx(0.547, abs=5e-4)
    assert waves.ursell(HEIGHT, LENGTH, DEPTH) == pytest.approx(66.2, abs=0.05)


@pytest.mark.parametrize("period", [0.05, 0.3, 0.777, 2.0, 10.0, 300.0])
@pytest.mark.parametrize("depth", [0.001, 0.04, 1.0, 100.0])
def test_wave_number_solves_the_dispersion_relation(period, depth):
    k = waves.wave_number(period, depth, G)
    assert G * k * math.tanh(k * depth) == pytest.approx((2 * math.pi / period) ** 2, rel=1e-12)


def test_wave_number_of_nonsense_does_not_pass_silently():
    with pytest.raises(RuntimeError):
        waves.wave_number(1.0, math.nan, G)


def test_group_celerity_is_the_derivative_of_frequency():
    def frequency(k):
        return math.sqrt(G * k * math.tanh(k * DEPTH))

    k, dk = waves.wave_number(PERIOD, DEPTH, G), 1e-4
    slope = (frequency(k + dk) - frequency(k - dk)) / (2 * dk)
    assert waves.group_celerity(PERIOD, DEPTH, G) == pytest.approx(slope, rel=1e-8)


def test_group_celerity_in_deep_water_is_half_the_celerity():
    assert waves.group_celerity(0.1, 50.0, G) == pytest.approx(G * 0.1 / (4 * math.pi), rel=1e-12)


def test_biesel_ratio_of_the_paper_wave_and_its_stroke():
    ratio = waves.biesel_stroke_ratio(waves.wave_number(PERIOD, DEPTH, G) * DEPTH)
    assert ratio == pytest.approx(0.5395, abs=5e-5)
    assert pytest.approx(36.3e-3, abs=5e-5) == HEIGHT / ratio


@pytest.mark.parametrize("kh", [0.1, 0.5, 2.0, 5.0])
def test_biesel_ratio_agrees_with_its_other_form(kh):
    other = 2 * (math.cosh(2 * kh) - 1) / (math.sinh(2 * kh) + 2 * kh)
    assert waves.biesel_stroke_ratio(kh) == pytest.approx(other, rel=1e-12)


def test_biesel_ratio_has_its_limits_in_shallow_and_deep_water():
    assert waves.biesel_stroke_ratio(1e-6) == pytest.approx(1e-6, rel=1e-9)
    assert waves.biesel_stroke_ratio(5000.0) == pytest.approx(2.0, rel=1e-12)


def test_shoaling_of_the_paper_wave():
    assert waves.shoaling_coefficient(PERIOD, DEPTH, G) == pytest.approx(1.053, abs=5e-4)
    assert pytest.approx(18.6e-3, abs=5e-5) == DEEP_HEIGHT


# Standing waves


def test_standing_wave_frequency_is_that_of_linear_theory():
    omega = waves.standing_wave_frequency(1, 0.16, 0.04, G)
    assert 2 * math.pi / omega == pytest.approx(0.56, abs=0.005)  # trial in the method sheet
    assert waves.wave_number(2 * math.pi / omega, 0.04, G) == pytest.approx(math.pi / 0.16)


def standing(x, z):
    return waves.standing_wave_velocity(x, z, 0.004, 2, 0.16, DEPTH, G)


def test_standing_wave_moves_the_surface_and_nothing_through_bed_and_walls():
    x = np.linspace(0.0, 0.16, 17)
    omega, k = waves.standing_wave_frequency(2, 0.16, DEPTH, G), 2 * math.pi / 0.16
    surface, bed = standing(x, np.full_like(x, DEPTH)), standing(x, np.zeros_like(x))
    np.testing.assert_allclose(surface[1], 0.004 * omega * np.cos(k * x), atol=1e-16)
    np.testing.assert_allclose(bed[1], 0.0, atol=1e-16)
    np.testing.assert_allclose(surface[0][[0, -1]], 0.0, atol=1e-16)


def test_standing_wave_is_free_of_divergence_and_rotation():
    x, z, step = np.linspace(0.01, 0.15, 15), np.linspace(0.005, 0.035, 15), 1e-5
    (u_e, w_e), (u_w, w_w) = standing(x + step, z), standing(x - step, z)
    (u_n, w_n), (u_s, w_s) = standing(x, z + step), standing(x, z - step)
    scale = np.max(np.abs(u_e - u_w))
    np.testing.assert_allclose(u_e - u_w + w_n - w_s, 0.0, atol=1e-6 * scale)
    np.testing.assert_allclose(w_e - w_w - (u_n - u_s), 0.0, atol=1e-6 * scale)


# Cnoidal and solitary waves


def test_cnoidal_numbers_of_the_paper_wave():
    wave = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G)
    assert wave.m == pytest.approx(0.99353, abs=5e-6)
    assert wave.length == pytest.approx(0.514, abs=5e-4)
    assert wave.celerity == pytest.approx(0.662, abs=5e-4)
    assert wave.trough == pytest.approx(-5.0e-3, abs=5e-5)
    assert wave.eta(0.0) == pytest.approx(14.6e-3, abs=5e-5)


def test_cnoidal_harmonics_of_the_paper_wave():
    wave = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G)
    harmonics = 2 * np.abs(np.fft.rfft(wave.eta(np.arange(512) / 512)))[1:4] / 512
    np.testing.assert_allclose(harmonics, [7.8e-3, 4.1e-3, 1.7e-3], atol=5e-5)


@pytest.mark.parametrize("height", [4e-5, 4e-3, 0.0196, 0.031])
@pytest.mark.parametrize("place", [0.0, 0.3, 1.0])
def test_cnoidal_wave_keeps_its_equations(height, place):
    shortest, longest = waves.cnoidal_period_range(height, DEPTH, G)
    wave = waves.cnoidal_wave(height, shortest + place * (longest - shortest), DEPTH, G)
    eta = wave.eta((np.arange(20000) + 0.5) / 20000)
    assert wave.length == pytest.approx(wave.celerity * wave.period)
    ursell = waves.ursell(height, wave.length, DEPTH)
    assert ursell == pytest.approx(16 / 3 * wave.m * ellipk(wave.m) ** 2, rel=1e-6)
    assert np.mean(eta) == pytest.approx(0.0, abs=1e-6 * height)
    assert np.ptp(eta) == pytest.approx(height, rel=1e-4)
    assert wave.length >= 8 * DEPTH * (1 - 1e-9)


def test_cnoidal_elevation_is_even_and_periodic():
    wave, phase = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G), np.linspace(0.01, 0.49, 25)
    np.testing.assert_allclose(wave.eta(-phase), wave.eta(phase), atol=1e-15)
    np.testing.assert_allclose(wave.eta(phase + 3.0), wave.eta(phase), atol=1e-13)


def test_cnoidal_surface_rises_through_still_water_at_the_rising_phase():
    wave = waves.cnoidal_wave(HEIGHT, PERIOD, DEPTH, G)
    assert wave.eta(wave.rising_phase) == pytest.approx(0.0, abs=1e-15)
    assert wave.eta(wave.rising_phase - 0.01) > 0.0 > wave.eta(wave.rising_phase + 0.01)


def test_long_cnoidal_crest_is_a_solitary_wave():
    height = 0.01
    wave = waves.cnoidal_wave(height, waves.cnoidal_period_range(height, DEPTH, G)[1], DEPTH, G)
    x = np.linspace(-0.2, 0.2, 41)
    above_trough = wave.eta(x / wave.length) - wave.trough
    solitary = waves.solitary_elevation(x, height, DEPTH)
    np.testing.assert_allclose(above_trough, solitary, atol=1e-3 * height)


@pytest.mark.parametrize("period", [0.3, 100.0])
def test_cnoidal_wave_outside_its_range_is_refused(period):
    with pytest.raises(ValueError, match=r"period = .* must be from .* to .* s"):
        waves.cnoidal_wave(HEIGHT, period, DEPTH, G)


def test_solitary_wave_has_the_volume_of_its_paddle():
    x = np.linspace(-1.0, 1.0, 20001)
    volume = np.sum(waves.solitary_elevation(x, HEIGHT, DEPTH)) * (x[1] - x[0])
    assert volume == pytest.approx(2 * HEIGHT / waves.solitary_wave_number(HEIGHT, DEPTH))
    assert waves.solitary_celerity(HEIGHT, DEPTH, G) == pytest.approx(math.sqrt(G * 0.0596))


# Breaking


def test_limits_of_height():
    assert breaking.mccowan_height(DEPTH) == pytest.approx(0.0312)
    assert breaking.miche_height(LENGTH, DEPTH) == pytest.approx(0.0326, abs=5e-5)
    assert breaking.miche_height(0.1, 50.0) == pytest.approx(0.0142)


def test_paper_wave_is_out_of_the_range_of_madsen():
    assert pytest.approx(26.3, abs=0.05) == breaking.MADSEN_URSELL_LIMIT
    assert not breaking.madsen_in_range(HEIGHT, LENGTH, DEPTH)
    assert breaking.madsen_in_range(0.0077, LENGTH, DEPTH)
    assert not breaking.madsen_in_range(0.0079, LENGTH, DEPTH)


def test_paper_wave_plunges():
    xi = breaking.surf_similarity(SLOPE, DEEP_HEIGHT, DEEP_LENGTH)
    assert xi == pytest.approx(0.71, abs=0.005)
    assert breaking.breaker_type(xi) == "plunging"


@pytest.mark.parametrize(
    ("xi", "kind"), [(0.49, "spilling"), (0.51, "plunging"), (3.29, "plunging"), (3.31, "surging")]
)
def test_breaker_types_change_at_the_limits_of_battjes(xi, kind):
    assert breaking.breaker_type(xi) == kind


@pytest.mark.parametrize(
    ("index", "depth", "height"),
    [
        (breaking.goda_1970, 18.3e-3, 23.0e-3),
        (breaking.goda_2010, 20.1e-3, 22.5e-3),
        (breaking.weggel, 18.7e-3, 22.9e-3),
    ],
)
def test_breaking_point_of_the_paper_wave(index, depth, height):
    found = breaking.breaking_point(DEEP_HEIGHT, PERIOD, SLOPE, G, index)
    assert found == pytest.approx((depth, height), abs=6e-5)


@pytest.mark.parametrize(("coefficient", "depth"), [(0.12, 24.9e-3), (0.18, 17.4e-3)])
def test_breaking_depth_over_the_band_of_goda(coefficient, depth):
    def index(*place):
        return breaking.goda_1970(*place, coefficient)

    found, _ = breaking.breaking_point(DEEP_HEIGHT, PERIOD, SLOPE, G, index)
    assert found == pytest.approx(depth, abs=6e-5)


def test_shoaled_wave_has_the_breaker_height_at_the_breaking_point():
    depth, height = breaking.breaking_point(DEEP_HEIGHT, PERIOD, SLOPE, G)
    shoaled = DEEP_HEIGHT * waves.shoaling_coefficient(PERIOD, depth, G)
    assert shoaled == pytest.approx(height, rel=1e-8)


def test_wave_too_steep_for_deep_water_has_no_breaking_point():
    with pytest.raises(ValueError, match=r"deep-water height = 0.2 m: must be below"):
        breaking.breaking_point(0.2, PERIOD, SLOPE, G)


# Run-up


def test_hunt_runup_of_the_paper_wave():
    assert breaking.hunt_runup(DEEP_HEIGHT, PERIOD, SLOPE, G) == pytest.approx(13.2e-3, abs=6e-5)


def test_synolakis_runup_at_his_slope():
    slope, depth = 1 / 19.85, 0.3
    limit = 0.8183 * 19.85 ** (-10 / 9) * depth
    assert not breaking.synolakis_breaks(0.99 * limit, depth, slope)
    assert breaking.synolakis_breaks(1.01 * limit, depth, slope)
    runup = breaking.synolakis_runup(0.0185 * depth, depth, slope)
    assert runup / depth == pytest.approx(2.831 * math.sqrt(19.85) * 0.0185**1.25)
    assert breaking.synolakis_breaking_runup(0.3 * depth, depth) / depth == pytest.approx(
        0.550, abs=5e-4
    )


def test_synolakis_runup_of_a_breaking_wave_is_refused():
    with pytest.raises(ValueError, match=r"height = 0.09 m: must be up to"):
        breaking.synolakis_runup(0.09, 0.3, 1 / 19.85)
