"""Pictures are drawn from the files of a run folder alone, and show what the files hold."""

import tomllib

import numpy as np
import pytest
from matplotlib.image import imread
from synthetic import write_run

from mpslab import pictures, snapshots, vtkhdf
from mpslab.output import RunFolder
from mpslab.particles import FLUID, make_particles

SPACING = 0.004


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("runs") / "run", spacing=SPACING, frames=6)


@pytest.fixture
def case(folder):
    return tomllib.loads(folder.case.read_text())


def test_all_pictures_are_drawn(tmp_path):
    folder = write_run(tmp_path / "run", spacing=SPACING, frames=26)
    drawn = pictures.draw_run(folder.path)
    names = ["tank", "breaker", "gauges", "probes", "energy", "solver"]
    assert drawn == [folder.pictures / f"{name}.png" for name in names]
    for path in drawn:
        assert imread(path)[..., :3].std() > 0.05, f"{path.name} is blank"


def test_empty_tables_and_no_frames_give_no_pictures(tmp_path, folder):
    empty = RunFolder.create(tmp_path / "empty")
    empty.write_case(folder.case.read_text())
    assert pictures.draw_run(empty.path) == []
    empty.open_tables(["g1"])
    empty.close()
    assert pictures.draw_run(empty.path) == []


@pytest.mark.parametrize("text", [None, "name = "])
def test_folder_without_a_case_is_named(tmp_path, text):
    if text:
        (tmp_path / "case.toml").write_text(text)
    with pytest.raises(ValueError, match=r"case\.toml"):
        pictures.draw_run(tmp_path)


def panels(figure):
    """Titles to axes of the panels, the colour bar left out."""
    return {ax.get_title(loc="left"): ax for ax in figure.axes if ax.get_title(loc="left")}


def test_tank_shows_the_frames_nearest_to_the_times_asked_for(folder, case):
    case["output"]["pictures"] = [0.2, 0.76, 9.0]
    figure = snapshots.draw_tank(folder.particles, case)
    assert list(panels(figure)) == ["t = 0.250 s", "t = 0.750 s", "t = 1.250 s"]


def test_tank_shows_six_times_if_none_are_asked_for(folder, case):
    assert len(panels(snapshots.draw_tank(folder.particles, case))) == 6


def test_discs_are_particles_as_wide_as_the_spacing_coloured_by_speed(folder, case):
    figure = snapshots.draw_tank(folder.particles, case)
    water = panels(figure)["t = 0.500 s"].collections[-1]
    frame = vtkhdf.read_frame(folder.particles, 2)
    fluid = frame["kind"] == FLUID
    np.testing.assert_array_equal(water.get_offsets(), frame["position"][fluid][:, [0, 2]])
    speed = np.linalg.norm(frame["velocity"][fluid], axis=1)
    np.testing.assert_array_equal(water.get_array(), speed)
    assert set(water.get_widths()) == set(water.get_heights()) == {SPACING}
    assert all(ax.get_aspect() == 1.0 for ax in panels(figure).values())


def test_panels_share_limits_that_hold_the_water(folder, case):
    axes = panels(snapshots.draw_tank(folder.particles, case)).values()
    ((x, z),) = {(ax.get_xlim(), ax.get_ylim()) for ax in axes}
    for _, frame in vtkhdf.read_frames(folder.particles):
        water = frame["position"][frame["kind"] == FLUID]
        assert (water[:, 0] > x[0]).all() and (water[:, 0] < x[1]).all()
        assert (water[:, 2] > z[0]).all() and (water[:, 2] < z[1]).all()


def test_breaker_shows_the_onset_of_overturning(tmp_path):
    run = write_run(tmp_path / "run", spacing=0.002, frames=26)
    case = tomllib.loads(run.case.read_text())
    figure = snapshots.draw_breaker(run.particles, case)
    assert next(iter(panels(figure))) == "t = 1.050 s", "one frame before the first jet"
    left, right = figure.axes[0].get_xlim()
    assert left < 0.12 + 0.42 * 1.1 + 0.04 < right
    assert "overturns" in figure.get_suptitle()


def test_gentle_waves_have_no_breaker(tmp_path):
    run = write_run(tmp_path / "run", spacing=0.002, frames=4, breaks=False)
    assert snapshots.draw_breaker(run.particles, tomllib.loads(run.case.read_text())) is None


def test_frames_without_velocity_are_drawn_in_one_colour(tmp_path, folder, case):
    path = tmp_path / "p.vtkhdf"
    particles = make_particles(np.random.default_rng(0).random((50, 3)) * [1, 0, 0.1], [FLUID] * 50)
    vtkhdf.ParticleSeries(path, []).append(0.0, particles)
    figure = snapshots.draw_tank(path, case)
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
    table = pictures.read_table(folder.path / "gauges.csv")
    figure = pictures.draw_gauges(table, case)
    first, second = panels(figure).items()
    assert first[0] == "g1, x = 0.2 m"
    np.testing.assert_allclose(first[1].lines[-1].get_ydata(), table["g1 [m]"] - 0.04)
    assert np.isnan(second[1].lines[-1].get_ydata()[-1])


def test_energy_starts_at_that_of_the_motion(folder, case):
    steps = pictures.read_table(folder.path / "steps.csv")
    kinetic, potential, total = (
        line.get_ydata() for line in pictures.draw_energy(steps, case).axes[0].lines
    )
    assert potential[0] == 0.0
    np.testing.assert_array_equal(total, kinetic + potential)


def test_solver_names_every_limit_that_held(folder, case):
    steps = pictures.read_table(folder.path / "steps.csv")
    figure = pictures.draw_solver(steps, case)
    legend = figure.axes[1].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["growth", "maximum", "courant"]
    assert sum(len(points.get_offsets()) for points in figure.axes[1].collections) == 1000
