"""Walls that continue the pressure of the water, and the graded free surface."""

import numpy as np
import pytest
from tanks import SINGLE, flow_of, inside, lattice, make_case, near_of, run

from mpslab.core import plugins
from mpslab.core.particles import FACE, FLUID, PISTON, WATER, make_particles
from mpslab.core.stencil import make_stencil
from mpslab.models import surface, wall_pressure

RHO, G, DT = 1000.0, 9.81, 1e-3
GRAVITY = np.array([0.0, 0.0, -G])


def tank(dim=3, jitter=0.1, half=4):
    """Water above z = -0.5 and walls below it, spacing 1, hydrostatic pressure everywhere."""
    position = lattice(dim, half)
    role = np.where(position[:, 2] < -0.5, FACE, FLUID)
    move = np.random.default_rng(2).uniform(-jitter, jitter, position.shape)
    position += move * [1.0, dim - 2.0, 1.0] * (role == FLUID)[:, None]
    particles = make_particles(position, role)
    particles.pressure[:] = RHO * G * (10.0 - position[:, 2])
    return particles, near_of(particles, dim, active=role == FLUID)


def pull_of(particles):
    return wall_pressure.pull(particles, np.zeros_like(particles.velocity), GRAVITY, DT,
                      np.zeros(len(particles), bool))


@pytest.mark.parametrize("dim", [2, 3])
def test_extrapolated_pressure_of_still_water_is_exact_in_any_arrangement(dim):
    particles, near = tank(dim)
    exact = particles.pressure.copy()
    wall_pressure.fill(near, RHO, pull_of(particles), True)
    reached = (particles.role == FACE) & (particles.pressure > 0.0)
    assert np.count_nonzero(reached) > 9
    np.testing.assert_allclose(particles.pressure[reached], exact[reached], rtol=SINGLE)
    far = particles.position[:, 2] < -3.5
    assert np.all(particles.pressure[far] == 0.0)


@pytest.mark.parametrize("dim", [2, 3])
def test_laplacian_of_hydrostatic_pressure_vanishes_beside_a_wall(dim):
    particles, near = tank(dim, jitter=0.0)
    terms = plugins.load("laplacians", "standard").pair_terms(near.stencil)
    share = wall_pressure.flux(near, near.stencil, terms, pull_of(particles))
    for i in np.flatnonzero(inside(particles.position, 1.0) & particles.fluid):
        j = near.other[near.row[i] : near.solid[i]]
        r = np.linalg.norm(particles.position[j] - particles.position[i], axis=1)
        laplacian = np.sum((terms[0] + terms[1] / r) * (particles.pressure[j] -
                           particles.pressure[i]))  # fmt: skip
        assert laplacian / RHO + share[i] == pytest.approx(0.0, abs=SINGLE * G)


def test_pull_of_an_accelerating_piston_is_gravity_less_its_acceleration():
    particles = make_particles(np.zeros((2, 3)), [FLUID, FACE], [WATER, PISTON])
    particles.velocity[1, 0] = 0.3
    pull = wall_pressure.pull(particles, np.array([[0.0, 0, 0], [0.1, 0, 0]]), GRAVITY, 0.1,
                      np.array([False, True]))
    np.testing.assert_allclose(pull, [[0.0, 0.0, -G], [-2.0, 0.0, -G]])


def graded_block(dim):
    position = lattice(dim, 4)
    particles = make_particles(position, np.full(len(position), FLUID))
    near = near_of(particles, dim)
    particles.number_density[:] = near.number_density
    return particles, near.stencil, surface.grade_surface(near)


@pytest.mark.parametrize("dim", [2, 3])
def test_grade_is_one_at_the_faces_of_a_block_and_zero_inside(dim):
    particles, _, graded = graded_block(dim)
    outermost = ~inside(particles.position, 3.5)
    assert np.all(graded[outermost] == 1.0)
    assert np.all(graded[~outermost] == 0.0)
    assert np.all(particles.surface == outermost)


def test_lone_particle_is_all_surface_and_its_row_is_not_singular():
    flow = flow_of(make_case(), keep=lambda p: (p.gid == p.gid[p.fluid][0]) & p.fluid)
    run(flow, 3, 1e-4)
    assert flow.particles.pressure[0] == 0.0
    assert flow.particles.velocity[0, 2] == pytest.approx(-3e-4 * G, rel=1e-12)


@pytest.mark.parametrize("dim", [2, 3])
def test_missing_neighbours_count_as_present_in_the_density_of_the_surface(dim):
    particles, stencil, graded = graded_block(dim)
    n = surface.filled_density(particles.number_density, graded, stencil)
    np.testing.assert_allclose(n[graded == 1.0], stencil.relaxed)
    inner = graded == 0.0
    np.testing.assert_array_equal(n[inner], particles.number_density[inner])


@pytest.mark.parametrize("clip", [True, False])
def test_walls_hold_a_negative_pressure_unless_it_is_clipped(clip):
    particles, near = tank(2)
    particles.pressure[particles.fluid] = -1e6
    wall_pressure.fill(near, RHO, pull_of(particles), clip)
    beside = np.unique(near.other[~particles.fluid[near.other]])
    assert np.all(particles.pressure[beside] == 0.0 if clip else particles.pressure[beside] < 0.0)


def test_walls_without_rows_are_never_marked_as_surface():
    """They would keep the water beside them from being shifted."""
    scheme = {"scheme.surface": "marked", "scheme.walls": "extrapolated"}
    flow = flow_of(make_case(scheme))
    run(flow, 1, 1e-4)
    fluid = flow.particles.fluid
    assert not flow.particles.surface[~fluid].any()
    assert 0 < np.count_nonzero(flow.particles.surface[fluid]) <= 20


@pytest.mark.parametrize("radius", [2.1, 3.1])
@pytest.mark.parametrize("dim", [2, 3])
def test_surface_pull_is_twice_the_missing_share_of_the_laplacian(dim, radius):
    """The share that is missing of the number density, whatever the radius of the Laplacian."""
    particles, stencil, graded = graded_block(dim)
    wide = make_stencil(dim, 1.0, radius)
    terms = plugins.load("laplacians", "standard").pair_terms(wide)
    pull = surface.surface_pull(particles, graded, stencil, wide, terms, RHO)
    full = 2.0 * dim / wide.lambda0 / RHO
    missing = 1.0 - particles.number_density / stencil.n0
    np.testing.assert_allclose(pull, 2.0 * graded * missing * full, rtol=1e-9, atol=1e-18)
