"""The same input gives the same bytes, wherever in memory the arrays happen to lie."""

import numpy as np
import pytest
from tanks import cloud, flow_of, make_case, neighbors_of, particles_at, run, scheme

from mpslab.core import plugins
from mpslab.core.neighbourhood import LANES, Neighbourhood
from mpslab.core.parameters import Fluid, Scheme
from mpslab.core.particles import FACE, FLUID
from mpslab.core.stencil import make_stencil
from mpslab.kernels import sparse
from mpslab.models import friction

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


def placed(by, seed=5):
    """Neighbourhood of a cloud of water and solids, all of whose arrays lie `by` bytes off."""
    random = np.random.default_rng(seed)
    particles = particles_at(cloud(3, 500, 1))
    particles.role[:] = random.choice([FLUID] * 4 + [FACE], 500)
    particles.surface[:] = particles.position[:, 2] > 2.0
    particles.velocity[:] = random.normal(size=(500, 3))
    particles.pressure[:] = random.uniform(size=500)
    found = neighbors_of(particles.position, 2.1)
    for name in vars(particles):
        setattr(particles, name, shifted(getattr(particles, name), by))
    found.indptr, found.indices = shifted(found.indptr, by), shifted(found.indices, by)
    near = Neighbourhood(make_stencil(3, 1.0, 2.1))
    room = len(found.indices) + LANES
    near.offset = shifted(np.zeros((room, 4), np.float32), by)
    near.inverse = shifted(np.zeros(room, np.float32), by)
    return near.measure(particles, found)


def bytes_of(*arrays):
    return b"".join(np.ascontiguousarray(a).tobytes() for a in arrays)


def test_geometry_and_its_sums_do_not_depend_on_the_address():
    def sums(by):
        near = placed(by)
        m = len(near.other)
        return bytes_of(near.other, near.offset[:m], near.inverse[:m], near.first, near.second)

    assert len({sums(by) for by in (0, *SHIFTS)}) == 1


@pytest.mark.parametrize("name", plugins.names("sources"))
def test_sources_do_not_depend_on_the_address(name):
    def source(by):
        near = placed(by)
        velocity = near.particles.velocity
        model = plugins.load("sources", name)
        return bytes_of(model.source(near, velocity, near.number_density, 0.1, 1.0, scheme()))

    assert len({source(by) for by in (0, *SHIFTS)}) == 1


@pytest.mark.parametrize("name", plugins.names("stabilisers"))
def test_stabilisers_do_not_depend_on_the_address(name):
    def moved(by):
        near = placed(by)
        plugins.load("stabilisers", name).stabilise(near, 0.1, 0.1, scheme())
        assert np.any(near.particles.position != near.position[:, :3])
        return bytes_of(near.particles.position, near.particles.velocity)

    assert len({moved(by) for by in (0, *SHIFTS)}) == 1


def test_friction_does_not_depend_on_the_address():
    def drag(by):
        near, keys = placed(by), Scheme(smagorinsky=0.1)
        seen = friction.velocity_seen(near, keys, id)
        eddy = friction.eddies(near, seen, keys, id)
        fluid = Fluid(viscosity=1.0)
        return bytes_of(friction.acceleration(near, near.stencil, seen, eddy, fluid, keys))

    assert len({drag(by) for by in (0, *SHIFTS)}) == 1


@pytest.mark.parametrize("name", plugins.names("gradients"))
def test_gradients_do_not_depend_on_the_address(name):
    def gradient(by):
        out = np.empty((500, 3))
        plugins.load("gradients", name).gradient(placed(by), out)
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
