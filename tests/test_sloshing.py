"""What is foretold of a tank that moves: its acceleration, the rise of the water, the time step."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tanks import make_case

from mpslab.core.motion import Sine
from mpslab.forcings.frame import motion_of, strongest
from mpslab.run import settling
from mpslab.run.preflight import preflight
from mpslab.simulation import Simulation
from mpslab.theory import sloshing

FRAME = ("type", "amplitude", "period", "file")
G, LENGTH, DEPTH = 9.81, 0.3, 0.1
TANK = {"tank.length": LENGTH, "tank.depth": DEPTH, "tank.height": 0.15, "particles.spacing": 0.01}


def moving(**changes):
    """A case with its changes, those of the table [frame] by their bare names."""
    frame = {"type": "sway", "amplitude": 0.01, "period": 1.0}
    frame |= {key: changes.pop(key) for key in list(changes) if key in FRAME}
    return make_case({**TANK, "time.end": 4.0, "frame": frame, **changes})


@pytest.mark.parametrize("axis, amplitude", [(0, 0.01), (2, 0.04)])
def test_rise_solves_the_equation_of_each_mode(axis, amplitude):
    motion, above = Sine(axis, amplitude, 0.9, 1.5), -0.05
    times = np.linspace(0.0, 5.0, 4001)
    sway, _, spin = np.array([motion(t, 2) for t in times]).T
    angle = np.array([motion(t)[2] for t in times])
    total = np.zeros(len(times))
    for n in sloshing.MODES:
        k = n * np.pi / LENGTH
        t, arm = np.tanh(k * DEPTH), above + 2.0 / k * np.tanh(0.5 * k * DEPTH)

        def rate(time, b, k=k, t=t, arm=arm):
            x, a, s = motion(time, 2)[0], motion(time)[2], motion(time, 2)[2]
            push = 4.0 * t / (LENGTH * k) * (x + G * a + arm * s)
            return b[1], push - G * k * t * b[0]

        total += solve_ivp(rate, (0.0, 5.0), (0.0, 0.0), t_eval=times, rtol=1e-8, atol=1e-10).y[0]
    found = sloshing.rise(times, sway, angle, spin, LENGTH, DEPTH, above, G)
    np.testing.assert_allclose(found, total, rtol=0.0, atol=2e-4 * abs(total).max())


def test_water_in_a_tank_that_tilts_slowly_stays_level():
    times = np.linspace(0.0, 200.0, 200_001)
    tilt = Sine(2, 0.02, 800.0)
    angle, spin = (np.array([tilt(t, k)[2] for t in times]) for k in (0, 2))
    found = sloshing.rise(times, 0.0 * times, angle, spin, LENGTH, DEPTH, 0.0, G)
    share = 8.0 / np.pi**2 * sum(1.0 / n**2 for n in sloshing.MODES)  # of a level surface
    np.testing.assert_allclose(found[-1], share * angle[-1] * LENGTH / 2.0, rtol=5e-3)


def test_strongest_pull_is_gravity_with_the_inertia_of_the_motion():
    w = 2.0 * np.pi
    assert strongest(make_case()) == G
    assert strongest(moving()) == pytest.approx(np.hypot(G, 0.01 * w**2), rel=1e-4)
    heave = moving(type="heave", amplitude=0.1)
    assert strongest(heave) == pytest.approx(G + 0.1 * w**2, rel=1e-4)
    assert heave.time.maximum == pytest.approx(0.4 * 0.01 / np.sqrt(strongest(heave) * DEPTH))
    free = moving(type="heave", amplitude=0.1, **{"fluid.gravity": 0.0})
    assert free.time.maximum == pytest.approx(0.4 * 0.01 / np.sqrt(0.1 * w**2 * DEPTH), rel=1e-4)


def test_check_tells_the_motion_of_the_tank():
    report = preflight(moving())
    found, lines = report.findings["tank_motion"], dict(report.sections["Motion of the tank"])
    assert found["sway [m]"] == pytest.approx(0.01, rel=1e-4) and found["period [s]"] == 1.0
    assert found["largest_acceleration [m/s2]"] == pytest.approx(0.01 * (2 * np.pi) ** 2, rel=1e-4)
    assert found["natural_period [s]"] == pytest.approx(0.7, abs=0.005)
    assert 0.01 < found["rise [m]"] < found["room [m]"] == pytest.approx(0.05)
    assert lines["sway"] == "up to 10 mm" and lines["largest acceleration"] == "0.395 m/s2"
    assert not report.warnings
    assert "tank_motion" not in preflight(make_case()).findings


@pytest.mark.parametrize("lid, what", [(True, "lid"), (False, "top of the walls")])
def test_check_warns_where_the_water_may_reach_the_lid(lid, what):
    at_resonance = moving(period=0.7, **{"tank.lid": lid})
    assert f"the water may reach the {what}, 0.05 m above it" in " ".join(
        preflight(at_resonance).warnings
    )


def test_check_says_nothing_of_a_rise_where_something_else_stands_in_the_tank():
    case = moving(obstacle=[{"from": [0.1, 0.0, 0.0], "to": [0.2, 0.1, 0.06]}])
    found = preflight(case).findings["tank_motion"]
    assert "rise [m]" not in found and "largest_acceleration [m/s2]" in found


def test_a_record_is_told_by_how_far_it_goes(tmp_path):
    rows = ["time [s],x [m],roll [deg]", "0,0,0", "1,0.02,-3", "2,-0.01,0", "3,0,0"]
    (tmp_path / "frame.csv").write_text("\n".join(rows))
    case = moving(type="file", file=tmp_path / "frame.csv")
    found = preflight(case).findings["tank_motion"]
    assert (found["sway [m]"], found["roll [deg]"]) == pytest.approx((0.02, 3.0))
    assert "period [s]" not in found and "heave [m]" not in found


def test_water_that_settles_weighs_as_the_moving_tank_has_it(tmp_path, monkeypatch):
    """A record that begins with the tank turned upright: what is deep is at the wall x = 0."""
    rows = ["time [s],roll [deg]", "0,90", "1,90", "2,90"]
    (tmp_path / "frame.csv").write_text("\n".join(rows))
    frame = {"type": "file", "file": tmp_path / "frame.csv"}
    changes = {"frame": frame, "scheme.settling": 5, "particles.jitter": 0.1}
    monkeypatch.setattr(settling, "SHAKE", 0.0)  # which no pressure follows
    before = Simulation(make_case({**changes, "scheme.settling": 0})).particles
    after = Simulation(make_case(changes)).particles
    moved = after.position - before.position
    water = after.fluid & (np.abs(moved[:, 0]) > 1e-7)
    assert np.count_nonzero(water) > 50
    gained = after.pressure - before.pressure
    np.testing.assert_allclose(gained[water], -1000.0 * G * moved[water, 0], atol=1e-6)


def test_a_long_record_is_looked_at_in_some_rows_and_its_extremes(tmp_path):
    times = np.linspace(0.0, 100.0, 20_001)
    place = np.where(times == 50.0, 0.1, 0.02 * np.sin(times))
    rows = np.column_stack([times, place])
    np.savetxt(tmp_path / "frame.csv", rows, delimiter=",", header="time [s],x [m]", comments="")
    motion = motion_of(moving(type="file", file=tmp_path / "frame.csv").frame)
    moments = motion.moments(100.0)
    assert len(moments) < 1100 and 50.0 in moments
    assert max(abs(motion(t, 2)[0]) for t in moments) == abs(motion.curve(times, 2)[:, 0]).max()
