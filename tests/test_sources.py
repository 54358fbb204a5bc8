"""Contract of the right-hand sides of the pressure equation, -(1/rho) <lap p> = b."""

import numpy as np
import pytest
from tanks import SINGLE, cloud, inside, lattice, near_of, particles_at, scheme

from mpslab.core import plugins
from mpslab.core.stencil import make_stencil

NAMES = plugins.names("sources")
DT = 1e-3


def source(
    name, position, velocity, dim, radius=2.1, ratio=None, dt=DT, reach=None, rate=5.0, **changes
):
    """b at every particle, spacing 1; `ratio` stands in for n over the density of rest."""
    near = near_of(particles_at(position), dim, radius, reach=reach)
    n, stencil = near.number_density.copy(), near.stencil
    rest = stencil.relaxed if name in ("adjoint", "corrected") else stencil.n0
    n[:] = n * rest / stencil.n0 if ratio is None else ratio * rest
    velocity = np.ascontiguousarray(velocity, float)
    return plugins.load("sources", name).source(near, velocity, n, dt, rate, scheme(**changes))


def at_centre(name, dim, velocity, radius=2.1, **changes):
    """b at the centre of a lattice."""
    position = lattice(dim, int(radius) + 1)
    b = source(name, position, velocity(position), dim, radius, **changes)
    return b[inside(position, 0)][0]


def uniform(x):
    return np.broadcast_to([0.4, 0.3, -0.7], x.shape)


def squeeze(x):
    return -0.2 * x


def test_six_models_are_there():
    assert {"density", "hs", "ecs", "mixed", "corrected", "adjoint"} <= set(NAMES)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_uniform_motion_at_n0_needs_no_pressure(name, dim):
    scale = abs(at_centre(name, dim, squeeze, ratio=1.01))
    assert abs(at_centre(name, dim, uniform)) < 100 * SINGLE * scale  # 1e-6 of n, for a 1 %


@pytest.mark.parametrize("name", NAMES)
def test_uniform_motion_of_a_random_cloud_at_n0_needs_no_pressure(name):
    position = cloud(3, 300, seed=1)
    b = source(name, position, uniform(position), 3, ratio=1.0)
    assert np.abs(b).max() < 1e-11 / DT


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_compressed_and_squeezed_water_gets_a_positive_source(name, dim):
    assert at_centre(name, dim, squeeze, ratio=1.01) > 0.0


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_rarefied_and_stretched_water_gets_a_negative_source(name, dim):
    assert at_centre(name, dim, lambda x: 0.2 * x, ratio=0.99) < 0.0


@pytest.mark.parametrize("name", [name for name in NAMES if name != "density"])
def test_squeezing_alone_gives_a_positive_source(name):
    assert at_centre(name, 3, squeeze, ratio=1.0) > 0.0


@pytest.mark.parametrize("name", ["density", "mixed"])
def test_compression_alone_gives_a_positive_source(name):
    assert at_centre(name, 3, uniform, ratio=1.01) > 0.0


@pytest.mark.parametrize("name", NAMES)
def test_shear_and_rotation_inside_the_lattice_need_no_pressure(name):
    def shear(x):
        return np.stack([0.3 * x[:, 2] + 0.1 * x[:, 1], -0.1 * x[:, 0], 0.2 * x[:, 0]], axis=1)

    assert abs(at_centre(name, 3, shear)) < 100 * SINGLE * abs(
        at_centre(name, 3, squeeze, ratio=1.01)
    )


def test_corrected_divergence_is_exact_for_linear_velocities_in_any_arrangement():
    position = cloud(3, 400, seed=3)
    matrix = np.array([[0.3, -0.2, 0.1], [0.5, 0.4, -0.3], [0.2, 0.1, -1.1]])
    b = source("corrected", position, position @ matrix.T, 3, ratio=1.0, rate=0.0)
    exact = np.isclose(b, -np.trace(matrix) / DT, rtol=10 * SINGLE)
    assert exact.mean() > 0.9  # the rest have too few neighbours for an inverse


def test_adjoint_divergence_is_the_adjoint_of_the_corrected_gradient():
    """sum p_i <div u>_i = -sum u_i . <grad p>_i for any pressures and velocities."""
    position = cloud(3, 400, seed=3, jitter=0.2)
    random = np.random.default_rng(4)
    velocity, p = random.normal(size=position.shape), random.uniform(size=len(position))
    particles, out = particles_at(position), np.empty(position.shape)
    particles.pressure[:] = p
    plugins.load("gradients", "corrected").gradient(near_of(particles, 3), out)
    divergence = -DT * source("adjoint", position, velocity, 3, ratio=1.0, rate=0.0)
    assert p @ divergence == pytest.approx(-np.sum(velocity * out), rel=1e-10)


@pytest.mark.parametrize("name", NAMES)
def test_source_is_a_rate_over_dt_and_an_error_over_dt_squared(name):
    """b dt^2 is linear in dt, whatever the model."""
    position = cloud(3, 300, seed=2)
    velocity = np.random.default_rng(3).normal(size=position.shape)
    one, two, three = (
        source(name, position, velocity, 3, dt=k * DT) * (k * DT) ** 2 for k in (1, 2, 3)
    )
    assert np.abs(one - 2.0 * two + three).max() < 1e-12 * np.abs(three).max()


@pytest.mark.parametrize("name", NAMES)
def test_particles_beyond_the_radius_do_not_matter(name):
    """The list may reach further, for the Laplacian."""
    position = cloud(3, 300, seed=2)
    velocity = np.random.default_rng(3).normal(size=position.shape)
    near = source(name, position, velocity, 3)
    far = source(name, position, velocity, 3, reach=3.1)
    assert np.abs(far - near).max() < 1e-12 * np.abs(near).max()


POWERS = {"density": 2, "hs": 1, "ecs": 1}


@pytest.mark.parametrize("name", POWERS)
def test_source_scales_with_its_power_of_dt(name):
    position = cloud(3, 300, seed=2)
    velocity = np.random.default_rng(3).normal(size=position.shape)
    whole = source(name, position, velocity, 3, dt=DT)
    half = source(name, position, velocity, 3, dt=0.5 * DT)
    np.testing.assert_allclose(half, whole * 2.0 ** POWERS[name], rtol=1e-13)


def test_density_source_is_the_relaxed_deviation():
    b = at_centre("density", 3, squeeze, ratio=1.03, relaxation=0.5)
    assert b == pytest.approx(0.5 * 0.03 / DT**2, rel=1e-12)


# (1/n0) sum (r_e/r^3) r.u of a field with div u = 1 (reference 3.1).
HS_RATIOS = [
    (2, 2.1, 1.417),
    (2, 3.1, 1.238),
    (2, 4.0, 1.118),
    (3, 2.1, 1.073),
    (3, 3.1, 1.082),
    (3, 4.0, 1.005),
]


@pytest.mark.parametrize(("dim", "radius", "ratio"), HS_RATIOS)
def test_hs_has_its_known_ratio_to_the_divergence(dim, radius, ratio):
    b = at_centre("hs", dim, lambda x: x / dim, radius)
    assert -b * DT == pytest.approx(ratio, abs=5e-4)


def test_hs_is_the_rate_of_the_number_density():
    """Against the number density itself, a small time before and after."""
    position = cloud(3, 300, seed=4, jitter=0.2)
    velocity = np.random.default_rng(5).normal(size=position.shape)
    stencil, small, n = make_stencil(3, 1.0, 2.1), 1e-7, []
    # Pairs that cross the radius have no derivative of w; there w' jumps from -1/r_e to 0.
    for time in (-small, small):
        moved = position + time * velocity
        r = np.linalg.norm(moved[:, None] - moved, axis=-1) + 1e9 * np.eye(len(moved))
        n.append(np.maximum(2.1 / r - 1.0, 0.0).sum(axis=1))
    rate = (n[1] - n[0]) / (2.0 * small) / stencil.n0
    b = source("hs", position, velocity, 3)
    np.testing.assert_allclose(b * DT, rate, rtol=1e-5, atol=1e-5)


def test_ecs_adds_the_two_compensating_terms():
    position = cloud(3, 300, seed=6, jitter=0.2)
    velocity = np.random.default_rng(7).normal(size=position.shape)
    error = -0.02
    hs = source("hs", position, velocity, 3)
    ecs = source("ecs", position, velocity, 3, ratio=1.0 + error)
    np.testing.assert_allclose(ecs, hs + abs(error) * hs + np.abs(hs) * error, rtol=1e-12)


def test_mixed_is_divergence_over_dt_plus_a_share_of_the_deviation():
    """Exact divergence of a linear field on the lattice: -div u/dt + s (n - n0)/(n0 dt)."""
    for dim in (2, 3):
        b = at_centre("mixed", dim, squeeze, ratio=1.03, rate=50.0)
        assert b == pytest.approx(0.2 * dim / DT + 50.0 * 0.03 / DT, rel=SINGLE)
