"""Friction of the water: strain rate, eddy viscosity, and what walls do to it."""

import numpy as np
import pytest
from ranks import start
from tanks import SINGLE, cloud, inside, lattice, make_case, near_of, particles_at

from mpslab.core.keys import CaseError
from mpslab.core.neighbourhood import padded
from mpslab.core.parameters import Fluid, Scheme
from mpslab.core.particles import FACE, FLUID
from mpslab.kernels import viscosity
from mpslab.models import friction
from mpslab.simulation import Simulation

RATE, CONSTANT = 3.0, 0.2
LINEAR = {
    "shear": ([[0, 0, RATE], [0, 0, 0], [0, 0, 0]], RATE),
    "strain": ([[RATE, 0, 0], [0, 0, 0], [0, 0, -RATE]], 2.0 * RATE),
    "rotation": ([[0, 0, RATE], [0, 0, 0], [-RATE, 0, 0]], 0.0),
}
ALL = np.array([[1.0, 2.0, -0.5], [3.0, -2.0, 0.7], [0.4, -1.1, 1.3]])


def strain_rate(position, velocity, dim, role=None, slip=True):
    near = near_of(particles_at(position, FLUID if role is None else role), dim)
    out = np.full(len(position), np.nan)
    viscosity.strain_rate(
        near.row, near.solid, near.other, near.offset, near.particles.role, near.stencil,
        padded(velocity), near.correction, slip, out,
    )  # fmt: skip
    return out


def acceleration(position, velocity, dim, nu=0.0, slip=True, role=FLUID):
    particles = particles_at(position, role)
    particles.velocity[:] = velocity
    near = near_of(particles, dim)
    return friction_of(near, Fluid(viscosity=nu), Scheme(smagorinsky=CONSTANT, wall_slip=slip))


def friction_of(near, fluid, scheme):
    seen = friction.velocity_seen(near, scheme, lambda _: None)
    eddy = friction.eddies(near, seen, scheme, lambda _: None)
    return friction.acceleration(near, near.stencil, seen, eddy, fluid, scheme)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("flow", LINEAR)
def test_strain_rate_of_linear_flow_is_exact_in_disorder(flow, dim):
    matrix, exact = LINEAR[flow]
    position = cloud(dim, 9**dim, 1, jitter=0.2)
    found = strain_rate(position, position @ np.transpose(np.array(matrix, float)), dim)
    np.testing.assert_allclose(found[inside(position, 1.5)], exact, atol=SINGLE)


def test_strain_rate_in_3d_takes_all_components():
    position = cloud(3, 9**3, 2, jitter=0.2)
    found = strain_rate(position, position @ ALL.T, 3)
    exact = np.sqrt(2.0 * np.sum((0.5 * (ALL + ALL.T)) ** 2))
    np.testing.assert_allclose(found[inside(position, 1.5)], exact, atol=SINGLE)


def stream_along_a_wall():
    """Position, velocity and role of water at 2 m/s over a wall; the middle of its lowest layer."""
    position = lattice(2, 5)
    role = np.where(position[:, 2] < 0.0, FACE, FLUID)
    velocity = np.zeros_like(position)
    velocity[role == FLUID, 0] = 2.0
    at_wall = (position[:, 2] == 0.0) & (np.abs(position[:, 0]) < 2.0)
    return position, velocity, role, at_wall


def test_strain_rate_sees_the_wall_only_without_slip():
    position, velocity, role, at_wall = stream_along_a_wall()
    assert np.all(strain_rate(position, velocity, 2, role, slip=True)[at_wall] < 1e-12)
    assert np.all(strain_rate(position, velocity, 2, role, slip=False)[at_wall] > 0.5)
    assert np.all(strain_rate(position, velocity, 2, role, slip=False)[role == FACE] == 0.0)


@pytest.mark.parametrize("dim", [2, 3])
def test_eddy_viscosity_of_uniform_shear_acts_as_a_viscosity_of_its_size(dim):
    """u = R z + e z^2, whose |S| is R + 2 e z: the force is d/dz of C^2 |S|^2, twice that of the
    viscosity C^2 R."""
    position, bend = lattice(dim, 6), 1e-4
    velocity = np.zeros_like(position)
    velocity[:, 0] = RATE * position[:, 2] + bend * position[:, 2] ** 2
    middle = inside(position, 1)
    found = acceleration(position, velocity, dim)[middle]
    near = near_of(particles_at(position), dim)
    near.particles.velocity[:] = velocity
    constant = friction_of(near, Fluid(viscosity=CONSTANT**2 * RATE), Scheme())[middle]
    np.testing.assert_allclose(found[:, 0], 2.0 * constant[:, 0], rtol=1e-3)
    np.testing.assert_allclose(found[:, 1:], 0.0, atol=1e-7)


def test_molecular_and_eddy_viscosity_add_up():
    position = cloud(2, 400, 4, jitter=0.2)
    velocity = np.random.default_rng(5).normal(size=position.shape) * [1, 0, 1]
    both, eddy = (acceleration(position, velocity, 2, nu) for nu in (0.3, 0.0))
    near = near_of(particles_at(position), 2)
    near.particles.velocity[:] = velocity
    alone = friction_of(near, Fluid(viscosity=0.3), Scheme())
    np.testing.assert_allclose(both, eddy + alone, atol=1e-12)


@pytest.mark.parametrize("dim", [2, 3])
def test_eddies_keep_momentum_and_lose_energy(dim):
    position = cloud(dim, 500, 1, jitter=0.3)
    velocity = np.random.default_rng(2).normal(size=position.shape)
    velocity[:, 1] *= dim - 2
    found = acceleration(position, velocity, dim)
    assert np.linalg.norm(found.sum(axis=0)) < 1e-13 * np.linalg.norm(found, axis=1).sum()
    assert np.sum(found * velocity) < 0.0


def test_walls_brake_the_water_by_its_own_eddies():
    position, velocity, role, at_wall = stream_along_a_wall()
    assert np.all(acceleration(position, velocity, 2, slip=True, role=role)[at_wall] == 0.0)
    rough = acceleration(position, velocity, 2, slip=False, role=role)
    assert np.all(rough[at_wall, 0] < 0.0)
    assert np.all(rough[role == FACE] == 0.0)


def test_a_wall_with_friction_is_at_rest_at_its_face():
    """u = z over a wall whose face is at z = 0 has no viscous force; solids that stood for the
    water half a spacing behind it with their own velocity would leave a large one."""
    position = lattice(2, 6) + np.array([0.0, 0.0, 0.5])
    role = np.where(position[:, 2] < 0.0, FACE, FLUID)
    near = near_of(particles_at(position, role), 2)
    near.particles.velocity[:, 0] = np.maximum(position[:, 2], 0.0)
    scheme, fluid = Scheme(wall_slip=False), Fluid(viscosity=1.0)
    lowest = (position[:, 2] == 0.5) & (np.abs(position[:, 0]) < 2.0)
    force = friction_of(near, fluid, scheme)[lowest, 0]
    still = padded(near.particles.velocity)
    bare = friction.acceleration(near, near.stencil, still, None, fluid, scheme)[lowest, 0]
    assert np.all(bare > 0.3)
    assert np.all(np.abs(force) < 0.3 * bare)


def test_velocity_of_a_wall_is_mirrored_in_that_of_the_water():
    position = cloud(3, 8**3, 3, jitter=0.2)
    role = np.where(position[:, 2] < 0.0, FACE, FLUID)
    particles = particles_at(position, role)
    particles.velocity[:] = np.random.default_rng(4).normal(size=position.shape)
    seen = friction.velocity_seen(near_of(particles, 3), Scheme(wall_slip=False), lambda _: None)
    apart = np.linalg.norm(position[:, None] - position, axis=2) + 1e9 * np.eye(len(position))
    w = np.maximum(2.1 / apart - 1.0, 0.0) * (role == FLUID)
    mean = w @ particles.velocity / np.maximum(w.sum(axis=1), 1e-30)[:, None]
    mirrored = (role == FACE) & (w.sum(axis=1) > 0.0)
    expected = np.where(mirrored[:, None], 2.0 * particles.velocity - mean, particles.velocity)
    np.testing.assert_allclose(seen[:, :3], expected, atol=1e-5)


STREAM = {
    "tank.length": 0.06, "fluid.gravity": 0.0, "fluid.viscosity": 0.0, "initial.type": "stream",
    "initial.speed": 0.5, "water": [{"from": [0.0, 0, 0], "to": [0.04, 0, 0.01]}],
    "particles.jitter": 0.1,
}  # fmt: skip


def test_stream_is_slowed_by_a_bed_with_friction_and_by_no_other():
    speed = {}
    for name, changes in {
        "slip": {"scheme.smagorinsky": 0.12},
        "none": {"scheme.wall_slip": False},
        "rough": {"scheme.smagorinsky": 0.12, "scheme.wall_slip": False},
    }.items():
        p = Simulation(make_case({**STREAM, **changes})).run(until=0.02).particles
        low = p.fluid & (p.position[:, 2] < 0.002)
        speed[name] = p.velocity[low, 0].mean()
    assert speed["rough"] < 0.98 * speed["none"]
    assert speed["slip"] == pytest.approx(speed["none"], rel=0.01)


def test_ranks_give_the_same_bits_with_eddies_as_one():
    """A column that collapses."""
    changes = {"tank.length": 0.06, "water": [{"from": [0.0, 0, 0], "to": [0.03, 0, 0.03]}],
               "scheme.smagorinsky": 0.12, "scheme.wall_slip": False}  # fmt: skip
    assert start("steps", 2, changes, 30, 4e-4) == start("steps", 1, changes, 30, 4e-4)


@pytest.mark.parametrize("value", [-0.1, 1.5])
def test_constant_out_of_range_is_refused(value):
    with pytest.raises(CaseError, match=r"^scheme\.smagorinsky = .*: must be "):
        make_case({"scheme.smagorinsky": value})
