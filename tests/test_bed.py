"""The bed line, and the layers of particles along it."""

from itertools import pairwise

import numpy as np
import pytest

from mpslab.core import bed as beds

SLOPE = [[0.0, 0.0], [0.2, 0.0], [0.8, 0.06]]
BAR = [[0.0, 0.01], [0.2, 0.01], [0.3, 0.05], [0.4, 0.0], [0.8, 0.0]]


def test_elevation_follows_the_points_and_the_lines_between():
    found = beds.elevation(SLOPE, [0.0, 0.1, 0.2, 0.5, 0.8])
    np.testing.assert_allclose(found, [0.0, 0.0, 0.0, 0.03, 0.06], atol=1e-16)


def test_elevation_goes_on_level_before_and_sloping_after_the_ends():
    found = beds.elevation(BAR, [-0.1, 0.9])
    np.testing.assert_allclose(found, [0.01, 0.0], atol=1e-16)
    np.testing.assert_allclose(beds.elevation(SLOPE, [-0.1, 0.9]), [0.0, 0.07], atol=1e-15)


def test_slope_is_the_derivative_of_the_elevation():
    x = np.array([-0.05, 0.1, 0.25, 0.35, 0.6, 0.85])
    for bed in (SLOPE, BAR):
        numeric = (beds.elevation(bed, x + 1e-6) - beds.elevation(bed, x - 1e-6)) / 2e-6
        np.testing.assert_allclose(beds.slope(bed, x), numeric, atol=1e-8)


def test_extended_bed_has_the_elevation_of_the_bed():
    points = beds.extended(SLOPE, 0.05, 0.1)
    np.testing.assert_allclose(points[[0, -1]], [[-0.05, 0.0], [0.9, 0.07]], atol=1e-15)
    np.testing.assert_allclose(points[:, 1], beds.elevation(SLOPE, points[:, 0]), atol=1e-15)


def distance_to_line(points, line):
    """Distance of points from a polyline, (n,)."""
    best = np.full(len(points), np.inf)
    for a, b in pairwise(line):
        t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(points - a - t[:, None] * (b - a), axis=1))
    return best


@pytest.mark.parametrize("bed", [SLOPE, BAR])
@pytest.mark.parametrize("depth", [0.001, 0.003, 0.005])
def test_layer_lies_at_its_depth_below_the_bed(bed, depth):
    line = np.array(bed)
    layer = beds.layer(line, depth, 0.002)
    away = distance_to_line(layer, line)
    np.testing.assert_allclose(np.median(away), depth, rtol=1e-9)
    assert away.min() > depth * (1.0 - 1e-9)
    assert np.all(layer[:, 1] < beds.elevation(bed, layer[:, 0]))


@pytest.mark.parametrize("bed", [SLOPE, BAR])
def test_layer_is_spaced_evenly_along_the_bed(bed):
    layer = beds.layer(np.array(bed), 0.001, 0.002)
    step = np.hypot(*np.diff(layer, axis=0).T)
    assert np.median(step) == pytest.approx(0.002, rel=0.02)
    assert step.min() > 0.9 * 0.002
    assert step.max() < 1.1 * 0.002


def test_short_piece_gets_one_particle():
    layer = beds.layer(np.array([[0.0, 0.0], [0.0005, 0.0]]), 0.001, 0.002)
    np.testing.assert_allclose(layer, [[0.00025, -0.001]])
