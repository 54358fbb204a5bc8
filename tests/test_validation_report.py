"""The report of a validation says what the results hold, and works in a browser and on paper."""

import base64
import io
import json
import re

import numpy as np
import pytest
from devtools import open_tab
from matplotlib.figure import Figure
from matplotlib.image import imread

from validation import browser, figures, report, words

README = """\
# Standing wave

A wave of the first mode in a closed tank, left to itself. The theory of **potential flow** gives
its period and, with the boundary layers left out, no damping at all.

## Set-up of the tank

| quantity | value |
|---|---|
| length | 0.5 m |
| depth | 0.1 m |

See [Lamb, *Hydrodynamics*](https://en.wikipedia.org/wiki/Hydrodynamics_(book)), and run it with

    python -m mpslab.tank standing_wave --set particles.spacing=0.002
"""


def metric(name, title, unit, low, high, value, known=None):
    passed = value is not None and (low is None or value >= low) and (high is None or value <= high)
    reason = "The scatter of three seeds is 0.015, and the bar stands two such below the mean."
    return {"id": name, "title": title, "unit": unit, "low": low, "high": high, "value": value,
            "passed": passed, "reason": reason, "known": known}  # fmt: skip


def run(name, case, particles, steps, seconds, outcome="finished", reason=None, **changes):
    changes = {key.replace("__", "."): value for key, value in changes.items()}
    return {"name": name, "case": case, "changes": changes, "particles": particles, "steps": steps,
            "seconds": seconds, "outcome": outcome, "reason": reason}  # fmt: skip


def series(label, style, x, y, y2=None):
    columns = {"x": x, "y": y} | ({} if y2 is None else {"y2": y2})
    return {"label": label, "style": style, **{k: list(map(float, c)) for k, c in columns.items()}}


def result(case, title, question, **parts):
    empty = dict.fromkeys(("runs", "metrics", "figures", "tables", "convergence", "notes"), ())
    provenance = {
        "versions": {"mpslab": "0.1.0", "python": "3.11.2", "numpy": "2.4.6", "scipy": "1.17.1"},
        "machine": {"platform": "Linux-6.1-x86_64", "cpu": "Intel(R) Xeon(R) CPU", "cores": 2},
        "commit": "dd1eca4a5b0f8a3c9e7d1b2f4a6c8e0d1f3b5a79-dirty",
        "date": "2026-11-25T10:00:00+00:00",
        "seconds": 812.0,
    }
    return {"case": case, "title": title, "question": question, "suite": "full", "readme": README,
            **{name: list(part) for name, part in empty.items()}, **parts,
            "provenance": provenance}  # fmt: skip


def standing_wave():
    t = np.linspace(0.0, 2.0, 400)
    wave = np.cos(2 * np.pi * t)
    return result(
        "standing_wave",
        "Standing wave",
        "Does a wave live, and with the right period?",
        runs=[
            run("a01_d4", "standing_wave", 980, 870, 4.2, particles__spacing=0.004),
            run("a01_d2", "standing_wave", 3900, 1750, 31.0, particles__spacing=0.002),
            run("a01_d1", "standing_wave", 15600, 3490, 412.0, particles__spacing=0.001,
                initial__amplitude=0.01),
        ],
        metrics=[
            metric("kept", "First mode kept after two periods", "", 0.85, None, 0.97512),
            metric("period", "Period against linear theory", "", 0.98, 1.02, 1.00712),
            metric("level", "Drift of the mean level", "mm", -0.5, 0.5, -0.24),
        ],
        figures=[
            {"title": "First mode, amplitude 0.1 of the depth", "x": "t/T", "equal": False,
             "y": "amplitude / linear amplitude",
             "series": [
                 series("potential flow ± 5 %", "band", t, 0.95 * wave - 0.03, 0.95 * wave + 0.03),
                 series("mpslab, d0 = 4 mm", "line", t, wave * np.exp(-0.12 * t)),
                 series("mpslab, d0 = 2 mm", "line", t, wave * np.exp(-0.03 * t)),
                 series("linear theory", "dashed", t, wave)]},
            {"title": "Mean level", "x": "t/T", "y": "level [mm]", "equal": False,
             "series": [series("mpslab, d0 = 2 mm", "line", t, 0.24 * t / 2 + 0.02 * wave)]},
        ],
        convergence=[{"title": "Error of the first mode", "spacing": [0.004, 0.002, 0.001],
                      "error": [0.1, 0.031, 0.0095], "order": 1.7}],
        notes=["Three seeds of the jitter differ by 0.015 at most."],
    )  # fmt: skip


def breaker():
    t = np.linspace(0.0, 3.0, 800)
    level = 10 * np.maximum(np.sin(4 * t), -0.6) * np.minimum(t, 1.0)
    noise = np.sin(977 * t) + np.sin(541 * t)
    x = np.linspace(0.0, 1.96, 150)
    return result(
        "plunging_breaker",
        "Plunging breaker",
        "Does the wave break where and when the experiment saw it?",
        runs=[
            run("d4", "plunging_breaker", 9120, 3000, 188.0, particles__spacing=0.004),
            run("d2", "plunging_breaker", 36480, 6012, 4810.0, "failed",
                "particle 12345 left the tank at t = 1.31 s, x = 0.57 m", particles__spacing=0.002),
        ],
        metrics=[
            metric("jet_x", "Place of the first jet", "m", 0.55, 0.60, 0.583),
            metric("jet_t", "Time of the first jet", "s", 1.04, 1.14, 0.925,
                   "The paddle starts without the experiment's delay of 0.15 s."),
            metric("height", "Height of the second wave at the toe", "mm", 18.6, 20.6, None),
            metric("rmse", "RMSE of the level at the toe", "mm", None, 1.5, 1.50004),
        ],
        figures=[
            {"title": "Water level at the toe", "x": "time [s]", "y": "level [mm]", "equal": False,
             "series": [series("experiment", "points", t[::20], level[::20] + 0.4 * noise[::20]),
                        series("mpslab, d0 = 4 mm", "line", t, level)]},
            {"title": "Every reading", "x": "time [s]", "y": "level [mm]", "equal": False,
             "series": [series("experiment", "points", t, level + noise),
                        series("mpslab, d0 = 4 mm", "line", t, level)]},
            {"title": "Surface at t = 1.05 s", "x": "x [m]", "y": "z [m]", "equal": True,
             "series": [series("mpslab", "line", x, 0.2 + 0.03 * np.exp(-(((x - 1) / 0.1) ** 2))),
                        series("bed", "dashed", [0, 0.6, 1.96], [0, 0, 0.24])]},
            {"title": "The jet", "picture": "jet.png"},
        ],
        tables=[{"title": "Errors at the gauges",
                 "columns": ["gauge", "RMSE [mm]", "bias [mm]", "phase [s]", "peak [mm]"],
                 "rows": [["toe", 0.4, -0.1, 0.004, 0.3], ["shoreline", 1.93, 0.42, -0.012, 2.1]]}],
    )  # fmt: skip


def dispersion():
    return result(
        "dispersion",
        "Dispersion relation",
        "Do the wavemakers hold the theory that they are made of?",
        metrics=[
            metric("k", "Largest error of the wave number", "", None, 1e-10, 3.1e-13),
            metric("same", "Bits that differ from run to run", "", 0, 0, 0),
        ],
    )


def made():
    return [standing_wave(), breaker(), dispersion()]


def save(results, folder):
    """Results as JSON files, and the picture that one of them names."""
    for number, found in enumerate(results):
        text = json.dumps(found | {"order": number})
        (folder / f"{found['case']}.json").write_text(text)
    picture = Figure(figsize=(6, 2))
    picture.subplots().plot([0, 1], [1, 0])
    picture.savefig(folder / "jet.png")
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = save(made(), tmp_path_factory.mktemp("results"))
    report.write(made(), folder)
    return folder


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "report.html").read_text(encoding="utf-8")


def text_of(page):
    """What the body says, its tags taken out."""
    body = page.partition("<body>")[2].partition("<script>")[0]
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", body)).replace("\u00a0", " ")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.97512, "0.9751"),
        (0.5, "0.5"),
        (100.0, "100"),
        (0.0, "0"),
        (-0.24, "−0.24"),
        (99.996, "100"),
        (123456.0, "123\u202f500"),
        (1234.5, "1234"),
        (3.1e-13, "3.1 × 10⁻¹³"),
        (-2.5e7, "−2.5 × 10⁷"),
        (15600, "15\u202f600"),
        (3900, "3900"),
        ("toe", "toe"),
        (None, "–"),
        (float("nan"), "not a number"),
    ],
)
def test_numbers_are_printed_to_four_digits(value, text):
    assert words.number(value) == text


@pytest.mark.parametrize(
    ("low", "high", "unit", "text"),
    [
        (0.85, 1.05, "", "0.85 to 1.05"),
        (0.85, None, "", "≥ 0.85"),
        (None, 0.05, "m/s", "≤ 0.05\u00a0m/s"),
        (-0.5, 0.5, "mm", "−0.5 to 0.5\u00a0mm"),
        (0, 0, "", "= 0"),
        (None, None, "", "any"),
    ],
)
def test_bands_say_what_is_allowed(low, high, unit, text):
    assert words.band({"low": low, "high": high, "unit": unit}) == text


@pytest.mark.parametrize(("value", "text"), [(1.50004, "1.50004"), (1.5, "1.5"), (1.2, "1.2")])
def test_measured_value_shows_on_which_side_of_the_band_it_lies(value, text):
    assert words.measured(metric("m", "", "mm", None, 1.5, value)) == f"{text}\u00a0mm"


def test_times_are_printed_in_words():
    spans = [words.duration(seconds) for seconds in (4.21, 31.0, 744.0, 11520.0)]
    assert spans == ["4.21\u00a0s", "31\u00a0s", "12.4\u00a0min", "3.2\u00a0h"]
    assert words.date("2026-11-25T10:00:00+00:00") == "25 November 2026, 10:00 UTC"


def test_verdict_counts_and_misses_stand_first(page):
    text = text_of(page)
    assert "6 of 9 criteria met" in text
    assert "3 missed: 1 with a known cause, 2 without." in text
    places = [text.index(word) for word in ("Time of the first jet", "RMSE of the level",
                                            "First mode kept", "All criteria")]  # fmt: skip
    assert places[0] < places[1] < places[3] < places[2]


def test_miss_says_band_value_and_cause(page):
    text = text_of(page)
    assert (
        "Plunging breaker : Time of the first jet Band 1.04 to 1.14 s Measured 0.925 s "
        "Cause The paddle starts without the experiment's delay of 0.15 s."
    ) in text.replace("&#39;", "'")
    assert "Band ≤ 1.5 mm Measured 1.50004 mm Cause not known yet" in text


def test_failed_run_is_a_miss_with_its_reason(page):
    assert (
        "Height of the second wave at the toe Band 18.6 to 20.6 mm Measured no value: run d2 "
        "failed: particle 12345 left the tank at t = 1.31 s, x = 0.57 m Cause not known yet"
    ) in text_of(page)


def test_value_that_is_missing_is_a_miss_whatever_the_judge_said(tmp_path):
    found = dispersion()
    found["metrics"] = [metric("k", "Wave number", "", None, 1.0, None) | {"passed": True}]
    text = text_of(report.render([found], tmp_path))
    assert "0 of 1 criteria met" in text
    assert "Measured no value: see the notes of the case" in text


def test_without_a_miss_the_page_says_so(tmp_path):
    text = text_of(report.render([dispersion()], tmp_path))
    assert "2 of 2 criteria met None is missed." in text
    assert "Cause" not in text


def test_pass_and_miss_are_words(page):
    rows = re.findall(r"<tr>.*?</tr>", page.partition('id="criteria"')[2], re.DOTALL)[:10]
    told = [re.sub(r"<[^>]+>", " ", row).split()[-1] for row in rows[1:]]
    assert told == ["pass"] * 4 + ["miss"] * 3 + ["pass"] * 2


def test_case_section_holds_all_that_was_found(page):
    text = text_of(page)
    for told in (
        "Does a wave live, and with the right period?",
        "a01_d1 standing_wave particles.spacing = 0.001 initial.amplitude = 0.01 15 600 3490 "
        "6.9 min finished",
        "Set-up of the tank quantity value length 0.5 m",
        "Error of the first mode, observed order 1.7",
        "Errors at the gauges gauge RMSE [mm] bias [mm] phase [s] peak [mm] toe 0.4 −0.1 0.004 0.3",
        "Three seeds of the jitter differ by 0.015 at most.",
        "No simulation: this case is computed directly.",
        "Intel(R) Xeon(R) CPU, 2 cores",
        "mpslab 0.1.0, python 3.11.2",
        "dd1eca4a5b-dirty",
        "python -m validation --full",
    ):
        assert told in text.replace("&#39;", "'"), told


def test_readme_becomes_html_under_the_headings_of_the_page():
    html = report.prose(README)
    assert "<strong>potential flow</strong>" in html
    assert "<h4>Set-up of the tank</h4>" in html
    assert "<table>" in html
    assert "Standing wave</h" not in html


def test_texts_are_escaped(tmp_path):
    found = dispersion() | {"title": "<script>alert(1)</script>", "notes": ["p < 0 & more"]}
    page = report.render([found], tmp_path)
    assert "<script>alert" not in page
    assert "p &lt; 0 &amp; more" in page


def test_page_loads_nothing(page):
    tags = re.findall(r"<(?:img|script|link|iframe|source|object|embed)\b[^>]*>", page)
    sources = [u for tag in tags for u in re.findall(r"(?:src|href|data)=\"([^\"]*)\"", tag)]
    assert len(sources) == 7
    assert all(source.startswith("data:image/") for source in sources)
    assert "url(" not in page
    assert "@import" not in page
    assert "default-src 'none'" in page


def test_picture_that_is_not_there_is_told(tmp_path):
    assert "The picture is not among the results." in report.render([breaker()], tmp_path)


def test_report_drawn_again_has_the_same_bytes(folder, page, tmp_path, monkeypatch, capsys):
    save(made(), tmp_path)
    monkeypatch.setattr(browser, "find", lambda: None)
    assert report.main([str(tmp_path)]) == 0
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == page
    said = capsys.readouterr()
    assert said.out == f"Report: {tmp_path / 'report.html'}\n"
    assert "no PDF: no browser" in said.err


def test_old_pdf_does_not_outlive_its_page(tmp_path, monkeypatch):
    (tmp_path / "report.pdf").write_text("of an earlier run")
    monkeypatch.setattr(browser, "find", lambda: "/bin/false")
    assert report.write([dispersion()], tmp_path) == [tmp_path / "report.html"]
    assert not (tmp_path / "report.pdf").exists()


@pytest.mark.parametrize("text", [None, "{", "[]", '{"case": "x"}'])
def test_folder_without_results_is_refused(tmp_path, text, capsys):
    if text:
        (tmp_path / "x.json").write_text(text)
    assert report.main([str(tmp_path)]) == 2
    assert str(tmp_path) in capsys.readouterr().err
    assert not (tmp_path / "report.html").exists()


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


with_browser = pytest.mark.skipif(not browser.find(), reason="no browser is installed")


@pytest.fixture(scope="module")
def tab():
    with open_tab() as tab:
        yield tab


@pytest.fixture
def opened(tab, folder):
    """The report, just opened on a desk."""
    tab.events.clear()
    tab.load((folder / "report.html").as_uri(), width=1280)
    return tab


SHOWN = "[...document.querySelectorAll('#criteria tbody tr')].filter((row) => !row.hidden)"


def column(tab, number):
    """Texts of a column of the table, of the rows that are shown."""
    return tab.evaluate(f"{SHOWN}.map((row) => row.cells[{number}].textContent.trim())")


def click(tab, heading):
    """Click a heading of the table; returns the aria-sort of all."""
    tab.evaluate(f"document.querySelectorAll('#criteria th button')[{heading}].click()")
    return sorts(tab)


def sorts(tab):
    return tab.evaluate(
        "[...document.querySelectorAll('#criteria th')].map((th) => th.getAttribute('aria-sort'))"
    )


@with_browser
def test_page_opens_without_network_and_without_errors(opened):
    asked = [
        event["params"]["request"]["url"]
        for event in opened.events
        if event["method"] == "Network.requestWillBeSent"
    ]
    assert [url for url in asked if not url.startswith(("data:", "file:"))] == []
    assert sum(url.startswith("file:") for url in asked) == 1, "the page itself"
    bad = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")
    assert [event for event in opened.events if event["method"] in bad] == []


@with_browser
def test_pictures_are_there(opened):
    widths = opened.evaluate("[...document.images].map((image) => image.naturalWidth)")
    assert len(widths) == 7
    assert min(widths) > 200


@with_browser
def test_table_sorts_by_number_and_back(opened):
    assert sorts(opened) == ["ascending", None, None, None, None]
    assert click(opened, 3) == [None, None, None, "ascending", None]
    values = column(opened, 3)
    assert values[:3] == ["−0.24\u00a0mm", "0", "3.1 × 10⁻¹³"]
    assert values[-1] == "no value"
    assert click(opened, 3) == [None, None, None, "descending", None]
    assert column(opened, 3)[0] == "1.50004\u00a0mm"
    assert column(opened, 3)[-1] == "no value"
    click(opened, 0)
    cases = column(opened, 0)
    assert cases[:3] + cases[-1:] == ["Standing wave"] * 3 + ["Dispersion relation"]


@with_browser
def test_table_sorts_from_the_keyboard(opened):
    opened.evaluate("document.querySelectorAll('#criteria th button')[4].focus()")
    opened.press("Enter")
    assert sorts(opened)[4] == "ascending"
    assert [text.split()[-1] for text in column(opened, 4)][:4] == ["miss"] * 3 + ["pass"]


@with_browser
def test_headings_are_reached_by_tab(opened):
    opened.evaluate("document.querySelectorAll('#criteria th button')[0].focus()")
    opened.press("Tab")
    assert opened.evaluate("document.activeElement.textContent") == "Criterion"


@with_browser
def test_table_filters_by_miss_and_by_text(opened):
    opened.evaluate("document.querySelector('input[value=missed]').click()")
    assert len(column(opened, 0)) == 3
    typed = (
        "{const box = document.querySelector('input[type=search]'); box.value = 'JET';"
        "box.dispatchEvent(new Event('input', {bubbles: true}))}"
    )
    opened.evaluate(typed)
    assert column(opened, 1) == ["Time of the first jet"]
    assert opened.evaluate("document.querySelector('output').textContent") == "1 of 9 shown"
    opened.evaluate("document.querySelector('input[value=all]').click()")
    assert column(opened, 1) == ["Place of the first jet", "Time of the first jet"]


@with_browser
def test_paper_shows_all_rows_and_no_controls(opened):
    opened.evaluate("document.querySelector('input[value=missed]').click()")
    assert len(column(opened, 0)) == 3
    opened.call("Emulation.setEmulatedMedia", media="print")
    seen = opened.evaluate(
        "[...document.querySelectorAll('#criteria tbody tr')]"
        ".filter((row) => row.getClientRects().length).length"
    )
    control = opened.evaluate("getComputedStyle(document.querySelector('.filter')).display")
    opened.call("Emulation.setEmulatedMedia", media="")
    assert (seen, control) == (9, "none")


@with_browser
@pytest.mark.parametrize("width", [320, 390, 800])
def test_page_does_not_scroll_sideways(tab, folder, width):
    tab.load((folder / "report.html").as_uri(), width=width)
    page = "document.documentElement"
    assert tab.evaluate(f"{page}.scrollWidth - {page}.clientWidth") == 0
    assert tab.evaluate("window.innerWidth") == width, "a phone zooms out to what is too wide"


@with_browser
def test_pdf_has_pages(folder):
    pdf = (folder / "report.pdf").read_bytes()
    assert pdf.startswith(b"%PDF")
    assert len(re.findall(rb"/Type\s*/Page\b", pdf)) >= 5
