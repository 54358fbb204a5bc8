"""The paper's figures: what is measured, what the figures show, and what is claimed."""

import json
import shutil

import numpy as np
import pytest
from matplotlib.text import Text

from paper_figures import __main__ as command
from paper_figures import (
    agreement,
    fig_1,
    fig_2,
    fig_3,
    fig_4,
    fig_5,
    kept,
    measures,
    runs,
    samples,
    table_1,
)
from paper_figures.keep import CUTS, METHODS, RANKS, write_table

D0 = 0.002
SIZE = "quick"  # the size of which all runs are kept
RESULTS = command.HERE / "results" / SIZE
FIGURES = {f.__name__.split(".")[1]: f for f in (fig_1, fig_2, fig_3, fig_4, fig_5, table_1)}


def block(x, y, z, hole=lambda x, z: np.zeros_like(x, bool)):
    """Water on a lattice of so many particles, less a hole."""
    place = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in (x, y, z)), indexing="ij"), -1)
    place = place.reshape(-1, 3) * D0
    return place[~hole(place[:, 0], place[:, 2])]


# Measures


def test_air_in_water_is_measured_and_air_above_it_is_not():
    def chamber(x, z):
        return np.hypot(x - 0.03, z - 0.02) < 0.008

    def bay(x, z):
        return (np.abs(x - 0.03) < 0.008) & (z > 0.01)

    bed = [(-1.0, 0.0), (1.0, 0.0)]
    # What the discs of the particles around it cover is not seen: about half a spacing all round.
    area = np.pi * (0.008 - 0.5 * D0) ** 2
    assert measures.enclosed_air(block(30, 1, 20, chamber), D0, bed) == pytest.approx(area, rel=0.2)
    assert measures.enclosed_air(block(30, 1, 20, bay), D0, bed) == 0.0
    assert measures.enclosed_air(block(30, 1, 20), D0, bed) == 0.0


def test_share_across_the_tank_is_that_of_the_surface():
    x, y = np.meshgrid(np.arange(60) * D0, np.arange(16) * D0, indexing="ij")
    along, across = np.sin(2 * np.pi * x / 0.12), np.cos(2 * np.pi * y / 0.032)
    for part, expected in ((0.0, 0.0), (1.0, 0.5), (2.0, 0.8)):
        z = 0.01 * (along + part * across)
        place = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
        assert measures.share_across(place, D0, 0.032) == pytest.approx(expected, abs=0.03)


def test_splash_is_the_height_ahead_of_a_place_without_single_particles():
    water = block(30, 4, 20)
    ahead = np.array([[0.05, y, 0.06] for y in (np.arange(4) + 0.5) * D0])
    alone = np.array([[0.055, 0.5 * D0, 0.2]])
    found = measures.splash(np.vstack([water, ahead, alone]), D0, 4 * D0, 0.045)
    assert found == pytest.approx(0.06 - measures.STILL, abs=1e-12)


def test_layers_share_out_all_particles():
    place = block(5, 8, 3)
    assert sum(one.astype(int) for one in measures.slices(place, D0, 8 * D0)).tolist() == [1] * 120


def test_in_2d_all_water_is_one_layer_and_none_of_its_surface_is_across():
    water = block(30, 1, 20)
    water[:, 1] = 0.0
    assert [one.all() for one in measures.slices(water, D0, 0.0)] == [True]
    slope = water[water[:, 2] < 0.5 * water[:, 0] + 0.01]
    assert measures.share_across(slope, D0, 0.0) == 0.0


# Figures


@pytest.fixture(scope="module")
def found():
    """The kept results in the repository."""
    return kept.read(RESULTS, runs.read_runs(SIZE), samples.read_methods())


@pytest.fixture(scope="module")
def drawn(found):
    """Each figure, from the kept results."""
    return {name: module.draw(found) for name, module in FIGURES.items()}


def words(figure):
    """All texts of a figure, or of a panel, that are not empty."""
    return [text.get_text() for text in figure.findobj(Text) if text.get_text()]


def panels(figure):
    return [ax for ax in figure.axes if ax.get_title(loc="left")]


def flat(figure):
    """The panels that have axes."""
    return [ax for ax in panels(figure) if ax.axison]


def scenes(figure):
    """The panels in perspective."""
    return [ax for ax in panels(figure) if not ax.axison]


def labels(ax):
    return ax.get_xlabel(), ax.get_ylabel()


def title(found, name, time):
    """How a panel is headed that shows a run at a time of a wave that is not late [s]."""
    recipe = {"mps": "MPS", "cmps": "CMPS"}.get(name, "standard")
    spacing = 1e3 * found[name].spacing
    kind = "" if found[name].width else ", 2-D"
    return f"{recipe}, $d_0$ = {spacing:g} mm{kind}, t = {time + found[name].late:.2f} s"


def titles(axes):
    return [ax.get_title(loc="left") for ax in axes]


def test_all_runs_that_a_figure_needs_are_in_the_table():
    for figure in FIGURES.values():
        assert set(figure.RUNS) <= {*runs.read_runs("full"), *samples.read_methods()}


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_has_its_caption(drawn, name):
    assert any(FIGURES[name].CAPTION in text for text in words(drawn[name]))


def test_figure_1_shows_three_runs_just_before_the_jet_and_at_it(drawn, found):
    times = (fig_1.BEFORE, fig_1.JET)
    wanted = [title(found, name, time) for name in fig_1.RUNS for time in times]
    assert titles(flat(drawn["fig_1"])) == wanted
    assert titles(scenes(drawn["fig_1"])) == wanted[1::2]


def test_figure_2_shows_four_runs_at_touch_down_and_splash_up(drawn, found):
    times = (fig_2.TOUCH_DOWN, fig_2.SPLASH_UP)
    wanted = [title(found, name, time) for name in fig_2.RUNS for time in times]
    assert titles(panels(drawn["fig_2"])) == titles(flat(drawn["fig_2"])) == wanted
    assert found["fine"].spacing == 0.5 * found["standard"].spacing


def test_figure_3_shows_the_surface_at_the_jet_and_after_it_and_its_variance(drawn, found):
    wanted = [title(found, name, time) for time in fig_3.TIMES for name in fig_3.SEEN]
    assert titles(scenes(drawn["fig_3"])) == wanted
    (below,) = flat(drawn["fig_3"])
    assert labels(below) == ("t [s]", "variance across\nthe tank / all [-]")
    for name, line in zip(fig_3.RUNS, below.lines, strict=True):
        assert title(found, name, 0.0).startswith(line.get_label())
        times, share = (found[name].series[of] for of in ("time [s]", "share across the tank"))
        assert np.array_equal(line.get_xydata(), np.transpose([times, share]))
        assert times[0] < fig_3.TIMES[0] + found[name].late
        assert times[-1] >= fig_3.TIMES[-1] + found[name].late - 1e-3


@pytest.mark.parametrize("name", ["fig_1", "fig_2"])
def test_slices_show_water_in_metres_on_one_scale(drawn, name):
    for ax in flat(drawn[name]):
        assert labels(ax) == ("x [m]", "z [m]")
        (discs,) = (one for one in ax.collections if one.get_array() is not None)
        place, (left, right) = discs.get_offsets(), ax.get_xlim()
        assert np.count_nonzero((place[:, 0] > left) & (place[:, 0] < right)) > 100
    sizes = {(round(np.ptp(ax.get_xlim()), 9), ax.get_ylim()) for ax in flat(drawn[name])}
    assert len(sizes) == 1


@pytest.mark.parametrize("name", ["fig_1", "fig_3"])
def test_scenes_show_water_and_tell_where_it_is(drawn, found, name):
    wide = {f"y: 0 to {found[run].width:g} m" for run in FIGURES[name].RUNS}
    for ax in scenes(drawn[name]):
        assert "x [m]" in words(ax) and wide & {*words(ax)}
        (picture,) = ax.images
        coloured = np.ptp(picture.get_array().astype(int), axis=-1) > 60  # white and bed are not
        assert coloured.mean() > 0.1


@pytest.mark.parametrize("name", ["fig_1", "fig_2", "fig_3"])
def test_the_colours_of_the_water_are_told(drawn, name):
    assert "velocity along the tank, u [m/s]" in words(drawn[name])


def test_figure_4_tells_the_share_of_each_rank(drawn):
    axes = panels(drawn["fig_4"])
    wanted = [(method, time) for method in METHODS for time in CUTS]
    for ax, (method, time) in zip(axes, wanted, strict=True):
        text = ax.get_title(loc="left")
        assert text.startswith(method) and f"t = {time:.2f} s" in text
        assert ax.get_ylabel() == "z [m]"
        shares = [float(text.get_text()) for text in ax.texts]
        assert len(shares) == RANKS and sum(shares) == pytest.approx(100.0, abs=0.5)
        (discs,) = (one for one in ax.collections if one.get_array() is not None)
        assert len(np.unique(discs.get_array())) > RANKS // 2  # the beach is dry
    assert axes[-1].get_xlabel() == "x [m]"


def test_figure_5_has_a_line_for_each_method_in_both_panels(drawn, found):
    seconds, iterations = panels(drawn["fig_5"])
    assert titles([seconds, iterations]) == ["(a)", "(b)"]
    for ax, column in ((seconds, "seconds"), (iterations, "iterations")):
        lines = [line for line in ax.lines if not line.get_label().startswith("_")]
        assert [line.get_label() for line in lines] == [found[n].title for n in fig_5.RUNS]
        for name, line in zip(fig_5.RUNS, lines, strict=True):
            assert np.array_equal(line.get_ydata(), found[name].middle(column))
    assert seconds.get_ylabel() == "time of a step [s]"
    assert labels(iterations) == ("time step", "iterations of a step")
    assert {found[name].title for name in fig_5.RUNS} <= {*words(drawn["fig_5"])}


def test_table_1_tells_time_steps_and_times_beside_the_papers(drawn, found):
    (table,) = drawn["table_1"].axes[0].tables
    cells = {place: cell.get_text().get_text() for place, cell in table.get_celld().items()}
    head = [cells[0, column] for column in range(len(table_1.HEADER))]
    assert head == list(table_1.HEADER)
    assert sum("[s]" in text for text in head) == 5
    first = [cells[row, 0] for row in range(1, len(table_1.METHODS) + 2)]
    assert first == [found[name].title for name in (*table_1.METHODS, "standard")]


def test_table_1_adds_up(found):
    steps = found["cmps"].steps
    to_end = int((steps["time [s]"] <= table_1.END).sum())
    for name, row in zip(table_1.METHODS, table_1.rows(found), strict=False):
        count, net, each = (float(cell.replace(",", "")) for cell in row[3:6])
        assert count == to_end
        assert net == pytest.approx(each * count, rel=0.02)
        middle = found[name].middle("seconds")
        assert middle.min() - 6e-4 <= each <= middle.max() + 6e-4
    assert table_1.rows(found)[0][6] == "1.00"


def test_a_method_costs_between_the_medians_of_its_samples(tmp_path):
    rows = [(at, 10 * at + k, 0.0, 5, cost) for at, cost in ((1.0, 2.0), (3.0, 4.0))
            for k in (-1, 0, 1)]  # fmt: skip
    table = tmp_path / samples.TABLE
    write_table(table, samples.HEADER, [[f"{value:g}" for value in row] for row in rows])
    method = kept.Sampled(tmp_path, "method")
    assert method.middle("seconds").tolist() == [2.0, 4.0]
    assert method.over("seconds", np.array([1, 10, 20, 30, 99])).tolist() == [2, 2, 3, 4, 4]


def test_the_papers_times_a_step_follow_from_its_totals():
    assert list(map(table_1._papers, table_1.PAPER)) == [
        ("4,269", "250,481", "58.67", "1.00"),
        ("4,291", "90,010", "20.98", "0.36"),
        ("4,290", "90,215", "21.03", "0.36"),
        ("4,170", "79,272", "19.01", "0.32"),
    ]


# Agreement


def test_every_claim_is_judged_and_what_is_kept_is_todays(found, tmp_path):
    path = agreement.write(found, tmp_path)
    rows = json.loads(path.read_text(encoding="utf-8"))
    assert len(rows) == len(agreement.CLAIMS) >= 13
    for row in rows:
        assert list(row) == ["claim", "paper", "ours", "agrees", "note"]
        assert isinstance(row["agrees"], bool) and all(row[key] for key in ("claim", "ours"))
    kept_rows = json.loads((RESULTS / "agreement.json").read_text(encoding="utf-8"))
    assert kept_rows == rows


class Fake:
    """A run, and a method, with steps of a given cost."""

    def __init__(self, iterations, seconds, ranks=1):
        self.steps = {"step": np.arange(1, 101), "time [s]": np.linspace(0.0, 1.2, 100)}
        self.cost = {"iterations": iterations, "seconds": seconds}
        self.record = {"ranks": ranks, "machine": {"cores": 2, "cpu": "a processor"}}

    def over(self, column, steps):
        return np.full(len(steps), self.cost[column])


def test_claims_on_cost_turn_with_the_numbers():
    run = Fake(0, 0.0)
    assert agreement.iterations(Fake(10, 1.0), Fake(30, 1.0), run).agrees
    assert not agreement.iterations(Fake(10, 1.0), Fake(15, 1.0), run).agrees
    assert agreement.time_of_solvers(Fake(10, 1.0), Fake(30, 1.1), run).agrees
    assert not agreement.time_of_solvers(Fake(10, 1.0), Fake(30, 1.5), run).agrees
    assert agreement.saved(Fake(10, 1.0), Fake(10, 0.9), run).agrees
    assert not agreement.saved(Fake(10, 1.0), Fake(10, 1.0), run).agrees
    assert agreement.speedup(Fake(10, 3.0), Fake(10, 2.0, ranks=2), run).agrees
    assert not agreement.speedup(Fake(10, 2.5), Fake(10, 2.0, ranks=2), run).agrees


# The command line


def test_all_pictures_are_drawn_from_kept_results(tmp_path, capsys):
    assert command.main(["--quick", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    for name in command.FIGURES:
        assert (tmp_path / f"{name}.png").stat().st_size > 50_000
        assert f"{name}.png" in said


def test_an_unknown_name_is_refused(tmp_path, capsys):
    assert command.main(["--out", str(tmp_path), "--only", "fig_6"]) == 2
    assert "--only fig_6: must be out of fig_1, fig_2" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_figure_whose_runs_are_missing_is_named(tmp_path, capsys):
    results = tmp_path / "results"
    for name in ("iccg", "cmps"):
        shutil.copytree(RESULTS / name, results / name)
    line = ["--quick", "--out", str(tmp_path / "out"), "--results", str(results)]
    line += ["--only", "table_1"]
    assert command.main(line) == 1
    assert "table_1: not drawn, no results of piccg, scg" in capsys.readouterr().out
