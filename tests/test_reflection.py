"""Incident and reflected waves, against other ways to solve for them and seas that are known."""

import numpy as np
import pytest
from seas import GRAVITY, sea

from mpslab.analysis import reflection
from mpslab.theory.waves import wave_number

HEIGHT, PERIOD, DEPTH, STEP = 0.1, 1.5, 0.5, 0.05
LENGTH = 2.0 * np.pi / wave_number(PERIOD, DEPTH, GRAVITY)
BAND = (1.0 / 3.0 / PERIOD, 6.0 / PERIOD)
ARRAYS = {3: [0.0, 0.1, 0.27], 5: [0.0, 0.1, 0.23, 0.41, 0.6]}  # in wavelengths


def places(gauges):
    return 5.0 + LENGTH * np.array(ARRAYS[gauges])


def split(elevation, x, **options):
    return reflection.of_sea(
        elevation, np.asarray(x), STEP, *BAND, 1.0 / (20.0 * PERIOD), DEPTH, GRAVITY, **options
    )


def amplitudes(x, k, incident, reflected):
    phase = np.multiply.outer(x, k)
    return incident * np.exp(-1j * phase) + reflected * np.exp(1j * phase)


@pytest.fixture
def drawn():
    random = np.random.default_rng(7)
    k = np.linspace(1.0, 6.0, 40)
    pairs = random.normal(size=(4, 40))
    return k, pairs[0] + 1j * pairs[1], pairs[2] + 1j * pairs[3]


# The equations


@pytest.mark.parametrize("weights", reflection.WEIGHTS)
@pytest.mark.parametrize("x", [[0.0, 0.31], [0.2, 0.5, 0.93], [1.0, 1.1, 1.31, 1.77, 2.0, 2.9]])
def test_two_waves_come_back_exactly(drawn, x, weights):
    k, incident, reflected = drawn
    found = reflection.separate(amplitudes(np.array(x), k, incident, reflected), x, k, weights)
    sound = found[3] > 1e-3
    assert np.count_nonzero(sound) > 30
    np.testing.assert_allclose(found[0][sound], incident[sound], rtol=1e-9)
    np.testing.assert_allclose(found[1][sound], reflected[sound], rtol=1e-9)
    assert found[2][sound].max() < 1e-20


def test_two_gauges_are_goda_and_suzuki():
    """a_I = |(A2 - A1 cos - B1 sin) + i (B2 + A1 sin - B1 cos)| / 2 |sin k dx|, their formula; of a
    wave onwards, a cos(k x - w t), it gives a, and with the signs of a_R nothing.
    """
    random = np.random.default_rng(3)
    k, dx = np.linspace(1.0, 6.0, 20), 0.31
    (a1, b1), (a2, b2) = random.normal(size=(2, 2, 20))  # eta = A cos wt + B sin wt
    sin, cos = np.sin(k * dx), np.cos(k * dx)
    incident = np.hypot(a2 - a1 * cos - b1 * sin, b2 + a1 * sin - b1 * cos) / (2 * np.abs(sin))
    reflected = np.hypot(a2 - a1 * cos + b1 * sin, b2 - a1 * sin - b1 * cos) / (2 * np.abs(sin))
    found = reflection.separate(np.array([a1 - 1j * b1, a2 - 1j * b2]), [0.0, dx], k)
    np.testing.assert_allclose(np.abs(found[0]), incident, rtol=1e-10)
    np.testing.assert_allclose(np.abs(found[1]), reflected, rtol=1e-10)
    np.testing.assert_allclose(found[3], sin**2, rtol=1e-10)


@pytest.mark.parametrize("weights", reflection.WEIGHTS)
def test_noisy_gauges_are_fitted_by_least_squares(weights):
    random = np.random.default_rng(4)
    x, k = np.array([0.0, 0.2, 0.53, 0.7]), np.array([2.0, 3.3])
    seen = random.normal(size=(4, 2)) + 1j * random.normal(size=(4, 2))
    incident, reflected, residual, _ = reflection.separate(seen, x, k, weights)
    apart = np.multiply.outer(x, k)[:, np.newaxis] - np.multiply.outer(x, k)[np.newaxis]
    weight = np.sum(np.sin(apart) ** 2 / (1.0 + (apart / np.pi) ** 2), axis=1)
    weight = weight if weights == "spacing" else np.ones_like(weight)
    for j in range(2):
        terms = np.stack([np.exp(-1j * k[j] * x), np.exp(1j * k[j] * x)], axis=1)
        root = np.sqrt(weight[:, j])
        fit = np.linalg.lstsq(terms * root[:, np.newaxis], seen[:, j] * root, rcond=None)[0]
        np.testing.assert_allclose([incident[j], reflected[j]], fit, rtol=1e-9)
        left = np.mean(np.abs(seen[:, j] - terms @ fit) ** 2)
        assert residual[j] == pytest.approx(left, rel=1e-9)


def test_a_record_is_separated_as_by_another_program():
    """deltares-wave-toolbox 1.1.1, decompose_linear_ZS over the whole record, no taper:
    4 standard deviations 0.100705 and 0.049692, Kr = 0.49344.
    """
    x = np.array([5.0, 5.3, 5.8])
    level = sea(x, 4000, STEP, HEIGHT, PERIOD, DEPTH, 0.5, 12.0, 3, 1.3)
    f = np.fft.rfftfreq(4000, STEP)[1:-1]
    k = np.array([wave_number(1.0 / one, DEPTH, GRAVITY) for one in f])
    spectra = np.fft.rfft(level - level.mean(axis=0), axis=0)[1:-1].T * np.sqrt(2.0) / 4000
    incident, reflected, _, soundness = reflection.separate(spectra, x, k)
    sound = soundness > 0.125 * 4.0 / 9.0  # its limit
    heights = [4.0 * np.sqrt(np.sum(np.abs(a[sound]) ** 2)) for a in (incident, reflected)]
    assert heights == pytest.approx([0.100705, 0.049692], rel=1e-3)
    assert heights[1] / heights[0] == pytest.approx(0.49344, rel=1e-3)


# Seas


@pytest.mark.parametrize("gauges", [3, 5])
@pytest.mark.parametrize("kr", [0.0, 0.1, 0.5, 0.95])
def test_sea_with_noise_is_separated(gauges, kr):
    """100 waves, noise of 5 % of the height. The height within 3 %; Kr within 0.01, the floor and
    5 %, as the taper leaves other waves out of the incident than out of the reflected sea.
    """
    x = places(gauges)
    level = sea(x, 3000, STEP, HEIGHT, PERIOD, DEPTH, kr, 12.0, seed=1)
    level += np.random.default_rng(2).normal(0.0, 0.05 * HEIGHT / 4.0, level.shape)
    found = split(level, x)
    assert found.kr_primary == pytest.approx(kr, abs=0.01 + found.floor + 0.05 * kr)
    assert found.incident_height == pytest.approx(HEIGHT, rel=0.03)
    assert found.lost < 0.01
    assert 0.0 < found.unexplained < 0.05


def test_floor_foretells_what_noise_makes_of_no_reflection():
    x, found = places(3), []
    for seed in range(6):
        level = sea(x, 3000, STEP, HEIGHT, PERIOD, DEPTH, seed=seed, repeats=1.3)
        level += np.random.default_rng(seed).normal(0.0, 0.4 * HEIGHT / 4.0, level.shape)
        found.append(split(level, x))
    seen, foretold = (np.mean([getattr(f, n) for f in found]) for n in ("kr_primary", "floor"))
    assert seen == pytest.approx(foretold, rel=0.15)
    assert foretold > 0.04


def test_record_without_whole_periods_makes_no_reflection_of_its_own():
    """Of 60 waves from which nothing comes back; 0.05 without the taper."""
    x = places(3)
    found = [split(sea(x, 1800, STEP, HEIGHT, PERIOD, DEPTH, seed=seed, repeats=1.3), x).kr
             for seed in range(4)]  # fmt: skip
    assert max(found) < 0.035


def test_frequencies_where_the_gauges_are_blind_are_left_out():
    """Two gauges half a wavelength of 2 / period apart."""
    k = wave_number(0.5 * PERIOD, DEPTH, GRAVITY)
    x = np.array([5.0, 5.0 + np.pi / k])
    found = split(sea(x, 3000, STEP, HEIGHT, PERIOD, DEPTH, 0.3, 12.0), x)
    blind = np.argmin(np.abs(found.frequency - 2.0 / PERIOD))
    assert found.left_out[blind]
    assert np.isnan(found.incident[blind])
    assert 0.005 < found.lost < 0.2
    assert found.kr_primary == pytest.approx(0.3, abs=0.03)
    assert np.isnan(found.unexplained)


# Regular waves


def regular(x, parts):
    """Amplitudes (gauges, harmonics) of harmonics, each (incident, reflected, wave number)."""
    return np.stack([amplitudes(np.asarray(x), k, a, b) for a, b, k in parts], axis=1)


def test_bound_second_harmonic_leaves_kr_of_the_first_alone():
    """It travels with the first, as 2 k, and not as the free wave that it is taken for."""
    k = wave_number(PERIOD, DEPTH, GRAVITY)
    x = places(5)
    seen = regular(x, [(0.05, 0.02j, k), (0.01, 0.0, 2.0 * k)])
    found = reflection.of_harmonics(seen, x, PERIOD, DEPTH, GRAVITY)
    assert found.kr_primary == pytest.approx(0.4, rel=1e-9)
    assert found.incident_height == pytest.approx(0.1, rel=1e-9)
    assert found.unexplained < 1e-9
    assert found.residual[1] > 1e-3
    free = wave_number(0.5 * PERIOD, DEPTH, GRAVITY)
    seen = regular(x, [(0.05, 0.02j, k), (0.01, 0.004, free)])
    found = reflection.of_harmonics(seen, x, PERIOD, DEPTH, GRAVITY)
    assert found.kr == pytest.approx(0.4, rel=1e-9)
    assert found.incident[1] == pytest.approx(0.01, rel=1e-9)


def test_partial_standing_wave_has_the_kr_of_its_envelope():
    """(a_max - a_min) / (a_max + a_min), from the amplitudes along a wavelength."""
    k = wave_number(PERIOD, DEPTH, GRAVITY)
    along = np.linspace(0.0, LENGTH, 2001)
    envelope = np.abs(amplitudes(along, np.array([k]), 0.03 + 0.01j, -0.012j)[:, 0])
    expected = (envelope.max() - envelope.min()) / (envelope.max() + envelope.min())
    x = np.array([0.3, 0.8, 1.1])
    seen = regular(x, [(0.03 + 0.01j, -0.012j, k)])
    found = reflection.of_harmonics(seen, x, PERIOD, DEPTH, GRAVITY)
    assert found.kr_primary == pytest.approx(expected, rel=1e-5)


# Bad input


def test_gauges_that_tell_nothing_are_refused():
    k = wave_number(PERIOD, DEPTH, GRAVITY)
    for x, words in (
        ([1.0, 1.0, 1.5], "two gauges at x = 1 m: must be at different places"),
        ([1.0], "1 gauge: reflection needs 2 or more"),
        ([1.0, 1.0 + 0.5 * LENGTH, 1.0 + LENGTH], "cannot tell incident from reflected waves"),
    ):
        with pytest.raises(ValueError, match=words):
            reflection.of_harmonics(
                regular(x, [(0.05, 0.01, k)]), np.array(x), PERIOD, DEPTH, GRAVITY
            )
    with pytest.raises(ValueError, match="weights = 'best': must be out of equal, spacing"):
        reflection.separate(np.ones((2, 1)), [0.0, 0.1], [1.0], "best")
