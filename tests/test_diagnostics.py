"""Energy, volume and speed of the water."""

import numpy as np
import pytest
from tanks import flow_of, make_case, particles_at, run

from mpslab.core import diagnostics
from mpslab.core.particles import FACE, FILLER, FLUID
from mpslab.core.stencil import make_stencil

DENSITY, GRAVITY = 1000.0, 9.81


def two_and_a_wall():
    position = [[0.0, 0.0, 1.0], [0.0, 0.0, 3.0], [0.0, 0.0, 9.0]]
    particles = particles_at(position, [FLUID, FLUID, FACE])
    particles.velocity[:] = [[3.0, 0.0, 4.0], [0.0, 1.0, 0.0], [7.0, 0.0, 0.0]]
    return particles


@pytest.mark.parametrize(("dim", "mass"), [(2, 1000.0 * 0.1**2), (3, 1000.0 * 0.1**3)])
def test_energies_are_sums_over_the_water(dim, mass):
    stencil, particles = make_stencil(dim, 0.1, 2.1), two_and_a_wall()
    kinetic = diagnostics.kinetic_energy(particles, stencil, DENSITY)
    potential = diagnostics.potential_energy(particles, stencil, DENSITY, GRAVITY)
    assert kinetic == pytest.approx(0.5 * mass * (25.0 + 1.0), rel=1e-14)
    assert potential == pytest.approx(mass * GRAVITY * 4.0, rel=1e-14)


def test_speed_is_the_length_of_the_fastest_velocity():
    assert diagnostics.max_speed(two_and_a_wall()) == 5.0


@pytest.mark.parametrize("width", [0.0, 0.016])
def test_volume_of_still_water_is_that_of_the_tank(width):
    """On the lattice, which in 3-D is denser than relaxed water."""
    flow = flow_of(make_case({"tank.width": width}))
    run(flow, 1, 1e-9)
    exact = 0.04 * 0.02 * (width or 1.0)
    assert diagnostics.volume(flow.particles, flow.stencil) == pytest.approx(
        exact * flow.stencil.relaxed / flow.stencil.n0, rel=0.01
    )


def test_volume_grows_where_particles_spread():
    stencil = make_stencil(3, 1.0, 2.1)
    particles = particles_at(np.zeros((3, 3)), [FLUID, FLUID, FILLER])
    particles.number_density[:] = [stencil.relaxed, 0.8 * stencil.relaxed, stencil.n0]
    assert diagnostics.volume(particles, stencil) == pytest.approx(1.0 + 1.25, rel=1e-14)


def test_surface_particles_count_in_full():
    stencil = make_stencil(3, 1.0, 2.1)
    particles = particles_at(np.zeros((2, 3)))
    particles.number_density[:] = [stencil.relaxed, 0.1 * stencil.n0]
    particles.surface[1] = 1
    assert diagnostics.volume(particles, stencil) == pytest.approx(2.0, rel=1e-14)
