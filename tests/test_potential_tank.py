"""Potential flow in a tank with a piston, against theory and against a spectral solution."""

from pathlib import Path

import numpy as np
import pytest

from mpslab.analysis.harmonics import harmonics
from mpslab.analysis.reflection import separate
from mpslab.cases import load_case
from validation import potential_flow, potential_tank

CASES = Path(potential_tank.__file__).parent
GRAVITY = 9.81


def _smoothly(time, derivative=0):
    """A piston that goes 10 mm forward in half a second, and stays there."""
    share = min(max(2.0 * time, 0.0), 1.0)
    if derivative:
        return 0.01 * 12.0 * share * (1.0 - share)
    return 0.01 * share * share * (3.0 - 2.0 * share)


def test_low_waves_are_those_of_biesel(monkeypatch):
    """One wavelength from the piston, before anything comes back from the wall."""
    monkeypatch.setattr(potential_tank, "COLUMNS", 40)
    monkeypatch.setattr(potential_tank, "STEPS", 40)
    changes = {"wavemaker.height": 4e-5, "tank.length": 1.8, "time.end": 3.2}
    case = load_case(CASES / "wavemaker/regular.toml", changes)
    time, level = potential_tank.levels(case, [case.gauge[0].x])
    period, height = case.wavemaker.period, case.wavemaker.height
    first = harmonics(time, level[:, 0], period, 5.0 * period, 3)[1]
    assert 2.0 * abs(first) == pytest.approx(height, rel=1e-3)


def test_sponge_gives_back_next_to_nothing():
    depth, k = 0.1, 12.5
    rate = np.sqrt(GRAVITY * k * np.tanh(k * depth))
    length, period = 2.0 * np.pi / k, 2.0 * np.pi / rate

    def motion(time, derivative=0):
        share = min(max(0.5 * time / period, 0.0), 1.0)
        fade = share * share * (3.0 - 2.0 * share)
        if not derivative:
            return 1e-4 * fade * np.sin(rate * time)
        growth = 3.0 * share * (1.0 - share) / period
        return 1e-4 * (fade * rate * np.cos(rate * time) + growth * np.sin(rate * time))

    tank = potential_tank.Tank(4.0 * length, depth, GRAVITY, 160, motion)
    tank.swallow(3.0 * length, potential_tank.STRENGTH * rate)
    step, late = period / 40, []
    for n in range(16 * 40):
        tank.advance(n * step, step)
        if n >= 14 * 40:
            late.append(tank.level[40:112:8])
    turn = np.exp(-1j * rate * step * (1.0 + np.arange(14 * 40, 16 * 40)))
    waves = 2.0 * turn @ np.array(late) / len(late)
    incident, back = separate(waves[:, np.newaxis], tank.x(0.0)[40:112:8], np.array([k]))[:2]
    assert abs(back[0]) < 0.02 * abs(incident[0])


@pytest.mark.parametrize("amplitude", [0.004, 0.02])
def test_standing_wave_is_that_of_the_spectral_solution(amplitude):
    length, depth, steps = 0.5, 0.2, 160
    rate = np.sqrt(GRAVITY * np.pi / length * np.tanh(np.pi * depth / length))
    tank = potential_tank.Tank(length, depth, GRAVITY, 60, lambda time, derivative=0: 0.0)
    shape = np.cos(np.pi * tank.x(0.0) / length)
    tank.potential = amplitude * GRAVITY / rate * shape
    step = 2.0 * 2.0 * np.pi / rate / steps
    mode = np.zeros(steps + 1)
    for n in range(steps):
        tank.advance(n * step, step)
        mode[n + 1] = 2.0 / length * np.trapezoid(tank.level * shape, tank.x(0.0))
    times, wanted = potential_flow.standing_wave(amplitude, length, depth, GRAVITY, rate, 2)
    wanted = np.interp(step * np.arange(steps + 1), times, wanted)
    assert mode == pytest.approx(wanted, abs=1e-4 * amplitude)


def test_water_that_the_piston_displaces_is_found_under_the_surface():
    tank = potential_tank.Tank(1.0, 0.1, GRAVITY, 150, _smoothly)
    for n in range(120):
        tank.advance(0.005 * n, 0.005)
    assert _smoothly(0.6) == 0.01
    assert np.trapezoid(tank.level, tank.x(0.6)) == pytest.approx(0.1 * 0.01, rel=1e-3)


def test_a_wave_that_breaks_is_refused():
    def rammed(time, derivative=0):
        return 1.0 if derivative else time

    tank = potential_tank.Tank(1.0, 0.1, GRAVITY, 150, rammed)
    with np.errstate(all="ignore"), pytest.raises(ArithmeticError, match="is a wave breaking"):
        for n in range(100):
            tank.advance(0.005 * n, 0.005)
