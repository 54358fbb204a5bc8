"""Contract of the passes over pairs: each against its formula, written out in numpy."""

from types import SimpleNamespace

import numpy as np
import pytest
from tanks import SINGLE, cloud, lattice, near_of, neighbors_of, particles_at

from mpslab.core import plugins
from mpslab.core.neighbourhood import SLACK, Neighbourhood, padded
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil
from mpslab.kernels import viscosity
from mpslab.models import wall_pressure
from mpslab.models.stabilisers.shifting import LONGEST, shift
from mpslab.pressure import equation

WIDTH = 7.0
DIMS = [2, 3]


def crowd(dim, seed=1):
    """Shaken block of water, faces and fillers, periodic across in 3-D."""
    random = np.random.default_rng(seed)
    position = cloud(dim, 400, seed, jitter=0.25)
    if dim == 3:
        position = position[np.abs(position[:, 1]) < 0.5 * WIDTH] + [0.0, 0.5 * WIDTH, 0.0]
    particles = particles_at(position)
    particles.role[:] = random.choice([FLUID] * 8 + [FACE, FILLER], len(position))
    particles.velocity[:] = random.normal(size=position.shape) * [1.0, dim - 2.0, 1.0]
    particles.pressure[:] = random.uniform(0.0, 100.0, len(position))
    return particles


def setting(dim, reach=2.6, solids=True):
    """Neighbourhood of a crowd, whose list reaches further than its stencil; and the plain form.

    Without `solids` only water has rows.
    """
    particles, width = crowd(dim), WIDTH if dim == 3 else 0.0
    active = particles.fluid | solids
    near = near_of(particles, dim, width=width, reach=reach, active=active)
    return near, plain(particles, dim, width)


def plain(particles, dim, width):
    """All pairs as (n, n) arrays in double precision: r_ij (n, n, 3), r, w, g = w/r^2, C, D."""
    x, stencil = particles.position, make_stencil(dim, 1.0, 2.1, width)
    r = x[None] - x[:, None]
    if width:
        r[:, :, 1] -= width * np.rint(r[:, :, 1] / width)
    distance = np.linalg.norm(r, axis=2) + 1e9 * np.eye(len(x))
    w = np.maximum(stencil.radius / distance - 1.0, 0.0)
    g = w / distance**2
    moment = dim / stencil.n0 * np.einsum("ij,ija,ijb->iab", g, r, r)
    if dim == 2:
        moment[:, 1, 1] = 1.0
    good = np.linalg.det(moment) >= 0.6
    c = np.where(good[:, None, None], np.linalg.inv(moment + ~good[:, None, None] * np.eye(3)),
                 np.eye(3))  # fmt: skip
    water = particles.role == FLUID
    d = np.where(water[None, :, None, None], c[None], c[:, None])
    return SimpleNamespace(r=r, distance=distance, w=w, g=g, c=c, d=d, water=water)


def assert_close(found, expected, of=SINGLE):
    assert np.abs(found - expected).max() < 10 * of * np.abs(expected).max()


@pytest.mark.parametrize("dim", DIMS)
def test_offsets_are_opposite_to_the_last_bit(dim):
    near, _ = setting(dim)
    n, m = len(near.particles), len(near.other)
    pair = np.repeat(np.arange(n), np.diff(near.row)) * n + near.other
    back = near.other.astype(int) * n + np.repeat(np.arange(n), np.diff(near.row))
    there, here = np.argsort(pair), np.argsort(back)
    np.testing.assert_array_equal(near.offset[:m][there, :3], -near.offset[:m][here, :3])
    np.testing.assert_array_equal(near.offset[:m][there, 3], near.offset[:m][here, 3])
    np.testing.assert_array_equal(near.inverse[:m][there], near.inverse[:m][here])


@pytest.mark.parametrize("dim", DIMS)
def test_rows_have_water_before_solids_each_in_the_order_of_the_list(dim):
    particles = crowd(dim)
    found = neighbors_of(particles.position, 2.6)
    before = found.indices.copy()
    near = Neighbourhood(make_stencil(dim, 1.0, 2.1)).measure(particles, found)
    for i in range(len(particles)):
        row = before[found.indptr[i] : found.indptr[i + 1]]
        water = row[particles.fluid[row]]
        assert near.other[near.row[i] : near.solid[i]].tolist() == water.tolist()
        solid = near.other[near.solid[i] : near.row[i + 1]]
        assert solid.tolist() == row[~particles.fluid[row]].tolist()


def washboard(dim, height, along, smooth):
    """Offsets to solids, and w/r^2, of one particle of water above a bed of particles."""
    bed = lattice(dim, 3)
    bed = bed[bed[:, 2] < 0.0] + [0.0, 0.0, 0.5]
    position = np.vstack([[along, 0.3 * along * (dim - 2), height], bed])
    particles = particles_at(position, np.where(np.arange(len(position)), FACE, FLUID))
    found = neighbors_of(position, 2.6)
    near = Neighbourhood(make_stencil(dim, 1.0, 2.1)).measure(particles, found, smooth=smooth)
    pairs = near.offset[near.solid[0] : near.row[1]].astype(float)
    return pairs[:, :3], pairs[:, 3:]


@pytest.mark.parametrize("dim", DIMS)
def test_a_smooth_bed_pushes_nowhere_but_up(dim):
    """The largest push along the bed, over that upwards, at uniform pressure."""
    aside = {}
    for smooth in (False, True):
        sums = []
        for along in np.linspace(0.05, 0.45, 9):
            r, g = washboard(dim, 0.4, along, smooth)
            sums.append((r * g).sum(axis=0))
        sums = np.array(sums)
        aside[smooth] = np.abs(sums[:, :2]).max() / np.abs(sums[:, 2]).min()
    assert aside[False] > 0.025
    assert aside[True] < 0.3 * aside[False]


@pytest.mark.parametrize("dim", DIMS)
def test_shifting_sees_a_smooth_bed_as_the_pressure_does(dim):
    """Where the pressure pushes straight up, water is shifted straight up."""
    bed = lattice(dim, 3)
    bed = bed[bed[:, 2] < 0.0] + [0.0, 0.0, 0.5]
    place = np.vstack([[0.2, 0.1 * (dim - 2), 0.4], bed])
    particles = particles_at(place, np.where(np.arange(len(place)), FACE, FLUID))
    aside = {}
    for smooth in (False, True):
        near = Neighbourhood(make_stencil(dim, 1.0, 2.1))
        near.measure(particles, neighbors_of(place, 2.6), smooth=smooth)
        push, before = near.second[0, :, 3].copy(), particles.position[0].copy()
        shift(near, np.pad(near.second[:, :, 3], ((0, 0), (0, 1))), 1e-3, 1.0)
        move = particles.position[0] - before
        np.testing.assert_allclose(move, -1e-3 * push, atol=1e-12)
        particles.position[0] = before
        aside[smooth] = np.abs(move[:2]).max() / move[2]
    assert aside[False] > 0.02
    assert aside[True] < 0.3 * aside[False]


def box_in_water(dim):
    """Water on the lattice around a box of 6 x 4 spacings (6 x 6 x 4), and which of it is near."""
    place = lattice(dim, 8)
    inside = np.all(np.abs(place - 0.5) < [3.0, 3.0 * (dim - 2) + 1.0, 2.0], axis=1)
    particles = particles_at(place, np.where(inside, FACE, FLUID))
    return particles, np.flatnonzero(np.all(np.abs(place) < 6.0, axis=1) & ~inside)


@pytest.mark.parametrize("dim", DIMS)
def test_a_smooth_box_is_lifted_by_the_water_it_displaces(dim):
    """On the lattice, where particles as they are give the lift of Archimedes."""
    particles, water = box_in_water(dim)
    p, lift = -particles.position[:, 2], {}
    for smooth in (False, True):
        near = Neighbourhood(make_stencil(dim, 1.0, 2.1))
        near.measure(particles, neighbors_of(particles.position, 2.1), smooth=smooth)
        force = 0.0
        for i in water:
            pairs = slice(near.solid[i], near.row[i + 1])
            r, g = near.offset[pairs, :3], near.offset[pairs, 3]
            push = (p[i] + p[near.other[pairs]]) * g @ r
            force -= near.correction[i, 2, :3] @ push * dim / near.stencil.n0
        lift[smooth] = -force / np.count_nonzero(~particles.fluid)
    assert lift[False] == pytest.approx(1.0, abs=1e-4)
    assert lift[True] == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("dim", DIMS)
def test_moments_are_the_sums_of_their_formulas(dim):
    near, pairs = setting(dim)
    assert_close(near.number_density, pairs.w.sum(axis=1))
    assert_close(near.first[:, :3], np.einsum("ij,ija->ia", pairs.w, pairs.r))
    assert_close(near.second[:, :, :3], np.einsum("ij,ija,ijb->iab", pairs.g, pairs.r, pairs.r))
    assert_close(near.second[:, :, 3], np.einsum("ij,ija->ia", pairs.g, pairs.r))
    assert_close(near.correction[:, :, :3], pairs.c)


@pytest.mark.parametrize("dim", DIMS)
def test_adjoint_divergence_and_lean_are_the_sums_of_their_formulas(dim):
    near, pairs = setting(dim)
    u = near.particles.velocity
    turned = np.einsum("ij,ijab,ijb->ija", pairs.g, pairs.d, pairs.r)
    divergence = np.einsum("ija,ija->i", u[None] - u[:, None], turned)
    assert_close(near.lean[:, :3], turned.sum(axis=1))  # on its own, before it comes for nothing
    assert_close(near.adjoint_divergence(u), divergence)
    assert_close(near.lean[:, :3], turned.sum(axis=1))


@pytest.mark.parametrize("dim", DIMS)
def test_corrected_divergence_is_the_sum_of_its_formula(dim):
    near, pairs = setting(dim)
    u = near.particles.velocity
    difference = u[None] - u[:, None]
    moment = dim / near.stencil.n0 * np.einsum("ij,ija,ijb->iab", pairs.g, pairs.r, pairs.r)
    if dim == 2:
        moment[:, 1, 1] = 1.0
    regular = np.linalg.det(moment) >= 0.3
    moment[~regular] = np.eye(3)
    sums = np.einsum("ij,ija,ijb->iab", pairs.g, difference, pairs.r)
    expected = np.einsum("iab,iab->i", np.linalg.inv(moment), sums)
    assert 0.5 < regular.mean() < 1.0
    assert_close(near.corrected_divergence(u, 0.3), expected)
    turned = np.einsum("ij,ijab,ijb->ia", pairs.g, pairs.d, pairs.r)
    assert_close(near.lean[:, :3], turned)


@pytest.mark.parametrize("dim", DIMS)
def test_largest_together_is_that_of_a_particle_and_the_water_beside_it(dim):
    near, pairs = setting(dim)
    rate = np.random.default_rng(2).normal(size=len(pairs.water))
    rate[~pairs.water] = 100.0
    beside = (pairs.distance < 2.6) & pairs.water
    mean = (rate + beside @ np.where(pairs.water, rate, 0.0)) / (1.0 + beside.sum(axis=1))
    shared = np.where(pairs.water, np.minimum(rate, mean), 0.0)
    half = len(rate) // 2
    for mine in (slice(0, half), slice(half, len(rate))):
        assert near.largest_together(rate, mine) == pytest.approx(shared[mine].max())
    assert near.largest_together(-np.abs(rate), slice(0, half)) == 0.0


@pytest.mark.parametrize("walls_act", [False, True])
@pytest.mark.parametrize("dim", DIMS)
def test_corrected_gradient_is_the_sum_of_its_formula(dim, walls_act):
    near, pairs = setting(dim)
    if walls_act:
        near.loaded[:] = 1
    p = near.particles.pressure
    both = p[:, None, None, None] * pairs.d + p[None, :, None, None] * pairs.c[:, None]
    g = pairs.g * near.loaded
    expected = np.einsum("ij,ijab,ijb->ia", g, both, pairs.r) * dim / near.stencil.n0
    expected[~pairs.water] = 0.0
    out = np.empty_like(expected)
    plugins.load("gradients", "corrected").gradient(near, out)
    assert_close(out, expected)


@pytest.mark.parametrize("dim", DIMS)
def test_corrected_shifting_is_the_sum_of_its_formula(dim):
    near, pairs = setting(dim)
    half = 0.5 * (pairs.d + pairs.c[:, None])
    expected = -0.1 * np.einsum("ij,ijab,ijb->ia", pairs.g, half, pairs.r)
    expected[~pairs.water | (near.beside_surface == 1)] = 0.0
    length = np.linalg.norm(expected, axis=1, keepdims=True)
    expected *= LONGEST / np.maximum(length, LONGEST)
    assert np.any(length > LONGEST) and np.any(length[:, 0] * pairs.water == 0.0)
    before = near.particles.position.copy()
    shift(near, 0.5 * near.disorder, 0.1, 1.0)
    assert_close(near.particles.position - before, expected)


@pytest.mark.parametrize("slip", [True, False])
@pytest.mark.parametrize("dim", DIMS)
def test_viscous_acceleration_is_the_sum_of_its_formula(dim, slip):
    near, pairs = setting(dim)
    u, stencil = near.particles.velocity, make_stencil(dim, 1.0, 2.6)
    w = np.maximum(2.6 / pairs.distance - 1.0, 0.0) * (pairs.water if slip else 1.0)
    nu = np.random.default_rng(4).uniform(0.1, 0.5, len(u))
    factor = dim * (dim + 2) / (stencil.lambda0 * stencil.n0)
    e, apart = pairs.r / pairs.distance[:, :, None], u[None] - u[:, None]
    rate = np.einsum("ija,ija->ij", apart, e)
    water = np.einsum("ij,ija->ia", w * (nu[:, None] + nu) * rate * pairs.water, e)
    solids = 2.0 / (dim + 2) * np.einsum("ij,ija->ia", w * nu[:, None] * ~pairs.water, apart)
    expected = factor * (water + solids)
    expected[~pairs.water] = 0.0
    out = np.zeros_like(u)
    viscosity.acceleration(
        near.row, near.solid, near.other, near.offset, near.inverse, near.particles.role, stencil,
        padded(u), nu, slip, out,
    )  # fmt: skip
    assert_close(out, expected)


@pytest.mark.parametrize("name", plugins.names("laplacians"))
@pytest.mark.parametrize("dim", DIMS)
def test_matrix_and_flux_of_walls_are_the_sums_of_their_formulas(dim, name):
    near, pairs = setting(dim)
    stencil, particles = make_stencil(dim, 1.0, 2.6), near.particles
    one, first, third = plugins.load("laplacians", name).pair_terms(stencil)
    laplacian = one + first / pairs.distance + third / pairs.distance**3
    laplacian[pairs.distance >= stencil.radius] = 0.0
    n = len(particles)
    system, rows = equation.assemble(near, stencil, (one, first, third), 2.0, np.zeros(n),
                                     particles.fluid, np.ones(n))  # fmt: skip
    expected = -0.5 * laplacian[np.ix_(pairs.water, pairs.water)]
    found = np.zeros_like(expected)
    found[np.repeat(np.arange(len(rows)), np.diff(system.row)), system.column] = system.value
    assert_close(found, expected)
    assert_close(system.diagonal, 1.0 - expected.sum(axis=1))
    pull = np.random.default_rng(3).normal(size=(n, 3))
    flux = np.einsum("ij,ja,ija->i", laplacian * ~pairs.water, pull, pairs.r)
    assert_close(wall_pressure.flux(near, stencil, (one, first, third), pull), flux)


@pytest.mark.parametrize("dim", DIMS)
def test_pressure_of_walls_is_the_mean_of_its_formula(dim):
    near, pairs = setting(dim, solids=False)
    p = near.particles.pressure.copy()
    pull = np.random.default_rng(3).normal(size=(len(p), 3))
    w = pairs.w[pairs.water][:, ~pairs.water]
    rise = 5.0 * np.einsum("ja,ija->ij", pull, pairs.r)[pairs.water][:, ~pairs.water]
    expected = (w * (p[pairs.water][:, None] + rise)).sum(axis=0) / w.sum(axis=0)
    wall_pressure.fill(near, 5.0, pull, clip=False)
    assert_close(near.particles.pressure[~pairs.water], expected)
    np.testing.assert_array_equal(near.particles.pressure[pairs.water], p[pairs.water])


@pytest.mark.parametrize("dim", DIMS)
def test_no_pair_that_comes_close_is_missed(dim):
    """After moves of up to 0.3 spacings, and again after more than the slack of the first look."""
    near, _ = setting(dim)
    particles, random, width = near.particles, np.random.default_rng(9), near.stencil.width
    for most in (0.05, 0.3):
        particles.position += random.uniform(-most, most, (len(particles), 3)) * [1, dim - 2, 1]
        row, other = near.close(0.8)
        found = set(zip(np.repeat(np.arange(len(particles)), np.diff(row)), other, strict=True))
        apart = plain(particles, dim, width).distance
        closer = set(zip(*np.nonzero(apart < 0.8), strict=True))
        assert len(closer) > 10
        assert closer <= found
    assert len(found) < len(near.other)


@pytest.mark.parametrize("dim", DIMS)
def test_forces_on_water_and_solids_cancel_to_the_rounding_of_doubles(dim):
    """A solid's share is -(p_i + p_j) C_i r_ij w/r^2 of each water neighbour i."""
    near, _ = setting(dim, reach=2.1)
    near.loaded[:] = 1
    particles, out = near.particles, np.empty((len(near.particles), 3))
    particles.pressure += 1e5  # a weight of thousands of layers
    plugins.load("gradients", "corrected").gradient(near, out)
    on_solids = np.zeros(3)
    for i in np.flatnonzero(particles.fluid):
        k = np.arange(near.solid[i], near.row[i + 1])
        pull = near.offset[k, :3].astype(float) * near.offset[k, 3:].astype(float)
        both = particles.pressure[i] + particles.pressure[near.other[k]]
        on_solids -= near.correction[i, :, :3] @ (both @ pull) * dim / near.stencil.n0
    assert np.abs(on_solids).max() > 0.0
    assert np.abs(out.sum(axis=0) + on_solids).max() < 1e-14 * np.abs(out).sum()


@pytest.mark.parametrize("dim", DIMS)
def test_pairs_taken_from_another_radius_are_as_those_measured(dim):
    near, _ = setting(dim)
    other = make_stencil(dim, 1.0, 2.6, near.stencil.width)
    taken = Neighbourhood(other).measure_as(near)
    measured = near_of(near.particles, dim, width=near.stencil.width, reach=2.6, radius=2.6)
    pairs = len(measured.other)
    assert np.array_equal(taken.other, measured.other)
    assert np.array_equal(taken.offset[:pairs], measured.offset[:pairs])
    assert np.array_equal(taken.first, measured.first)
    assert np.array_equal(taken.correction, measured.correction)
    # The neighbourhood that they were taken from keeps its own.
    assert not np.array_equal(near.offset[:pairs, 3], taken.offset[:pairs, 3])


@pytest.mark.parametrize("dim", DIMS)
def test_close_pairs_are_found_wherever_the_particles_have_gone(dim):
    """All of them, and no pair that is more than the slack too far; each row in its order."""
    near, _ = setting(dim)
    x, nearest, random = near.particles.position, 0.8, np.random.default_rng(3)
    pairs = np.zeros((len(x), len(x)), bool)
    here = np.repeat(np.arange(len(x)), np.diff(near.row))
    pairs[here, near.other] = True
    kept = 0
    for path in (0.0, 0.3, 0.01, 0.0, 0.2, 0.1):
        x += path * random.uniform(-1.0, 1.0, x.shape) * [1.0, dim - 2.0, 1.0]
        before = near._close
        row, other = near.close(nearest)
        kept += near._close is before
        found = np.zeros_like(pairs)
        found[np.repeat(np.arange(len(x)), np.diff(row)), other] = True
        distance = plain(near.particles, dim, WIDTH if dim == 3 else 0.0).distance
        assert np.all(found[pairs & (distance < nearest)])
        assert np.all((distance < nearest + 2.0 * SLACK)[found])
        assert np.array_equal(other, near.other[found[here, near.other]])
    assert kept == 2  # where next to nothing has moved they are not looked for again
