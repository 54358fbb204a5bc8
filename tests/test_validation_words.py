"""Numbers, bands and times as the report prints them."""

import pytest
from results import metric

from validation import words


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


@pytest.mark.parametrize(
    ("draws", "error", "text"),
    [([1.2], 0.0, ""), ([1.2], 0.1, ""), ([1.1, 1.3], 0.1, "mean of 2 seeds"),
     ([1.2, 1.0], 0.0, "worst of 2 seeds")],
)  # fmt: skip
def test_value_of_several_draws_says_what_it_is(draws, error, text):
    assert words.drawn(metric("m", "", "mm", None, 1.5, 1.2, draws=draws, error=error)) == text


def test_standard_error_stands_behind_the_value():
    found = metric("m", "", "mm", None, 1.5, 1.2, error=0.0577)
    assert words.measured(found) == "1.2 ± 0.058\u00a0mm"


def test_times_are_printed_in_words():
    spans = [words.duration(seconds) for seconds in (4.21, 31.0, 744.0, 11520.0)]
    assert spans == ["4.21\u00a0s", "31\u00a0s", "12.4\u00a0min", "3.2\u00a0h"]
    assert words.date("2026-11-25T10:00:00+00:00") == "25 November 2026, 10:00 UTC"
