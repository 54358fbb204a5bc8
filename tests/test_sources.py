"""Contract of the right-hand sides of the pressure equation, -(1/rho) <lap p> = b."""

import numpy as np
import pytest
from tanks import cloud, inside, lattice, matrices_of, neighbors_of, scheme

from mpslab import plugins
from mpslab.kernels import density
from mpslab.stencil import make_stencil

NAMES = plugins.names("sources")
DT = 1e-3


def source(
    name, position, velocity, dim, radius=2.1, ratio=None, dt=DT, reach=None, rate=5.0, **changes
):
    """b at every particle, spacing 1; `ratio` stands in for n over the density of rest."""
    stencil = make_stencil(dim, 1.0, radius)
    found = neighbors_of(position, reach or radius)
    n = np.empty(len(position))
    density.number_density(position, found.indptr, found.indices, stencil, n)
    rest = stencil.relaxed if name in ("adjoint", "corrected") else stencil.n0
    n[:] = n * rest / stencil.n0 if ratio is None else ratio * rest
    out, role = np.full(len(position), np.nan), np.zeros(len(position), np.int8)
    c = matrices_of(position, role, found, stencil)
    plugins.load("sources", name).source(
        position, np.ascontiguousarray(velocity), role, n, found.indptr, found.indices, stencil,
        c, dt, rate, scheme(**changes), out,
    )  # fmt: skip
    return out


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
    assert abs(at_centre(name, dim, uniform)) < 1e-9 * scale


@pytest.mark.parametrize("name", NAMES)
def test_uniform_motion_of_a_random_cloud_at_n0_needs_no_pressure(name):
    position = cloud(3, 300, seed=1)
    b = source(name, position, uniform(position), 3, ratio=1.0)
    assert np.all(b == 0.0)


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

    assert abs(at_centre(name, 3, shear)) < 1e-9 * abs(at_centre(name, 3, squeeze, ratio=1.01))


def test_corrected_divergence_is_exact_for_linear_velocities_in_any_arrangement():
    position = cloud(3, 400, seed=3)
    matrix = np.array([[0.3, -0.2, 0.1], [0.5, 0.4, -0.3], [0.2, 0.1, -1.1]])
    b = source("corrected", position, position @ matrix.T, 3, ratio=1.0, rate=0.0)
    exact = np.isclose(b, -np.trace(matrix) / DT, rtol=1e-9)
    assert exact.mean() > 0.9  # the rest have too few neighbours for an inverse


def test_adjoint_divergence_is_the_adjoint_of_the_corrected_gradient():
    """sum p_i <div u>_i = -sum u_i . <grad p>_i for any pressures and velocities."""
    position = cloud(3, 400, seed=3, jitter=0.2)
    random = np.random.default_rng(4)
    velocity, p = random.normal(size=position.shape), random.uniform(size=len(position))
    found, stencil = neighbors_of(position, 2.1), make_stencil(3, 1.0, 2.1)
    role, out = np.zeros(len(p), np.int8), np.empty(position.shape)
    c = matrices_of(position, role, found, stencil)
    plugins.load("gradients", "corrected").gradient(
        position, p, role, found.indptr, found.indices, stencil, c, out
    )
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
    stencil, small = make_stencil(3, 1.0, 2.1), 1e-7
    # Pairs that cross the radius have no derivative of w; there w' jumps from -1/r_e to 0.
    n = []
    for time in (-small, small):
        moved = position + time * velocity
        found, here = neighbors_of(moved, 2.1), np.empty(len(position))
        density.number_density(moved, found.indptr, found.indices, stencil, here)
        n.append(here)
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
        assert b == pytest.approx(0.2 * dim / DT + 50.0 * 0.03 / DT, rel=1e-12)
