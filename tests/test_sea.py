"""Waves of a run, from its folder: numbers, files, and what is refused."""

import csv
import json
import re

import numpy as np
import pytest
from seas import GRAVITY, sea, write_run

from mpslab import sea as command
from mpslab.analysis import arrays, graphs, page, readings, windows
from mpslab.theory.waves import group_celerity, wave_number

HEIGHT, PERIOD, DEPTH, STEP, KR = 0.1, 1.5, 0.5, 0.05, 0.5
PLACES = [5.0, 5.3, 5.8, 6.7]
DRIVEN = {
    "wavemaker.type": "linear", "wavemaker.height": 0.05, "wavemaker.period": PERIOD,
    "wavemaker.start": 3.0,
}  # fmt: skip


@pytest.fixture(scope="module")
def irregular(tmp_path_factory):
    """A sea of 120 waves with Kr = 0.5, read at uneven times, and its folder."""
    level = sea(PLACES, 3600, STEP, HEIGHT, PERIOD, DEPTH, KR, 12.0, seed=4)
    time = STEP * np.arange(3600)
    uneven = time + np.random.default_rng(1).uniform(-0.2, 0.2, len(time)) * STEP
    uneven[0] = 0.0
    moved = np.stack([np.interp(uneven, time, column) for column in level.T], axis=1)
    return write_run(tmp_path_factory.mktemp("sea") / "run", uneven, moved, PLACES, DEPTH)


def regular_record(end, kr=0.3, wall=8.5):
    """A wave with a bound second harmonic that a wall reflects, ramped, as the piston makes it."""
    time = np.arange(0.0, end, 0.02)
    k, w = wave_number(PERIOD, DEPTH, GRAVITY), 2.0 * np.pi / PERIOD
    speed = group_celerity(PERIOD, DEPTH, GRAVITY)
    columns = []
    for x in PLACES:
        level = np.zeros_like(time)
        for size, way, sign in ((0.025, x, 1.0), (kr * 0.025, 2.0 * wall - x, -1.0)):
            late = time - way / speed
            ramp = np.clip(late / 3.0, 0.0, 1.0)
            phase = w * time - k * way
            level += ramp * size * np.cos(phase)
            level += ramp * (0.004 * np.cos(2.0 * phase) if sign > 0.0 else 0.0)
        columns.append(level)
    return time, np.stack(columns, axis=1)


@pytest.fixture(scope="module")
def regular(tmp_path_factory):
    time, level = regular_record(40.0)
    changes = DRIVEN | {"tank.length": 8.5}
    return write_run(tmp_path_factory.mktemp("waves") / "run", time, level, PLACES, DEPTH, changes)


def refused(capsys, *arguments):
    """The line that a call is refused with."""
    assert command.main([str(a) for a in arguments]) == 2
    out = capsys.readouterr()
    assert out.out == ""
    assert out.err.startswith("mpslab: ")
    assert out.err.count("\n") == 1
    return out.err


# Numbers


def test_sea_comes_back_from_a_folder(irregular):
    found = command.look(irregular, start=0.0)
    assert not found.regular
    near = 1.0 + KR * KR  # variance of both, where they do not add up
    expected = HEIGHT * np.sqrt(near)
    np.testing.assert_allclose(found.gauges["Hm0"].mean(), expected, rtol=0.05)
    assert found.reflection.kr_primary == pytest.approx(KR, abs=0.03)
    assert found.reflection.incident_height == pytest.approx(HEIGHT, rel=0.03)
    assert found.array == ("g1", "g2", "g3", "g4")
    assert found.gauges["Tp"].mean() == pytest.approx(PERIOD, rel=0.05)
    assert (np.abs(found.gauges["N"] - 120 / 0.85) < 20).all()
    assert found.gauges["Hmax"][0] > found.gauges["H1/10"][0] > found.gauges["H1/3"][0]
    assert set(found.gauges.dtype.names) - {"name"} <= set(command.UNITS)


def test_regular_waves_come_back_with_their_harmonics(regular):
    """From when the reflected wave is back; over whole periods."""
    found = command.look(regular)
    assert found.regular
    assert found.reflection.kr_primary == pytest.approx(0.3, abs=0.005)
    assert found.reflection.incident_height == pytest.approx(0.05, rel=0.01)
    assert found.reflection.unexplained < 0.01
    np.testing.assert_allclose(found.gauges["a2"], 0.004, rtol=0.05)
    assert np.isnan(found.gauges["Hm0 scatter"]).all()
    periods = len(found.readings.time) * found.readings.step / PERIOD
    assert periods == pytest.approx(round(periods), abs=1e-9)
    assert "x = 8.5 m are back" in found.back.reason
    assert found.back.start > found.window.start


def test_period_of_ones_own_makes_the_waves_regular(irregular):
    found = command.look(irregular, period=1.5, start=10.0, end=40.0)
    assert found.regular
    assert "a1" in found.gauges.dtype.names


def test_window_waits_for_the_waves_at_the_last_gauge(regular):
    found = command.look(regular).window
    speed = group_celerity(PERIOD, DEPTH, GRAVITY)
    assert found.start == pytest.approx(3.0 + 1.5 * PERIOD + 6.7 / speed)
    assert "x = 6.7 m" in found.reason
    asked = command.look(regular, start=20.0, end=35.0).window
    assert (asked.start, asked.end, asked.reason) == (20.0, 35.0, "as asked for")


def test_window_without_a_period_begins_with_the_first_wave(tmp_path):
    time = np.arange(0.0, 60.0, 0.05)
    level = np.where(time > 20.0, 0.02 * np.sin(4.0 * time), 0.0)[:, np.newaxis]
    found = command.look(write_run(tmp_path / "run", time, level, [3.0], DEPTH)).window
    assert found.start == pytest.approx(20.05, abs=0.1)
    assert "first wave at 'g1'" in found.reason


def test_few_waves_are_told_to_be_no_sea_state(irregular):
    few = command.look(irregular, start=0.0, end=15.0)
    assert any("waves at most are in the window: a sea state wants 20" in n for n in few.notes)
    assert not any("sea state" in note for note in command.look(irregular, start=0.0).notes)


def test_reflected_waves_that_come_too_late_are_told(tmp_path):
    time, level = regular_record(15.0)
    run = write_run(tmp_path / "run", time, level, PLACES, DEPTH, DRIVEN | {"tank.length": 8.5})
    found = command.look(run)
    assert found.back == found.window
    assert any("not in all of the window" in note for note in found.notes)


def test_default_array_is_in_one_depth_and_off_the_piston():
    x = np.array([0.2, 2.0, 2.5, 2.5, 3.3, 9.0])
    depth = np.array([0.5, 0.5, 0.5, 0.5, 0.5, 0.1])
    assert arrays.most(x, depth, piston=True) == [1, 2, 4]
    assert arrays.most(x, depth, piston=False) == [0, 1, 2, 4]
    assert arrays.most(np.array([1.0]), np.array([-0.1]), piston=True) == []


def test_slope_of_the_case_brings_the_run_up_that_eurotop_expects(tmp_path):
    level = sea(PLACES, 1800, STEP, HEIGHT, PERIOD, DEPTH, 0.3, 10.0, seed=4)
    bed = {"tank.length": 13.0, "tank.bed": [[0.0, 0.0], [8.5, 0.0], [13.0, 1.5]]}
    run = write_run(tmp_path / "run", STEP * np.arange(1800), level, PLACES, DEPTH, bed)
    found = command.look(run, start=0.0)
    (row,) = found.expected
    assert row["name"] == "R2%"
    assert 1.5 * HEIGHT < row["low"] < row["mean"] < row["high"] < 4.0 * HEIGHT
    assert not row["doubts"]


@pytest.mark.parametrize("whole", [None, 1.0])
def test_uneven_readings_twenty_to_a_period_keep_the_wave(whole):
    """Within 1 % of the amplitude, times off by a fifth of their distance."""
    time = np.arange(0.0, 12.0, 0.05)
    time[1:-1] += np.random.default_rng(3).uniform(-0.01, 0.01, len(time) - 2)
    rows = np.zeros(len(time), [("time", float), ("g", float)])
    rows["time"], rows["g"] = time, 0.5 + 0.01 * np.sin(2.0 * np.pi * time)
    seen = readings.read(rows, 0.5, windows.Window(1.0, 11.5, ""), whole)
    error = seen.elevation[:, 0] - 0.01 * np.sin(2.0 * np.pi * seen.time)
    assert np.abs(error).max() < 1e-4
    np.testing.assert_allclose(np.diff(seen.time), seen.step, rtol=1e-9)
    if whole:
        assert len(seen.time) * seen.step == pytest.approx(10.0)


# Dry gauges, and runs that are not finished


def test_dry_readings_are_bridged_or_the_gauge_is_left_out(irregular, tmp_path):
    rows = list(csv.reader((irregular / "gauges.csv").open()))
    level = np.array(rows[1:], float)
    level[100:110, 1] = np.nan
    level[::3, 2] = np.nan
    run = write_run(tmp_path / "run", level[:, 0], level[:, 1:] - DEPTH, PLACES, DEPTH)
    found = command.look(run, start=0.0)
    assert found.gauges["dry"] == pytest.approx([10 / 3600, 1 / 3, 0.0, 0.0], abs=1e-4)
    assert np.isfinite(found.gauges["Hm0"]).tolist() == [True, False, True, True]
    assert found.array == ("g1", "g3", "g4")
    notes = " ".join(found.notes)
    assert "gauge 'g1': dry in 0.28 % of the readings: these are bridged" in notes
    assert "gauge 'g2': dry in 33 % of the readings: no numbers" in notes
    whole = command.look(irregular, start=0.0)
    assert found.gauges["Hm0"][0] == pytest.approx(whole.gauges["Hm0"][0], rel=0.02)


def test_a_run_that_was_cut_amid_a_row_is_read_as_far_as_it_is_whole(irregular, tmp_path):
    run = tmp_path / "cut"
    run.mkdir()
    (run / "case.toml").write_text((irregular / "case.toml").read_text())
    text = (irregular / "gauges.csv").read_text()
    (run / "gauges.csv").write_text(text[: len(text) // 2])
    found = command.look(run, start=0.0)
    assert found.readings.time[-1] == pytest.approx(90.0, abs=3.0)
    assert found.reflection.kr_primary == pytest.approx(KR, abs=0.05)


# Files


def test_command_writes_tables_pictures_and_a_page(irregular, capsys):
    assert command.main([str(irregular), "--from", "0"]) == 0
    out = capsys.readouterr().out
    assert "Kr = 0." in out
    assert "Hm0 [mm]" in out
    folder = irregular / "sea"
    gauges = list(csv.DictReader((folder / "gauges.csv").open()))
    found = command.look(irregular, start=0.0)
    assert [float(row["Hm0 [m]"]) for row in gauges] == list(found.gauges["Hm0"])
    spectra = list(csv.reader((folder / "spectra.csv").open()))
    assert spectra[0][:4] == ["frequency [Hz]", "g1 [m2 s]", "g1 low [m2 s]", "g1 high [m2 s]"]
    assert len(spectra) - 1 == len(found.spectra["g1"].frequency)
    waves = list(csv.DictReader((folder / "waves.csv").open()))
    assert len(waves) == sum(map(len, found.waves.values()))
    reflection = list(csv.DictReader((folder / "reflection.csv").open()))
    assert {"incident [m2 s]", "reflected [m2 s]"} < set(reflection[0])
    said = json.loads((folder / "sea.json").read_text())
    assert said["reflection"]["kr_primary"] == found.reflection.kr_primary
    assert said["gauges"][0]["Tp [s]"] == found.gauges["Tp"][0]
    assert said["window"]["reason"] == "as asked for"
    for name in ("levels", "spectra", "reflection"):
        assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    text = (folder / "page.html").read_text()
    assert not re.search(r'(src|href)="(?!data:)', text)
    assert text.count("data:image/png") == 3


def test_regular_waves_have_harmonics_in_place_of_spectra(regular, tmp_path, capsys):
    assert command.main([str(regular), "--out", str(tmp_path / "out")]) == 0
    assert "first harmonic" in capsys.readouterr().out
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"harmonics.png", "reflection.csv", "page.html"} <= names
    assert "spectra.png" not in names
    said = json.loads((tmp_path / "out" / "sea.json").read_text())
    assert said["gauges"][0]["Hm0 scatter [-]"] is None


def test_without_jinja2_there_is_no_page_and_a_line_says_so(regular, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(page, "available", lambda: False)
    monkeypatch.setattr(graphs, "draw", lambda sea: [])
    assert command.main([str(regular), "--out", str(tmp_path / "out")]) == 0
    assert "pip install jinja2" in capsys.readouterr().out
    assert not (tmp_path / "out" / "page.html").exists()


# Bad input


@pytest.mark.parametrize(
    ("arguments", "words"),
    [(["--gauges", "g1", "g9"], "--gauges g9: must be out of g1, g2, g3, g4"),
     (["--gauges", "g1"], "--gauges g1: must be 2 or more"),
     (["--gauges", "g1", "g1"], "two stand at one place, x = 5 m"),
     (["--from", "500"], "window from 500 to 179.9"),
     (["--from", "10", "--to", "10.2"], "holds 4 readings, must hold 16 or more"),
     (["--from", "0", "--period", "-1"], "--period -1: must be above 0 s"),
     (["--from", "0", "--to", "2", "--period", "1.5"], "must hold two whole periods of 1.5 s"),
     (["--from", "0", "--band", "2", "1"], "--band 2 1: must rise"),
     (["--from", "0", "--segment", "1"], "--segment 1: must be from"),
     (["--crossing", "left"], "invalid choice"),
     (["--out", "/nowhere/at/all"], "--out /nowhere/at/all: there is no folder /nowhere/at")],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(irregular, tmp_path, capsys, arguments, words):
    before = set(irregular.iterdir())
    assert words in refused(capsys, irregular, *arguments)
    assert set(irregular.iterdir()) == before


def test_gauges_in_water_of_two_depths_are_refused(tmp_path, capsys):
    time = np.arange(0.0, 30.0, 0.05)
    level = 0.01 * np.sin(4.0 * time)[:, np.newaxis] * np.ones(2)
    bed = {"tank.length": 8.0, "tank.bed": [[0.0, 0.0], [4.0, 0.0], [8.0, 0.4]]}
    run = write_run(tmp_path / "run", time, level, [3.0, 6.0], DEPTH, bed)
    line = refused(capsys, run, "--gauges", "g1", "g2")
    assert "must stand in water of one depth, not 0.5, 0.3 m" in line
    found = command.look(run)
    assert found.reflection is None
    assert any(note.startswith("no reflection: 1 gauges") for note in found.notes)


def test_gauges_at_one_place_across_the_tank_are_refused(tmp_path, capsys):
    time = np.arange(0.0, 30.0, 0.05)
    level = 0.01 * np.sin(4.0 * time)[:, np.newaxis] * np.ones(2)
    run = write_run(tmp_path / "run", time, level, [3.0, 3.0], DEPTH)
    line = refused(capsys, run, "--gauges", "g1", "g2")
    assert "--gauges g1 g2: two stand at one place, x = 3 m" in line


def test_runs_without_waves_are_refused(tmp_path, capsys):
    time = np.arange(0.0, 30.0, 0.05)
    still = write_run(tmp_path / "still", time, np.zeros((600, 1)), [3.0], DEPTH)
    assert "no waves: the levels at all gauges stay" in refused(capsys, still)
    dry = write_run(tmp_path / "dry", time, np.full((600, 1), np.nan), [3.0], DEPTH)
    assert "all gauges are dry" in refused(capsys, dry)
    assert "cannot be read as a case" in refused(capsys, tmp_path / "nothing")
    empty = write_run(
        tmp_path / "empty", time[:0], np.zeros((0, 1)), [3.0], DEPTH, {"time.end": 1.0}
    )
    assert "has no readings of gauges" in refused(capsys, empty)


def small_waves(folder, size, changes):
    """A run whose elevation is a sine of a Hm0 [spacings], 4 sigma."""
    time = np.arange(0.0, 30.0, 0.05)
    level = size * DEPTH / 20.0 / np.sqrt(8.0) * np.sin(4.0 * time)[:, np.newaxis]
    return write_run(folder, time, level, [3.0], DEPTH, changes)


def test_noise_of_still_water_is_no_sea(tmp_path, capsys):
    line = refused(capsys, small_waves(tmp_path / "still", 0.24, {}))
    assert "no waves: the levels at all gauges stay as those of still water" in line
    assert "(Hm0 below 0.00625 m, a quarter of a spacing)" in line
    assert "nothing in the case moves it" in line
    assert "no waves" in refused(capsys, tmp_path / "still", "--period", "1.57")


@pytest.mark.parametrize(
    ("size", "changes"),
    [
        (0.26, {}),
        (0.1, {"initial.type": "standing_wave", "initial.amplitude": 0.01}),
        (0.1, {"frame.type": "sway", "frame.amplitude": 0.001, "frame.period": 1.57}),
        (0.1, {"water": [{"from": [0, 0, 0], "to": [1, 0, 0.5]}]}),
        (0.1, {"gate": [{"x": 2.0, "speed": 0.1}]}),
    ],
)
def test_small_waves_that_something_makes_are_a_sea(tmp_path, size, changes):
    found = command.look(small_waves(tmp_path / "run", size, changes))
    assert found.gauges["Hm0"][0] == pytest.approx(size * DEPTH / 20.0, rel=0.1)


def test_run_that_ends_before_the_waves_come_is_refused(tmp_path, capsys):
    time, level = regular_record(8.0)
    run = write_run(tmp_path / "run", time, level, PLACES, DEPTH, DRIVEN)
    line = refused(capsys, run)
    assert "must leave two periods of 1.5 s; --from chooses another start" in line


def test_windows_are_told_with_their_reason():
    assert str(windows.Window(1.0, 20.5, "as asked for")) == "1 to 20.5 s (as asked for)"
