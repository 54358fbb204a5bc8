"""What --check foretells: numbers of particles, steps and results, without laying anything out."""

import json

import numpy as np
import pytest
from tanks import make_case

from mpslab import cases
from mpslab.core.keys import CaseError
from mpslab.core.kinds import FLUID, KIND_NAMES, kinds_of
from mpslab.core.parameters import LISTS
from mpslab.run.preflight import preflight
from mpslab.run.preflight_text import sections
from mpslab.simulation import Simulation
from mpslab.solids import census, layout
from mpslab.solids.piston import make_paddle

BOX = {"from": [0.66, 0.03, 0.0], "to": [0.82, 0.09, 0.161]}
TALL = {"from": [0.7, 0.0, 0.0], "to": [0.9, 0.15, 0.2]}
DISC = {"from": [0.1, 0.0, 0.1], "to": [0.5, 0.15, 0.5], "shape": "disc"}
BARE = {name: [] for name in LISTS if name not in ("water", "obstacle")}


def findings(case, section):
    return dict(preflight(case).sections[section])


def laid_out(case):
    paddle = make_paddle(case)
    particles = layout.build_particles(case, paddle.backmost if paddle else 0.0)
    return np.bincount(kinds_of(case, particles), minlength=len(KIND_NAMES))


def counted(case):
    paddle = make_paddle(case)
    return census.census(case, paddle.backmost if paddle else 0.0)


@pytest.mark.parametrize("name", cases.names())
@pytest.mark.parametrize("changes", [{}, {"particles.bed": "staircase"}, {"tank.width": 0.0}])
def test_particles_are_counted_as_they_are_laid_out(name, changes):
    if name in ("regular_waves", "solitary_runup", "irregular_waves", "focused_wave"):
        changes = {**changes, "particles.spacing": 0.004}
    if name in ("cylinder_in_waves", "sphere_drop") and "tank.width" in changes:
        changes = {**BARE, **changes}  # they have no slice
    case = cases.load_case(name, changes)
    real = laid_out(case)
    np.testing.assert_allclose(counted(case), real, rtol=0.02, atol=0.02 * real.sum())
    assert counted(case).sum() == pytest.approx(real.sum(), rel=0.02)


@pytest.mark.parametrize(
    "changes",
    [
        {"obstacle": [BOX]},
        {"obstacle": [BOX, TALL]},
        {"water": [DISC]},
        {"tank.periodic": True},
        {"gate": [{"x": 0.6, "speed": 1.0}], "obstacle": [TALL]},
        {"tank.bed": [[0.0, 0.0], [0.8, 0.05], [1.61, 0.3]], "particles.spacing": 0.008},
    ],
)
def test_solids_and_parts_of_the_width_are_counted(changes):
    case = cases.load_case("dam_break", {**BARE, **changes})
    real = laid_out(case)
    np.testing.assert_allclose(counted(case), real, rtol=0.02, atol=0.02 * real.sum())


def test_columns_too_many_to_look_at_stand_for_one_another(monkeypatch):
    case = cases.load_case("plunging_breaker")
    exact = counted(case)
    monkeypatch.setattr(census, "MOST_COLUMNS", 23)
    np.testing.assert_allclose(counted(case), exact, rtol=0.03)


@pytest.mark.parametrize("name", cases.names())
def test_the_words_follow_from_the_numbers_as_json_holds_them(name):
    report = preflight(cases.load_case(name))
    read = json.loads(json.dumps(report.findings))
    assert read == report.findings
    assert sections(read) == report.sections


def test_the_numbers_have_their_units_in_their_names():
    case = cases.load_case("plunging_breaker")
    found = preflight(case).findings
    maker, wave = found["wavemaker"], found["wave"]
    assert found["particles"]["fluid"] == pytest.approx(laid_out(case)[FLUID], rel=0.02)
    assert found["largest_time_step [s]"] == case.time.maximum
    assert maker["stroke [m]"] == make_paddle(case).stroke
    assert maker["paddle_depth [m]"] == case.tank.depth
    assert maker["wave_height [m]"] == wave["height [m]"] == pytest.approx(case.wavemaker.height)
    k, depth = 2.0 * np.pi / wave["wavelength [m]"], case.tank.depth
    frequency = np.sqrt(9.81 * k * np.tanh(k * depth))
    assert 2.0 * np.pi / frequency == pytest.approx(case.wavemaker.period, rel=1e-6)
    assert wave["kh"] == pytest.approx(k * depth)
    ursell = wave["height [m]"] * wave["wavelength [m]"] ** 2 / depth**3
    assert wave["ursell_number"] == pytest.approx(ursell)
    assert not wave["second_order_in_range"] and wave["breaker_type"] == "plunging"
    still = preflight(cases.load_case("hydrostatic")).findings
    assert not {"wave", "wavemaker"} & set(still) and still["warnings"] == []


def test_faces_are_told_as_they_are_laid_out():
    case = cases.load_case("dam_break", {"obstacle": [{**BOX, "from": [0.66, 0.0, 0.0]}]})
    (faces,) = preflight(case).findings["laid_out"].values()
    assert faces["x [m]"] == pytest.approx([0.66, 0.82])
    assert faces["y [m]"][0] is None and faces["z [m]"][0] is None


def test_check_lays_out_nothing(monkeypatch):
    def refuse(*arguments):
        raise AssertionError

    monkeypatch.setattr(layout, "build_particles", refuse)
    assert preflight(cases.load_case("plunging_breaker")).text()


def test_walls_of_a_slip_of_the_pen_are_refused():
    with pytest.raises(CaseError, match=r"^tank\.height = 1000000000\.0: must be"):
        cases.load_case("regular_waves", {"tank.height": 1e9})
    with pytest.raises(CaseError, match=r"^tank\.height = 1000000\.0: must be lower: .* 1e\+09$"):
        cases.load_case("regular_waves", {"tank.height": 1e6})


def test_viscosity_is_seen_in_the_number_of_steps():
    """Honey of 14 Pa s, given as if it were kinematic."""
    changes = {"fluid.viscosity": 14.0, "particles.spacing": 0.002, "time.end": 0.125}
    report = preflight(cases.load_case("hydrostatic", changes))
    lines = dict(report.sections["Cost (one core, rough)"])
    assert lines["limit of the time step"] == "viscous"
    assert lines["expected steps"] == "4,375,000 to t = 0.125 s"
    assert any("fluid.viscosity = 14 m2/s" in line for line in report.warnings)
    assert not preflight(cases.load_case("hydrostatic")).warnings


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"time.end": 1e7}, r"^time\.end = 10000000\.0: must be <= .* more than 1e\+08"),
        ({"fluid.viscosity": 1e3}, r"^fluid\.viscosity = 1000\.0: must be <= .* m2/s"),
        ({"output.interval": 1e-12}, r"^output\.interval = 1e-12: must be >= 1e-09 s, or 0"),
        ({"output.gauge_interval": 1e-12}, r"^output\.gauge_interval = 1e-12: must be >= "),
        ({"output.checkpoint": 1e-12}, r"^output\.checkpoint = 1e-12: must be >= "),
        (
            {"output.interval": 1e-7, "time.maximum": 5e-7},
            r"^output\.interval = 1e-07: must be >= 1e-06 s, for it makes 2e\+06 frames",
        ),
    ],
)
def test_run_larger_than_any_is_refused(changes, message):
    case = cases.load_case("hydrostatic", changes)
    with pytest.raises(CaseError, match=message):
        preflight(case)


def test_frames_and_tables_are_told_with_their_size(tmp_path):
    changes = {"time.end": 0.05, "output.interval": 0.005, "scheme.settling": 0}
    case = cases.load_case("hydrostatic", changes)
    lines = findings(case, "Results (rough)")
    Simulation(case, tmp_path / "run").run()
    frames = (tmp_path / "run" / "particles.vtkhdf").stat().st_size
    told = float(lines["frames"].split(", ")[-1].split()[0]) * 1e3
    assert lines["frames"].startswith("11 of ")
    assert 0.4 < told / frames < 2.5
    assert lines["tables"].startswith("40 rows of steps, 41 of gauges")


def test_run_beyond_the_memory_of_the_machine_brings_a_warning(monkeypatch):
    from mpslab.core import memory

    case = cases.load_case("hydrostatic")
    assert memory.physical() > 1e8
    monkeypatch.setattr(memory, "physical", lambda: 1e6)
    assert any("of memory, and this machine has" in line for line in preflight(case).warnings)


@pytest.mark.parametrize(("depth", "narrow"), [(0.02, True), (-0.02, True), (0.001, False)])
def test_bed_finer_than_the_particles_brings_a_warning(depth, narrow):
    ground = 0.03
    bed = [[0, ground], [0.2, ground], [0.205, ground - depth], [0.21, ground], [0.4, ground]]
    case = make_case({"tank.length": 0.4, "tank.depth": 0.1, "particles.spacing": 0.004,
                      "tank.bed": bed})  # fmt: skip
    found = [line for line in cases.warnings(case) if "narrower than 4 spacings" in line]
    assert bool(found) == narrow
    if narrow:
        assert f"{'notch' if depth > 0 else 'ridge'} at x = 0.205 m, 0.02 m high" in found[0]
        assert "0.016 m wide" in found[0]


def test_bed_of_many_points_along_a_curve_and_a_step_bring_none():
    x = np.linspace(0.0, 0.4, 200)
    curve = [[a, 0.02 + 0.01 * np.sin(20.0 * a)] for a in x]
    step = [[0, 0.0], [0.2, 0.0], [0.201, 0.04], [0.4, 0.04]]
    for bed in (curve, step):
        case = make_case({"tank.length": 0.4, "tank.depth": 0.1, "particles.spacing": 0.004,
                          "tank.bed": bed})  # fmt: skip
        assert not any("narrower" in line for line in cases.warnings(case))


def test_breaker_formula_says_where_its_range_ends():
    steep = {"tank.bed": [[0.0, 0.0], [0.2, 0.0], [0.8, 0.2]]}
    steep |= {"probe": [], "wavemaker.height": 0.0196, "wavemaker.period": 0.5}
    line = findings(cases.load_case("plunging_breaker", steep), "Wave")
    assert line["breaking point (Goda 2010)"].endswith("outside of its range, slopes up to 0.1")
    line = findings(cases.load_case("plunging_breaker"), "Wave")
    assert "outside" not in line["breaking point (Goda 2010)"]


def test_toe_of_the_slope_in_the_path_of_the_piston_brings_a_warning():
    """The stroke of 56 mm follows from the height."""
    toe = {"tank.bed": [[0.0, 0.0], [0.05, 0.0], [0.65, 0.06], [0.8, 0.06]], "probe": []}
    near = preflight(cases.load_case("plunging_breaker", toe)).warnings
    assert any("not flat under the piston's path, up to x = 0.0556" in line for line in near)
    assert not preflight(cases.load_case("plunging_breaker")).warnings


def test_record_is_described_as_one_whatever_the_height(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("".join(f"{t / 50},{0.02 * np.sin(t / 50) ** 2:.7f}\n" for t in range(70)))
    changes = {"wavemaker.type": "file", "wavemaker.file": str(path), "wavemaker.height": 0.02}
    report = preflight(cases.load_case("plunging_breaker", changes))
    assert "Wave" not in report.sections
    lines = dict(report.sections["Wavemaker"])
    assert {"stroke", "record", "top speed", "largest acceleration"} <= lines.keys()


def test_piston_that_hardly_moves_brings_a_warning(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("0,0.5\n1000,0.51\n")  # in milliseconds
    changes = {"wavemaker.type": "file", "wavemaker.file": str(path)}
    found = preflight(cases.load_case("plunging_breaker", changes)).warnings
    assert any("the piston moves by" in line and "time.end = 1.25 s" in line for line in found)


# The piston's motion and the tank


def test_stroke_that_follows_from_the_height_is_held_against_the_tank():
    changes = {"wavemaker.height": 0.02, "wavemaker.period": 15.0, "time.end": 8.0}
    with pytest.raises(CaseError) as caught:
        preflight(cases.load_case("plunging_breaker", changes))
    message = str(caught.value)
    assert "wavemaker.height = 0.02 with wavemaker.period = 15 s: moves the piston" in message
    assert "< tank.length = 0.8 m" in message
    assert "x <= 0.588 m, 3 spacings before the shore" in message


@pytest.mark.parametrize("name", ["linear", "second_order", "cnoidal", "solitary"])
def test_motion_of_every_theory_is_held_against_the_tank(name):
    changes = {"wavemaker.type": name, "wavemaker.height": 0.0075, "tank.length": 0.04,
               "wavemaker.period": 0.777, "tank.bed": [], "gauge": [], "probe": [],
               "particles.spacing": 0.01, "tank.width": 0.0}  # fmt: skip
    with pytest.raises(CaseError, match=r"^wavemaker\.height = 0\.0075"):
        make_paddle(cases.load_case("plunging_breaker", changes))
    assert make_paddle(cases.load_case("plunging_breaker", {**changes, "tank.length": 0.4}))


@pytest.mark.parametrize("scale", [1.0, -1.0])
def test_record_in_millimetres_is_refused_with_a_hint(tmp_path, scale):
    path = tmp_path / "record.csv"
    path.write_text("".join(f"{t},{scale * 20 * t}\n" for t in range(4)))
    changes = {"wavemaker.type": "file", "wavemaker.file": str(path)}
    with pytest.raises(CaseError, match=r"^wavemaker\.file = .*moves .* by .*m, and not in"):
        make_paddle(cases.load_case("plunging_breaker", changes))


def test_extremes_of_a_motion_take_as_many_samples_whatever_the_end():
    case = cases.load_case("regular_waves", {"time.end": 1e6, "wavemaker.start": 1e5})
    assert make_paddle(case).stroke < make_paddle(cases.load_case("regular_waves")).stroke * 1.01


def test_faces_of_water_that_are_no_whole_spacings_are_told():
    case = cases.load_case("dam_break", {"tank.width": 0.0, "particles.spacing": 0.007})
    assert "water.0 in whole spacings    x 0 m to 0.602 m" in preflight(case).text()
    whole = cases.load_case("dam_break", {"tank.width": 0.0, "particles.spacing": 0.01})
    assert "water.0" not in preflight(whole).text()
