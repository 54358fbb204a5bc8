"""The piston: it stands where the paddle says, with the velocity of its move."""

import numpy as np
import pytest
from tanks import flow_of, make_case

from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.parallel.communicator import Alone
from mpslab.solids import layout
from mpslab.solids.collection import solids_of
from mpslab.solids.paddle import from_motion, sample_times
from mpslab.solids.piston import make_paddle

D0 = 0.002
STROKE, PERIOD = 0.02, 0.5


def motion(t):
    """Forward by the stroke and back again, from rest."""
    return 0.5 * STROKE * (1.0 - np.cos(2.0 * np.pi * t / PERIOD))


def backward(t):
    return -motion(t)


@pytest.fixture(params=[motion, backward])
def tank(request):
    """Particles and piston of a tank whose paddle goes forward, or backward."""
    return tank_of(request.param)


def tank_of(path):
    case = make_case({"tank.length": 0.1, "wavemaker.type": "still"})
    paddle = from_motion(path, sample_times(1.0, PERIOD), 0.0, "drawn")
    particles = layout.build_particles(case, paddle.backmost)
    return particles, begun(case, paddle, particles), paddle


def begun(case, paddle, particles):
    """The solids of a case, of these particles."""
    solids = solids_of(case, paddle)
    solids.begin(particles, Alone())
    return solids


@pytest.mark.parametrize("time", [0.0, 0.1, 0.3, 0.7])
def test_piston_stands_where_the_paddle_is_after_the_step(tank, time):
    particles, piston, paddle = tank
    rest = particles.position.copy()
    moving = particles.moves_with_piston
    piston.push(particles, time, 0.01)
    piston.move(particles, time, 0.01)
    shift = particles.position - rest
    np.testing.assert_allclose(shift[moving, 0], paddle.displacement(time + 0.01), atol=1e-15)
    assert np.all(shift[moving, 1:] == 0.0)
    assert np.all(shift[~moving] == 0.0)
    assert np.count_nonzero(moving) > 0


def test_velocity_is_that_of_the_move(tank):
    particles, piston, _ = tank
    moving, dt = particles.moves_with_piston, 0.003
    piston.push(particles, 0.1, dt)
    piston.move(particles, 0.1, dt)
    before = particles.position[moving, 0].copy()
    piston.push(particles, 0.1 + dt, dt)
    piston.move(particles, 0.1 + dt, dt)
    np.testing.assert_allclose(
        particles.velocity[moving, 0], (particles.position[moving, 0] - before) / dt, rtol=1e-9
    )
    assert np.all(particles.velocity[moving, 1:] == 0.0)
    assert np.all(particles.velocity[~moving] == 0.0)


def test_position_has_no_drift_over_many_small_steps(tank):
    """It is set from the paddle, not summed up."""
    particles, piston, _ = tank
    rest = particles.position[particles.moves_with_piston, 0].copy()
    for k in range(1000):
        piston.push(particles, 0.001 * k, 0.001)
        piston.move(particles, 0.001 * k, 0.001)
    np.testing.assert_allclose(
        particles.position[particles.moves_with_piston, 0], rest, atol=1e-12
    )  # fmt: skip


def test_face_is_the_displacement(tank):
    _, piston, paddle = tank
    assert piston.face(0.0) == 0.0
    assert piston.face(0.2) == paddle.displacement(0.2)


def test_bed_behind_the_face_carries_no_pressure_and_comes_back():
    particles, piston, _ = tank_of(motion)
    role = particles.role.copy()
    floor = role == FACE
    particles.pressure[:] = 5.0
    piston.push(particles, 0.0, 0.5 * PERIOD)
    piston.move(particles, 0.0, 0.5 * PERIOD)
    covered = floor & (particles.position[:, 0] < STROKE - 0.75 * D0)
    assert np.count_nonzero(covered) >= STROKE / D0 - 1
    assert np.all(particles.role[covered] == FILLER)
    assert np.all(particles.pressure[covered] == 0.0)
    assert np.all(particles.pressure[~covered] == 5.0)
    assert np.all(particles.role[~covered] == role[~covered])
    piston.push(particles, 0.5 * PERIOD, 0.5 * PERIOD)
    piston.move(particles, 0.5 * PERIOD, 0.5 * PERIOD)
    behind = floor & (particles.position[:, 0] < -0.75 * D0)
    np.testing.assert_array_equal(particles.role[~behind], role[~behind])
    assert np.all(particles.role[behind] == FILLER)


def test_bed_ahead_of_a_withdrawn_piston_carries_pressure():
    """The floor that it leaves is floor of the tank."""
    particles, piston, _ = tank_of(backward)
    piston.push(particles, 0.0, 0.5 * PERIOD)
    piston.move(particles, 0.0, 0.5 * PERIOD)
    x, z = particles.position[:, 0], particles.position[:, 2]
    top = ~particles.moves_with_piston & (np.abs(z + 0.5 * D0) < 1e-9)
    ahead = top & (x > -STROKE) & (x < 0.1)
    assert np.all(particles.role[ahead] == FACE)
    assert np.count_nonzero(ahead & (x < 0.0)) == round(STROKE / D0)


def test_tank_and_bed_to_cover_do_not_depend_on_the_end_of_the_run(tmp_path):
    (tmp_path / "record.csv").write_text("0,0\n0.5,0.01\n1.0,0.02\n1.6,-0.01\n")
    changes = {"tank.length": 0.1, "wavemaker.type": "file",
               "wavemaker.file": str(tmp_path / "record.csv")}  # fmt: skip
    early, late = (flow_of(make_case({**changes, "time.end": end})) for end in (0.1, 2.0))
    assert early.particles.position.tobytes() == late.particles.position.tobytes()
    assert early.solids.piston.bed.tolist() == late.solids.piston.bed.tolist()
    assert early.domain.slabs == late.domain.slabs
    assert early.solids.piston.paddle.foremost < late.solids.piston.paddle.foremost


def test_bed_is_covered_right_after_particles_were_lost():
    """The bed is known by gid; rows shift when water is taken out."""
    particles, piston, _ = tank_of(motion)
    gone = np.flatnonzero(particles.fluid)[::3]
    keep = np.ones(len(particles), bool)
    keep[gone] = False
    rest = particles.take(keep)
    piston.push(particles, 0.0, 0.1)
    piston.move(particles, 0.0, 0.1)
    piston.push(rest, 0.0, 0.1)
    piston.move(rest, 0.0, 0.1)
    np.testing.assert_array_equal(rest.role, particles.role[keep])
    np.testing.assert_array_equal(rest.position, particles.position[keep])


def test_water_is_never_touched(tank):
    particles, piston, _ = tank
    water = particles.position[particles.fluid].copy()
    piston.push(particles, 0.0, 0.25)
    piston.move(particles, 0.0, 0.25)
    assert np.all(particles.position[particles.role == FLUID] == water)


def test_tank_without_wavemaker_has_a_fixed_wall():
    case = make_case()
    particles = layout.build_particles(case)
    assert make_paddle(case) is None
    piston = begun(case, None, particles)
    before = particles.position.copy(), particles.role.copy()
    piston.push(particles, 0.0, 0.1)
    piston.move(particles, 0.0, 0.1)
    assert piston.face(3.0) == 0.0
    np.testing.assert_array_equal(particles.position, before[0])
    np.testing.assert_array_equal(particles.role, before[1])
