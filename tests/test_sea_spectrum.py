"""Spectra and waves one by one, against closed forms, many draws, and another program.

Numbers of deltares-wave-toolbox 1.1.1 and wavespectra 4.9.0 were taken once, from the same record
or density; neither is needed here.
"""

import numpy as np
import pytest
from scipy import special
from seas import jonswap, sea

from mpslab.analysis import crossings, spectrum
from mpslab.analysis.harmonics import harmonics

HEIGHT, PERIOD, DEPTH, STEP = 0.1, 1.5, 0.5, 0.05
BAND = (1.0 / 3.0 / PERIOD, 6.0 / PERIOD)


def record(**options):
    """The record that the other programs were given: 4000 readings at three gauges."""
    return sea([5.0, 5.3, 5.8], 4000, STEP, HEIGHT, PERIOD, DEPTH, 0.5, 12.0, 3, 1.3, **options)


def density_of(shape, step=0.001, last=4.0):
    f = np.arange(0.0, last, step)
    return spectrum.Spectrum(f, np.append(0.0, shape(f[1:])), 1e9)


# Spectrum


def test_variance_of_regular_waves_over_whole_periods_is_exact():
    time = np.arange(400) * PERIOD / 40
    phase = 2.0 * np.pi * time / PERIOD
    level = 0.03 + 0.01 * np.cos(phase - 0.4) + 0.002 * np.cos(2.0 * phase)
    found = spectrum.of_periods(level - level.mean(), PERIOD / 40)
    numbers = spectrum.parameters(found, *BAND, 10 * PERIOD)
    assert numbers["Hm0"] == pytest.approx(4.0 * np.sqrt(0.5 * (0.01**2 + 0.002**2)), rel=1e-12)
    assert numbers["Tp"] == pytest.approx(PERIOD, rel=1e-2)
    assert numbers["Hm0 slow"] < 1e-12


def test_hann_segments_keep_the_variance_of_a_sine():
    time = np.arange(2000) * STEP
    found = spectrum.welch(0.01 * np.sin(2.0 * np.pi * time), STEP, 400)
    assert np.sum(found.density) * found.step == pytest.approx(0.5 * 0.01**2, rel=2e-3)
    assert found.frequency[np.argmax(found.density)] == pytest.approx(1.0)


def test_freedom_tells_the_scatter_of_a_density_and_the_band_holds_the_true_one():
    """White noise of 9 segments, 400 times: 17.1 degrees of freedom, 95 % within the band."""
    random = np.random.default_rng(1)
    found = [spectrum.welch(random.normal(size=640), 1.0, 128) for _ in range(400)]
    freedom = found[0].freedom
    assert freedom == pytest.approx(2 * 9 / (1 + 2 * 8 / 9 / 36))
    inner = np.array([one.density[3:-3] for one in found])
    true = 2.0  # variance 1 over frequencies up to 1/2
    assert inner.mean() == pytest.approx(true, rel=0.01)
    assert 2.0 * (inner.mean() / inner.std()) ** 2 == pytest.approx(freedom, rel=0.05)
    low, high = (np.array([one.band()[k][3:-3] for one in found]) for k in (0, 1))
    assert np.mean((low < true) & (true < high)) == pytest.approx(0.95, abs=0.01)


def test_periods_of_pierson_and_moskowitz_are_those_of_its_closed_form():
    """m_n = A/4 B^(n/4 - 1) Gamma(1 - n/4), B = 1.25 fp^4, of S = A f^-5 exp(-B f^-4)."""
    b = 1.25 / PERIOD**4
    found = density_of(lambda f: 1e-4 * f**-5.0 * np.exp(-b * f**-4.0), last=40.0)
    numbers = spectrum.parameters(found, 0.01, 40.0, 100.0)
    assert numbers["Tm-1,0"] == pytest.approx(b**-0.25 * special.gamma(1.25), rel=1e-4)
    assert numbers["Tm01"] == pytest.approx(b**-0.25 / special.gamma(0.75), rel=1e-3)
    assert numbers["Hm0"] == pytest.approx(4.0 * np.sqrt(1e-4 / 4.0 / b), rel=1e-4)
    assert numbers["Tp"] == pytest.approx(0.954 * PERIOD, rel=2e-3)  # as its docstring says


def test_numbers_of_jonswap_are_those_of_two_other_programs():
    found = density_of(lambda f: jonswap(f, HEIGHT, PERIOD))
    numbers = spectrum.parameters(found, *BAND, 100 * PERIOD)
    # deltares-wave-toolbox: 1.355675, 1.256004, 1.182113; wavespectra: 1.355675, 1.256003, 1.182109
    assert numbers["Tm-1,0"] == pytest.approx(1.355675, rel=1e-5)
    assert numbers["Tm01"] == pytest.approx(1.256003, rel=1e-5)
    assert numbers["Tm02"] == pytest.approx(1.182109, rel=1e-5)
    # deltares-wave-toolbox gives 1.4880 with weights S^4, and 1.4998 by a parabola
    assert numbers["Tp"] == pytest.approx(1.488, abs=2e-3)


def test_sea_state_comes_back_from_a_record():
    """120 waves: the height within 2 %, Tp within one step of frequency, Tm-1,0 within 2 %."""
    level = sea(5.0, 3600, STEP, HEIGHT, PERIOD, DEPTH, seed=5)[:, 0]
    found = spectrum.welch(level, STEP, 600)
    numbers = spectrum.parameters(found, *BAND, 3600 * STEP)
    assert numbers["Hm0"] == pytest.approx(HEIGHT, rel=0.02)
    assert abs(1.0 / numbers["Tp"] - 1.0 / PERIOD) < found.step
    assert numbers["Tm-1,0"] == pytest.approx(1.3557, rel=0.02)
    # deltares-wave-toolbox, with its own segments: 0.10977 and 1.3632
    other = spectrum.parameters(spectrum.welch(record()[:, 0], STEP, 600), *BAND, 4000 * STEP)
    assert other["Hm0"] == pytest.approx(0.10977, rel=0.01)
    assert other["Tm-1,0"] == pytest.approx(1.3632, rel=0.01)


def test_scatter_of_the_height_is_that_of_many_seas():
    """Records of 60 waves out of a sea that goes on: 7.9 % by the formula."""
    long = sea(5.0, 1200 * 400, STEP, HEIGHT, PERIOD, DEPTH, seed=2)[:, 0]
    heights = 4.0 * long.reshape(400, 1200).std(axis=1)
    density = density_of(lambda f: jonswap(f, HEIGHT, PERIOD))
    foretold = spectrum.parameters(density, *BAND, 1200 * STEP)["Hm0 scatter"]
    assert heights.std() / heights.mean() == pytest.approx(foretold, rel=0.12)
    one = spectrum.welch(long[:1200], STEP, 400)
    assert spectrum.parameters(one, *BAND, 1200 * STEP)["Hm0 scatter"] == pytest.approx(
        foretold, rel=0.35
    )


# Waves one by one


def test_waves_of_a_drawn_record_are_counted_and_measured():
    """Three crests and troughs of known height; the first part and the last make no wave."""
    time = np.linspace(0.0, 4.0, 401)
    level = np.sin(2.0 * np.pi * time) * np.interp(time, [0, 4], [1.0, 2.0])
    down, up = (crossings.waves(time, level, way) for way in ("down", "up"))
    np.testing.assert_allclose(down["time"], [0.5, 1.5, 2.5], atol=1e-9)
    np.testing.assert_allclose(up["time"], [1.0, 2.0], atol=1e-9)
    np.testing.assert_allclose(down["period"], 1.0, atol=1e-9)
    np.testing.assert_allclose(down["height"], 2.0 + 0.5 * np.arange(1, 4), atol=0.01)
    assert (down["trough"] < 0.0).all()
    assert crossings.statistics(down)["N"] == 3
    assert np.isnan(crossings.statistics(down)["H1/10"])


def test_ripple_on_the_mean_level_makes_no_wave():
    time = np.linspace(0.0, 20.0, 4001)
    level = np.sin(2.0 * np.pi * time / 2.0) + 0.04 * np.sin(2.0 * np.pi * time / 0.05)
    assert len(crossings.waves(time, level)) == 9
    assert len(crossings.waves(time, level, ripple=0.0)) > 9


@pytest.mark.parametrize(
    ("crossing", "mean", "third", "period", "highest"),
    [("down", 0.0714544, 0.1087866, 1.38660, 0.1510138),
     ("up", 0.0713959, 0.1086340, 1.42797, 0.1520707)],
)  # fmt: skip
def test_waves_are_those_of_another_program(crossing, mean, third, period, highest):
    """deltares-wave-toolbox: 159 waves; it has no smallest ripple."""
    level = record()[:, 0]
    time = STEP * np.arange(len(level))
    found = crossings.waves(time, level - level.mean(), crossing, ripple=0.0)
    numbers = crossings.statistics(found)
    assert numbers["N"] == 159
    assert numbers["Hmean"] == pytest.approx(mean, rel=1e-5)
    assert numbers["H1/3"] == pytest.approx(third, rel=1e-5)
    assert numbers["T1/3"] == pytest.approx(period, rel=1e-4)
    assert numbers["Hmax"] == pytest.approx(highest, rel=1e-5)


def test_heights_of_a_narrow_sea_are_those_of_rayleigh():
    """H1/3 = 1.416 Hrms for waves of one frequency and slowly changing height."""
    random = np.random.default_rng(4)
    time = np.arange(400_000) * 0.05
    slow = [np.interp(time, np.arange(0.0, 20_020.0, 20.0), random.normal(size=1001))
            for _ in range(2)]  # fmt: skip
    level = slow[0] * np.cos(2.0 * np.pi * time) + slow[1] * np.sin(2.0 * np.pi * time)
    found = crossings.waves(time, level)
    ratio = crossings.statistics(found)["H1/3"] / np.sqrt(np.mean(found["height"] ** 2))
    assert ratio == pytest.approx(1.416, rel=0.02)


def test_unknown_crossing_is_refused():
    with pytest.raises(ValueError, match="crossing = 'left': must be 'down' or 'up'"):
        crossings.waves(np.arange(4.0), np.arange(4.0), "left")


def test_harmonics_have_the_phase_that_reflection_expects():
    time = np.linspace(0.0, 3.0, 300)
    level = np.real(0.01 * np.exp(1j * (2.0 * np.pi * time / 0.5 - 0.7)))
    assert harmonics(time, level, 0.5, 0.0, 5)[1] == pytest.approx(0.01 * np.exp(-0.7j), rel=1e-6)
