"""Contract of the stabilisers, and what each of them claims."""

import numpy as np
import pytest
from tanks import cloud, inside, lattice, near_of, particles_at, scheme

from mpslab.core import plugins
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil

NAMES = plugins.names("stabilisers")
MODELS = {name: plugins.load("stabilisers", name) for name in NAMES}
DT = 0.01


def apply(name, particles, before=None, dim=3, reach=2.1, dt=DT, **changes):
    """Run a stabiliser in place, with the pace DT; returns the moves and changes of velocity."""
    position, velocity = particles.position.copy(), particles.velocity.copy()
    near = measured(particles, position if before is None else before, dim, reach)
    MODELS[name].stabilise(near, dt, DT, scheme(**changes))
    return particles.position - position, particles.velocity - velocity


def measured(particles, before, dim=3, reach=2.1, width=0.0):
    """Neighbourhood of particles as they lay `before`; they are left where they are now."""
    now, particles.position[:] = particles.position.copy(), before
    near = near_of(particles, dim, width=width, reach=reach)
    particles.position[:] = now
    return near


def pair(distance, roles=(FLUID, FLUID), speed=0.0, direction=(0.6, 0.0, 0.8)):
    """Two particles at a distance; the first moves towards the second, the second towards it."""
    e = np.array(direction)
    particles = particles_at(np.outer([0.0, distance], e))
    particles.role[:] = roles
    particles.velocity[:] = np.outer([speed, -speed], e)
    return particles


def messy(roles=(FLUID, FACE, FILLER), dim=3, seed=5):
    """Crowded cloud of particles of several roles in random motion."""
    random = np.random.default_rng(seed)
    particles = particles_at(0.8 * cloud(dim, 400, seed))
    particles.role[:] = random.choice(roles, len(particles))
    particles.velocity[:] = random.normal(size=(len(particles), 3)) * [1.0, dim - 2.0, 1.0]
    return particles


def moved_from(particles, seed=6):
    """Positions a little before those of now."""
    return particles.position - 0.1 * np.random.default_rng(seed).normal(size=(len(particles), 3))


def test_four_models_are_there():
    assert {"collision", "shifting", "corrected_shifting", "ds"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_stage_is_one_that_the_step_knows(name):
    assert MODELS[name].STAGE in ("predicted", "corrected")


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_lattice_at_rest_stays_as_it_is(name, dim):
    """Where the neighbours, too, have all of theirs."""
    particles = particles_at(lattice(dim, 6))
    particles.surface[:] = ~inside(particles.position, 5)
    core = inside(particles.position, 1)
    move, change = apply(name, particles, dim=dim)
    assert np.abs(move[core]).max() < 1e-14
    assert np.abs(change[core]).max() < 1e-12


@pytest.mark.parametrize("name", NAMES)
def test_walls_and_piston_are_never_moved(name):
    particles = messy()
    solid = particles.role != FLUID
    move, change = apply(name, particles, before=moved_from(particles))
    assert np.all(move[solid] == 0.0)
    assert np.all(change[solid] == 0.0)
    assert np.abs(move[~solid]).max() > 0.0


@pytest.mark.parametrize("name", NAMES)
def test_particles_beyond_the_radius_do_not_matter(name):
    """The list may reach further, for the Laplacian."""
    near, far = messy(), messy()
    near.surface[:] = far.surface[:] = near.position[:, 0] > 1.0
    before = moved_from(near) if name == "ds" else None
    move, change = apply(name, near, before=before)
    far_move, far_change = apply(name, far, before=before, reach=3.1)
    np.testing.assert_allclose(far_move, move, atol=1e-14)
    np.testing.assert_allclose(far_change, change, atol=1e-12)
    assert np.abs(move).max() > 0.0


@pytest.mark.parametrize("name", NAMES)
def test_one_particle_alone_is_left_alone(name):
    particles = particles_at(np.ones((1, 3)))
    particles.velocity[:] = 3.0
    move, change = apply(name, particles)
    assert np.all(move == 0.0)
    assert np.all(change == 0.0)


@pytest.mark.parametrize("name", NAMES)
def test_coincident_particles_give_finite_moves(name):
    particles = particles_at(np.ones((4, 3)))
    particles.velocity[:] = np.arange(12.0).reshape(4, 3)
    move, change = apply(name, particles)
    assert np.isfinite(move).all()
    assert np.isfinite(change).all()


@pytest.mark.parametrize("name", NAMES)
def test_2d_particles_stay_in_their_plane(name):
    particles = messy(dim=2)
    before = moved_from(particles) * [1.0, 0.0, 1.0]
    move, change = apply(name, particles, before=before, dim=2)
    assert np.all(move[:, 1] == 0.0)
    assert np.all(change[:, 1] == 0.0)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", ["ds", "collision"])
def test_momentum_is_conserved_between_fluid_particles(name, dim):
    particles = messy(roles=(FLUID,), dim=dim)
    _, change = apply(name, particles, before=moved_from(particles) * [1, dim - 2, 1], dim=dim)
    assert np.count_nonzero(change) > 100
    assert np.linalg.norm(change.sum(axis=0)) < 1e-13 * np.linalg.norm(change, axis=1).sum()


@pytest.mark.parametrize(("distance", "keep"), [(0.3, 0.9), (0.6, 0.8), (0.89, 0.9)])
def test_ds_takes_a_head_on_pair_apart_to_its_distance(distance, keep):
    particles = pair(distance)
    move, _ = apply("ds", particles, before=pair(1.0).position, ds_distance=keep)
    apart = np.linalg.norm(particles.position[1] - particles.position[0])
    assert apart == pytest.approx(keep, rel=1e-13)
    np.testing.assert_allclose(move[0], -move[1], rtol=1e-13)


@pytest.mark.parametrize(("speed", "taken"), [(-1.0, 0.0), (0.0, 0.0), (0.5, 0.5), (1.7, 1.0)])
def test_ds_takes_the_approach_that_led_to_an_overlap_and_no_more(speed, taken):
    """Speeds in those that would have led to the overlap of 0.3 within the step."""
    most = 0.3 / DT
    particles = pair(0.6, speed=0.5 * speed * most)
    _, change = apply("ds", particles, before=pair(1.0).position, ds_distance=0.9)
    expected = -pair(0.6, speed=0.5 * taken * most).velocity
    np.testing.assert_allclose(change, expected, rtol=1e-12, atol=1e-12 * most)


def test_ds_takes_a_glancing_pair_apart_along_its_old_direction():
    """The pair slid past each other by 0.5, normal to the direction it had before."""
    along, slid = np.array([2.0, 3.0, 6.0]) / 7.0, np.array([3.0, -6.0, 2.0]) / 7.0
    particles = particles_at([0.0 * along, 0.4 * along + 0.5 * slid])
    move, _ = apply("ds", particles, before=[0.0 * along, along])
    assert np.linalg.norm(np.diff(particles.position, axis=0)) == pytest.approx(0.9, rel=1e-13)
    assert np.abs(np.cross(move, along)).max() < 1e-15


def test_ds_leaves_the_layers_behind_a_wall_to_the_wall():
    move, _ = apply("ds", pair(0.6, roles=(FLUID, FILLER)), before=pair(1.0).position)
    assert np.all(move == 0.0)


def test_ds_takes_water_all_the_way_off_a_wall():
    particles = pair(0.6, roles=(FLUID, FACE))
    apply("ds", particles, before=pair(1.0).position)
    assert np.linalg.norm(np.diff(particles.position, axis=0)) == pytest.approx(0.9, rel=1e-13)


@pytest.mark.parametrize("roles", [(FLUID, FLUID), (FLUID, FACE)])
def test_ds_leaves_pairs_at_its_distance_alone(roles):
    move, _ = apply("ds", pair(0.9 + 1e-12, roles=roles), before=pair(1.0).position)
    assert np.all(move == 0.0)


def test_ds_acts_across_a_periodic_boundary():
    particles = particles_at([[0.0, 0.1, 0.0], [0.0, 9.6, 0.0]])
    before = np.array([[0.0, 0.3, 0.0], [0.0, 9.3, 0.0]])
    MODELS["ds"].stabilise(measured(particles, before, width=10.0), DT, DT, scheme())
    np.testing.assert_allclose(particles.position[:, 1], [0.3, 9.4], rtol=1e-12)


def shaken_water(strength):
    """Moves of shifting in a shaken block whose outermost layer is free surface."""
    particles = particles_at(cloud(3, 900, 7, jitter=0.3))
    x = particles.position.copy()
    particles.surface[:] = ~inside(x, np.abs(x).max() - 0.8)
    move, change = apply("shifting", particles, shifting_strength=strength)
    return x, particles.surface == 1, move, change


@pytest.mark.parametrize("strength", [0.1, 10.0])
def test_shifting_moves_a_particle_by_a_twentieth_of_the_spacing_at_most(strength):
    _, _, move, _ = shaken_water(strength)
    length = np.linalg.norm(move, axis=1)
    assert length.max() <= 0.05 * (1.0 + 1e-12)
    assert np.isclose(length.max(), 0.05) == (strength == 10.0)


def test_shifting_leaves_velocities_alone():
    assert np.all(shaken_water(0.1)[3] == 0.0)


def test_shifting_is_zero_at_the_surface_and_beside_it():
    x, surface, move, _ = shaken_water(0.1)
    apart = np.linalg.norm(x[:, None] - x[None, surface], axis=-1).min(axis=1)
    beside = apart < 2.1
    assert np.all(move[beside] == 0.0)
    assert np.all(np.linalg.norm(move[~beside], axis=1) > 0.0)
    assert np.count_nonzero(~beside) > 20


def test_shifting_leaves_a_lone_surface_particle_inside_the_water_where_it_is():
    particles = particles_at(cloud(3, 300, 7, jitter=0.3))
    middle = int(np.argmin(np.linalg.norm(particles.position, axis=1)))
    particles.surface[middle] = 1
    move, _ = apply("shifting", particles)
    assert np.all(move[middle] == 0.0)
    assert np.count_nonzero(np.all(move == 0.0, axis=1)) > 20


def test_shifting_follows_its_formula():
    """dr = -A d0^2 sum (w/(n0 r^2)) r_ij, for a particle between six others, one of them near."""
    around = np.vstack([np.eye(3), -np.eye(3)])
    around[0] *= 0.8
    particles = particles_at(np.vstack([np.zeros(3), around]))
    move, _ = apply("shifting", particles)
    n0 = make_stencil(3, 1.0, 2.1).n0
    expected = -0.1 / n0 * ((2.1 / 0.8 - 1.0) / 0.8 - 1.1)
    np.testing.assert_allclose(move[0], [expected, 0.0, 0.0], atol=1e-7)


@pytest.mark.parametrize("dim", [2, 3])
def test_corrected_shifting_takes_back_its_share_of_a_displacement(dim):
    """Of one particle, moved off its place in the lattice; its neighbours' matrices change, too."""
    particles = particles_at(lattice(dim, 6))
    middle = inside(particles.position, 0)
    particles.position[middle, 0] = 1e-6
    move, _ = apply("corrected_shifting", particles, dim=dim, shifting_strength=0.25)
    np.testing.assert_allclose(move[middle], [[-0.25e-6, 0.0, 0.0]], rtol=0.1, atol=1e-12)


def test_corrected_shifting_stills_the_force_of_a_constant_pressure():
    """The conservative gradient of a constant pressure, inside a rim that stays where it is."""
    particles = particles_at(cloud(3, 900, 7, jitter=0.1))
    particles.surface[:] = ~inside(particles.position, 4.0)
    core = inside(particles.position, 1.5)

    def force():
        out, particles.pressure[:] = np.empty((len(particles), 3)), 1.0
        plugins.load("gradients", "corrected").gradient(near_of(particles, 3), out)
        return np.sqrt(np.mean(out[core] ** 2))

    before = force()
    for _ in range(30):
        apply("corrected_shifting", particles, shifting_strength=0.25)
    assert force() < 0.2 * before


def test_shifting_takes_particles_from_crowds_to_gaps():
    """The least distance inside a shaken block grows, and the number density evens out."""
    particles = particles_at(cloud(3, 900, 7, jitter=0.3))
    core = inside(particles.position, 2.5)

    def closest():
        x = particles.position
        apart = np.linalg.norm(x[core][:, None] - x[None], axis=-1)
        return np.sort(apart, axis=1)[:, 1].min()

    before = closest()
    for _ in range(20):
        apply("shifting", particles)
    assert closest() > 1.1 * before


@pytest.mark.parametrize("restitution", [0.0, 0.2, 1.0])
def test_collision_reverses_the_approach_with_the_restitution(restitution):
    particles = pair(0.4, speed=2.0)
    apply("collision", particles, restitution=restitution)
    e = np.array([0.6, 0.0, 0.8])
    assert (particles.velocity[0] - particles.velocity[1]) @ e == pytest.approx(-4.0 * restitution)


@pytest.mark.parametrize("role", [FACE, FILLER])
def test_collision_with_a_wall_reverses_the_approach_of_the_water_alone(role):
    particles = pair(0.4, roles=(FLUID, role), speed=2.0)
    particles.velocity[1] = 0.0
    apply("collision", particles, restitution=0.2)
    e = np.array([0.6, 0.0, 0.8])
    np.testing.assert_allclose(particles.velocity[0], -0.2 * 2.0 * e, atol=1e-15)
    assert np.all(particles.velocity[1] == 0.0)


def test_collision_keeps_the_velocity_along_the_contact():
    particles = pair(0.4, speed=2.0)
    particles.velocity[0] += [0.8, 5.0, -0.6]
    _, change = apply("collision", particles)
    assert np.abs(np.cross(change, [0.6, 0.0, 0.8])).max() < 1e-14


def test_collision_moves_the_particles_by_the_change_of_velocity():
    move, change = apply("collision", pair(0.4, speed=2.0))
    np.testing.assert_allclose(move, change * DT, rtol=1e-12)
    assert np.abs(move).max() > 0.0


@pytest.mark.parametrize(("distance", "speed"), [(0.51, 2.0), (0.4, -2.0), (0.4, 0.0)])
def test_collision_leaves_distant_and_parting_pairs_alone(distance, speed):
    move, change = apply("collision", pair(distance, speed=speed))
    assert np.all(move == 0.0)
    assert np.all(change == 0.0)


def test_collision_never_adds_energy_to_a_pair():
    for seed in range(20):
        random = np.random.default_rng(seed)
        particles = pair(0.4)
        particles.velocity[:] = random.normal(size=(2, 3))
        before = np.sum(particles.velocity**2)
        apply("collision", particles, restitution=0.2)
        assert np.sum(particles.velocity**2) <= before * (1.0 + 1e-14)


@pytest.mark.parametrize("name", ["shifting", "corrected_shifting"])
def test_two_short_steps_shift_a_particle_as_far_as_one_long_one(name):
    """What is left of a displacement: (1 - strength)^(dt/pace)."""
    moves = []
    for dt in (0.5 * DT, DT, 2.0 * DT):
        particles = particles_at(lattice(3, 4))
        middle = np.flatnonzero(~particles.position.any(axis=1))
        particles.position[middle, 0] = 0.01
        moves.append(apply(name, particles, dt=dt, shifting_strength=0.3)[0][middle, 0].item())
    half, _, double = 0.3 * np.array(moves) / moves[1]
    assert moves[1] < 0.0
    assert 1.0 - half == pytest.approx(np.sqrt(0.7), rel=1e-12)
    assert 1.0 - double == pytest.approx(0.7**2, rel=1e-12)
