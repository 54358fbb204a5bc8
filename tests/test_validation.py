"""The validation suite: its cases are complete, its verdicts right, its runs are kept."""

import json

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread

from mpslab.analysis.harmonics import harmonics
from validation import __main__ as command
from validation import judge, result, suite
from validation.comparison import Comparison
from validation.data import foremost, read_columns
from validation.jet import compare as jet
from validation.suite import Criterion, PlannedRun
from validation.wave_analysis import decay
from validation.work import Outcome, Task, Work, fingerprint

TINY = {"particles.spacing": 0.008, "scheme.settling": 0, "time.end": 0.02}


@pytest.mark.parametrize("name", suite.names())
def test_a_case_of_the_suite_is_whole(name):
    case = suite.load(name)
    assert case.question.endswith("?")
    assert callable(case.compare)
    assert len({run.name for run in case.runs}) == len(case.runs)
    again = [run.first for run in case.runs if run.draw]
    assert len({again.count(name) for name in again}) <= 1
    for run in case.runs:
        assert set(run.suites) <= set(suite.SUITES)
        assert run.resolved.time.end > 0.0
    for criterion in case.criteria:
        assert criterion.low is not None or criterion.high is not None
        assert criterion.reason.endswith((".", ")"))
        assert bool(criterion.scatter) == criterion.scatter_from.endswith(".")
        assert set(criterion.suites) <= set(suite.SUITES)


def test_known_misses_name_criteria_that_there_are():
    known = judge.known_misses()
    for name, entries in known.items():
        criteria = {criterion.id: criterion for criterion in suite.load(name).criteria}
        for id_, entry in entries.items():
            assert set(entry["suites"]) <= set(criteria[id_].suites)
            for which in entry["suites"]:
                assert not criteria[id_].met(judge.value_of(known, name, id_, which))
            assert entry["cause"]


def test_a_known_miss_may_have_a_value_for_each_suite():
    values = {"made": {"a": {"value": {"quick": 2.0, "full": 1.0}}, "b": {"value": 3.0}}}
    assert [judge.value_of(values, "made", "a", which) for which in suite.SUITES] == [2.0, 1.0]
    assert judge.value_of(values, "made", "b", "full") == 3.0
    assert judge.value_of(values, "made", "c", "full") is None


def test_an_unknown_case_is_refused_with_the_nearest():
    with pytest.raises(ValueError, match=r"must be one of .*did you mean still_wa"):
        suite.load("still")


@pytest.mark.parametrize(
    "value, low, high, met",
    [(1.0, 0.0, 1.0, True), (1.1, 0.0, 1.0, False), (-0.1, 0.0, None, False),
     (9.0, 0.0, None, True), (np.nan, None, 1.0, False), (np.inf, 0.0, None, True),
     (-5.0, None, 1.0, True)],
)  # fmt: skip
def test_a_value_is_held_against_its_band(value, low, high, met):
    assert Criterion("a", "A", "because.", "", low, high).met(value) is met


MADE = suite.ValidationCase(
    "made", "Made", "Is it?", 1, "", (), (Criterion("a", "A", "because.", "", 0.0, 1.0),)
)


def test_pictures_of_a_case_go_beside_its_file(tmp_path, monkeypatch):
    comparison = Comparison()
    comparison.measure("a", 0.5)
    comparison.draws = [comparison.measured]
    comparison.picture("The jet", Figure(figsize=(2.0, 1.0)))
    monkeypatch.setattr(result, "compare", lambda *_: comparison)
    result.write(tmp_path, *result.make(MADE, "quick", [], {}))
    (figure,) = json.loads((tmp_path / "made.json").read_text())["figures"]
    assert figure["title"] == "The jet"
    assert imread(tmp_path / figure["picture"]).size


def test_what_was_measured_must_have_a_criterion_and_the_other_way_round():
    with pytest.raises(ValueError, match=r"measured .* but criteria"):
        judge.check(MADE, "quick", {"b": 1.0})


def test_a_comparison_that_measures_something_else_is_a_miss(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(suite.ValidationCase, "compare", lambda self, runs: Comparison())
    found, _ = result.make(MADE, "quick", [], {})
    assert found["metrics"][0]["verdict"] == "missed"
    assert "The comparison failed" in found["notes"][0]
    assert "measured []" in capsys.readouterr().err


def test_a_run_that_left_no_files_is_a_miss(tmp_path):
    lost = Outcome(Task("made", plan("tiny"), tmp_path / "nothing"), "failed", "killed")
    found, _ = result.make(MADE, "quick", [lost], {})
    assert found["metrics"][0]["verdict"] == "missed"
    assert found["runs"][0]["steps"] == 0
    assert "Run tiny failed: killed" in found["notes"]


def test_an_order_of_convergence_comes_back():
    spacing = np.array([4.0, 2.0, 1.0])
    assert np.isclose(Comparison().converge("error", spacing, -0.1 * spacing**1.5), 1.5)


def test_an_order_needs_two_errors_that_can_be_told_from_zero():
    comparison = Comparison()
    assert np.isclose(comparison.converge("error", [4.0, 2.0, 1.0], [0.4, np.nan, 0.1]), 1.0)
    assert np.isnan(comparison.converge("error", [4.0, 2.0], [0.4, 0.0]))
    assert comparison.convergence[1]["order"] is None
    json.dumps(comparison.convergence, allow_nan=False)


def test_errors_of_a_curve_that_is_late_and_high_come_back():
    x = np.linspace(0.0, 10.0, 2001)
    at = np.linspace(1.0, 9.0, 60)
    comparison = Comparison()
    row = comparison.hold("a hump", x, 0.1 + np.exp(-((x - 5.2) ** 2)), at,
                          np.exp(-((at - 5.0) ** 2)))  # fmt: skip
    assert np.isclose(row["bias"], 0.1, atol=0.002)
    assert np.isclose(row["late by"], 0.2, atol=0.01)
    assert np.isclose(row["peak / measured"], 1.1, atol=0.01)
    assert row["rms error"] > row["bias"]
    (table,) = comparison.all_tables
    assert table["rows"] == [list(row.values())]


def test_a_table_holds_no_number_that_json_does_not_know():
    comparison = Comparison()
    comparison.table("A", ["a", "b"], [["text", np.nan], [np.int64(3), np.inf]])
    assert comparison.tables[0]["rows"] == [["text", None], [3, None]]


def test_a_series_leaves_out_what_is_not_a_number_and_stays_short():
    figure = Comparison().figure("A", "x", "y")
    y = np.arange(5000.0)
    y[0] = np.nan
    figure.line("a", np.arange(5000.0), y)
    (series,) = figure.series
    assert len(series["x"]) == len(series["y"]) <= 800
    assert series["x"][0] == 1.0
    assert json.loads(json.dumps(series)) == series


def test_harmonics_of_a_known_wave_come_back():
    time = np.linspace(0.0, 5.0, 4000)
    level = 0.1 + 0.02 * np.cos(2 * np.pi * time / 0.5 - 0.3) + 0.004 * np.sin(8 * np.pi * time)
    found = harmonics(time, level, 0.5, 1.0, 3)
    assert np.isclose(found[0].real, 0.1)
    assert np.isclose(found[1], 0.02 * np.exp(-0.3j))
    assert np.isclose(abs(found[2]), 0.004)
    assert np.isnan(harmonics(time, level, 0.5, 4.0, 3)).all()


def test_a_known_decay_comes_back():
    x = np.linspace(0.0, 3.0, 7)
    assert np.allclose(decay(x, 0.02 * np.exp(-0.3 * x)), (0.3, 0.02, 0.0), atol=1e-6)


def test_scatter_of_the_amplitudes_shows_in_the_error_of_the_decay():
    x, scatter = np.linspace(0.0, 3.0, 7), np.array([1.0, -2.0, 1.0, 0.0, -1.0, 2.0, -1.0])
    small, large = (decay(x, np.exp(-0.3 * x + size * scatter))[2] for size in (0.01, 0.02))
    assert np.isclose(large, 2.0 * small)


def test_spray_is_not_the_foremost_water():
    row = np.zeros((4, 3))
    row[:, 0] = [0.0, 1.0, 2.5, 9.0]
    assert foremost(row, 1.0, others=0) == 9.0
    assert foremost(row, 1.0, others=1) == 2.5
    assert foremost(row, 1.0, others=2) == 1.0
    assert foremost(row[:0], 1.0, others=0) == -np.inf


def test_pressure_of_a_stream_on_a_wall_adds_up_to_its_momentum():
    """rho U^2 h, which is 2 in units of rho U^2/2 and h; highest at the foot."""
    height = np.linspace(0.0, 15.0, 3001)
    pressure = jet.theory(height)
    assert pressure[0] == pytest.approx(1.0)
    assert np.all(np.diff(pressure) < 0.0)
    assert np.trapezoid(pressure, height) == pytest.approx(2.0, abs=1e-4)


def test_columns_of_measurements_go_by_their_headings(tmp_path):
    (tmp_path / "a.csv").write_text("t [s],p [Pa]\n0.0,1.5\n0.1,2.5\n")
    found = read_columns(tmp_path / "a.csv")
    assert found["p [Pa]"].tolist() == [1.5, 2.5]


def plan(name="tiny", changes=TINY, **more):
    return PlannedRun(name, "hydrostatic", changes, ("quick",), **more)


def test_a_finished_run_is_kept_and_another_case_is_not(tmp_path):
    task = Task("made", plan(), tmp_path / "made" / "tiny")
    work = Work(1)
    assert [o.outcome for o in work.do([task])] == ["finished"]
    written = (task.folder / "steps.csv").stat().st_mtime_ns
    assert [o.outcome for o in work.do([task])] == ["finished"]
    assert (task.folder / "steps.csv").stat().st_mtime_ns == written
    other = Task("made", plan(changes={**TINY, "particles.seed": 1}), task.folder)
    assert fingerprint(other.plan.resolved) != fingerprint(task.plan.resolved)
    assert [o.outcome for o in work.do([other])] == ["finished"]
    assert (task.folder / "steps.csv").stat().st_mtime_ns != written


def test_an_interrupted_run_goes_on_from_its_checkpoint(tmp_path, monkeypatch):
    task = Task("made", plan(changes={**TINY, "time.end": 2.0, "output.checkpoint": 0.01}),
                tmp_path / "made" / "tiny")  # fmt: skip
    work = Work(1)

    def stop():
        if (task.folder / "checkpoint.h5").exists():
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(work.do([task], stop))
    assert json.loads(task.record.read_text())["outcome"] == "interrupted"
    assert [o.outcome for o in Work(1).do([task])] == ["finished"]
    assert json.loads((task.folder / "run.json").read_text())["resumed"] == 1


def test_a_run_that_goes_wrong_says_why(tmp_path):
    bad = plan(changes={**TINY, "scheme.max_iterations": 1})
    (outcome,) = Work(1).do([Task("made", bad, tmp_path / "made" / "bad")])
    assert outcome.outcome == "failed"
    assert "iteration" in outcome.reason


def test_a_failed_run_makes_all_criteria_of_its_case_misses(tmp_path):
    task = Task("still_water", plan("box"), tmp_path / "made" / "tiny")
    list(Work(1).do([task]))
    failed = [Outcome(task, "failed", "the water boiled")]
    found, _ = result.make(suite.load("still_water"), "quick", failed, {})
    assert {metric["verdict"] for metric in found["metrics"]} == {"missed"}
    assert "Run box failed: the water boiled" in found["notes"]


def test_the_command_lists_the_cases(capsys):
    assert command.main(["--list"]) == 0
    assert "Standing wave" in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments, message",
    [(["nonsense"], "case = 'nonsense': must be one of"), (["--ranks", "0"], "--ranks 0: must be"),
     (["--jobs", "-1"], "--jobs -1: must be"),
     (["bar"], "case bar: not in the quick suite; add --full")],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(capsys, arguments, message):
    assert command.main(arguments) == 2
    assert message in capsys.readouterr().err
