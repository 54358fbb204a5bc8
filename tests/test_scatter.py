"""Order of the water: isolated particles and roughness."""

import numpy as np
import pytest
from tanks import lattice

from mpslab.analysis.scatter import isolated_share, roughness

LINE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]])


def test_lattice_has_no_isolated_particle():
    assert isolated_share(lattice(3, 2), 1.0) == 0.0


@pytest.mark.parametrize(("gap", "share"), [(1.49, 0.0), (1.51, 0.25)])
def test_particle_is_isolated_from_one_and_a_half_spacings_on(gap, share):
    position = np.vstack([LINE, [[2.0 + gap, 0.0, 0.0]]])
    assert isolated_share(position, 1.0) == share


def test_particle_alone_in_the_tank_is_isolated():
    assert isolated_share(LINE[:1], 1.0) == 1.0
    assert isolated_share(LINE[:0], 1.0) == 0.0


def test_neighbour_across_the_period_counts():
    position = np.array([[5.0, 0.2, 7.0], [5.0, 9.6, 7.0], [20.0, 5.0, 0.0], [20.5, 5.0, 0.0]])
    assert isolated_share(position, 1.0) == 0.5
    assert isolated_share(position, 1.0, width=10.0) == 0.0


def test_only_the_sides_are_periodic():
    position = np.array([[0.0, 0.0, 0.0], [9.9, 0.0, 0.0], [0.0, 0.0, 9.9]])
    assert isolated_share(position, 1.0, width=10.0) == 1.0


def test_uniform_motion_is_smooth_and_shear_nearly_so():
    position = lattice(3, 4)
    assert roughness(position, np.ones_like(position), 1.0) == pytest.approx(0.0, abs=1e-15)
    core_only = roughness(position, position * [0.0, 0.0, 1.0], 1.0)
    assert core_only < 0.6  # of the rim, whose neighbours are on one side


def test_roughness_of_alternating_speeds_is_the_deviation_from_the_neighbours():
    """Two particles at +1 and -1 m/s: each deviates by 2 from the mean of its neighbours."""
    velocity = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    assert roughness(LINE[:2], velocity, 1.0) == pytest.approx(2.0)


def test_lone_particle_does_not_count_as_rough():
    position = np.vstack([LINE, [[50.0, 0.0, 0.0]]])
    velocity = np.array([[1.0, 0, 0], [1.0, 0, 0], [1.0, 0, 0], [99.0, 0, 0]])
    assert roughness(position, velocity, 1.0) == pytest.approx(0.0, abs=1e-15)
    assert roughness(position[2:], velocity[2:], 1.0) == 0.0
