"""Verdicts of the validation: no draw of a chaotic quantity can tip one, what is clear does."""

from dataclasses import replace

import numpy as np
import pytest

from validation import __main__ as command
from validation import judge, result, suite
from validation.comparison import Comparison
from validation.suite import Criterion, PlannedRun
from validation.work import Outcome, Task

SMOOTH = Criterion("a", "A", "because.", "", 0.0, 1.0)
CHAOTIC = replace(SMOOTH, scatter=0.1, scatter_from="Six seeds.")
KNOWN = {"made": {"a": {"suites": ["quick"], "value": 2.0, "cause": "the piston leaks"}}}
DRAWS = 20_000


def judged(values, known=None, criterion=CHAOTIC):
    """Results of a case with one criterion that the draws gave some values."""
    case = suite.ValidationCase("made", "Made", "Is it?", 1, "", (), (criterion,))
    metrics = judge.judge(case, "quick", [{"a": value} for value in values], known or {})
    return [{"case": "made", "title": "Made", "metrics": metrics}]


def verdict(values, criterion=CHAOTIC):
    return judged(values, criterion=criterion)[0]["metrics"][0]["verdict"]


@pytest.mark.parametrize("value, word", [(0.5, "met"), (1.0, "met"), (1.0001, "missed")])
def test_what_is_not_chaotic_is_met_or_missed(value, word):
    assert verdict([value], SMOOTH) == word


def test_what_is_not_chaotic_must_be_met_in_every_draw():
    assert verdict([0.5, 0.6, 1.1], SMOOTH) == "missed"
    (metric,) = judged([0.5, 1.1, 0.6], criterion=SMOOTH)[0]["metrics"]
    assert (metric["value"], metric["error"], metric["draws"]) == (1.1, 0.0, [0.5, 1.1, 0.6])


def test_mean_within_two_standard_errors_of_an_edge_is_open():
    error = 0.1 / np.sqrt(3.0)
    for edge, inward in ((0.0, 1.0), (1.0, -1.0)):
        for far, word in ((2.1, "met"), (1.9, "open"), (-1.9, "open"), (-2.1, "missed")):
            middle = edge + inward * far * error
            assert verdict([middle - 0.1, middle, middle + 0.1]) == word, (edge, far)


def test_single_draw_has_the_whole_scatter():
    assert [verdict([value]) for value in (0.79, 0.81, 1.19, 1.21)] == [
        "met", "open", "open", "missed"
    ]  # fmt: skip


def test_draws_of_the_same_bits_are_one():
    assert verdict([0.85, 0.85, 0.85]) == "open"
    assert verdict([0.84, 0.85, 0.86]) == "met"


@pytest.mark.parametrize("count", [1, 3])
def test_no_draw_around_an_edge_fails_and_hardly_any_mean_does(count):
    """A mean on the edge itself fails once in forty times, one that was listed as missed never."""
    random = np.random.default_rng(0)
    edge = random.normal(1.0, 0.1, (DRAWS, count))
    words = [judge.verdict(CHAOTIC, *judge.estimate(CHAOTIC, values)) for values in edge]
    assert words.count("missed") / DRAWS == pytest.approx(0.023, abs=0.005)
    assert words.count("met") / DRAWS == pytest.approx(0.023, abs=0.005)
    error = 0.1 / np.sqrt(count)
    inside = random.normal(1.0 - 2.0 * error, 0.1, (DRAWS, count))
    words = [judge.verdict(CHAOTIC, *judge.estimate(CHAOTIC, values)) for values in inside]
    assert words.count("missed") / DRAWS < 0.0005


def test_one_draw_in_the_wrong_place_does_not_tip_a_mean():
    assert verdict([0.80, 0.82, 1.05]) != "missed"
    assert not judge.unexpected(judged([0.80, 0.82, 1.05]))


def test_one_draw_gone_wild_does_not_excuse_itself():
    assert verdict([0.5, 0.5, 9.0]) == "missed"


@pytest.mark.parametrize("known", [None, KNOWN])
def test_mean_that_is_clearly_off_is_missed(known):
    assert verdict([1.2, 1.3, 1.25]) == "missed"
    assert bool(judge.unexpected(judged([1.2, 1.3, 1.25], known))) is (known is None)


@pytest.mark.parametrize("values", [[np.nan], [np.inf], [0.5, np.nan, 0.5]])
@pytest.mark.parametrize("criterion", [SMOOTH, CHAOTIC])
def test_draw_without_a_value_is_a_miss(values, criterion):
    (metric,) = judged(values, criterion=criterion)[0]["metrics"]
    assert (metric["value"], metric["verdict"]) == (None, "missed")


def test_a_miss_that_is_not_known_is_a_surprise():
    results = judged([2.0], criterion=SMOOTH)
    assert judge.with_verdict(results, "missed")
    assert "made.a is missed (2) and not among the known misses" in judge.unexpected(results)[0]


def test_a_known_miss_is_a_miss_and_no_surprise():
    results = judged([2.0], KNOWN, SMOOTH)
    assert judge.with_verdict(results, "missed")
    assert not judge.unexpected(results)


def test_a_known_miss_that_is_clearly_met_must_be_unlisted():
    for values, criterion in (([0.5], SMOOTH), ([0.5, 0.6, 0.7], CHAOTIC), ([0.7], CHAOTIC)):
        assert "take it off" in judge.unexpected(judged(values, KNOWN, criterion))[0]


def test_what_is_open_surprises_nobody_listed_or_not():
    for value in (0.85, 1.15):
        assert not judge.unexpected(judged([value]))
        assert not judge.unexpected(judged([value], KNOWN))


def test_a_known_miss_that_is_clearly_worse_is_a_surprise():
    """Farther off than two standard errors of the new value and two of the listed one."""
    for values, surprises in (([2.35], 0), ([2.45], 1), ([2.1, 2.2, 2.3], 0), ([2.2, 2.3, 2.4], 1),
                              ([1.5], 0), ([np.nan], 1)):  # fmt: skip
        assert len(judge.unexpected(judged(values, KNOWN))) == surprises, values
    (line,) = judge.unexpected(judged([2.45], KNOWN))
    assert line == "made.a is missed by more (2.45 +- 0.1) than the known misses say (2.0)"


def test_a_run_with_seeds_is_drawn_again_and_all_else_stays():
    run = {"name": "box", "case": "hydrostatic", "seeds": 3, "set": {"time.end": 1.0}}
    plans = suite._planned(suite.FOLDER, run)
    assert [plan.name for plan in plans] == ["box", "box-seed-1", "box-seed-2"]
    assert {plan.first for plan in plans} == {"box"}
    assert [plan.resolved.particles.seed for plan in plans] == [0, 1, 2]
    assert {plan.resolved.time.end for plan in plans} == {1.0}


class Drawn:
    """A run with a value in place of files."""

    def __init__(self, value):
        self.steps, self.value, self.record = {"step": [1]}, value, {}


def test_a_case_is_compared_draw_by_draw(tmp_path, monkeypatch):
    first = PlannedRun("box", "hydrostatic", {}, ("quick",))
    plans = [first, first.drawn_again(1), first.drawn_again(2), replace(first, name="tank")]
    outcomes = [Outcome(Task("made", plan, tmp_path), "finished") for plan in plans]
    runs = [Drawn(value) for value in (1.0, 2.0, 3.0, 10.0)]

    def compare(self, runs):
        found = Comparison(notes=[f"{runs['box'].value:g}"])
        found.measure("a", runs["box"].value + runs["tank"].value)
        return found

    monkeypatch.setattr(suite.ValidationCase, "compare", compare)
    case = suite.ValidationCase("made", "Made", "Is it?", 1, "", (), (CHAOTIC,))
    found = result.compare(case, "quick", outcomes, runs)
    assert found.draws == [{"a": 11.0}, {"a": 12.0}, {"a": 13.0}]
    assert found.notes == ["1"]


def test_the_command_fails_by_what_is_missed_and_not_by_what_is_open(capsys):
    assert command._verdict(judged([1.05]), against_known=False) == 0
    assert "Open: made.a = 1.05 +- 0.1, allowed 0.0 to 1.0" in capsys.readouterr().out
    assert command._verdict(judged([1.05]), against_known=True) == 0
    assert command._verdict(judged([1.5]), against_known=False) == 1
    assert command._verdict(judged([1.5]), against_known=True) == 1
    assert "0 of 1 criteria met, 1 open" in capsys.readouterr().out
