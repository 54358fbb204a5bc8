"""The report of a validation says what the results hold."""

import re

import pytest
from results import README, breaker, dispersion, made, metric, save, undecided, written

from validation import browser, report


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return written(tmp_path_factory.mktemp("results"))


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "report.html").read_text(encoding="utf-8")


def text_of(page):
    """What the body says, its tags taken out."""
    body = page.partition("<body>")[2].partition("<script>")[0]
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", body)).replace("\u00a0", " ")


def test_verdict_counts_and_misses_stand_first(page):
    text = text_of(page)
    assert "6 of 9 criteria met" in text
    assert "3 missed: 1 listed with what is known of the cause, 2 not listed." in text
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
    found["metrics"] = [metric("k", "Wave number", "", None, 1.0, None) | {"verdict": "met"}]
    text = text_of(report.render([found], tmp_path))
    assert "0 of 1 criteria met" in text
    assert "Measured no value: see the notes of the case" in text


def test_without_a_miss_the_page_says_so(tmp_path):
    text = text_of(report.render([dispersion()], tmp_path))
    assert "2 of 2 criteria met None is missed." in text
    assert "Cause" not in text


def test_what_is_open_is_neither_met_nor_missed_and_shown_with_its_error(tmp_path):
    found = dispersion()
    found["metrics"] = [*found["metrics"], undecided()]
    page = report.render([found], tmp_path)
    text = text_of(page)
    assert "2 of 3 criteria met None is missed. 1 open: within two standard errors" in text
    assert (
        "Height lost over five wavelengths Band ≤ 4 % Measured 3.4 ± 0.58 %, mean of 3 seeds "
        "Scatter 1 from draw to draw: Six seeds gave 1.9 to 4.7."
    ) in text.partition("All criteria")[0]
    assert "3.4 ± 0.58 % mean of 3 seeds ○ open" in text
    assert "2 of 3 met, 1 open" in text


def test_a_listed_miss_that_is_open_says_that_it_is_listed(tmp_path):
    found = dispersion() | {"metrics": [undecided("the beach sends some back")]}
    text = text_of(report.render([found], tmp_path))
    assert "Listed as missed. the beach sends some back" in text


def test_result_without_verdicts_is_refused(tmp_path, capsys):
    found = dispersion()
    del found["metrics"][0]["verdict"]
    save([found], tmp_path)
    assert report.main([str(tmp_path)]) == 2
    assert "is not the result of a case (KeyError('verdict'))" in capsys.readouterr().err


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
