"""The surface of the water is closed, and lies where the water ends."""

import numpy as np
import pytest

from mpslab.analysis.scenes.freesurface import find_surface

D0 = 0.002


def lattice(*counts):
    """Particles at half-way places of cells, (n, 3) [m]."""
    axes = [(np.arange(n) + 0.5) * D0 for n in counts]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def ball(radius, centre=0.05):
    grid = lattice(50, 50, 50)
    return grid[np.linalg.norm(grid - centre, axis=1) < radius]


def open_edges(surface):
    """How many sides of triangles have no partner that runs the other way."""
    sides = surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    forward = {}
    for start, end in sides.tolist():
        forward[start, end] = forward.get((start, end), 0) + 1
    return sum(count != forward.get((b, a), 0) for (a, b), count in forward.items())


def test_a_ball_has_the_area_and_the_volume_of_a_ball():
    surface = find_surface(ball(0.03), D0)
    assert open_edges(surface) == 0
    assert surface.volume == pytest.approx(4 / 3 * np.pi * 0.03**3, rel=0.02)
    assert surface.area == pytest.approx(4 * np.pi * 0.03**2, rel=0.03)
    outward = (surface.points - 0.05) / np.linalg.norm(surface.points - 0.05, axis=1)[:, None]
    assert np.sum(outward * surface.normals, axis=1).min() > 0.9
    assert not surface.spray.any()


def test_a_block_of_particles_ends_half_a_spacing_off_them():
    surface = find_surface(lattice(20, 10, 8), D0)
    low, high = surface.points.min(axis=0) / D0, surface.points.max(axis=0) / D0
    assert low == pytest.approx([0, 0, 0], abs=0.1)
    assert high == pytest.approx([20, 10, 8], abs=0.1)


@pytest.mark.parametrize("shift", [0.0, 0.3, 0.9])
def test_a_periodic_slab_in_a_window_is_cut_straight(shift):
    water = lattice(60, 12, 8)
    water[:, 1] = (water[:, 1] + shift * D0) % (12 * D0)
    window = (20.3 * D0, 40.7 * D0)
    surface = find_surface(water, D0, period=12 * D0, window=window)
    assert open_edges(surface) == 0
    for axis, (low, high) in enumerate([window, (0.0, 12 * D0)]):
        assert surface.points[:, axis].min() == pytest.approx(low, abs=0.02 * D0)
        assert surface.points[:, axis].max() == pytest.approx(high, abs=0.02 * D0)
    size = np.array([20.4, 12, 8]) * D0
    assert surface.volume == pytest.approx(np.prod(size), rel=0.02)
    area = 2 * (size[0] * size[1] + size[1] * size[2] + size[0] * size[2])
    assert surface.area == pytest.approx(area, rel=0.04)


def test_a_sheet_has_a_surface_and_a_lone_drop_is_spray():
    sheet = lattice(20, 20, 1)
    drop = [[20 * D0, 20 * D0, 20 * D0]]
    surface = find_surface(np.concatenate([sheet, drop]), D0)
    assert surface.spray[-1]
    assert surface.spray[:-1].reshape(20, 20)[1:-1, 1:-1].sum() == 0
    assert surface.points[:, 2].max() < 3 * D0


def test_values_are_carried_over_to_the_surface():
    water = lattice(30, 10, 10)
    surface = find_surface(water, D0, values=water[:, 0])
    inner = (surface.points[:, 0] > 3 * D0) & (surface.points[:, 0] < 27 * D0)
    assert surface.values[inner] == pytest.approx(surface.points[inner, 0], abs=0.1 * D0)


def test_a_hollow_lets_in_less_light_than_the_open():
    water = lattice(30, 10, 20)
    x, z = water[:, 0] / D0, water[:, 2] / D0
    surface = find_surface(water[~((abs(x - 15) < 5) & (abs(z - 10) < 2))], D0, period=10 * D0)
    place = surface.points / D0
    top = (place[:, 2] > 19.5) & (abs(place[:, 0] - 15) < 10)
    inside = (abs(place[:, 0] - 15) < 4) & (abs(place[:, 2] - 10) < 3) & (abs(place[:, 1] - 5) < 3)
    assert surface.openness[top].min() > 0.9
    assert surface.openness[inside].max() < 0.8


def test_no_water_has_no_surface():
    surface = find_surface(np.zeros((0, 3)), D0)
    assert len(surface.points) == len(surface.triangles) == surface.volume == 0
    far = find_surface(lattice(5, 5, 5), D0, window=(1.0, 1.1))
    assert len(far.points) == 0 and far.spray.all()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"position": np.zeros((4, 2))}, "position: shape"),
        ({"spacing": 0.0}, "spacing = 0 m"),
        ({"values": np.zeros(3)}, "values: shape"),
        ({"window": (1.0, 1.0)}, "window = 1 to 1 m"),
    ],
)
def test_bad_input_is_refused(options, says):
    with pytest.raises(ValueError, match=says):
        find_surface(**{"position": np.zeros((4, 3)), "spacing": D0, **options})
