"""The pressure of a step: which rows, what holds clusters cut off, and the column of water."""

import numpy as np
import pytest
from tanks import inside, lattice, near_of, particles_at

from mpslab.core import plugins
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil
from mpslab.models.laplacians.standard import pair_terms
from mpslab.pressure import equation
from mpslab.pressure.solvers import iccg

DENSITY, GRAVITY = 1000.0, 9.81


def assembled(particles, dim=3, source=0.0, laplacian=pair_terms, width=0.0):
    stencil = make_stencil(dim, 1.0, 2.1, width)
    near = near_of(particles, dim, width=width)
    right = np.broadcast_to(np.asarray(source, float), len(particles)).copy()
    return equation.assemble(near, stencil, laplacian(stencil), DENSITY, right)


def dense(system):
    a = np.diag(system.diagonal)
    for i in range(len(system)):
        a[i, system.column[system.row[i] : system.row[i + 1]]] = system.value[
            system.row[i] : system.row[i + 1]
        ]
    return a


def two_clusters():
    """Water with a surface, and 20 spacings away a cluster of eight without any."""
    near = lattice(3, 2)
    far = np.stack(np.meshgrid([20.0, 21.0], [0.0, 1.0], [0.0, 1.0]), axis=-1).reshape(-1, 3)
    particles = particles_at(np.vstack([near, far]))
    particles.surface[:125] = near[:, 2] == 2.0
    return particles


def test_cluster_cut_off_from_the_surface_keeps_the_matrix_positive_definite():
    particles = two_clusters()
    system, rows = assembled(particles)
    assert np.count_nonzero(rows >= 125) == 8
    values = np.linalg.eigvalsh(dense(system))
    assert values[0] > 1e-3 * values[-1]


def test_water_tied_to_the_surface_is_not_touched_by_the_cluster():
    particles = two_clusters()
    alone = assembled(particles.take(slice(0, 125)))[0]
    both = assembled(particles)[0]
    np.testing.assert_array_equal(both.diagonal[: len(alone)], alone.diagonal)


def test_cluster_that_touches_one_surface_particle_is_tied():
    """Through a chain: only the far end sees p = 0, and no diagonal is raised."""
    particles = particles_at(np.outer(np.arange(6.0), [1.5, 0.0, 0.0]))
    particles.surface[5] = 1
    system, _ = assembled(particles)
    a = dense(system)
    row_sums = a.sum(axis=1)
    np.testing.assert_allclose(row_sums[:4], 0.0, atol=1e-12 * a.max())
    assert row_sums[4] > 0.1 * a[4, 4]
    assert np.linalg.eigvalsh(a)[0] > 0.0


def test_particle_without_any_neighbour_of_its_kind_gets_a_finite_pressure():
    """Inside the layers behind a wall, its row would be empty."""
    particles = particles_at(lattice(3, 2), FILLER)
    particles.role[inside(particles.position, 0)] = FLUID
    system, rows = assembled(particles, source=1e4)
    report = equation.solve(system, rows, particles, iccg, 1e-8, 100, True)
    assert report.converged
    assert np.isfinite(particles.pressure).all()


def test_empty_row_does_not_spoil_the_others():
    particles = two_clusters()
    lost = particles_at([[60.0, 0.0, 0.0]])
    both = particles_at(np.vstack([particles.position, lost.position]))
    both.surface[:-1] = particles.surface
    system, rows = assembled(both, source=5.0)
    assert equation.solve(system, rows, both, iccg, 1e-10, 200, True).converged
    system, rows = assembled(particles, source=5.0)
    equation.solve(system, rows, particles, iccg, 1e-10, 200, True)
    np.testing.assert_allclose(both.pressure[:-1], particles.pressure, rtol=1e-7)


def column(dim, height=12):
    """Lattice column on a wall layer, to be taken as periodic in y; beside it there is nothing."""
    x, z = np.arange(6.0), np.arange(-2.0, height)
    y = np.arange(6.0) + 0.5 if dim == 3 else np.zeros(1)
    position = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    particles = particles_at(position)
    particles.role[position[:, 2] < 0.0] = FILLER
    particles.role[position[:, 2] == 0.0] = FACE
    particles.surface[:] = position[:, 2] == height - 1
    return particles


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("solver", plugins.names("solvers"))
def test_hydrostatic_column_is_solved_right(solver, dim):
    """The source is the one that rho g (h - z) asks for; the solve has to give that back."""
    particles = column(dim)
    width = 6.0 if dim == 3 else 0.0
    system, rows = assembled(particles, dim, width=width)
    carries = particles.carries_pressure
    exact = np.where(carries, DENSITY * GRAVITY * (11.0 - particles.position[:, 2]), 0.0)
    system.right[:] = dense(system) @ exact[rows]
    report = equation.solve(
        system, rows, particles, plugins.load("solvers", solver), 1e-12, 500, True
    )
    assert report.converged
    np.testing.assert_allclose(particles.pressure, exact, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("dim", [2, 3])
def test_hydrostatic_pressure_needs_a_source_only_at_the_bottom(dim):
    """Inside the column the Laplacian of a linear pressure is 0; the bed carries the weight."""
    particles = column(dim)
    system, rows = assembled(particles, dim, width=6.0 if dim == 3 else 0.0)
    z = particles.position[rows, 2]
    source = dense(system) @ (DENSITY * GRAVITY * (11.0 - z))
    inner = (z >= 3.0) & (z <= 9.0)
    assert np.abs(source[inner]).max() < 1e-9 * np.abs(source).max()
    assert np.all(source[z == 0.0] > 0.0)


@pytest.mark.parametrize("clip", [True, False])
def test_negative_pressure_is_clipped_if_asked(clip):
    particles = column(3)
    system, rows = assembled(particles, source=np.where(particles.position[:, 0] < 3, -1.0, 1.0))
    equation.solve(system, rows, particles, iccg, 1e-8, 200, clip)
    assert (particles.pressure.min() < 0.0) == (not clip)
    assert particles.pressure.max() > 0.0


def test_solve_starts_from_the_last_pressure():
    particles = column(3)
    system, rows = assembled(particles, source=1.0)
    first = equation.solve(system, rows, particles, iccg, 1e-8, 200, True)
    again = equation.solve(system, rows, particles, iccg, 1e-7, 200, True)
    assert first.iterations > 3
    assert again.iterations == 0


def test_particles_without_a_row_have_no_pressure():
    particles = column(3)
    particles.pressure[:] = 77.0
    system, rows = assembled(particles, source=1.0)
    equation.solve(system, rows, particles, iccg, 1e-8, 200, True)
    without = np.setdiff1d(np.arange(len(particles)), rows)
    assert set(particles.role[without]) == {FLUID, FILLER}
    assert np.all(particles.pressure[without] == 0.0)
