"""Numbers on the command line, names of cases and gauges, and how much a case may hold."""

import pytest

from mpslab import cases
from mpslab.core.keys import CaseError


def refusal(action, *arguments):
    """The message of the CaseError that an action raises; it must be one line."""
    with pytest.raises(CaseError) as caught:
        action(*arguments)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "value"),
    [(".005", 0.005), ("5.", 5.0), ("-.5e-3", -0.0005), ("+1e-3", 0.001), ("007", 7),
     ("[.1, 2.]", [0.1, 2.0]), ("[[0, 0.], [.8, .06]]", [[0, 0.0], [0.8, 0.06]]),
     ("1.2.3", "1.2.3"), ("2mm", "2mm"), ("1,5", "1,5")],
)  # fmt: skip
def test_setting_takes_numbers_as_python_writes_them(text, value):
    assert cases.parse_set(f"scheme.gamma={text}") == ("scheme.gamma", value)


@pytest.mark.parametrize("value", ["9" * 5000, "0x" + "f" * 5000])
def test_setting_of_a_number_of_thousands_of_digits_is_refused(value):
    key, value = cases.parse_set(f"particles.seed={value}")
    message = refusal(cases.load_case, "hydrostatic", {key: value})
    assert message.startswith("particles.seed = ") and "must be a whole number" in message


@pytest.mark.parametrize(
    ("stem", "name"),
    [("dam [1]", "dam 1"), ("a,b;c#d", "a b c d"), ("#", "case"), ("x" * 200, "x" * 80)],
)
def test_name_of_a_file_becomes_one_that_a_case_may_have(tmp_path, stem, name):
    path = tmp_path / f"{stem}.toml"
    path.write_text(cases.text("hydrostatic").replace('name = "hydrostatic"\n', ""))
    assert cases.load_case(path).name == name


def test_name_too_long_for_a_folder_is_refused():
    message = refusal(cases.load_case, "hydrostatic", {"name": "x" * 81})
    assert "of at most 80 characters" in message


def test_gauge_with_the_heading_of_the_times_is_refused():
    part = "gauge.0.name = 'time': must be another word than that of the column of times"
    assert part in refusal(cases.load_case, "dam_break", {"gauge": [{"name": "time", "x": 0.1}]})


@pytest.mark.parametrize("name", ["water", "obstacle", "gate", "gauge", "probe", "tank.bed"])
def test_more_entries_than_any_tank_has_are_refused(name):
    entry = {"water": {"from": [0, 0, 0], "to": [1, 1, 1]}, "gate": {"x": 0.1, "speed": 1.0},
             "gauge": {"name": "a", "x": 0}, "probe": {"name": "a", "x": 0, "z": 0}}  # fmt: skip
    entries = [entry.get(name, entry["water"])] * 2001
    if name == "tank.bed":
        entries = [[i / 2000, 0] for i in range(2001)]
    message = refusal(cases.load_case, "dam_break", {name: entries})
    assert f"{name} has 2,001 entries: must have at most" in message


def test_file_too_large_for_a_case_is_refused(tmp_path):
    path = tmp_path / "large.toml"
    path.write_text("#" * 1_000_001)
    assert "must be a file of at most 1 MB" in refusal(cases.load_case, path)
