"""Bad input to a case: one line with key, value and allowed range, and nothing else happens."""

import math
from dataclasses import fields

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mpslab import cases
from mpslab.core.keys import LARGEST, SMALLEST, toml_name
from mpslab.core.parameters import LISTS, TABLES, Case, CaseError, Gauge, Particles, Tank, Time
from mpslab.run.preflight import preflight

INF, NAN = math.inf, math.nan


def refusal(action, *arguments):
    """The message of the CaseError that an action raises; it must be one line."""
    with pytest.raises(CaseError) as caught:
        action(*arguments)
    message = str(caught.value)
    assert message and "\n" not in message
    return message


def assert_refused(name, changes, *parts):
    message = refusal(cases.load_case, name, changes)
    for part in parts:
        assert part in message, message


# Values of one key

VALUES = [
    ("particles.spacing", "a", "particles.spacing = 'a': must be a number > 0 [m]"),
    ("particles.spacing", 0, "particles.spacing = 0: must be a number > 0 [m]"),
    ("particles.spacing", True, "particles.spacing = true: must be a number > 0 [m]"),
    ("particles.spacing", [0.002], "particles.spacing = [0.002]: must be a number > 0 [m]"),
    ("particles.spacing", 10**400, "must be a number > 0 [m]"),
    ("tank.length", -0.8, "tank.length = -0.8: must be a number > 0 [m]"),
    ("tank.length", 0.0, "tank.length = 0.0: must be a number > 0 [m]"),
    ("tank.length", INF, "tank.length = inf: must be"),
    ("tank.depth", NAN, "tank.depth = nan: must be"),
    ("tank.width", -0.1, "tank.width = -0.1: must be a number >= 0 [m]"),
    ("tank.periodic", 1, "tank.periodic = 1: must be true or false"),
    ("tank.periodic", "yes", "tank.periodic = 'yes': must be true or false"),
    ("tank.bed", 0.0, "tank.bed = 0.0: must be a list of points [x, z], each number >= 0 [m]"),
    ("tank.bed", [[0, 0], [0.8]], "tank.bed = [[0, 0], [0.8]]: must be a list of points"),
    ("tank.bed", [[0, -0.1], [0.8, 0]], "must be a list of points [x, z], each number >= 0"),
    ("particles.layers", 2.0, "particles.layers = 2.0: must be a whole number from 0 to 20"),
    ("particles.layers", True, "particles.layers = true: must be a whole number from 0 to 20"),
    ("particles.jitter", 0.5, "must be a number from 0 to 0.3 [spacings]"),
    ("particles.bed", "stairs", "must be one of smooth, staircase; did you mean staircase?"),
    ("scheme.effective_radius", 1.4, "scheme.effective_radius = 1.4: must be a number from 1.5"),
    ("scheme.tolerance", 0, "scheme.tolerance = 0: must be a number > 0 and <= 0.1"),
    ("scheme.gradient", "cmsp", "scheme.gradient = 'cmsp': must be one of cmps, cmps_soft, "),
    ("scheme.gradient", "cmsp", "did you mean cmps?"),
    ("scheme.gradient", 4, "scheme.gradient = 4: must be text of one line"),
    ("scheme.source", "dens", "scheme.source = 'dens': must be one of adjoint, corrected"),
    ("scheme.laplacian", "lh", "scheme.laplacian = 'lh': must be one of hl, standard"),
    ("scheme.solver", "cg", "scheme.solver = 'cg': must be one of deflated"),
    ("scheme.stabiliser", "ds", "scheme.stabiliser = 'ds': must be a list of different words"),
    ("scheme.stabiliser", ["ds", "ds"], "must be a list of different words"),
    ("scheme.stabiliser", ["shift"], "scheme.stabiliser = 'shift': must be one of collision"),
    ("scheme.recipe", "papr", "scheme.recipe = 'papr': must be one of standard, paper; did you"),
    ("scheme.recipe", ["paper"], "scheme.recipe = ['paper']: must be one of standard, paper"),
    ("wavemaker.type", "cnoid", "wavemaker.type = 'cnoid': must be one of none, bichromatic, cnoi"),
    ("wavemaker.height", -0.01, "wavemaker.height = -0.01: must be a number from 0 to 1000 [m]"),
    ("initial.mode", 0, "initial.mode = 0: must be a whole number >= 1"),
    ("time.end", None, "time.end = None: must be a number > 0 [s]"),
    ("time.growth", 1, "time.growth = 1: must be a number > 1 and <= 10"),
    ("parallel.balance", "best", "must be one of static, centroid, optimal"),
    ("parallel.rebalance_every", 0, "must be a whole number >= 1"),
    ("output.fields", ["velocty"], "must be a list out of velocity, pressure"),
    ("output.fields", ["velocty"], "did you mean velocity?"),
    ("output.pictures", [0.1, "end"], "output.pictures = [0.1, 'end']: must be a list of numbers"),
    ("gauge.0.x", 1e308, "gauge.0.x = 1e+308: must be a number >= 0 [m], and unless 0 of a size"),
    ("time.end", 5e-324, "must be a number > 0 [s], and unless 0 of a size from 1e-30 to 1e+30"),
    ("tank.bed", [[0, 0], [0.8, 1e-200]], "each number >= 0 [m], and unless 0 of a size from"),
    ("wavemaker.offset", 1e30, "must be a number from -1e+09 to 1e+09 [s]"),
    ("gauge.0.name", "a,b", "gauge.0.name = 'a,b': must be text of one line"),
    ("gauge.0.name", "", "gauge.0.name = '': must be text of one line and not empty"),
    ("name", "two\nlines", "name = 'two\\nlines': must be text of one line"),
]


@pytest.mark.parametrize(("key", "value", "part"), VALUES)
def test_value_out_of_its_range_is_refused(key, value, part):
    assert_refused("plunging_breaker", {key: value}, key, part)


# Keys

KEYS = [
    ("particles.spacng", "particles.spacng = 1: unknown key", "did you mean particles.spacing?"),
    ("scheme.gradent", "must be one of recipe, gradient", "did you mean scheme.gradient?"),
    ("spacing", "spacing = 1: unknown key", "did you mean particles.spacing?"),
    ("tank.spacing", "tank.spacing = 1: unknown key", "did you mean particles.spacing?"),
    ("partcles.x", "partcles = {'x': 1}: unknown key", "did you mean particles?"),
    ("gauge.0.z", "gauge.0.z = 1: unknown key; must be one of name, x, y", "probe.z"),
    ("water.0.start", "unknown key", "must be one of from, to"),
    ("gauge.9.x", "gauge.9.x = 1: '9' must be a number from 0 to 3", ""),
    ("gauge.one.x", "gauge.one.x = 1: 'one' must be a number from 0 to 3", ""),
    ("tank.depth.x", "tank.depth.x = 1: must be a known key, and 'x' leads nowhere", ""),
]


@pytest.mark.parametrize(("key", "part", "hint"), KEYS)
def test_unknown_key_is_refused_with_the_nearest_known_one(key, part, hint):
    name = "dam_break" if key.startswith("water") else "plunging_breaker"
    assert_refused(name, {key: 1}, part, hint)


def test_index_into_tables_that_are_not_there_is_refused():
    assert_refused("plunging_breaker", {"water.0.to": [1, 1, 1]}, "water.0.to", "which is empty")


@pytest.mark.parametrize(
    ("key", "value", "part"),
    [
        ("tank", 3, "tank = 3: must be a table of keys, under [tank]"),
        ("scheme", "paper", "scheme = 'paper': must be a table of keys, under [scheme]"),
        ("gauge", {"name": "a"}, "gauge = {'name': 'a'}: must be tables, each under [[gauge]]"),
        ("probe", [1], "probe.0 = 1: must be a table of keys"),
        ("gauge", [{"x": 0.1}], "gauge.0.name is missing: must be text"),
        ("tank", {"length": 0.8}, "tank.depth is missing: must be a number > 0 [m]"),
        ("time", {}, "time.end is missing: must be a number > 0 [s]"),
    ],
)
def test_wrong_or_incomplete_table_is_refused(key, value, part):
    assert_refused("plunging_breaker", {key: value}, part)


# Values that clash

PERIODIC = {"tank.width": 0.02}
STANDING = {"initial.type": "standing_wave", "initial.amplitude": 0.05}
WEIGHTLESS = {"fluid.gravity": 0, "wavemaker.type": "none", "initial.amplitude": 0.01}
SHORT_STEP = {"time.maximum": 1e-4, "time.start": 1e-3}
WIDE = {"scheme.gradient": "symmetric", "scheme.gradient_radius": 4}
SOLVED = {
    "tank.width": 0, "scheme.gradient": "mps", "scheme.surface": "marked", "scheme.walls": "solved"
}  # fmt: skip
COPIED = SOLVED | {"scheme.walls": "copied"}
CLASHES = [
    ({"tank.bed": [[0, 0.05], [0.8, 0.06]]}, "tank.bed = ", "at the piston: first z < tank.depth"),
    ({"tank.bed": [[0, 0.04], [0.8, 0.06]]}, "tank.bed = ", "0.04 m"),
    ({"tank.bed": [[0, 0], [0.2, 0], [0.2, 0.1], [0.8, 0.1]]}, "tank.bed = ", "x increasing"),
    ({"tank.bed": [[0.1, 0], [0.8, 0]]}, "tank.bed = [[0.1", "from 0 to tank.length = 0.8 m"),
    ({"tank.bed": [[0, 0], [0.7, 0]]}, "tank.bed = ", "from 0 to tank.length = 0.8 m"),
    ({"tank.bed": [[0, 0]]}, "tank.bed = [[0.0, 0.0]]", "from 0 to tank.length"),
    ({"tank.height": 0.05}, "tank.height = 0.05", "> 0.06 m"),
    ({"wavemaker.stroke": 0.8}, "wavemaker.stroke = 0.8", "< tank.length = 0.8 m"),
    ({"wavemaker.stroke": 2}, "wavemaker.stroke = 2.0", "the piston leaves the tank"),
    ({"particles.spacing": 0.014}, "particles.spacing = 0.014", "no fluid"),
    ({"particles.spacing": 1e-6}, "particles.spacing = 1e-06", "more than 1e+09"),
    ({"particles.layers": 2}, "particles.layers = 2", ">= 3, or 0"),
    (PERIODIC, "tank.width = 0.02", ">= 0.0208 m, 5.2 spacings"),
    (PERIODIC | {"tank.periodic": False, "tank.width": 0.011}, "tank.width = 0.011", ">= 0.012 m"),
    ({"scheme.laplacian_radius": 4}, "tank.width = 0.032", ">= 0.036 m, 9 spacings"),
    (WIDE, "tank.width = 0.032", ">= 0.036 m, 9 spacings"),
    (WIDE | {"tank.width": 0, "particles.layers": 3}, "particles.layers = 3", "gradient_radius"),
    ({"scheme.gradient_radius": 1.4}, "scheme.gradient_radius = 1.4", "0, or >= 1.5 spacings"),
    ({"scheme.hyperviscosity": 0.6}, "scheme.hyperviscosity = 0.6", "0 to 0.5"),
    ({"scheme.residue": 1.5}, "scheme.residue = 1.5", "0 to 1"),
    ({"scheme.wall_law": True, "scheme.wall_slip": False}, "scheme.wall_law = true", "wall_slip"),
    ({"scheme.wall_law": True, "fluid.viscosity": 0.0}, "scheme.wall_law = true", "roughness"),
    (SOLVED | {"scheme.gradient_radius": 2.4}, "scheme.gradient_radius = 2.4", "<= 2.3 spacings"),
    (SOLVED | {"scheme.surface": "graded"}, "scheme.surface = 'graded'", "walls = 'solved'"),
    (COPIED | {"scheme.surface": "graded"}, "scheme.surface = 'graded'", "walls = 'copied'"),
    ({"wavemaker.type": "file"}, "wavemaker.file = ''", "a CSV file that exists"),
    ({"wavemaker.type": "file", "wavemaker.file": "/no.csv"}, "wavemaker.file = '/no.csv'", ""),
    (STANDING, "initial.amplitude = 0.05", "> 0 and < tank.depth = 0.04 m"),
    (STANDING | {"initial.amplitude": 0}, "initial.amplitude = 0.0", "> 0 and < tank.depth"),
    (SHORT_STEP, "time.start = 0.001", "<= time.maximum = 0.0001 s"),
    ({"time.minimum": 1.0}, "time.minimum = 1.0", "<= time.start"),
    ({"fluid.gravity": 0}, "fluid.gravity = 0.0", "> 0 for wavemaker.type = 'linear'"),
    (STANDING | WEIGHTLESS, "fluid.gravity = 0.0", "> 0 for initial.type = 'standing_wave'"),
    (WEIGHTLESS, "time.maximum = 0.0", "given, > 0 s, where fluid.gravity = 0"),
    ({"gauge.1.x": 0.9}, "gauge.1.x = 0.9", "from 0 to tank.length = 0.8 m"),
    ({"gauge.1.y": 0.04}, "gauge.1.y = 0.04", "from 0 to tank.width = 0.032 m"),
    ({"gauge.1.name": "flat"}, "gauge.1.name = 'flat'", "different from gauge.0.name"),
    ({"probe.1.z": 0.02}, "probe.1.z = 0.02", "from the bed, 0.03 m, to tank.height = 0.12 m"),
    ({"probe.1.z": 0.2}, "probe.1.z = 0.2", "to tank.height = 0.12 m"),
]


@pytest.mark.parametrize(("changes", "start", "part"), CLASHES)
def test_values_that_clash_are_refused(changes, start, part):
    assert_refused("plunging_breaker", changes, start, "must be", part)


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"water.0.to": [1.7, 0.15, 0.3]}, "inside the tank, [x, y, z] <= [1.61, 0.15, 0.6] m"),
        ({"water.0.to": [0.6, 0.2, 0.3]}, "inside the tank"),
        ({"water.0.to": [0.6, 0.15, 0.7]}, "inside the tank"),
        ({"water.0.to": [0.6, 0.15, 0.005]}, "by a spacing, 0.01 m, or there is no fluid"),
        ({"water.0.from": [0.6, 0, 0]}, "or there is no fluid"),
        ({"water.0.from": [0, 0.15, 0]}, "or there is no fluid"),
        ({"tank.bed": [[0, 0.295], [1.61, 0.3]]}, "above the bed by a spacing, z >= 0.305 m"),
    ],
)
def test_box_of_water_outside_the_tank_or_empty_is_refused(changes, part):
    changes = {"gauge": [], "probe": [], "particles.spacing": 0.01, **changes}
    if "tank.bed" in changes:
        changes["tank.depth"] = 0.5
    assert_refused("dam_break", changes, "water.0.to = [", part)


@pytest.mark.parametrize(
    "changes",
    [
        {"tank.width": 0.0208},
        {"scheme.effective_radius": 1.5},
        {"wavemaker.stroke": 0.79},
        {"tank.bed": [[0, 0.02], [0.8, 0.06]], "probe": []},
        {"gauge.1.x": 0.8, "gauge.1.y": 0.032},
        {"probe.0.name": "flat"},
        {"probe.1.z": 0.12},
        {"particles.spacing": 0.01, "tank.width": 0.1},
        {"tank.width": 0, "scheme.effective_radius": 6},
        SOLVED | {"scheme.gradient_radius": 2.3},
        COPIED | {"scheme.gradient_radius": 3.1},
    ],
)
def test_values_just_inside_their_range_are_taken(changes):
    assert isinstance(cases.load_case("plunging_breaker", changes), Case)


# Warnings


@pytest.mark.parametrize(
    ("name", "changes", "part"),
    [
        ("regular_waves", {"wavemaker.height": 0.009}, "only 4.5 particles over the wave height"),
        ("regular_waves", {"wavemaker.height": 0.009}, "particles.spacing <= 0.0018 m"),
        ("standing_wave", {"particles.spacing": 0.004}, "only 2 particles over the wave height"),
        ("regular_waves", {"tank.height": 0.121, "tank.bed": []}, ""),
        ("regular_waves", {"tank.height": 0.119, "tank.bed": []}, "lower than tank.depth + 2"),
        ("regular_waves", {"tank.width": 0.021}, "10.500 spacings, not a whole number"),
        ("regular_waves", {"time.maximum": 1e-3}, "the run may be unstable"),
        ("regular_waves", {"wavemaker.stroke": 2.7}, "not flat under the piston's path"),
        (
            "standing_wave",
            {"tank.bed": [[0, 0], [0.16, 0.01]], "probe": []},
            "not flat under the standing wave",
        ),
        ("regular_waves", {"wavemaker.height": 0.01}, ""),
        ("regular_waves", {"wavemaker.type": "none", "wavemaker.height": 0.001}, ""),
    ],
)
def test_doubtful_values_bring_a_warning_and_no_error(name, changes, part):
    found = cases.warnings(cases.load_case(name, changes))
    assert all("\n" not in warning for warning in found)
    assert any(part in warning for warning in found) if part else not found


# Files and settings


def test_disc_too_small_to_hold_a_particle_is_refused():
    disc = {"from": [0.1, 0.0, 0.1], "to": [0.119, 0.15, 0.2], "shape": "disc"}
    part = "beyond 'from' = [0.1, 0.0, 0.1] by 0.02 m, 2 spacings, in x and z for shape = 'disc'"
    assert_refused("dam_break", {"water": [disc]}, "water.0.to = [0.119, 0.15, 0.2]", part)
    assert cases.load_case("dam_break", {"water": [{**disc, "to": [0.12, 0.15, 0.12]}]}).water
    ball = {"water": [{**disc, "shape": "ball"}]}
    assert_refused("dam_break", ball, "water.0.shape = 'ball': must be one of box, disc")


def test_case_that_is_not_there_is_refused(tmp_path):
    message = refusal(cases.load_case, "plunging_braker")
    assert "case = 'plunging_braker': must be one of caisson, cylinder_in_waves" in message
    assert "did you mean plunging_breaker?" in message
    assert "must be a readable file" in refusal(cases.load_case, tmp_path / "none.toml")
    assert "must be one of caisson, cylinder_in_waves" in refusal(cases.load_case, tmp_path)
    assert "must be one of caisson, cylinder_in_waves" in refusal(cases.load_case, "x" * 5000)
    assert "case = 3: must be the name" in refusal(cases.load_case, 3)
    assert "must be one of caisson, cylinder_in_waves" in refusal(cases.text, "../parameters")


@pytest.mark.parametrize(
    ("content", "part"),
    [
        (b"[tank]\nlength = 0.8\ndepth 0.04\n", "line 3"),
        (b"[tank]\nlength = 0.8\nlength = 0.9\n", "line 3"),
        (b"\xff\xfe[tank]", "must be text in UTF-8"),
        (b"x = " + b"[" * 5000, "must be a file in TOML"),
        (b"", "tank.length is missing: must be a number > 0 [m]"),
        (b'"a\\nb" = 1\n', "unknown key"),
    ],
)
def test_file_that_is_not_a_case_is_refused(tmp_path, content, part):
    path = tmp_path / "mine.toml"
    path.write_bytes(content)
    message = refusal(cases.load_case, path)
    assert part in message
    assert "mine.toml" in message or "tank" in message or "unknown" in message


def test_folder_with_the_name_of_a_case_file_is_refused(tmp_path):
    folder = tmp_path / "folder.toml"
    folder.mkdir()
    assert "must be a readable file" in refusal(cases.load_case, folder)


@pytest.mark.parametrize("text", ["", "=", "particles.spacing", "=0.002", "particles.spacing= "])
def test_setting_without_key_or_value_is_refused(text):
    assert f"{text!r}: must be key=value" in refusal(cases.parse_set, text)


@pytest.mark.parametrize("value", ["[0, 1", '"open', "{a = 1", "[0.6, 0.1.2]"])
def test_setting_that_is_not_toml_is_refused(value):
    assert "must be a value in TOML" in refusal(cases.parse_set, f"tank.bed={value}")


def test_setting_of_a_number_with_a_unit_is_refused_with_the_range():
    key, value = cases.parse_set("particles.spacing=2mm")
    assert_refused("plunging_breaker", {key: value}, "particles.spacing = '2mm': must be a number")


# Tables made in Python


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (lambda: Tank(length=-1, depth=1), "tank.length = -1: must be a number > 0 [m]"),
        (lambda: Particles(spacing="a"), "particles.spacing = 'a': must be a number > 0 [m]"),
        (lambda: Time(end=NAN), "time.end = nan: must be a number > 0 [s]"),
        (lambda: Gauge(name="a", x=0, y="mid"), "gauge.y = 'mid': must be a number >= 0 [m]"),
        (
            lambda: Case(tank=1, particles=2, time=3),
            "tank = 1: must be made of mpslab.core.parameters",
        ),
    ],
)
def test_table_made_in_python_checks_itself(make, part):
    assert part in refusal(make)


# Whatever the value, it is taken or refused in one line

EVERY_KEY = [
    *(f"{table}.{toml_name(item)}" for table, kind in TABLES.items() for item in fields(kind)),
    *(f"{table}.0.{toml_name(item)}" for table, kind in LISTS.items() for item in fields(kind)),
    *(*TABLES, *LISTS, "name", "title"),
]
SCALARS = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=10))
JUNK = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=2)
    ),
    max_leaves=8,
)


@given(st.sampled_from(EVERY_KEY), JUNK)
@settings(max_examples=300, deadline=None)
def test_any_value_of_any_key_is_taken_or_refused_in_one_line(key, value):
    try:
        case = cases.load_case("dam_break", {key: value})
    except CaseError as error:
        assert len(str(error).splitlines()) == 1
    else:
        assert cases.loads(cases.dumps(case)) == case


@pytest.mark.parametrize("name", ["dam_break", "regular_waves"])
@pytest.mark.parametrize("value", [5e-324, 1e-200, SMALLEST, -SMALLEST, LARGEST, 1e200, 1.7e308])
def test_tiny_and_huge_numbers_are_taken_or_refused_in_one_line(name, value):
    for key in EVERY_KEY:
        try:
            preflight(cases.load_case(name, {key: value})).text()
        except ValueError as error:
            assert len(str(error).splitlines()) == 1 and " must " in str(error), key


@given(st.text(max_size=40))
@settings(max_examples=200, deadline=None)
def test_any_setting_is_taken_or_refused_in_one_line(text):
    try:
        key, value = cases.parse_set(text)
        cases.load_case("hydrostatic", {key: value})
    except CaseError as error:
        assert len(str(error).splitlines()) == 1


def test_boxes_of_water_that_overlap_are_refused():
    box = {"from": [0.0, 0.0, 0.0], "to": [0.6, 0.15, 0.3]}
    other = {"from": [0.5, 0.0, 0.0], "to": [0.8, 0.15, 0.1]}
    with pytest.raises(CaseError, match=r"^water\.1\.from = .*outside of the box water\.0"):
        cases.load_case("dam_break", {"water": [box, other]})
    beside = {**other, "from": [0.6, 0.0, 0.0]}
    assert len(cases.load_case("dam_break", {"water": [box, beside]}).water) == 2
