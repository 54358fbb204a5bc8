"""The list of keys is that of the parameters, and the page in docs is what the program prints."""

import dataclasses
from pathlib import Path

import pytest

from mpslab import tank
from mpslab.core.keys import toml_name
from mpslab.core.parameters import LISTS, TABLES

PAGE = Path(__file__).parents[1] / "docs" / "keys.md"


def printed(capsys, *arguments):
    assert tank.main(["--keys", *arguments]) == 0
    return capsys.readouterr().out


def test_the_page_of_keys_is_what_the_program_prints(capsys):
    assert PAGE.read_text(encoding="utf-8") == printed(capsys)


@pytest.mark.parametrize("name", [*TABLES, *LISTS])
def test_every_key_of_a_table_is_listed_with_unit_and_default(capsys, name):
    words = " ".join(printed(capsys, name).split())
    for item in dataclasses.fields((TABLES | LISTS)[name]):
        _, _, after = words.partition(f"- `{toml_name(item)}`: ")
        entry = after.partition(" - `")[0]
        assert item.metadata["doc"][1:] in entry, item.name
        required = item.default is dataclasses.MISSING
        assert ("default" in entry or "may be left out" in entry) != required, item.name
        assert item.metadata["choices"][0] in entry if "choices" in item.metadata else True
        if item.metadata["unit"]:
            assert f"[{item.metadata['unit']}]" in entry, item.name


def test_models_and_what_recipes_change_are_listed(capsys):
    words = " ".join(printed(capsys, "scheme").split())
    assert 'cmps, cmps_soft, corrected, gc, mps, symmetric; default `"corrected"`' in words
    assert 'with recipe paper `"cmps_soft"`' in words
    assert "one of standard, paper" in words


def test_an_unknown_table_is_refused_with_the_nearest(capsys):
    assert tank.main(["--keys", "wavemakr"]) == 2
    shown = capsys.readouterr()
    assert shown.out == "" and shown.err.count("\n") == 1
    assert "did you mean wavemaker?" in shown.err
