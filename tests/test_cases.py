"""Cases: the built-in ones, what is filled in, changes by key, and the way to TOML and back."""

import re
from dataclasses import FrozenInstanceError, fields, replace
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

from mpslab import cases
from mpslab.cases.changes import apply
from mpslab.cases.complete import complete
from mpslab.cases.recipes import RECIPES
from mpslab.core import plugins
from mpslab.core.keys import toml_name
from mpslab.core.parameters import LISTS, TABLES, Scheme
from mpslab.theory import waves

NAMES = (
    "caisson",
    "cylinder_in_waves",
    "dam_break",
    "floating_box",
    "focused_wave",
    "hydrostatic",
    "irregular_waves",
    "overtopping",
    "plunging_breaker",
    "regular_waves",
    "sluice",
    "solitary_runup",
    "sphere_drop",
    "standing_wave",
    "wedge_entry",
)
THREE_DIMENSIONAL = ("cylinder_in_waves", "dam_break", "plunging_breaker", "sphere_drop")


def small(**tables):
    """Tables of a small valid case, with some of them replaced."""
    least = {
        "tank": {"length": 0.5, "depth": 0.1},
        "particles": {"spacing": 0.01},
        "time": {"end": 2.0},
    }
    return {**least, **tables}


# Built-in cases


def test_built_in_cases_are_those_of_the_manual():
    assert cases.names() == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_built_in_case_loads_and_comes_back_equal_from_its_own_toml(name):
    case = cases.load_case(name)
    assert case.name == name
    assert case.title
    assert case.dim == (3 if name in THREE_DIMENSIONAL else 2)
    assert cases.loads(cases.dumps(case)) == case


@pytest.mark.parametrize("name", NAMES)
def test_built_in_case_is_complete_after_loading(name):
    case = cases.load_case(name)
    assert complete(case) == case
    assert case.tank.bed
    assert 0.0 < case.time.minimum < case.time.start < case.time.maximum
    assert case.particles.layers > 0
    assert case.output.interval > 0.0
    assert all(item.y is not None for item in (*case.gauge, *case.probe))
    assert case.gauge
    assert case.probe


@pytest.mark.parametrize("name", NAMES)
def test_file_of_a_built_in_case_names_the_unit_of_each_key(name):
    table, checked = "", 0
    for line in cases.text(name).splitlines():
        if heading := re.match(r"\[+(\w+)\]+", line):
            table = heading.group(1)
        elif pair := re.match(r"(\w+) = ", line):
            unit = unit_of(table, pair.group(1))
            assert not unit or f"# [{unit}]" in line, line
            checked += bool(unit)
    assert checked > 5


def unit_of(table, name):
    if not table:
        return ""
    kind = {**TABLES, **LISTS}[table]
    return next(item.metadata["unit"] for item in fields(kind) if toml_name(item) == name)


@pytest.mark.parametrize("name", NAMES)
def test_wavemaker_of_a_built_in_case_is_in_the_range_of_its_theory(name):
    case = cases.load_case(name)
    if case.wavemaker.type != "none":
        maker = plugins.load("wavemakers", case.wavemaker.type)
        depth, gravity = case.tank.depth, case.fluid.gravity
        paddle = maker.make(case.wavemaker, depth, gravity, case.time.end)
        if case.wavemaker.stroke:
            assert paddle.stroke == pytest.approx(case.wavemaker.stroke, rel=1e-3)
        else:
            assert paddle.height == pytest.approx(case.wavemaker.height)


def test_plunging_breaker_is_the_tank_of_the_paper():
    case = cases.load_case("plunging_breaker")
    assert case.tank.bed == ((0.0, 0.0), (0.2, 0.0), (0.8, 0.06))
    assert (case.tank.length, case.tank.depth, case.tank.width) == (0.8, 0.04, 0.032)
    assert case.tank.periodic
    assert (case.wavemaker.height, case.wavemaker.period) == (0.03, 0.777)
    assert (case.particles.spacing, case.time.end) == (0.004, 1.25)
    assert [gauge.x for gauge in case.gauge] == [0.1, 0.2, 0.4, 0.5]


def test_dam_break_is_the_tank_of_lobovsky_and_its_slice():
    case = cases.load_case("dam_break")
    assert (case.tank.length, case.tank.width, case.tank.height) == (1.61, 0.15, 0.6)
    assert not case.tank.periodic
    assert (case.water[0].start, case.water[0].end) == ((0.0, 0.0, 0.0), (0.6, 0.15, 0.3))
    assert [gauge.x for gauge in case.gauge] == [0.3, 0.865, 1.114, 1.3625]
    assert [(probe.x, probe.z) for probe in case.probe] == [
        (1.61, z) for z in (0.003, 0.015, 0.03, 0.08)
    ]
    flat = cases.load_case("dam_break", {"tank.width": 0})
    assert flat.dim == 2
    assert flat.water[0].end == (0.6, 0.0, 0.3)
    assert {item.y for item in (*flat.gauge, *flat.probe)} == {0.0}


def test_other_built_in_cases_hold_what_their_comments_say():
    standing = cases.load_case("standing_wave")
    k = np.pi / standing.tank.length
    rate = sqrt(standing.fluid.gravity * k * np.tanh(k * standing.tank.depth))
    assert standing.time.end == pytest.approx(2.0 * 2.0 * np.pi / rate, rel=2e-3)
    regular = cases.load_case("regular_waves")
    assert regular.wavemaker.height == pytest.approx(10.0 * regular.particles.spacing)
    length = waves.wavelength(regular.wavemaker.period, regular.tank.depth, regular.fluid.gravity)
    assert regular.tank.bed[1][0] == pytest.approx(6.5 * length, rel=0.01)
    irregular = cases.load_case("irregular_waves")
    assert irregular.wavemaker.height == pytest.approx(10.0 * irregular.particles.spacing)
    focused = cases.load_case("focused_wave")
    assert 2.0 * focused.wavemaker.amplitude == pytest.approx(10.0 * focused.particles.spacing)
    assert focused.wavemaker.place in [gauge.x for gauge in focused.gauge]
    for case in (irregular, focused):
        length = waves.wavelength(case.wavemaker.period, case.tank.depth, case.fluid.gravity)
        assert case.tank.bed[1][0] > 2.0 * length
    over, caisson = cases.load_case("overtopping"), cases.load_case("caisson")
    for case in (over, caisson):
        length = waves.wavelength(case.wavemaker.period, case.tank.depth, case.fluid.gravity)
        kh = 2.0 * np.pi * case.tank.depth / length
        assert kh == pytest.approx(0.8 if case is over else 1.5, rel=0.01)
        wall = over.tank.bed[1][0] if case is over else caisson.obstacle[0].start[0]
        assert wall == pytest.approx(2.0 * length, rel=0.08)
    (x0, z0), (x1, z1) = over.tank.bed[1:3]
    assert (x1 - x0) / (z1 - z0) == pytest.approx(3.0)
    assert z1 - over.tank.depth == pytest.approx(0.009)
    assert over.overtopping[0].x - x1 == pytest.approx(0.03)
    assert caisson.overtopping[0].drain
    assert caisson.obstacle[0].end[2] - caisson.tank.depth == pytest.approx(0.02)
    solitary = cases.load_case("solitary_runup")
    (x0, z0), (x1, z1) = solitary.tank.bed[1:]
    assert (x1 - x0) / (z1 - z0) == pytest.approx(19.85)
    assert solitary.wavemaker.height == pytest.approx(0.30 * solitary.tank.depth)


def test_only_the_coarse_built_in_cases_warn_and_only_of_their_wave():
    found = {name: cases.warnings(cases.load_case(name)) for name in NAMES}
    for name in ("standing_wave", "cylinder_in_waves"):
        (warning,) = found.pop(name)
        assert "particles over the wave height" in warning
    assert not any(found.values())


# Values that follow from others


def test_limits_of_the_time_step_follow_from_spacing_and_depth():
    time = cases.from_tables(small()).time
    assert time.maximum == pytest.approx(0.4 * 0.01 / sqrt(9.81 * 0.1), rel=1e-15)
    assert time.courant == 0.5
    assert time.start == pytest.approx(time.maximum / 10.0)
    assert time.minimum == pytest.approx(time.maximum * 1e-4)


@pytest.mark.parametrize(
    ("effective", "laplacian", "layers"),
    [(2.1, 2.1, 3), (2.1, 3.1, 4), (3.1, 2.1, 4), (2.1, 4.0, 4), (4.0, 4.0, 4)],
)
def test_wall_layers_fill_the_larger_radius(effective, laplacian, layers):
    scheme = {"effective_radius": effective, "laplacian_radius": laplacian}
    assert cases.from_tables(small(scheme=scheme)).particles.layers == layers


def test_walls_are_three_depths_high_or_a_depth_above_the_bed():
    assert cases.from_tables(small()).tank.height == pytest.approx(0.3)
    tank = {"length": 0.5, "depth": 0.1, "bed": [[0, 0], [0.5, 0.25]]}
    assert cases.from_tables(small(tank=tank)).tank.height == pytest.approx(0.35)


def test_bed_is_flat_and_instruments_stand_at_mid_width_unless_told():
    tank = {"length": 0.5, "depth": 0.1, "width": 0.2}
    gauge = [{"name": "a", "x": 0.1}, {"name": "b", "x": 0.1, "y": 0.05}]
    case = cases.from_tables(small(tank=tank, gauge=gauge, probe=[{"name": "a", "x": 0, "z": 0}]))
    assert case.tank.bed == ((0.0, 0.0), (0.5, 0.0))
    assert [item.y for item in case.gauge] == [0.1, 0.05]
    assert case.probe[0].y == 0.1
    assert [item.y for item in cases.from_tables(small(gauge=gauge)).gauge] == [0.0, 0.0]


def test_explicit_values_stay():
    tables = small(
        tank={"length": 0.5, "depth": 0.1, "height": 0.2},
        particles={"spacing": 0.01, "layers": 5},
        time={"end": 2.0, "maximum": 1e-3, "start": 5e-4, "minimum": 1e-6},
        output={"interval": 0.5, "checkpoint": 1.0},
    )
    case = cases.from_tables(tables)
    assert (case.tank.height, case.particles.layers) == (0.2, 5)
    assert (case.time.maximum, case.time.start, case.time.minimum) == (1e-3, 5e-4, 1e-6)
    assert (case.output.interval, case.output.checkpoint) == (0.5, 1.0)


def test_bed_height_runs_in_straight_lines():
    tank = cases.load_case("plunging_breaker").tank
    assert tank.bed_height(0.1) == 0.0
    np.testing.assert_allclose(tank.bed_height(np.array([0.2, 0.5, 0.8])), [0.0, 0.03, 0.06])


# Recipes


def test_recipes_set_the_same_keys_to_known_models():
    assert tuple(RECIPES) == ("standard", "paper")
    assert RECIPES["standard"].keys() == RECIPES["paper"].keys()
    for recipe in RECIPES:
        scheme = cases.from_tables(small(scheme={"recipe": recipe})).scheme
        assert replace(scheme, **RECIPES[recipe]) == scheme


def test_standard_is_the_default_scheme():
    assert cases.from_tables(small()).scheme == Scheme()
    assert cases.from_tables(small(scheme={"recipe": "standard"})).scheme == Scheme()


def test_recipe_paper_does_what_the_paper_does():
    scheme = cases.load_case("plunging_breaker", {"scheme.recipe": "paper"}).scheme
    assert (scheme.gradient, scheme.source, scheme.solver) == ("cmps_soft", "density", "piccg")
    assert (scheme.walls, scheme.stabiliser) == ("copied", ("collision",))
    assert (scheme.effective_radius, scheme.gradient_radius, scheme.laplacian_radius) == (
        2.1, 3.1, 3.1
    )  # fmt: skip


def test_explicit_key_wins_over_the_recipe():
    scheme = cases.from_tables(small(scheme={"recipe": "paper", "gradient": "gc"})).scheme
    assert (scheme.gradient, scheme.source) == ("gc", "density")
    changes = {"scheme.gradient": "mps", "scheme.recipe": "paper"}
    scheme = cases.load_case("hydrostatic", changes).scheme
    assert (scheme.gradient, scheme.source) == ("mps", "density")


def test_recipe_among_the_changes_replaces_the_recipe_of_a_complete_file(tmp_path):
    path = tmp_path / "done.toml"
    paper = cases.load_case("hydrostatic", {"scheme.recipe": "paper", "scheme.gamma": 0.05})
    path.write_text(cases.dumps(paper))
    assert cases.load_case(path) == paper
    scheme = cases.load_case(path, {"scheme.recipe": "standard"}).scheme
    assert scheme == Scheme(gamma=0.05)


# Changes by key


@pytest.mark.parametrize(
    ("text", "key", "value"),
    [
        ("particles.spacing=0.002", "particles.spacing", 0.002),
        (" time.end = 1e-1 ", "time.end", 0.1),
        ("tank.periodic=true", "tank.periodic", True),
        ("particles.seed=7", "particles.seed", 7),
        ("scheme.gradient=gc", "scheme.gradient", "gc"),
        ('scheme.gradient="gc"', "scheme.gradient", "gc"),
        ("scheme.stabiliser=[shifting, ds]", "scheme.stabiliser", ["shifting", "ds"]),
        ('scheme.stabiliser=["shifting"]', "scheme.stabiliser", ["shifting"]),
        ("scheme.stabiliser=[]", "scheme.stabiliser", []),
        ("water.0.to=[0.5, 0, 0.2]", "water.0.to", [0.5, 0, 0.2]),
        ("wavemaker.file=../a=b.csv", "wavemaker.file", "../a=b.csv"),
        ("title=Waves of today", "title", "Waves of today"),
    ],
)
def test_key_and_value_of_a_setting(text, key, value):
    found = cases.parse_set(text)
    assert found == (key, value)
    assert type(found[1]) is type(value)


def test_changes_reach_tables_lists_and_points():
    changes = {
        "name": "other",
        "particles.spacing": 0.002,
        "gauge.1.x": 0.25,
        "tank.bed.2.1": 0.07,
        "probe": [],
        "fluid.gravity": 1.62,
    }
    case = cases.load_case("plunging_breaker", changes)
    assert (case.name, case.particles.spacing, case.fluid.gravity) == ("other", 0.002, 1.62)
    assert [gauge.x for gauge in case.gauge] == [0.1, 0.25, 0.4, 0.5]
    assert case.tank.bed[2] == (0.8, 0.07)
    assert case.probe == ()


def test_tables_given_are_left_as_they_were():
    tables = small()
    cases.from_tables(tables)
    assert tables == small()
    bed = [[0, 0], [0.8, 0.06]]
    given = small(tank={"length": 0.8, "depth": 0.1, "bed": bed})
    assert apply(given, {"tank.bed.1.1": 0.05, "tank.depth": 1})["tank"]["bed"][1] == [0.8, 0.05]
    assert given["tank"]["depth"] == 0.1
    apply({}, {"tank.bed": bed, "tank.bed.1.1": 0.05})
    assert bed == [[0, 0], [0.8, 0.06]]


def test_numpy_values_and_paths_are_taken_as_plain_ones(tmp_path):
    path = tmp_path / "paddle.csv"
    path.write_text("0,0\n1,0.01\n")
    changes = {
        "particles.spacing": np.float32(0.5) / 128,
        "tank.bed": np.array([[0.0, 0.0], [0.8, 0.05]]),
        "particles.seed": np.int64(3),
        "wavemaker.type": "file",
        "wavemaker.file": path,
        "probe": [],
    }
    case = cases.load_case("plunging_breaker", changes)
    assert type(case.particles.spacing) is float
    assert type(case.particles.seed) is int
    assert case.tank.bed == ((0.0, 0.0), (0.8, 0.05))
    assert case.wavemaker.file == str(path)


def test_whole_numbers_become_floats_where_a_number_is_meant():
    case = cases.from_tables(small(tank={"length": 1, "depth": 1}, particles={"spacing": 0.1}))
    assert type(case.tank.length) is float


def test_case_cannot_be_changed_in_place():
    case = cases.load_case("hydrostatic")
    with pytest.raises(FrozenInstanceError):
        case.tank.length = 2.0


# Files


def test_file_of_the_user_is_named_after_itself(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        "[tank]\nlength = 1\ndepth = 0.1\n[particles]\nspacing = 0.01\n[time]\nend = 1\n"
    )
    assert cases.load_case(path).name == "mine"
    assert cases.load_case(str(path)) == cases.load_case(path)


def test_wavemaker_file_counts_from_the_case_file_or_from_where_the_user_is(tmp_path, monkeypatch):
    here, there = tmp_path / "here", tmp_path / "there"
    for folder in (here, there):
        folder.mkdir()
        (folder / "paddle.csv").write_text("0,0\n1,0.01\n")
    text = cases.text("hydrostatic").replace('type = "none"', 'type = "file"\nfile = "paddle.csv"')
    (there / "case.toml").write_text(text)
    monkeypatch.chdir(here)
    case = cases.load_case(Path("..") / "there" / "case.toml")
    assert Path(case.wavemaker.file).samefile(there / "paddle.csv")
    case = cases.load_case("../there/case.toml", {"wavemaker.file": "paddle.csv"})
    assert Path(case.wavemaker.file).samefile(here / "paddle.csv")
    assert Path(case.wavemaker.file).is_absolute()
