"""The same input gives the same bytes, wherever in memory the arrays happen to lie."""

import numpy as np
import pytest
from tanks import cloud, flow_of, make_case, matrices_of, neighbors_of, run

from mpslab import plugins
from mpslab.kernels import density, divergence, moments, repulsion, sparse, viscosity
from mpslab.particles import FACE, FLUID
from mpslab.stencil import make_stencil

SHIFTS = range(8, 64, 8)  # bytes; 64 is a line of the cache


def shifted(array, by):
    """Copy of an array whose data begins `by` bytes after a multiple of 64."""
    memory = np.zeros(array.nbytes + 192, np.uint8)
    start = -memory.ctypes.data % 64 + by
    copy = memory[start : start + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[:] = array
    assert copy.ctypes.data % 64 == by
    return copy


def vectors(n):
    random = np.random.default_rng(n)
    return random.normal(size=n), random.normal(size=n) * 10.0 ** random.uniform(-8, 8, n)


@pytest.mark.parametrize("n", [1, 7, 64, 1001, 50_000])
def test_dot_does_not_depend_on_the_address(n):
    x, y = vectors(n)
    expected = sparse.dot(shifted(x, 0), shifted(y, 0))
    assert expected == pytest.approx(float(np.dot(x, y)), rel=1e-8)
    for by in SHIFTS:
        assert sparse.dot(shifted(x, by), shifted(y, 0)) == expected
        assert sparse.dot(shifted(x, 0), shifted(y, by)) == expected
        assert sparse.dot(shifted(x, by), shifted(y, by)) == expected


@pytest.mark.parametrize("kernel", [sparse.axpy, sparse.xpay])
def test_vector_updates_do_not_depend_on_the_address(kernel):
    x, y = vectors(1001)

    def updated(by):
        a, b = shifted(x, by), shifted(y, 56 - by)
        kernel(a, 0.37, b) if kernel is sparse.xpay else kernel(0.37, a, b)
        return b.tobytes()

    assert len({updated(by) for by in (0, *SHIFTS) if by <= 56}) == 1


def matrix():
    """Random sparse rows with a diagonal."""
    found = neighbors_of(cloud(3, 500, 1), 2.1)
    random = np.random.default_rng(2)
    value, diagonal = random.normal(size=len(found.indices)), random.normal(size=500)
    return found.indptr, found.indices, value.astype(np.float32), diagonal


def test_product_does_not_depend_on_the_address():
    row, column, value, diagonal = matrix()
    x = np.random.default_rng(3).normal(size=len(diagonal))

    def product(by):
        out = np.empty(len(x))
        sparse.multiply(
            shifted(row, by), shifted(column, by), shifted(value, by), shifted(diagonal, by),
            shifted(x, by), out,
        )  # fmt: skip
        return out.tobytes()

    assert len({product(by) for by in (0, *SHIFTS)}) == 1


def test_particle_sums_do_not_depend_on_the_address():
    position = cloud(3, 500, 1)
    velocity = np.random.default_rng(4).normal(size=position.shape)
    found, stencil = neighbors_of(position, 2.1), make_stencil(3, 1.0, 2.1)

    def sums(by):
        n, rate = np.empty(500), np.empty(500)
        rows = shifted(found.indptr, by), shifted(found.indices, by)
        density.number_density(shifted(position, by), *rows, stencil, n)
        divergence.density_rate(shifted(position, by), shifted(velocity, by), *rows, stencil, rate)
        return n.tobytes() + rate.tobytes()

    assert len({sums(by) for by in (0, *SHIFTS)}) == 1


def test_sums_with_matrices_do_not_depend_on_the_address():
    position = cloud(3, 500, 1)
    velocity = np.random.default_rng(4).normal(size=position.shape)
    role = np.random.default_rng(5).choice([FLUID] * 4 + [FACE], 500).astype(np.int8)
    surface = (position[:, 2] > 2.0).astype(np.uint8)
    found, stencil = neighbors_of(position, 2.1), make_stencil(3, 1.0, 2.1)

    def sums(by):
        c, rate, drag, move = (np.empty((500, n)) for n in (6, 1, 3, 3))
        x, u, k = shifted(position, by), shifted(velocity, by), shifted(role, by)
        rows = shifted(found.indptr, by), shifted(found.indices, by)
        moments.correction_matrix(x, k, *rows, stencil, True, 0.6, c)
        c = shifted(c, by)
        divergence.adjoint_divergence(x, u, k, *rows, stencil, c, rate[:, 0])
        viscosity.viscous_acceleration(x, u, k, *rows, stencil, 1.0, True, drag)
        repulsion.shifting(x, k, shifted(surface, by), *rows, stencil, c, 1.0, 0.1, move)
        assert np.any(move)
        return b"".join(a.tobytes() for a in (c, rate, drag[role == FLUID], move))

    assert len({sums(by) for by in (0, *SHIFTS)}) == 1


@pytest.mark.parametrize("name", plugins.names("gradients"))
def test_gradients_do_not_depend_on_the_address(name):
    position = cloud(3, 500, 1)
    pressure = np.random.default_rng(5).uniform(size=500)
    role = np.zeros(500, np.int8)
    found, stencil = neighbors_of(position, 2.1), make_stencil(3, 1.0, 2.1)
    c = matrices_of(position, role, found, stencil)

    def gradient(by):
        out = np.empty((500, 3))
        plugins.load("gradients", name).gradient(
            shifted(position, by), shifted(pressure, by), shifted(role, by),
            shifted(found.indptr, by), shifted(found.indices, by), stencil, c, out,
        )  # fmt: skip
        return out.tobytes()

    assert len({gradient(by) for by in (0, *SHIFTS)}) == 1


def test_neighbour_list_is_the_same_from_fresh_and_from_used_memory():
    position = cloud(3, 500, 6)
    used = neighbors_of(cloud(3, 900, 7), 3.1).build(position, 2.1)
    fresh = neighbors_of(position, 2.1)
    np.testing.assert_array_equal(used.indptr, fresh.indptr)
    np.testing.assert_array_equal(used.indices, fresh.indices)


PAPER = {"scheme.recipe": "paper"}
PERIODIC = {"tank.width": 0.016, "tank.periodic": True, "particles.jitter": 0.01}
PISTON = {"wavemaker.type": "linear", "wavemaker.height": 0.004, "wavemaker.period": 0.5}
SEA = {**PISTON, "wavemaker.type": "irregular", "wavemaker.order": 2}
RUNS = [PISTON, SEA, PAPER, PERIODIC, *({**PISTON, "scheme.solver": s} for s in ("scg", "piccg"))]


NAMES = ["piston", "sea", "paper", "periodic 3-D", "scg", "piccg"]


@pytest.mark.parametrize("changes", RUNS, ids=NAMES)
def test_two_runs_of_20_steps_give_the_same_bytes(changes):
    def state():
        particles = run(flow_of(make_case(changes)), 20, 2e-4).particles
        return {name: getattr(particles, name).tobytes() for name in vars(particles)}

    first = state()
    rest = [np.empty(n) for n in (100, 1003, 10_007)]  # another layout of the memory
    assert state() == first
    assert len(rest) == 3
