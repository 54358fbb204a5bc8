"""Solids from STL, OBJ and PLY files: what is read, mended and refused, and how it is laid out."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tanks import make_case

from mpslab import Simulation, load_case
from mpslab.cases import dumps
from mpslab.core.keys import CaseError
from mpslab.core.particles import FACE, FIRST_SOLID
from mpslab.run.preflight import preflight
from mpslab.solids import layout, shaped, surfaces
from mpslab.solids.meshes import Mesh
from mpslab.solids.shapes import Box, Sphere, turned

pytest.importorskip("igl", reason="needs the extra stl")
trimesh = pytest.importorskip("trimesh", reason="needs the extra stl")

D0 = 0.01
TANK = {"tank.length": 0.2, "tank.width": 0.14, "tank.depth": 0.14, "particles.spacing": D0}
TURN = (20.0, 30.0, 10.0)


def block(size=(1.0, 1.0, 1.0)):
    return trimesh.creation.box(size)


def ell(size=10.0):
    """A block of an L, whose inner edge points inwards."""
    corner = size * np.array([[0, 0], [1, 0], [1, 0.4], [0.4, 0.4], [0.4, 1], [0, 1]])
    flat = np.column_stack([corner[:, 0], np.zeros(6), corner[:, 1]])
    ends = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
    faces = [*ends, *([a + 6, c + 6, b + 6] for a, b, c in ends)]
    for i in range(6):
        j = (i + 1) % 6
        faces += [[i, i + 6, j], [j, i + 6, j + 6]]
    return trimesh.Trimesh(np.vstack([flat, np.add(flat, [0.0, size, 0.0])]), faces, process=False)


def closed(mesh):
    return surfaces.closed(np.array(mesh.vertices, float), np.array(mesh.faces, np.int64))


def shape_of(mesh, turn=(0.0, 0.0, 0.0), spacing=1.0):
    surface = closed(mesh)
    place = surface.vertices @ turned(turn).T
    window = place.min(axis=0) - spacing, place.max(axis=0) + spacing
    return Mesh(place, surface.faces, spacing, 3, window)


def solid(path, **more):
    return {"shape": "mesh", "file": str(path), "center": [0.1, 0.07, 0.07], **more}


@pytest.fixture
def cube(tmp_path):
    """A cube of 50 mm about its origin, in millimetres."""
    path = tmp_path / "cube.stl"
    block([50.0, 50.0, 50.0]).export(path)
    return path


# Surfaces


def test_clean_surface_is_taken_as_it_is():
    surface = closed(block())
    assert surface.notes == () and surface.doubtful == 0.0
    assert surfaces.volume(surface.vertices, surface.faces) == pytest.approx(1.0)


def inside_out(mesh):
    return mesh.faces[:, ::-1]


def some_turned(mesh):
    faces = mesh.faces.copy()
    faces[[0, 5]] = faces[[0, 5], ::-1]
    return faces


def twice(mesh):
    return np.vstack([mesh.faces, mesh.faces[:2], [[0, 0, 1]]])


@pytest.mark.parametrize(("flaw", "note"), [
    (inside_out, "was inside out"),
    (some_turned, "2 triangles turned as their neighbours face"),
    (twice, "3 triangles without area, or given twice, left out"),
    (lambda mesh: mesh.faces[1:], "a hole closed"),
], ids=["inside out", "turned", "twice", "hole"])  # fmt: skip
def test_flaw_is_mended_and_told(flaw, note):
    ball = trimesh.creation.icosphere(2, 1.0)
    surface = surfaces.closed(np.array(ball.vertices), np.array(flaw(ball), np.int64))
    assert surface.notes == (note,)
    assert surfaces.volume(surface.vertices, surface.faces) == pytest.approx(ball.volume, rel=0.01)
    assert surface.doubtful < 0.01


def test_surfaces_that_cut_each_other_hold_what_either_holds():
    other = block()
    other.apply_translation([0.5, 0.3, 0.2])
    shape = shape_of(trimesh.util.concatenate([block(), other]), spacing=0.1)
    points = np.random.default_rng(1).uniform(-0.7, 1.2, (3000, 3))
    first, second = (np.all(np.abs(points - c) < 0.5, axis=1) for c in ([0, 0, 0], [0.5, 0.3, 0.2]))
    assert np.array_equal(shape.distance(points) < 0.0, first | second)


# Shapes


def test_distance_of_a_mesh_is_that_of_the_shape():
    points = np.random.default_rng(2).uniform(-8.0, 8.0, (4000, 3))
    for mesh, exact, off in (
        (block([10.0, 8.5, 7.0]), Box([0, 0, 0], [10.0, 8.5, 7.0], turned(TURN)), 1e-9),
        (trimesh.creation.icosphere(4, 5.0), Sphere([0, 0, 0], 5.0), 0.02),
    ):
        shape = shape_of(mesh, TURN)
        found, true = shape.distance(points), exact.distance(points)
        near = np.abs(true) < shape.reach - 0.1
        np.testing.assert_allclose(found[near], true[near], atol=off)
        far = np.abs(found[~near]) >= shape.reach - 0.2
        assert far.all() and np.array_equal(found[~near] < 0.0, true[~near] < 0.0)


@pytest.mark.parametrize(("mesh", "thinnest"), [
    (block([10.0, 8.0, 6.0]), 6.0), (trimesh.creation.icosphere(3, 4.0), 8.0), (ell(), 4.0),
    (trimesh.creation.cone(5.0, 12.0), np.inf),
], ids=["box", "ball", "L", "cone"])  # fmt: skip
def test_thinnest_is_between_faces_that_look_away_from_each_other(mesh, thinnest):
    assert shape_of(mesh, TURN).thinnest == pytest.approx(thinnest, abs=0.3)


MESHES = {
    "ball": (trimesh.creation.icosphere(3, 5.0), (0.0, 0.0, 0.0)),
    "box": (block([10.0, 8.5, 7.0]), TURN),
    "L": (ell(), (0.0, 0.0, 0.0)),
    "L, turned": (ell(), TURN),
    "ring": (trimesh.creation.torus(12.0, 4.5), TURN),
    "pile": (trimesh.creation.cylinder(5.0, 10.0, sections=48), TURN),
}


@pytest.mark.parametrize(("mesh", "turn"), MESHES.values(), ids=MESHES)
def test_layers_are_even_and_without_gaps(mesh, turn):
    """In spacings; each particle stands for a cube of the layer that it is in."""
    shape = shape_of(mesh, turn)
    position, normal, layer = shape.layers(1.0, 2)
    np.testing.assert_allclose(-shape.distance(position), layer + 0.5, atol=0.06)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0)
    assert np.all(shape.distance(position + normal)[layer == 0] > 0.0)
    assert cKDTree(position).query(position, k=2)[0][:, 1].min() > 0.6
    trial = np.random.default_rng(3).uniform(shape.low, shape.high, (40_000, 3))
    depth, volume = -shape.distance(trial), np.prod(shape.high - shape.low)
    for k in range(2):
        there = position[layer == k]
        share = np.mean((depth >= k) & (depth < k + 1))
        assert len(there) == pytest.approx(share * volume, rel=0.05)
        middle = trial[np.abs(depth - k - 0.5) < 0.02]
        assert cKDTree(there).query(middle)[0].max() < 0.95


def test_edges_of_a_box_stay_sharp():
    shape = shape_of(block([10.0, 8.0, 7.0]), TURN)
    position, _, layer = shape.layers(1.0, 1)
    found = {tuple(x) for x in np.round(position @ turned(TURN), 6).tolist()}
    corners = ((x, y, z) for x in (-4.5, 4.5) for y in np.arange(-3.5, 4.0) for z in (-3.0, 3.0))
    assert found >= set(corners) and not layer.any()


def test_box_in_whole_spacings_stands_as_an_obstacle_does():
    obstacle = {"from": [0.06, 0.04, 0.03], "to": [0.12, 0.1, 0.08]}
    box = {"shape": "box", "center": [0.09, 0.07, 0.055], "size": [0.06, 0.06, 0.05]}
    one, two = (layout.build_particles(make_case({**TANK, **given}))
                for given in ({"obstacle": [obstacle]}, {"solid": [box]}))  # fmt: skip
    a, b = (p.position[(p.role == FACE) & (p.body == FIRST_SOLID)] for p in (one, two))
    assert {tuple(np.round(x, 9)) for x in a} == {tuple(np.round(x, 9)) for x in b}


def test_box_in_2d_is_a_polygon_turned_about_its_middle():
    given = {"center": [0.02, 0.0, 0.01], "size": [0.012, 1.0, 0.01]}
    flat = {"tank.length": 0.04, "tank.depth": 0.02}
    case = make_case({**flat, "solid": [{"shape": "box", **given, "rotation": [0.0, 30.0, 0.0]}]})
    points = np.random.default_rng(4).uniform([0.0, 0.0, 0.0], [0.04, 0.0, 0.02], (500, 3))
    wide = Box(given["center"], given["size"], turned((0.0, 30.0, 0.0)))
    found = shaped.shapes(case)[0].distance(points)
    np.testing.assert_allclose(found, wide.distance(points), atol=1e-12)


# In the tank


def test_mesh_stands_where_its_keys_put_it(cube):
    case = make_case({**TANK, "solid": [solid(cube, unit="mm", scale=1.2, rotation=TURN)]})
    p = layout.build_particles(case)
    mine = p.position[p.body == FIRST_SOLID]
    box = Box([0.1, 0.07, 0.07], [0.06] * 3, turned(TURN))
    assert box.distance(mine).max() == pytest.approx(-0.5 * D0, abs=1e-6)
    assert box.distance(p.position[p.fluid]).min() > 0.49 * D0
    text = preflight(case).text()
    assert "mesh, x 0.0" in text and "6 spacings at the thinnest" in text


def test_run_goes_on_from_its_folder_alone(cube, tmp_path):
    """Case, mesh and motion are in the folder: it may be moved, and the files be lost."""
    motion = tmp_path / "down.csv"
    motion.write_text("time [s],z [m],roll [deg]\n0,0,0\n0.02,-0.001,1\n0.04,-0.003,3\n")
    (tmp_path / "case.toml").write_text(
        dumps(make_case({**TANK, "time.end": 0.03, "output.interval": 0.03})).replace("\\", "/")
        + '\n[[solid]]\nshape = "mesh"\nfile = "cube.stl"\nunit = "mm"\n'
        'center = [0.1, 0.07, 0.07]\nmotion = "file"\nmotion_file = "down.csv"\n'
        '[[force]]\nname = "cube"\non = "solid-1"\n'
    )
    case = load_case(tmp_path / "case.toml")
    whole = Simulation(case, tmp_path / "whole").run()
    Simulation(case, tmp_path / "part").run(until=0.015)
    shutil.move(tmp_path / "part", tmp_path / "moved")
    cube.unlink()
    motion.unlink()
    names = {path.name for path in Path(tmp_path / "moved").glob("solid-1*")}
    assert names == {"solid-1.stl", "solid-1-motion.csv"}
    rest = Simulation.resume(tmp_path / "moved").run()
    assert rest.particles.position.tobytes() == whole.particles.position.tobytes()
    tables = [(tmp_path / name / "forces.csv").read_bytes() for name in ("moved", "whole")]
    assert tables[0] == tables[1]


# What is refused


def test_without_the_packages_it_says_how_to_get_them(cube, monkeypatch):
    monkeypatch.setitem(sys.modules, "igl", None)
    with pytest.raises(CaseError, match=r"solid\.0\.file = .*pip install 'mpslab\[stl\]'"):
        make_case({**TANK, "solid": [solid(cube)]})


def test_open_surface_is_refused_with_the_share_that_is_in_doubt(tmp_path):
    path = tmp_path / "sheet.ply"
    mesh = block([0.06, 0.06, 0.06])
    trimesh.Trimesh(mesh.vertices, mesh.faces[:7], process=False).export(path)
    with pytest.raises(CaseError, match=r"solid\.0\.file = .*cannot be told for \d+ % of it"):
        make_case({**TANK, "solid": [solid(path)]})


BOX = {"shape": "box", "center": [0.1, 0.07, 0.07], "size": [0.05, 0.05, 0.05]}
REFUSED = [
    ({"shape": "mesh"}, "solid.0.file = '': must be a file that exists, .stl, .obj, .ply"),
    (BOX | {"size": [0.05, 0.05, 0.0]}, "must be three lengths > 0 for a box"),
    (BOX | {"size": [0.05, 0.05, 0.03]}, "solid.0.size = [0.05, 0.05, 0.03]: must be 4 spacings"),
    (BOX | {"center": [0.1, 0.3, 0.07]}, "must be in the tank, y from 0 to 0.14 m"),
    ({"shape": "sphere", "center": [0.1, 0.07, 0.07], "radius": 0.04, "rotation": TURN},
     "must be [0, 0, 0] for a sphere"),
    (BOX | {"motion": "file"}, "solid.0.motion_file = '': must be a CSV file that exists"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "part"), REFUSED)
def test_solid_that_cannot_be_is_refused(given, part):
    with pytest.raises(CaseError) as raised:
        make_case({**TANK, "solid": [given]})
    assert part in str(raised.value)


def test_file_without_triangles_is_refused(tmp_path):
    path = tmp_path / "empty.stl"
    path.write_text("no triangles here")
    with pytest.raises(CaseError, match=r"solid\.0\.file = .*cannot be read as triangles"):
        make_case({**TANK, "solid": [solid(path)]})


@pytest.mark.parametrize("center", [None, [0.1, 0.07, 0.026]])
def test_message_names_what_the_table_says_of_the_place(tmp_path, center):
    path = tmp_path / "block.obj"
    mesh = block([0.05, 0.05, 0.05])
    mesh.apply_translation([0.0, 0.0, 0.0] if center else [0.1, 0.07, 0.026])
    mesh.export(path)
    place = {"center": center} if center else {}
    given = {"shape": "mesh", "file": str(path), "motion": "free", "density": 500.0, **place}
    key = r"center = \[0\.1" if center else "file = '.*block.obj'"
    with pytest.raises(CaseError, match=rf"^solid\.0\.{key}.*a spacing, or more off the tank"):
        make_case({**TANK, "solid": [given]})


def test_thin_plate_is_refused(tmp_path):
    path = tmp_path / "plate.obj"
    block([0.08, 0.08, 0.03]).export(path)
    with pytest.raises(CaseError, match=r"solid\.0\.scale = 1\.0: must be 4 spacings, 0\.04 m"):
        make_case({**TANK, "solid": [solid(path)]})


def test_check_warns_of_narrow_gaps_but_not_of_solids_that_touch():
    box = {"shape": "box", "size": [0.05, 0.05, 0.05]}
    row = [box | {"center": [x, 0.07, 0.065]} for x in (0.025, 0.075, 0.15)]
    case = make_case({**TANK, "solid": row})
    notes = [line for line in preflight(case).warnings if "gap" in line]
    assert [note.partition(":")[0] for note in notes] == [
        "solid.1 and solid.2", "solid.2 and the end wall",
    ]  # fmt: skip
    assert "2.5 spacings at the narrowest" in notes[0]
