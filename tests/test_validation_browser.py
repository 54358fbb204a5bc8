"""The report works in a browser and on paper."""

import re

import pytest
from devtools import open_tab
from results import written

from validation import browser

with_browser = pytest.mark.skipif(not browser.find(), reason="no browser is installed")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return written(tmp_path_factory.mktemp("results"))


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
    opened.evaluate("document.querySelector('input[value=open]').click()")
    assert column(opened, 0) == []
    opened.evaluate("document.querySelector('input[value=missed]').click()")
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
