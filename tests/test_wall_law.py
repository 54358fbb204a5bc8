"""Friction of walls by the law of the wall."""

from types import SimpleNamespace

import numpy as np
import pytest
from ranks import start
from tanks import lattice, near_of, particles_at

import mpslab
from mpslab.core.particles import FACE, FLUID
from mpslab.models import wall_law

WATER = SimpleNamespace(viscosity=1e-6)


def test_friction_velocity_solves_the_law_of_a_smooth_wall():
    height, speed = 0.002, np.array([0.5, 1.0, 4.0])
    star = wall_law.friction_velocity(speed, height, WATER.viscosity, 0.0)
    law = star / 0.41 * np.log(9.0 * height * star / WATER.viscosity)
    np.testing.assert_allclose(law, speed, rtol=1e-3)


def test_friction_velocity_of_a_rough_wall_does_not_depend_on_the_viscosity():
    star = wall_law.friction_velocity(np.array([2.0]), 0.01, 1e-9, 0.003)
    assert star[0] == pytest.approx(0.41 * 2.0 / np.log(0.01 / 1e-4), rel=1e-3)


def test_slow_water_has_the_friction_of_a_laminar_layer():
    star = wall_law.friction_velocity(np.array([0.0, 0.01]), 0.001, WATER.viscosity, 0.0)
    np.testing.assert_allclose(star**2, [0.0, 1e-6 * 0.01 / 0.001])


@pytest.mark.parametrize("dim", [2, 3])
def test_a_stream_is_braked_by_the_stress_on_its_bed(dim):
    """The acceleration of all the water adds up to u*^2 over the area of the bed."""
    speed = 1.5
    place = lattice(dim, 6) + np.array([0.0, 0.0, 0.5])
    # A row above the bed that reaches past its edges, so that none of its faces lacks water.
    wet = place[:, 2] > 0.0
    bed = (np.abs(place[:, 2] + 0.5) < 0.1) & (np.abs(place[:, 0]) < 3.5)
    bed &= np.abs(place[:, 1]) < 3.5
    keep = wet | bed
    particles = particles_at(place[keep], np.where(wet[keep], FLUID, FACE))
    particles.velocity[particles.fluid, 0] = speed
    near = near_of(particles, dim)
    held = wall_law.grip(near, WATER, 0.0, lambda *_: None)
    found = wall_law.acceleration(near, held).sum(axis=0)
    star = wall_law.friction_velocity(np.array([speed]), 0.5, WATER.viscosity, 0.0)[0]
    expected = [-(star**2) * np.count_nonzero(bed), 0.0, 0.0]
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)


def test_a_drop_a_spacing_away_is_hardly_held():
    particles = particles_at(np.array([[0.0, 0, 0], [0, 0, -2.0]]), [FLUID, FACE])
    particles.velocity[0, 0] = 1.0
    near = near_of(particles, 2)
    held = wall_law.grip(near, WATER, 0.0, lambda *_: None)
    found = wall_law.acceleration(near, held)[0, 0]
    star = wall_law.friction_velocity(np.array([1.0]), 0.5, WATER.viscosity, 0.0)[0]
    assert -0.1 * star**2 < found < 0.0


def test_force_on_the_bed_is_what_the_water_loses():
    changes = {
        "scheme.wall_law": True, "tank.roughness": 0.002, "initial.type": "rest",
        "force": [{"name": "bed", "on": "bed"}],
    }  # fmt: skip
    simulation = mpslab.Simulation(mpslab.load_case("hydrostatic", changes))
    simulation.particles.velocity[simulation.particles.fluid, 0] = 0.3
    forces = simulation.run(until=1e-3).table("forces")
    assert forces["bed fx"][-1] > 0.0
    balance = forces["water on solids x"] - forces["water weight x"] - forces["water -dP/dt x"]
    assert np.abs(balance).max() < 1e-9 * 9810.0 * 0.04 * 0.08


def test_ranks_give_the_same_bits_as_one():
    """A column that collapses."""
    changes = {"tank.length": 0.06, "water": [{"from": [0.0, 0, 0], "to": [0.03, 0, 0.03]}],
               "scheme.wall_law": True}  # fmt: skip
    assert start("steps", 2, changes, 30, 4e-4) == start("steps", 1, changes, 30, 4e-4)
