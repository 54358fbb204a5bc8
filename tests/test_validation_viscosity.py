"""What the case `viscosity` is held against."""

import numpy as np
import pytest

from validation.viscosity.compare import fitted, growth

K = np.pi / 0.16


def test_small_viscosity_takes_twice_nu_k_squared():
    n = growth(0.16, 0.04, 9.81, 1e-7)
    assert -n.real == pytest.approx(2e-7 * K**2, rel=5e-3)
    assert n.imag == pytest.approx(np.sqrt(9.81 * K * np.tanh(0.04 * K)), rel=1e-5)


def test_large_viscosity_takes_less_than_that():
    assert -growth(0.16, 0.04, 9.81, 1e-3).real == pytest.approx(0.912 * 2e-3 * K**2, rel=1e-3)


def test_decay_and_frequency_are_found_again():
    time = np.linspace(0.0, 1.1, 110)
    mode = 0.9 * np.exp(-0.6 * time) * np.sin(11.0 * time) + 0.01
    assert fitted(time, mode, -0.7 + 11.2j) == pytest.approx((0.6, 11.0), rel=1e-6)
