"""Spectra of a sea, and linear waves of many frequencies: heights, moments, limits."""

import numpy as np
import pytest

from mpslab.theory import dispersion, spectra, waves

G, HEIGHT, PERIOD = 9.81, 2.0, 8.0
F = spectra.ALL / PERIOD


def density(name, gamma=3.3, depth=20.0, f=F):
    return spectra.density(name, f, HEIGHT, PERIOD, gamma, depth, G)


@pytest.mark.parametrize("name", spectra.NAMES)
@pytest.mark.parametrize("gamma", [1.0, 3.3, 7.0])
def test_every_spectrum_has_the_height_asked_for(name, gamma):
    assert 4.0 * np.sqrt(spectra.moment(F, density(name, gamma))) == pytest.approx(HEIGHT, 1e-4)


def test_moments_of_pierson_and_moskowitz_are_those_of_its_gamma_functions():
    """m_n = (Hm0^2 / 16) (1.25)^(n/4) Gamma(1 - n/4) fp^n."""
    from math import gamma

    s = density("pierson_moskowitz")
    for n in (-1, 0, 1, 2):
        expected = HEIGHT**2 / 16.0 * 1.25 ** (n / 4) * gamma(1 - n / 4) / PERIOD**n
        assert spectra.moment(F, s, n) == pytest.approx(expected, rel=2e-3), n
    assert F[np.argmax(s)] == pytest.approx(1.0 / PERIOD, rel=1e-3)


def test_jonswap_is_that_of_the_handbooks_where_these_mean_the_same_height():
    """DNV: the spectrum of Pierson and Moskowitz times (1 - 0.287 ln gamma) gamma^r, a fit."""
    near = np.linspace(0.6, 2.5, 40) / PERIOD
    for gamma in (1.0, 2.0, 3.3, 5.0):
        factor = (1.0 - 0.287 * np.log(gamma)) * spectra.peak(near, PERIOD, gamma)
        expected = factor * spectra.pierson_moskowitz(near, HEIGHT, PERIOD)
        np.testing.assert_allclose(density("jonswap", gamma, f=near), expected, rtol=0.01)


def test_goda_names_another_height_than_hm0():
    """Goda's constants mean H1/3 of crossings, 3.83 sqrt(m0): 9 % more variance."""
    gamma = 1.0
    goda = 0.0624 * (1.094 - 0.01915 * np.log(gamma)) / (0.23 + 0.0336 * gamma - 0.185 / 2.9)
    assert goda / 0.3125 == pytest.approx((4.0 / 3.83) ** 2, rel=0.01)


def test_depth_takes_all_but_a_share_of_the_high_frequencies():
    deep = spectra.depth_factor(np.array([0.5]), 50.0, G)
    assert deep[0] == pytest.approx(1.0, abs=1e-6)
    f = np.array([0.005, 0.01])
    shallow = 0.5 * (2.0 * np.pi * f) ** 2 * 4.0 / G
    np.testing.assert_allclose(spectra.depth_factor(f, 4.0, G), shallow, rtol=0.01)
    # Halfway between, after Thompson and Vincent (1983), who fit it within 4 %.
    w = np.linspace(0.3, 1.9, 9)
    fit = np.where(w < 1.0, 0.5 * w**2, 1.0 - 0.5 * (2.0 - w) ** 2)
    found = spectra.depth_factor(w * np.sqrt(G / 4.0) / (2.0 * np.pi), 4.0, G)
    np.testing.assert_allclose(found, fit, atol=0.04)


def test_share_outside_of_a_band():
    s = density("pierson_moskowitz")
    low, high = 0.6 / PERIOD, 2.0 / PERIOD
    inside = np.exp(-1.25 * 2.0**-4) - np.exp(-1.25 * 0.6**-4)
    assert spectra.share_outside(F, s, low, high) == pytest.approx(1.0 - inside, abs=1e-4)


def test_many_waves_are_those_of_one_at_a_time():
    periods = np.array([0.3, 0.8, 2.0, 10.0])
    rate = 2.0 * np.pi / periods
    k = dispersion.wave_numbers(rate, 0.5, G)
    expected = [waves.wave_number(t, 0.5, G) for t in periods]
    np.testing.assert_allclose(k, expected, rtol=1e-13)
    groups = [waves.group_celerity(t, 0.5, G) for t in periods]
    np.testing.assert_allclose(dispersion.group_velocity(rate, 0.5, G), groups, rtol=1e-12)
    ratios = [waves.biesel_stroke_ratio(kh) for kh in k * 0.5]
    np.testing.assert_allclose(dispersion.biesel(k * 0.5), ratios, rtol=1e-14)


def test_waves_that_stay_near_the_piston_are_roots():
    rate = np.array([0.5, 5.0, 50.0])
    roots = dispersion.evanescent(rate, 0.5, G, 6)
    np.testing.assert_allclose(
        roots * np.sin(roots), np.cos(roots) * (-(rate**2) * 0.5 / G), atol=1e-9
    )
    whole = np.pi * np.arange(1, 7)[:, np.newaxis]
    assert np.all((roots < whole) & (roots > whole - 0.5 * np.pi))
