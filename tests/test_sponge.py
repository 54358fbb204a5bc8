"""Zones that take waves in: what they reflect, what they do to the water, what is refused."""

import numpy as np
import pytest
from ranks import digest
from tanks import make_case, particles_at

from mpslab import Simulation
from mpslab.forcings import sponge as zones
from mpslab.run.preflight import preflight
from mpslab.theory import sponge
from mpslab.theory.dispersion import group_velocity

G, DEPTH = 9.81, 0.1


def rate_of(kh):
    return float(np.sqrt(G * kh / DEPTH * np.tanh(kh)))


def test_zone_without_damping_reflects_all():
    assert sponge.reflection(5.0, DEPTH, G, 1.0, 0.0, 0.3) == pytest.approx(1.0)


@pytest.mark.parametrize("kh", [0.5, 1.0, 2.5])
def test_long_weak_zone_lets_the_wave_decay_on_its_way_there_and_back(kh):
    """exp(-int r dx / c_g): where r changes slowly nothing else is reflected."""
    rate, length = rate_of(kh), 4.0 * 2.0 * np.pi * DEPTH / kh
    speed = float(group_velocity(np.array([rate]), DEPTH, G)[0])
    largest = 0.3 * rate
    decayed = np.exp(-largest * length / 3.0 / speed)
    assert sponge.reflection(rate, DEPTH, G, length, largest) == pytest.approx(decayed, rel=0.03)


def test_long_waves_reflect_what_the_shallow_water_equations_say():
    """eta_t + h u_x = 0, u_t + g eta_x = - r u, by finite differences on a fine grid."""
    rate, length, n = rate_of(0.05), 15.0, 4000
    largest = rate
    x = (np.arange(n) + 0.5) / n * length
    step, slope = length / n, 0.0 + 0.0j
    for damping in (largest * sponge.profile(x / length))[::-1]:  # s = eta' / eta; eta'' = -k^2 eta
        # Shallow water with r(x): (eta' / (1 - i r / omega))' + k^2 eta = 0.
        weight, k2 = 1.0 / (1.0 - 1j * damping / rate), rate**2 / (G * DEPTH)
        slope = slope + step * (k2 + slope * slope / weight)  # of flux / eta, towards the sea
    k = rate / np.sqrt(G * DEPTH)
    wanted = abs((-1j * k - slope) / (1j * k - slope))
    assert sponge.reflection(rate, DEPTH, G, length, largest) == pytest.approx(wanted, abs=0.01)


def test_default_zone_of_one_wavelength_reflects_little_in_any_depth():
    for kh in (0.3, 0.5, 1.0, 1.5, 2.5):
        length = 2.0 * np.pi * DEPTH / kh
        strength = sponge.best(rate_of(kh), DEPTH, G, length)
        best, less, more = (
            sponge.reflection(rate_of(kh), DEPTH, G, length, share * strength * rate_of(kh))
            for share in (1.0, 0.5, 2.0)
        )
        assert best < 0.03
        assert less > best < more


SMALL = {
    "tank.length": 0.6, "tank.depth": 0.1, "particles.spacing": 0.01, "time.end": 3.0,
    "initial": {"type": "standing_wave", "amplitude": 0.012, "mode": 2},
}  # fmt: skip
ZONE = {"from": 0.3, "to": 0.6, "period": 0.62}


def test_zone_of_any_strength_takes_no_more_than_all_of_the_speed():
    case = make_case({**SMALL, "sponge": [{**ZONE, "strength": 1000.0}]})
    position = np.array([[0.1, 0.0, 0.05], [0.45, 0.0, 0.05], [0.6, 0.0, 0.05]])
    velocity = np.array([[1.0, 0.0, -1.0]] * 3)
    step = case.time.maximum
    after = velocity + step * zones.make(case)(position, velocity, 0.0)
    assert np.array_equal(after[0], velocity[0])
    assert np.all(np.abs(after[1:]) <= np.abs(velocity[1:]))
    assert np.all(after[1:] * velocity[1:] >= 0.0)
    assert np.abs(after[2]).max() < 1e-3


def test_two_zones_add_up_and_none_is_none():
    one, other = {**ZONE, "to": 0.5}, {**ZONE, "strength": 0.5}
    places = particles_at(np.array([[0.42, 0.0, 0.05]]))
    places.velocity[:] = 1.0
    pushes = [
        zones.make(make_case({**SMALL, "sponge": found}))(places.position, places.velocity, 0.0)
        for found in ([one], [other], [one, other])
    ]
    assert pushes[2] == pytest.approx(pushes[0] + pushes[1])
    assert zones.make(make_case(SMALL)) is None


def test_standing_wave_dies_in_a_zone_and_the_bits_stay_the_same_after_a_restart(tmp_path):
    case = make_case({**SMALL, "gauge": [{"name": "end", "x": [0.0, 0.3]}], "sponge": [ZONE]})
    assert [gauge.name for gauge in case.gauge] == ["end-1", "end-2"]
    free = Simulation(make_case({**SMALL, "gauge": [{"name": "end-1", "x": 0.0}]})).run(until=1.3)
    whole = Simulation(case, tmp_path / "run").run(until=0.1)
    whole = Simulation.resume(tmp_path / "run").run(until=1.3)
    late = [np.ptp(run.gauges["end-1"][run.gauges["time"] > 0.9]) for run in (free, whole)]
    assert late[1] < 0.6 * late[0]  # one spacing is left, which is the noise of a gauge
    again = Simulation(case).run(until=1.3)
    assert digest(again.particles) == digest(whole.particles)


def test_preflight_tells_what_a_zone_reflects_and_warns_of_a_short_one():
    long, short = {**ZONE, "from": 0.1}, {**ZONE, "from": 0.55, "strength": 0.5}
    found = preflight(make_case({**SMALL, "sponge": [long, short]}))
    first, second = found.findings["sponges"]
    assert first["reflection"] < 0.2 < second["reflection"]
    assert any("sponge.1: reflects" in warning for warning in found.warnings)
    assert "x = 0.1 m to 0.6 m" in found.text()


@pytest.mark.parametrize(
    ("zone", "part"),
    [
        ({"to": 0.31}, "sponge.0.to = 0.31: must be 0.03 m or more away from sponge.0.from"),
        ({"to": 0.7}, "sponge.0.to = 0.7: must be from 0 to tank.length"),
        ({"period": 0.0}, "sponge.0.period = 0.0: must be > 0 s"),
        ({"strength": -1.0}, "sponge.0.strength = -1.0: must be a number from 0 to 1000"),
        ({"colour": 1}, "sponge.0.colour = 1: unknown key"),
    ],
)
def test_zone_that_cannot_be_is_refused_in_one_line(zone, part):
    with pytest.raises(ValueError, match="sponge") as refused:
        make_case({**SMALL, "sponge": [{**ZONE, **zone}]})
    assert part in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1


@pytest.mark.parametrize("x", [[], [0.1, "a"], [0.1, 0.9]])
def test_row_of_gauges_that_cannot_be_is_refused_in_one_line(x):
    with pytest.raises(ValueError, match=r"gauge\.\d\.x") as refused:
        make_case({**SMALL, "gauge": [{"name": "g", "x": x}]})
    assert len(str(refused.value).splitlines()) == 1
