"""Contract of the pressure gradients; a new module is tested the day it is added."""

import numpy as np
import pytest
from tanks import SINGLE, cloud, inside, lattice, near_of, particles_at

from mpslab.core import plugins
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil

NAMES = plugins.names("gradients")
MODELS = {name: plugins.load("gradients", name) for name in NAMES}
CONSERVATIVE = [name for name in NAMES if MODELS[name].CONSERVES_MOMENTUM]
EXACT = [name for name in NAMES if MODELS[name].EXACT_FOR_LINEAR]
SLOPE = np.array([3.0, -2.0, 5.0])
RADII = [2.1, 3.1]
CMPS = ["cmps", "cmps_soft"]


def apply(name, position, pressure, dim, radius=2.1, role=None, width=0.0, reach=None):
    """Gradient of a model at every particle, spacing 1; `reach` is that of the list."""
    particles = particles_at(position, FLUID if role is None else role)
    particles.pressure[:] = pressure
    out = np.full(position.shape, np.nan)
    MODELS[name].gradient(near_of(particles, dim, radius, width, reach), out)
    return out


def slope(dim):
    return SLOPE * [1.0, dim - 2.0, 1.0]


def relative_error(found, exact):
    return np.linalg.norm(found - exact, axis=-1).max() / np.linalg.norm(exact)


def lattice_interior(name, dim, radius, offset=100.0):
    """Gradients of a linear pressure where neighbours of neighbours are all there."""
    half = int(2 * radius) + 1
    position = lattice(dim, half)
    found = apply(name, position, offset + position @ slope(dim), dim, radius)
    return found[inside(position, half - 2 * radius)]


def test_six_models_are_there():
    assert {"mps", "cmps", "cmps_soft", "symmetric", "corrected", "gc"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_module_states_what_it_promises(name):
    assert isinstance(MODELS[name].CONSERVES_MOMENTUM, bool)
    assert isinstance(MODELS[name].EXACT_FOR_LINEAR, bool)


@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", [name for name in NAMES if name not in CMPS])
def test_gradient_of_linear_field_is_exact_inside_the_lattice(name, dim, radius):
    assert relative_error(lattice_interior(name, dim, radius), slope(dim)) < 10 * SINGLE


@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", CMPS)
def test_cmps_does_not_see_a_linear_field_inside_the_lattice(name, dim, radius):
    """Equation (4): the bracket is the same for all neighbours, and their sum is 0."""
    found = lattice_interior(name, dim, radius)
    assert np.abs(found).max() < 1e-12 * np.linalg.norm(SLOPE)


@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", CMPS)
def test_cmps_sees_the_curvature_of_the_pressure_inside_the_lattice(name, dim, radius):
    """p = z^2/2 above z = 0: p - p^ = k z - k^2/2 with the k layers of the radius, slope k."""
    half, layers = int(2 * radius) + 1, int(radius)
    position = lattice(dim, half)
    found = apply(name, position, 0.5 * (position[:, 2] + half + 1.0) ** 2, dim, radius)
    there = inside(position, half - 2 * radius)
    np.testing.assert_allclose(found[there], [[0.0, 0.0, layers]] * there.sum(), atol=SINGLE)


def test_cmps_sees_the_linear_field_only_near_the_surface():
    """Ratio to the exact gradient in layers 0..4 under a flat surface, 3-D (reference, trap 2)."""
    x = lattice(3, 6)
    found = apply("cmps", x, 6.0 - x[:, 2], 3)
    column = inside(x[:, :2], 0)
    ratio = -found[column, 2][np.argsort(-x[column, 2])][:5]
    np.testing.assert_allclose(ratio, [0.50, 0.995, 0.50, 0.005, 0.0], atol=6e-3)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", EXACT)
def test_gradient_of_linear_field_is_exact_on_a_random_cloud(name, dim):
    """At four points per unit volume every particle has neighbours on all sides but at the rim."""
    position = cloud(dim, 1200, seed=1) / 4.0 ** (1.0 / dim)
    rim = np.abs(position).max()
    found = apply(name, position, 7.0 + position @ slope(dim), dim)
    assert relative_error(found[inside(position, rim - 1.0)], slope(dim)) < 10 * SINGLE


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", EXACT)
def test_gradient_of_linear_field_is_exact_up_to_the_faces_of_a_shaken_block(name, dim):
    """At edges and corners too few neighbours may be left: the correction falls back to none."""
    position = cloud(dim, 700, seed=2, jitter=0.2)
    found = apply(name, position, 7.0 + position @ slope(dim), dim)
    error = np.linalg.norm(found - slope(dim), axis=1) / np.linalg.norm(slope(dim))
    at_rim = np.abs(position) > np.abs(position).max() - 1.0
    assert error[at_rim.sum(axis=1) <= 1].max() < 10 * SINGLE


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", sorted(set(NAMES) - set(EXACT)))
def test_models_without_the_promise_miss_the_linear_field_on_a_shaken_lattice(name, dim):
    position = cloud(dim, 700, seed=2, jitter=0.2)
    found = apply(name, position, 7.0 + position @ slope(dim), dim)
    assert relative_error(found[inside(position, 3.0)], slope(dim)) > 1e-2


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", EXACT)
def test_gradient_of_linear_field_is_exact_beside_dummies(name, dim):
    """They are no neighbours: neither in the sum nor in the correction."""
    position = cloud(dim, 700, seed=2, jitter=0.2)
    role = np.where(position[:, 2] < -1.0, FILLER, FLUID)
    pressure = np.where(role == FLUID, 7.0 + position @ slope(dim), 1e6)
    found = apply(name, position, pressure, dim, role=role)
    there = (role == FLUID) & inside(position, np.abs(position).max() - 2.2)
    assert np.any(there & (position[:, 2] < 0.0))
    assert relative_error(found[there], slope(dim)) < 10 * SINGLE


def test_correction_of_corrected_counts_the_dummies():
    """Beside a wall on the lattice it corrects nothing, and equals the symmetric model."""
    position = lattice(3, 6)
    role = np.where(position[:, 2] < 0.0, FILLER, FLUID)
    pressure = np.random.default_rng(1).uniform(size=len(position))
    there = inside(position, 1)
    np.testing.assert_allclose(
        apply("corrected", position, pressure, 3, role=role)[there],
        apply("symmetric", position, pressure, 3, role=role)[there],
        rtol=SINGLE, atol=SINGLE,
    )  # fmt: skip


# Bracket of the sum for the first and the second of two particles with p = 2 and 5 (p^ = 2).
PAIRS = {"mps": (3.0, 0.0), "cmps": (3.0, 3.0), "symmetric": (7.0, 7.0), "gc": (3.0, -3.0)}


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", PAIRS)
def test_pair_of_particles_gives_the_printed_formula(name, dim):
    """(Ds/n0) [...] r_ij w/r^2; p^ is the least pressure around a particle, itself included."""
    r = np.array([0.8, 0.0, 0.6]) * 1.5
    first, second = apply(name, np.array([0.0 * r, r]), np.array([2.0, 5.0]), dim)
    unit = dim / make_stencil(dim, 1.0, 2.1).n0 * r * (2.1 / 1.5 - 1.0) / 1.5**2
    np.testing.assert_allclose(first, PAIRS[name][0] * unit, rtol=SINGLE)
    np.testing.assert_allclose(second, -PAIRS[name][1] * unit, rtol=SINGLE)


@pytest.mark.parametrize("dim", [2, 3])
def test_pair_of_particles_gives_the_formula_of_cmps_soft(dim):
    """(Ds/m0) (7 - 4) r_ij w/r, m0 = sum w r over the lattice; the second has the opposite."""
    r = np.array([0.8, 0.0, 0.6]) * 1.5
    first, second = apply("cmps_soft", np.array([0.0 * r, r]), np.array([2.0, 5.0]), dim)
    distance = np.linalg.norm(lattice(dim, 2), axis=1)
    m0 = (2.1 - distance[(distance > 0.0) & (distance < 2.1)]).sum()
    np.testing.assert_allclose(first, dim / m0 * 3.0 * r / 1.5 * (2.1 / 1.5 - 1.0), rtol=SINGLE)
    np.testing.assert_array_equal(second, -first)


@pytest.mark.parametrize("name", NAMES)
def test_particles_beyond_the_radius_do_not_matter(name):
    """The list may reach further, for the Laplacian."""
    position, role, pressure = mixed_cloud()
    near = apply(name, position, pressure, 3, role=role)
    far = apply(name, position, pressure, 3, role=role, reach=3.1)
    assert np.abs(far - near).max() < 1e-12 * np.abs(near).max()


def forces(name, dim):
    """Positions and pressure forces of 2,000 random particles without walls, random p >= 0."""
    position = cloud(dim, 2000, seed=3)
    pressure = np.random.default_rng(4).uniform(0.0, 1000.0, len(position))
    return position, -apply(name, position, pressure, dim)


def momentum_error(force):
    return np.linalg.norm(force.sum(axis=0)) / np.linalg.norm(force, axis=1).sum()


def torque_error(position, force):
    total = np.linalg.norm(np.cross(position, force).sum(axis=0))
    arms = np.linalg.norm(position, axis=1) * np.linalg.norm(force, axis=1)
    return total / arms.sum()


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", CONSERVATIVE)
def test_linear_momentum_of_2000_random_particles_is_conserved(name, dim):
    _, force = forces(name, dim)
    assert len(force) == 2000
    assert momentum_error(force) < 1e-13


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", [*CMPS, "symmetric"])
def test_angular_momentum_of_central_forces_is_conserved(name, dim):
    assert torque_error(*forces(name, dim)) < SINGLE


@pytest.mark.parametrize("dim", [2, 3])
def test_corrected_does_not_conserve_angular_momentum(dim):
    assert torque_error(*forces("corrected", dim)) > 10 * SINGLE


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", sorted(set(NAMES) - set(CONSERVATIVE)))
def test_models_without_the_promise_do_not_conserve_momentum(name, dim):
    position, force = forces(name, dim)
    assert momentum_error(force) > 1e-3
    assert torque_error(position, force) > 1e-4


def test_flags_say_who_conserves_momentum():
    assert {"cmps", "cmps_soft", "symmetric", "corrected"} <= set(CONSERVATIVE)
    assert {"mps", "gc"}.isdisjoint(CONSERVATIVE)


def mixed_cloud(dim=3):
    """Cloud with particles of every role, and their pressures."""
    random = np.random.default_rng(8)
    position = cloud(dim, 400, seed=7, jitter=0.3)
    role = random.choice([FLUID, FACE, FILLER], len(position))
    return position, role, random.uniform(0.0, 100.0, len(position))


@pytest.mark.parametrize("name", NAMES)
def test_gradient_is_zero_for_all_but_fluid(name):
    position, role, pressure = mixed_cloud()
    found = apply(name, position, pressure, 3, role=role)
    assert np.all(found[role != FLUID] == 0.0)
    assert np.all(np.linalg.norm(found[role == FLUID], axis=1) > 0.0)


@pytest.mark.parametrize("name", NAMES)
def test_pressure_of_dummies_does_not_matter(name):
    position, role, pressure = mixed_cloud()
    other = np.where(role == FILLER, -1e6, pressure)
    np.testing.assert_array_equal(
        apply(name, position, pressure, 3, role=role), apply(name, position, other, 3, role=role)
    )


@pytest.mark.parametrize("name", NAMES)
def test_pressure_of_walls_matters(name):
    position, role, pressure = mixed_cloud()
    other = np.where(role == FACE, pressure + 50.0, pressure)
    here = apply(name, position, pressure, 3, role=role)
    there = apply(name, position, other, 3, role=role)
    assert np.abs(there - here)[role == FLUID].max() > 1.0


@pytest.mark.parametrize("name", NAMES)
def test_gradient_does_not_depend_on_the_place(name):
    position, role, pressure = mixed_cloud()
    here = apply(name, position, pressure, 3, role=role)
    there = apply(name, position + np.array([17.3, -5.1, 40.7]), pressure, 3, role=role)
    assert np.abs(there - here).max() < 1e-11 * np.abs(here).max()


@pytest.mark.parametrize("name", NAMES)
def test_gradient_in_2d_equals_itself_turned_upside_down(name):
    """Mirroring z mirrors the gradient: no direction is preferred."""
    position, role, pressure = mixed_cloud(dim=2)
    here = apply(name, position, pressure, 2, role=role)
    mirrored = apply(name, position * [1.0, 1.0, -1.0], pressure, 2, role=role)
    assert np.abs(mirrored * [1.0, 1.0, -1.0] - here).max() < 1e-12 * np.abs(here).max()


@pytest.mark.parametrize("name", NAMES)
def test_gradient_in_2d_has_no_component_across(name):
    position, role, pressure = mixed_cloud(dim=2)
    assert np.all(apply(name, position, pressure, 2, role=role)[:, 1] == 0.0)


@pytest.mark.parametrize("name", NAMES)
def test_periodic_tank_equals_explicit_copies(name):
    width = 7.0
    position, role, pressure = mixed_cloud()
    within = np.abs(position[:, 1]) < 0.5 * width
    across = np.array([0.0, width, 0.0])
    position, role, pressure = position[within] + 0.5 * across, role[within], pressure[within]
    copies = np.vstack([position + copy * across for copy in (0, -1, 1)])
    wrapped = apply(name, position, pressure, 3, role=role, width=width)
    explicit = apply(name, copies, np.tile(pressure, 3), 3, role=np.tile(role, 3))[: len(position)]
    assert np.abs(wrapped - explicit).max() < 1e-11 * np.abs(explicit).max()


@pytest.mark.parametrize("name", NAMES)
def test_gradient_of_one_particle_alone_is_zero(name):
    assert np.all(apply(name, np.zeros((1, 3)), np.array([5.0]), 3) == 0.0)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_coincident_and_collinear_particles_give_finite_gradients(name, dim):
    """The moment matrix is singular here: models that invert it have to fall back."""
    x = np.array([0.0, 0.0, 1.0, 2.0, 3.0])
    found = apply(name, np.outer(x, [1.0, 0.0, 0.0]), np.arange(5.0), dim)
    assert np.isfinite(found).all()
