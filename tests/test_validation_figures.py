"""Figures of the report."""

import base64
import io

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from results import breaker, standing_wave

from validation import figures


def test_figure_shows_each_series_in_its_style():
    ax = figures.draw(standing_wave()["figures"][0]).axes[0]
    fine, coarse, theory = ax.lines
    assert [line.get_linestyle() for line in (fine, coarse)] == ["-", "-"]
    assert theory.is_dashed()
    assert fine.get_color() != coarse.get_color()
    assert len(ax.collections) == 1, "the band"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("t/T", "amplitude / linear amplitude")


def test_points_are_markers_and_gaps_stay_gaps():
    data = {"label": "gauge", "style": "points", "x": [0, 1, 2], "y": [1.0, None, 2.0]}
    figure = {"title": "", "x": "time [s]", "y": "level [mm]", "equal": False, "series": [data]}
    (points,) = figures.draw(figure).axes[0].lines
    assert points.get_marker() == "o"
    assert points.get_linestyle() == "None"
    assert np.isnan(points.get_ydata()).tolist() == [False, True, False]


def test_equal_figure_has_equal_scales():
    ax = figures.draw(breaker()["figures"][2]).axes[0]
    assert ax.get_aspect() == 1.0


def test_convergence_is_drawn_with_its_slope():
    ax = figures.draw_convergence(standing_wave()["convergence"][0]).axes[0]
    points, line = ax.lines
    assert points.get_xdata().tolist() == [4.0, 2.0, 1.0]
    slope = np.diff(np.log(line.get_ydata())) / np.diff(np.log(line.get_xdata()))
    assert slope == pytest.approx(1.7)
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")


@pytest.mark.parametrize("equal", [False, True])
@pytest.mark.parametrize("series", [[], [{"label": "a", "style": "line", "x": [], "y": []}]])
def test_figure_without_data_is_drawn_all_the_same(series, equal):
    figure = {"title": "", "x": "x [m]", "y": "z [m]", "equal": equal, "series": series}
    assert figures.data_url(figures.draw(figure)).startswith("data:")


@pytest.mark.parametrize(("error", "order"), [([0.1, 0.0], None), ([0.1, None], float("nan"))])
def test_convergence_without_an_order_shows_the_errors_alone(error, order):
    entry = {"title": "", "spacing": [0.004, 0.002], "error": error, "order": order}
    drawn = figures.draw_convergence(entry)
    (points,) = drawn.axes[0].lines
    assert points.get_ydata().tolist() == [0.1]
    assert figures.data_url(drawn).startswith("data:")


def test_picture_keeps_its_size_and_takes_less_room():
    picture = Figure(figsize=(6, 4), dpi=150)
    picture.subplots().imshow(np.random.default_rng(1).random((60, 90)), cmap="viridis")
    buffer = io.BytesIO()
    picture.savefig(buffer)
    url = figures.picture_url(buffer.getvalue())
    small = base64.b64decode(url.removeprefix("data:image/png;base64,"))
    assert imread(io.BytesIO(small)).shape[:2] == (600, 900)
    assert len(small) < 0.7 * len(buffer.getvalue())


def test_large_figure_becomes_a_png():
    few, many = (figures.data_url(figures.draw(breaker()["figures"][k])) for k in (0, 1))
    assert few.startswith("data:image/svg+xml")
    assert many.startswith("data:image/png")
    assert len(many) < 150_000
