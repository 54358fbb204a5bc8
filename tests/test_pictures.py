"""Pictures are drawn from the files of a run folder alone, and show what the files hold."""

import tomllib

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.image import imread
from synthetic import write_run
from tanks import open_tables

from mpslab import cases
from mpslab.analysis import headings, pictures, snapshots
from mpslab.analysis import panels as panels_of
from mpslab.analysis.results import Frames, open_run
from mpslab.core.kinds import DUMMY, FLUID, GATE, GATE_DUMMY, WALL
from mpslab.core.particles import FIRST_SOLID, make_particles
from mpslab.output import vtkhdf
from mpslab.output.run_folder import RunFolder

SPACING = 0.004


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("runs") / "run", spacing=SPACING, frames=6)


@pytest.fixture
def case(folder):
    return tomllib.loads(folder.case.read_text())


def test_all_pictures_are_drawn(tmp_path):
    folder = write_run(tmp_path / "run", spacing=0.002, frames=26)
    drawn = pictures.draw_run(folder.path)
    names = ["tank", "pressure", "breaker", "gauges", "probes", "energy", "solver"]
    assert drawn == [folder.pictures / f"{name}.png" for name in names]
    for path in drawn:
        assert imread(path)[..., :3].std() > 0.05, f"{path.name} is blank"


def test_empty_tables_and_no_frames_give_no_pictures(tmp_path, folder):
    empty = RunFolder.create(tmp_path / "empty")
    empty.write_case(folder.case.read_text())
    assert pictures.draw_run(empty.path) == []
    open_tables(empty, ["g1"])
    empty.close()
    assert pictures.draw_run(empty.path) == []


@pytest.mark.parametrize("text", [None, "name = "])
def test_folder_without_a_case_is_named(tmp_path, text):
    if text:
        (tmp_path / "case.toml").write_text(text)
    with pytest.raises(ValueError, match=r"case\.toml"):
        pictures.draw_run(tmp_path)


def text_of(figure):
    """The heading as one line."""
    return " ".join(figure.get_suptitle().split())


def test_every_picture_says_what_was_run(folder, case):
    run = open_run(folder.path)
    case["scheme"] |= {"gradient": "mps", "smagorinsky": 0.12}
    for figure in (
        snapshots.draw_tank(Frames(folder.particles), case),
        snapshots.draw_tank(Frames(folder.particles), case, "pressure"),
        pictures.draw_gauges(run.gauges, case),
        pictures.draw_probes(run.probes, case),
        pictures.draw_energy(run.steps, case),
        pictures.draw_solver(run.steps, case),
    ):
        for words in ("drawn: Plunging breaker", "2-D", "$d_0$ = 4 mm", "H = 30 mm, T = 0.777 s",
                      "recipe standard with gradient mps, smagorinsky 0.12"):  # fmt: skip
            assert words in text_of(figure), words


@pytest.mark.parametrize("title", ["short", "a long title that goes on and on " * 8])
def test_nothing_stands_beyond_the_edge_of_the_page(folder, case, title):
    run = open_run(folder.path)
    case["title"] = title
    run.tables = case
    with matplotlib.rc_context(pictures.STYLE):
        for name, figure in pictures._figures(run):
            seen = figure.get_tightbbox(FigureCanvasAgg(figure).get_renderer())
            page = figure.get_size_inches()
            assert np.all(seen.min >= 0.0) and np.all(seen.max <= page), name
            assert seen.ymin < 0.3 and seen.ymax > page[1] - 0.3, f"{name}: empty edges"


@pytest.mark.parametrize(
    ("maker", "initial", "words"),
    [
        ({"type": "none"}, {}, ""),
        ({"type": "solitary", "height": 0.018}, {}, "solitary wave, H = 18 mm"),
        ({"type": "linear", "stroke": 0.05, "period": 1.5}, {},
         "linear wave, stroke = 50 mm, T = 1.5 s"),
        ({"type": "file", "file": "/some/where/paddle.csv"}, {}, "piston after paddle.csv"),
        ({"type": "none"}, {"type": "standing_wave", "amplitude": 0.004},
         "standing wave, a = 4 mm"),
    ],
)  # fmt: skip
def test_the_heading_tells_the_wave(maker, initial, words):
    maker = {"height": 0.0, "period": 0.0, "stroke": 0.0} | maker
    assert headings.wave({"wavemaker": maker, "initial": {"type": "rest"} | initial}) == words


def test_heading_of_every_built_in_case_names_its_recipe():
    for name in cases.names():
        case = tomllib.loads(cases.dumps(cases.load_case(name)))
        less = " with wall_slip false, hyperviscosity 0.2, smagorinsky 0.12"
        assert headings.models(case) == "recipe standard" + less * (name == "dam_break")
        if name in ("floating_box", "sphere_drop", "wedge_entry"):  # refused with other walls
            continue
        case = tomllib.loads(cases.dumps(cases.load_case(name, {"scheme.recipe": "paper"})))
        other = " with wall_slip false, smagorinsky 0.12"
        assert headings.models(case) == "recipe paper" + other * (name == "dam_break")


def norms(figure):
    """Limits of the colours of the water in the panels."""
    water = [ax.collections[-1] for ax in panels(figure).values()]
    return {(one.norm.vmin, one.norm.vmax, one.get_cmap().name) for one in water}


def test_colours_are_those_of_the_case_in_every_picture(tmp_path):
    run = write_run(tmp_path / "run", spacing=0.002, frames=26)
    case = tomllib.loads(run.case.read_text())
    ends = set()
    for recipe, times in (("standard", [0.0]), ("paper", [0.3, 1.2])):
        case["scheme"]["recipe"], case["output"]["pictures"] = recipe, times
        ends |= norms(snapshots.draw_tank(Frames(run.particles), case))
    ends |= norms(snapshots.draw_breaker(Frames(run.particles), case))
    (speed,) = ends
    assert speed == (0.0, pytest.approx(np.sqrt(9.81 * 0.04)), "viridis")
    (pressure,) = norms(snapshots.draw_tank(Frames(run.particles), case, "pressure"))
    assert pressure == (0.0, pytest.approx(1.2 * 9810 * 0.04), "plasma")


@pytest.mark.parametrize(
    ("name", "end"),
    [("dam_break", 2), ("hydrostatic", 0.05), ("plunging_breaker", 1), ("regular_waves", 0.5),
     ("solitary_runup", 1), ("standing_wave", 0.2)],
)  # fmt: skip
def test_speed_ends_at_a_round_part_of_the_long_wave_speed(name, end):
    case = tomllib.loads(cases.dumps(cases.load_case(name)))
    assert panels_of.make_scale(case, "speed").end == pytest.approx(end)


def test_the_legend_names_every_solid_that_is_seen(tmp_path, folder, case):
    def legend(figure):
        return [text.get_text() for text in figure.legends[0].get_texts()]

    assert legend(snapshots.draw_tank(Frames(folder.particles), case)) == [
        "wall", "piston", "still water level"
    ]  # fmt: skip
    kinds = [FLUID, FLUID, WALL, DUMMY, WALL, GATE, GATE_DUMMY]
    places = np.array([[0.01 * k, 0.0, 0.0] for k in range(len(kinds))])
    path = tmp_path / "p.vtkhdf"
    vtkhdf.ParticleSeries(path, []).append(
        0.0, make_particles(places, np.zeros(len(kinds))), np.array(kinds, np.int8)
    )
    case["obstacle"] = [{"from": [0.035, 0.0, -0.005], "to": [0.045, 0.0, 0.005]}]
    case["water"] = [{"from": [0.0, 0.0, 0.0], "to": [0.02, 0.0, 0.02]}]
    assert legend(snapshots.draw_tank(Frames(path), case)) == ["water", "wall", "obstacle", "gate"]


def panels(figure):
    """Titles to axes of the panels, the colour bar left out."""
    return {ax.get_title(loc="left"): ax for ax in figure.axes if ax.get_title(loc="left")}


def test_tank_shows_the_frames_nearest_to_the_times_asked_for(folder, case):
    case["output"]["pictures"] = [0.2, 0.76, 9.0]
    figure = snapshots.draw_tank(Frames(folder.particles), case)
    assert list(panels(figure)) == ["t = 0.250 s", "t = 0.750 s", "t = 1.250 s"]


def test_tank_shows_six_times_if_none_are_asked_for(folder, case):
    assert len(panels(snapshots.draw_tank(Frames(folder.particles), case))) == 6


def test_discs_are_particles_as_wide_as_the_spacing_coloured_by_speed(folder, case):
    figure = snapshots.draw_tank(Frames(folder.particles), case)
    water = panels(figure)["t = 0.500 s"].collections[-1]
    frame = vtkhdf.read_frame(folder.particles, 2)
    fluid = frame["kind"] == FLUID
    np.testing.assert_array_equal(water.get_offsets(), frame["position"][fluid][:, [0, 2]])
    speed = np.linalg.norm(frame["velocity"][fluid], axis=1)
    np.testing.assert_array_equal(water.get_array(), speed)
    assert set(water.get_widths()) == set(water.get_heights()) == {SPACING}
    assert all(ax.get_aspect() == 1.0 for ax in panels(figure).values())


def test_panels_share_limits_that_hold_the_water(folder, case):
    axes = panels(snapshots.draw_tank(Frames(folder.particles), case)).values()
    ((x, z),) = {(ax.get_xlim(), ax.get_ylim()) for ax in axes}
    for _, frame in vtkhdf.read_frames(folder.particles):
        water = frame["position"][frame["kind"] == FLUID]
        assert (water[:, 0] > x[0]).all() and (water[:, 0] < x[1]).all()
        assert (water[:, 2] > z[0]).all() and (water[:, 2] < z[1]).all()


def test_breaker_shows_the_onset_of_overturning(tmp_path):
    run = write_run(tmp_path / "run", spacing=0.002, frames=26)
    case = tomllib.loads(run.case.read_text())
    figure = snapshots.draw_breaker(Frames(run.particles), case)
    assert next(iter(panels(figure))) == "t = 1.050 s", "one frame before the first jet"
    left, right = figure.axes[0].get_xlim()
    assert left < 0.12 + 0.42 * 1.1 + 0.04 < right
    assert "overturns" in figure.get_suptitle()


def test_gentle_waves_have_no_breaker(tmp_path):
    run = write_run(tmp_path / "run", spacing=0.002, frames=4, breaks=False)
    found = open_run(run.path)
    assert snapshots.draw_breaker(found.frames, found.tables) is None


def test_a_picture_that_is_no_longer_due_is_taken_away(tmp_path):
    run = write_run(tmp_path / "run", spacing=SPACING, frames=4, breaks=False)
    run.pictures.mkdir()
    (run.pictures / "breaker.png").write_bytes(b"of an earlier run")
    drawn = pictures.draw_run(run.path)
    assert not (run.pictures / "breaker.png").exists()
    assert "no breaker.png" in pictures.listed(drawn)[-1]
    assert pictures.listed([*drawn, run.pictures / "breaker.png"])[-1].endswith("breaker.png")


def test_frames_without_velocity_are_drawn_in_one_colour(tmp_path, folder, case):
    path = tmp_path / "p.vtkhdf"
    particles = make_particles(np.random.default_rng(0).random((50, 3)) * [1, 0, 0.1], [FLUID] * 50)
    vtkhdf.ParticleSeries(path, []).append(0.0, particles)
    figure = snapshots.draw_tank(Frames(path), case)
    assert len(figure.axes) == 1, "no colour bar"


@pytest.mark.parametrize("layers", [15, 16])
def test_slice_holds_one_layer(layers):
    width = layers * SPACING
    y = (np.arange(layers) + 0.5) * SPACING
    y = np.repeat(y, 100) + np.random.default_rng(0).normal(0, 0.01 * SPACING, 100 * layers)
    position = np.column_stack([0 * y, y, 0 * y])
    frame = {"position": position, "kind": np.zeros(len(y)), "velocity": position}
    seen = snapshots.middle_slice(0.0, frame, SPACING, width)
    assert len(seen.x) == 100
    assert np.ptp(seen.speed) < 0.1 * SPACING
    assert abs(seen.speed.mean() - 0.5 * width) < 0.6 * SPACING


def test_gauges_are_drawn_above_still_water_and_broken_where_dry(folder, case):
    table = open_run(folder.path).gauges.copy()
    figure = pictures.draw_gauges(table, case)
    first, second = panels(figure).items()
    assert first[0] == "g1, x = 0.2 m"
    np.testing.assert_allclose(first[1].lines[-1].get_ydata(), table["g1"] - 0.04)
    assert np.isnan(second[1].lines[-1].get_ydata()[-1])


def test_probes_are_drawn_with_name_and_place(folder, case):
    table = open_run(folder.path).probes.copy()
    (axes,) = panels(pictures.draw_probes(table, case)).values()
    assert axes.get_title(loc="left") == "p1, x = 0.2 m, z = 0.01 m"
    assert axes.get_ylabel() == "pressure [Pa]"
    case["tank"]["width"] = 0.1
    (axes,) = panels(pictures.draw_probes(table, case)).values()
    assert axes.get_title(loc="left") == "p1, x = 0.2 m, y = 0 m, z = 0.01 m"


@pytest.mark.parametrize("at", [0, 1, 500, 999])
def test_a_lone_reading_sets_no_scale_and_is_marked(folder, case, at):
    table = open_run(folder.path).probes.copy()
    name = "p1 pressure"
    low, high = table[name].min(), table[name].max()
    table[name][at] = 40_000.0
    (axes,) = panels(pictures.draw_probes(table, case)).values()
    bottom, top = axes.get_ylim()
    assert low - 0.2 * (high - low) < bottom <= low and high - 20 < top < high + 20
    line, marks = axes.lines
    np.testing.assert_array_equal(line.get_ydata(), table[name])
    assert marks.get_xdata() == [table["time"][at]]
    assert axes.get_legend().get_texts()[0].get_text() == "off the scale, to 40,000 Pa"


def test_a_peak_of_several_readings_stays_on_the_scale(folder, case):
    table = open_run(folder.path).probes.copy()
    table["p1 pressure"][500:503] = 9_000.0
    (axes,) = panels(pictures.draw_probes(table, case)).values()
    assert axes.get_ylim()[1] > 9_000.0 and axes.get_legend() is None


def test_the_level_of_water_in_boxes_counts_from_the_bed(folder, case):
    case["water"] = [{"from": [0.0, 0.0, 0.0], "to": [0.1, 0.0, 0.03]}]
    table = open_run(folder.path).gauges.copy()
    figure = pictures.draw_gauges(table, case)
    axes = panels(figure)["g1, x = 0.2 m"]
    np.testing.assert_array_equal(axes.lines[-1].get_ydata(), table["g1"])
    assert "above z = 0" in text_of(figure)


def test_energy_starts_at_that_of_the_motion(folder, case):
    steps = open_run(folder.path).steps
    kinetic, potential, total = (
        line.get_ydata() for line in pictures.draw_energy(steps, case).axes[0].lines
    )
    assert potential[0] == 0.0
    np.testing.assert_array_equal(total, kinetic + potential)


def test_solver_names_every_limit_that_held(folder, case):
    steps = open_run(folder.path).steps
    figure = pictures.draw_solver(steps, case)
    legend = figure.axes[1].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["growth", "maximum", "courant"]
    assert sum(len(points.get_offsets()) for points in figure.axes[1].collections) == 1000


def test_bodies_are_drawn_whole_and_the_still_water_beside_them():
    ring = [(x, z) for x in (0.3, 0.5) for z in np.arange(0.05, 0.3, 0.01)]
    water = [(x, 0.05) for x in np.arange(0.05, 1.0, 0.1)]
    gate = [(0.8, 0.6)]
    x, z = np.array(ring + water + gate).T
    body = np.array([FIRST_SOLID + 1] * len(ring) + [0] * len(water) + [FIRST_SOLID])
    kind = np.array([WALL] * len(ring) + [FLUID] * len(water) + [GATE])
    piece = snapshots.Slice(0.0, kind, x, z, None, body=body)
    top = snapshots._box([piece], {"particles": {"spacing": 0.01}})[1][1]
    assert 0.29 < top < 0.4  # the body is whole, and the gate is not
    along = np.array([0.1, 0.29, 0.31, 0.4, 0.49, 0.51])
    held = piece.inside(along, 0.1, 0.01)
    assert held.tolist() == [False, False, True, True, True, False]
    assert not piece.inside(along, 0.4, 0.01).any()  # the body is below
    assert not snapshots.Slice(0.0, kind, x, z, None).inside(along, 0.1, 0.01).any()
