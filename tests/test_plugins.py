"""Finding models by file name."""

import sys
from types import ModuleType

import pytest

from mpslab.core import plugins


@pytest.fixture
def shapes(monkeypatch, tmp_path):
    """A family mpslab.shapes with two models and a helper."""
    for name in ("circle", "square", "_helper"):
        (tmp_path / f"{name}.py").write_text(f"label = {name!r}\n")
    package = ModuleType("mpslab.shapes")
    package.__path__ = [str(tmp_path)]
    monkeypatch.setitem(sys.modules, "mpslab.shapes", package)
    monkeypatch.setitem(plugins.KEYS, "shapes", "scheme.shape")
    yield tmp_path
    for name in ("circle", "square", "triangle"):
        sys.modules.pop(f"mpslab.shapes.{name}", None)


def test_names_are_sorted_and_leave_helpers_out(shapes):
    assert plugins.names("shapes") == ("circle", "square")


def test_new_file_is_a_new_model(shapes):
    (shapes / "triangle.py").write_text("label = 'new'\n")
    assert plugins.names("shapes") == ("circle", "square", "triangle")
    assert plugins.load("shapes", "triangle").label == "new"


def test_load_gives_the_module_of_that_name(shapes):
    assert plugins.load("shapes", "circle").label == "circle"
    assert plugins.load("shapes", "square").label == "square"


def test_unknown_name_lists_the_choices_and_the_nearest(shapes):
    with pytest.raises(ValueError) as caught:
        plugins.load("shapes", "squrae")
    assert str(caught.value) == (
        "scheme.shape = 'squrae': unknown; choose one of circle, square; did you mean 'square'?"
    )


@pytest.mark.parametrize("name", ["zzz", "", 3, "_helper", "../circle"])
def test_name_far_from_all_others_gets_no_suggestion(shapes, name):
    with pytest.raises(ValueError, match=r"unknown; choose one of circle, square") as caught:
        plugins.load("shapes", name)
    assert "\n" not in str(caught.value)


def test_wavemakers_are_all_found():
    expected = {"still", "linear", "second_order", "cnoidal", "solitary", "file", "irregular",
                "focused", "bichromatic", "stream_function"}  # fmt: skip
    assert expected <= set(plugins.names("wavemakers"))


def test_unknown_wavemaker_names_the_key_of_the_case():
    with pytest.raises(ValueError, match=r"^wavemaker\.type = 'soltary'.*'solitary'\?$"):
        plugins.load("wavemakers", "soltary")
