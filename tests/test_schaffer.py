"""Second-order motion of a piston: against Schaffer's formula, Madsen's limit and what is bound."""

import numpy as np
import pytest

from mpslab.theory import dispersion, schaffer, waves

G, DEPTH = 9.81, 1.0


def rate_of(kh):
    return np.sqrt(G * kh / DEPTH * np.tanh(kh))


def transfer(one, other, sign, modes=schaffer.MODES):
    return complex(schaffer.transfer(np.array([one]), np.array([other]), sign, DEPTH, G, modes)[0])


def bound(one, other, sign):
    return complex(schaffer.bound_wave(np.array([one]), np.array([other]), sign, DEPTH, G)[0])


def printed(one, other, sign, modes, pairs):
    """F / h by Schaffer's equations (15) to (41) as they are printed, for a piston.

    Its double sum has the first `pairs` modes only.
    """

    def wave(rate):
        number = dispersion.wave_numbers(np.array([rate]), DEPTH, G)[0]
        near = dispersion.evanescent(np.array([rate]), DEPTH, G, modes)[:, 0]
        kh = np.array([number * DEPTH, *(-1j * near)])
        share = 0.5 * kh * (kh / (np.sinh(kh) * np.cosh(kh)) + 1.0)
        return kh / DEPTH, rate**2 * DEPTH / G / share

    (k, c), (m, d) = wave(one), wave(other)
    if sign < 0:
        m, d = m.conj(), d.conj()
    total = one + sign * other
    free = dispersion.wave_numbers(np.array([total]), DEPTH, G)[0]
    both = k[:, np.newaxis] + sign * m
    h = (total * (sign * one * other - G**2 * np.outer(k, m) / (one * other))
         + 0.5 * (one**3 + sign * other**3)
         - 0.5 * G**2 * (k[:, np.newaxis] ** 2 / one + sign * m**2 / other))  # fmt: skip
    terms = np.outer(c, d) * both / (both**2 - free**2) * h
    f = np.sum(terms[: pairs + 1, : pairs + 1])
    for rate, number, ratio in ((one, k, c), (other, m, d)):
        lack = rate**2 - total**2
        f -= sign * G / (2.0 * rate) * np.sum(ratio * number**2 / (number**2 - free**2)) * lack
    once = 0.5 if one == other else 1.0
    return once * free**2 * f / (c[0].real * d[0].real * total**3)


@pytest.mark.parametrize("kh", [0.2, 0.5, 1.0, 2.0])
@pytest.mark.parametrize(("ratio", "sign"), [(1.0, 1), (0.9, 1), (0.6, 1), (0.9, -1), (0.6, -1)])
def test_motion_is_that_of_schaffers_printed_equations(kh, ratio, sign):
    """Both with as many modes, and what is left of them taken in the same way."""
    rate = rate_of(kh)
    few, many = (printed(rate, ratio * rate, sign, 12, pairs) for pairs in (6, 12))
    expected = -1j * (2.0 * many - few)
    assert transfer(rate, ratio * rate, sign, 12) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("kh", [0.1, 0.2, 0.3])
def test_a_long_wave_with_itself_is_madsens(kh):
    second = (3.0 * np.cosh(kh) / np.sinh(kh) ** 3 - 2.0 / waves.biesel_stroke_ratio(kh)) / 8.0
    found = transfer(rate_of(kh), rate_of(kh), 1)
    assert (1j * found).real == pytest.approx(second / DEPTH, rel=0.2 * kh**2)


@pytest.mark.parametrize("kh", [0.3, 1.0, 2.0])
def test_long_group_gets_as_much_water_as_its_bound_wave_carries(kh):
    """Near the same frequency the flux of the piston, h dX/dt, is that of the set-down, c_g eta."""
    rate, gap = rate_of(kh), 1e-3
    speed = dispersion.group_velocity(np.array([rate * (1.0 - 0.5 * gap)]), DEPTH, G)[0]
    flux = 1j * gap * rate * DEPTH * transfer(rate, rate * (1.0 - gap), -1)
    carried = speed * bound(rate, rate * (1.0 - gap), -1)
    assert flux == pytest.approx(carried, rel=4e-3)


@pytest.mark.parametrize("kh", [0.3, 1.0, 3.0])
def test_set_down_of_a_group_is_that_of_longuet_higgins_and_stewart(kh):
    rate, gap = rate_of(kh), 1e-4
    k = dispersion.wave_numbers(np.array([rate]), DEPTH, G)[0]
    speed = dispersion.group_velocity(np.array([rate]), DEPTH, G)[0]
    stress = G * (2.0 * speed * k / rate - 0.5)  # 2 Sxx / (rho a^2), and a^2 = 2 A_n A_m there
    expected = -stress / (G * DEPTH - speed**2)
    assert bound(rate, rate * (1.0 - gap), -1) == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("ratio", [0.95, 0.7, 0.4])
def test_bound_difference_is_that_of_another_form(ratio):
    """The form of the pages of FUNWAVE, after Hasselmann (1962)."""
    one = rate_of(1.2)
    other, gap = ratio * one, (1.0 - ratio) * one
    k, m = dispersion.wave_numbers(np.array([one, other]), DEPTH, G)
    sech = np.cosh(np.array([k, m]) * DEPTH) ** -2.0
    c = gap * ((one * other / G) ** 2 + k * m)
    c -= 0.5 * (one * m**2 * sech[1] - other * k**2 * sech[0])
    expected = -G * k * m / (2.0 * one * other) + (one**2 - one * other + other**2) / (2.0 * G)
    expected -= c * G * gap / (one * other * (G * (k - m) * np.tanh((k - m) * DEPTH) - gap**2))
    assert bound(one, other, -1) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("kh", [0.5, 1.5, 4.0])
def test_bound_wave_of_a_wave_with_itself_is_that_of_stokes(kh):
    k = kh / DEPTH
    expected = 0.25 * k * np.cosh(kh) * (2.0 + np.cosh(2.0 * kh)) / np.sinh(kh) ** 3
    assert bound(rate_of(kh), rate_of(kh), 1) == pytest.approx(expected, rel=1e-9)


def test_modes_left_out_are_made_up_for():
    one, other = rate_of(2.0), rate_of(1.2)
    for sign in (1, -1):
        exact = transfer(one, other, sign, 60)
        assert transfer(one, other, sign) == pytest.approx(exact, abs=0.01 * abs(exact))


def test_the_free_wave_may_be_one_of_the_two():
    """Where the difference of the frequencies is one of them, wave numbers are equal."""
    rate = rate_of(1.0)
    near = [transfer(rate, ratio * rate, -1) for ratio in (0.499, 0.5, 0.501)]
    assert near[1] == pytest.approx(0.5 * (near[0] + near[2]), rel=1e-4)


@pytest.mark.parametrize("kh", [0.5, 1.5])
def test_a_sea_has_the_motion_of_all_its_pairs(kh):
    step, first = 0.05 * rate_of(kh), 12
    rng = np.random.default_rng(3)
    amplitude = 0.01 * (rng.standard_normal(20) + 1j * rng.standard_normal(20))
    rate = (first + np.arange(20)) * step
    expected = np.zeros(2 * (first + 20) - 1, complex)
    i, j = np.tril_indices(20)
    pairs = amplitude[i] * amplitude[j] * schaffer.transfer(rate[i], rate[j], 1, DEPTH, G)
    np.add.at(expected, 2 * first + i + j, pairs)
    i, j = np.tril_indices(20, -1)
    pairs = amplitude[i] * amplitude[j].conj()
    pairs *= schaffer.transfer(rate[i], rate[j], -1, DEPTH, G)
    np.add.at(expected, i - j, pairs)
    found = schaffer.motion(amplitude, first, step, DEPTH, G)
    np.testing.assert_allclose(found, expected, rtol=2e-3, atol=1e-4 * np.abs(expected).max())
    slow = schaffer.motion(amplitude, first, step, DEPTH, G, lowest=3.5 * step)
    np.testing.assert_array_equal(slow[:4], 0.0)
    np.testing.assert_array_equal(slow[4:], found[4:])
