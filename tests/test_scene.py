"""A picture of a scene shows its points where the projection says that they are."""

import sys

import numpy as np
import pytest

from mpslab.analysis.scenes import light, scene
from mpslab.analysis.scenes.view import View, fitted

D0 = 0.002
BOX = ((0.0, 0.1), (0.0, 0.032), (0.0, 0.05))
VIEWS = {
    "side": View(BOX, parallel=True, size=(320, 200)),
    "tilted": View(BOX, azimuth=35, elevation=25, parallel=True, size=(300, 220)),
    "perspective": View(BOX, azimuth=-30, elevation=20, size=(320, 240)),
}
BACKENDS = [
    "plain",
    pytest.param(
        "pyvista", marks=pytest.mark.skipif(scene.available() != "pyvista", reason="not installed")
    ),
]


@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_the_box_fills_the_picture(view):
    corners = np.array(np.meshgrid(*BOX)).reshape(3, -1).T
    place = view.project(corners)
    assert (place >= 0).all() and (place <= view.size).all()
    assert (np.ptp(place, axis=0) / view.size).max() > 0.95


def test_across_the_tank_x_goes_right_and_z_up_in_true_scale():
    view = VIEWS["side"]
    origin, right, up, far = view.project([[0, 0, 0], [0.1, 0, 0], [0, 0, 0.05], [0, 0.032, 0]])
    assert right - origin == pytest.approx([0.1 * view.pixels_per_metre([[0, 0, 0]])[0], 0])
    assert up - origin == pytest.approx([0, -0.5 * (right - origin)[0]])
    assert far == pytest.approx(origin)


@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_lines_of_sight_lead_back_to_what_is_projected(view):
    points = np.random.default_rng(0).uniform(*np.transpose(BOX), (20, 3))
    start, way = view.rays(*view.project(points).T)
    depth = view.depth(points) - view.depth(start)
    assert start + depth[:, None] * way == pytest.approx(points)


def centre(image, dark=110):
    """Middle of the dark pixels [pixels]."""
    rows, columns = np.nonzero(image.max(axis=2) < dark)
    return np.array([columns.mean(), rows.mean()]) + 0.5


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_a_particle_lies_where_the_projection_says(view, backend):
    for point in ([0.02, 0.004, 0.04], [0.08, 0.028, 0.01]):
        picture = scene.draw([point], 0.006, view, colour=(0, 0, 0.2), backend=backend)
        assert picture.image.shape == (view.size[1], view.size[0], 3)
        assert picture.image.dtype == np.uint8
        assert centre(picture.image) == pytest.approx(picture.project(point), abs=1.0)
        size = np.sqrt(4 / np.pi * np.count_nonzero(picture.image.max(axis=2) < 110))
        assert size == pytest.approx(0.006 * view.pixels_per_metre([point])[0], abs=1.5)


def block(*counts):
    axes = [(np.arange(n) + 0.5) * D0 for n in counts]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def blue(image):
    return image[..., 2].astype(int) - image[..., 0] > 15


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("as_surface", [False, True], ids=["particles", "surface"])
def test_water_fills_the_outline_of_its_block(backend, as_surface):
    view, water = VIEWS["side"], block(50, 16, 15)
    image = scene.draw(water, D0, view, as_surface=as_surface, period=0.032, backend=backend).image
    (left, low), (right, high) = view.project([[0, 0, 0], [0.1, 0, 0.03]])
    wet = blue(image)
    inside = wet[int(high) + 2 : int(low) - 2, int(left) + 2 : int(right) - 2]
    # Between spheres on a square lattice there are gaps, and glints are white.
    share = 1.0 if as_surface else np.pi / 4
    assert share - 0.03 < inside.mean() < share + 0.13
    assert wet.sum() <= 1.04 * (right - left) * (low - high)


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_nearer_hides_the_farther(backend):
    view = VIEWS["side"]
    near, far = [0.05, 0.004, 0.02], [0.05, 0.028, 0.02]
    for water, values in (([near, far], [0, 1]), ([far, near], [1, 0])):
        image = scene.draw(water, 0.01, view, values, "Greys", (0, 1), backend=backend).image
        x, y = view.project(near).astype(int)
        assert image[y, x].min() > 200  # that of value 0, which is white
    near = [0.05, 0.012, 0.02]
    wall = [((0.04, 0.0, 0.0), (0.06, 0.002, 0.05), (1, 0, 0))]
    image = scene.draw([near], 0.01, view, blocks=wall, backend=backend).image
    assert image[y, x, 0] > 100 and image[y, x, 2] < 30


@pytest.mark.parametrize("backend", BACKENDS)
def test_bed_and_paddle_stand_where_they_are(backend):
    view = VIEWS["side"]
    bed = [(0.0, 0.0), (0.05, 0.01), (0.1, 0.03)]
    image = scene.draw(np.zeros((0, 3)), D0, view, bed=bed, paddle_x=0.02, backend=backend).image
    drawn = (image < 250).any(axis=2)
    for x, z in ((0.04, 0.008), (0.09, 0.026)):
        column, row = view.project([x, 0.0, z])
        assert abs(np.argmax(drawn[:, int(column)]) - row) < 2.5
    column, row = view.project([0.02 - D0, 0.0, 0.04]).astype(int)
    assert image[row, column].max() < 120
    column, _ = view.project([0.02 + D0, 0.0, 0.04]).astype(int)
    assert not drawn[row, column]


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_solid_of_any_shape_is_drawn_where_its_particles_are(backend):
    view, middle = VIEWS["side"], np.array([0.05, 0.016, 0.02])
    ball = block(16, 16, 16) + middle - 8 * D0
    ball = ball[np.linalg.norm(ball - middle, axis=1) < 0.01]
    image = scene.draw(np.zeros((0, 3)), D0, view, solids=[ball], backend=backend).image
    drawn = (image < 250).any(axis=2)
    rows, columns = np.nonzero(drawn)
    assert np.all(image[drawn][:, 0] >= image[drawn][:, 2])  # brown
    seen = np.array([columns.mean(), rows.mean()])
    assert np.abs(seen - view.project(middle)).max() < 1.5
    (left, _), (right, _) = view.project(middle + np.array([[-0.01, 0, 0], [0.01, 0, 0]]))
    assert np.ptp(columns) == pytest.approx(right - left, rel=0.1)


def test_both_backends_draw_the_same_picture():
    if scene.available() != "pyvista":
        pytest.skip("no pyvista")
    rng = np.random.default_rng(0)
    water = block(50, 16, 12)
    water = np.concatenate([water + rng.uniform(-1, 1, water.shape) * 2e-4, [[0.03, 0.01, 0.04]]])
    for as_surface in (False, True):
        first, second = (
            scene.draw(water, D0, VIEWS["perspective"], water[:, 0], as_surface=as_surface,
                       period=0.032, bed=[(0, 0), (0.1, 0.02)], backend=name).image.astype(int)
            for name in scene.BACKENDS
        )  # fmt: skip
        assert np.abs(first - second).mean() < 4.0


def test_without_pyvista_the_plain_backend_draws(monkeypatch):
    monkeypatch.setattr(scene, "find_spec", lambda name: None)
    monkeypatch.setitem(sys.modules, "pyvista", None)
    assert scene.available() == "plain"
    assert blue(scene.draw(block(20, 16, 10), D0, VIEWS["side"]).image).any()
    with pytest.raises(ValueError, match=r"backend = 'pyvista': is not installed.*viz"):
        scene.draw(block(2, 2, 2), D0, VIEWS["side"], backend="pyvista")


def test_light_comes_from_above_and_hollows_are_dark():
    grey = np.full((3, 3), 0.5)
    normals = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]])
    up, down, hollow = light.lit(grey, normals, openness=np.array([1.0, 1.0, 0.3])).mean(axis=1)
    assert up > 1.2 * down and hollow == pytest.approx(0.3 * up)


def test_a_fitted_view_is_as_high_as_it_must_be():
    view = fitted(BOX, 400, azimuth=-30, elevation=20)
    place = view.project(np.array(np.meshgrid(*BOX)).reshape(3, -1).T)
    assert view.size[1] % 2 == 0
    assert (np.ptp(place, axis=0) / view.size).min() > 0.9
    assert fitted(BOX, 400, 0.2, azimuth=-30).size == (400, 80)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"box": ((0, 1), (0, 0), (0, 1))}, "box"),
        ({"elevation": 90.0}, "elevation = 90"),
        ({"angle": 0.0}, "angle = 0"),
        ({"size": (8, 8)}, "size"),
    ],
)
def test_a_view_of_nothing_is_refused(options, says):
    with pytest.raises(ValueError, match=says):
        View(**{"box": BOX, **options})


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"water": np.zeros((4, 2))}, "water: shape"),
        ({"values": np.zeros(3)}, "values: shape"),
        ({"backend": "povray"}, "backend = 'povray': must be out of pyvista, plain"),
    ],
)
def test_bad_input_is_refused(options, says):
    with pytest.raises(ValueError, match=says):
        scene.draw(**{"water": np.zeros((4, 3)), "spacing": D0, "view": VIEWS["side"], **options})
