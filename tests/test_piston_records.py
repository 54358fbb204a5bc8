"""Records of a piston as loggers and spreadsheets write them: form, units, place in time, jerks."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpslab.solids.wavemakers import file

END = 3.0
TIMES = np.arange(0.0, END + 0.02, 0.04)
PATH = 0.05 * np.sin(0.5 * np.pi * TIMES / END) ** 4 + 0.1234


def replay(path, end=END, **given):
    blank = {"type": "file", "height": 0.0, "period": 0.0, "stroke": 0.0, "start": 0.0,
             "offset": 0.0, "smoothing": 0.0, "quantity": "displacement"}  # fmt: skip
    return file.make(SimpleNamespace(**{**blank, "file": path, **given}), 0.3, 9.81, end)


def lines(separator=",", mark=".", times=TIMES, path=PATH, digits=7):
    rows = (f"{t:.2f}{separator}{x:.{digits}f}" for t, x in zip(times, path, strict=True))
    return "\n".join(rows).replace(".", mark) + "\n"


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "motion.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def places(motion, times=TIMES):
    return np.array([motion.displacement(t) for t in times])


def refusal(path, **given):
    with pytest.raises(ValueError) as caught:
        replay(path, **given)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# Form


@pytest.mark.parametrize("separator", [",", ", ", ";", " ; ", "\t", " ", "   "])
@pytest.mark.parametrize("heading", ["", "time{}x\n", "t [s]{}x [m]\n", "# Zeit{}Weg\n"])
def test_columns_may_be_parted_by_commas_semicolons_tabs_or_blanks(write, separator, heading):
    motion = replay(write(heading.format(separator) + lines(separator)))
    np.testing.assert_allclose(places(motion), PATH - PATH[0], atol=1e-7)


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_decimal_commas_are_read_where_no_comma_parts_the_columns(write, separator):
    motion = replay(write(lines(separator, ",")))
    np.testing.assert_allclose(places(motion), PATH - PATH[0], atol=1e-7)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("0;0\n1,5;0.1\n", 2),
        ("0.0;0\n1;0,1\n", 2),
        ("0,0,0\n1,0,1\n", 1),
        ("0;0\n1,0\n", 2),
        ("0 0\n1;0\n", 2),
        ("0,0\n1_0,0\n", 2),
        ("0,0\n1,0x1\n", 2),
        ("0,0\n1,1e999\n", 2),
    ],
)
def test_row_that_can_be_read_in_two_ways_or_none_is_refused_with_what_is_allowed(
    write, text, line
):
    message = refusal(write(text))
    assert f", line {line}: " in message
    assert "parted by a comma, semicolon, tab or blanks" in message


@pytest.mark.parametrize("first", ["0.00,-", "-,-", "nan,nan", ",", "0,", "2mm,x", "x,1", "t,NA",
                                   "'0',x", "inf,x"])  # fmt: skip
def test_row_with_a_number_or_a_missing_one_is_no_heading(write, first):
    assert ", line 1: " in refusal(write(first + "\n0,0\n1,0.1\n"))


@pytest.mark.parametrize("heading", ["time,cm", "t,x [mm]", "t,x/km", "t,x (in)", "t [ms],x [m]",
                                     "time (min),x"])  # fmt: skip
def test_heading_with_other_units_is_refused(write, heading):
    message = refusal(write(heading + "\n0,0\n1,0.1\n"))
    assert ", line 1: " in message and "convert the column" in message


@pytest.mark.parametrize("heading", ["time [s],x [m]", "t / s,displacement in m", "t,commanded"])
def test_heading_in_seconds_and_metres_is_taken(write, heading):
    assert replay(write(heading + "\n0,0\n1,0.1\n")).stroke == pytest.approx(0.1)


def test_record_too_long_to_be_one_is_refused_before_it_is_read_to_the_end(write, monkeypatch):
    monkeypatch.setattr(file._record, "MOST_ROWS", 10)
    assert "must have at most 10 rows" in refusal(write(lines()))
    monkeypatch.setattr(file._record, "MOST_BYTES", 10)
    assert "leave out what lies before" in refusal(write(lines()))


# Place in time


def test_record_that_begins_after_the_end_of_the_run_is_refused_with_the_offset(write):
    path = write(lines(times=TIMES + 22.0))
    message = refusal(path)
    assert "begins at 22 s" in message and "time.end = 3 s; wavemaker.offset = 22 lets" in message
    moved = replay(path, offset=22.0)
    np.testing.assert_allclose(places(moved), PATH - PATH[0], atol=1e-7)
    assert not moved.doubts


def test_paddle_that_stands_still_at_first_or_for_most_of_the_run_brings_a_warning(write):
    path = write(lines(times=TIMES + 22.0))
    assert ["still until t = 22 s" in doubt for doubt in replay(path, end=30.0).doubts] == [True]
    late = replay(path, end=30.0, offset=22.0).doubts
    assert len(late) == 1 and "ends at t = 3 s" in late[0] and "time.end = 30 s" in late[0]


def test_run_that_begins_within_the_record_begins_at_rest_at_zero(write):
    motion = replay(write(lines()), offset=1.2)
    start = PATH[TIMES.tolist().index(pytest.approx(1.2))]
    assert motion.displacement(0.0) == 0.0
    assert abs(motion.displacement(1e-6)) < 1e-10
    later = TIMES[TIMES > 1.3]
    np.testing.assert_allclose(
        places(motion, later - 1.2), PATH[TIMES > 1.3] - start, atol=1e-6
    )  # fmt: skip


def test_time_below_zero_needs_an_offset(write):
    path = write(lines(times=TIMES - 1.0))
    assert "line 1: time = -1 s: must not be below 0 s" in refusal(path)
    np.testing.assert_allclose(places(replay(path, offset=-1.0)), PATH - PATH[0], atol=1e-7)


def test_offset_beyond_the_record_is_refused(write):
    assert "wavemaker.offset = 9 s: must be below 3 s" in refusal(write(lines()), offset=9.0)


# Jerks


def test_record_rounded_to_tenths_of_a_millimetre_brings_a_warning_until_it_is_smoothed(write):
    rough = replay(write(lines(digits=4)))
    (doubt,) = rough.doubts
    assert "rounded to 0.1 mm" in doubt and "wavemaker.smoothing = 0.2" in doubt
    smoothed = replay(write(lines(digits=4)), smoothing=0.2)
    assert smoothed.doubts == ()
    exact = replay(write(lines(digits=9)))
    assert exact.doubts == ()

    def jerk(motion):
        return np.abs(np.diff(places(motion, np.arange(0.2, 2.8, 0.04)), 3)).max()

    assert jerk(smoothed) < 0.2 * jerk(rough)
    np.testing.assert_allclose(places(smoothed), places(exact), atol=1e-4)


def test_smoothing_keeps_straight_lines_and_halves_wiggles_of_its_period():
    rng = np.random.default_rng(1)
    times = np.sort(rng.uniform(0.0, 10.0, 200))
    values, slopes = file.smooth(times, 3.0 * times + 1.0, 2.0)
    np.testing.assert_allclose(values, 3.0 * times + 1.0, atol=1e-12)
    np.testing.assert_allclose(slopes, 3.0, atol=1e-9)
    times = np.arange(0.0, 10.0, 0.01)
    for period, kept in ((0.25, 1 / 17), (0.5, 0.5), (1.0, 16 / 17), (2.0, 256 / 257)):
        values, slopes = file.smooth(times, np.sin(2.0 * np.pi * times / period), 0.5)
        assert np.abs(values[300:700]).max() == pytest.approx(kept, rel=0.01)
        top = np.abs(slopes[300:700]).max() * period / (2.0 * np.pi)
        assert top == pytest.approx(kept, rel=0.01)


def test_smoothed_motion_starts_at_rest_at_zero(write):
    motion = replay(write(lines(digits=3)), smoothing=0.3)
    assert motion.displacement(0.0) == 0.0
    assert abs(motion.displacement(1e-6)) < 1e-10


@pytest.mark.parametrize("smoothing", [1.6, 1e3, 1e30])
def test_smoothing_over_more_than_half_of_the_record_is_refused(write, smoothing):
    message = refusal(write(lines()), smoothing=smoothing)
    assert message.startswith(f"wavemaker.smoothing = {smoothing:g} s: must be at most 1.5 s")


def test_smoothing_that_round_off_makes_impossible_is_refused(write, monkeypatch):
    def singular(*arguments):
        raise np.linalg.LinAlgError

    monkeypatch.setattr(file, "smooth", singular)
    with pytest.raises(ValueError, match=r"^wavemaker\.smoothing = 1 s: must be at most 0\.1 s"):
        replay(write(lines()), smoothing=1.0)


def test_motion_more_violent_than_gravity_brings_a_warning(write):
    (doubt,) = replay(write("0,0\n0.1,0.1\n3,0.1\n")).doubts
    assert "above gravity" in doubt


def test_record_says_how_fast_it_is_and_names_no_wave(write):
    motion = replay(write(lines()), height=0.05)
    facts = motion.facts
    assert motion.height == 0.0
    assert [facts[name] for name in ("rows", "begin [s]", "end [s]")] == [76, 0.0, 3.0]
    speed = np.abs(np.gradient(PATH, TIMES)).max()
    assert facts["top_speed [m/s]"] == pytest.approx(speed, rel=0.02)
    bent = np.abs(np.diff(PATH, 2)).max() / 0.04**2
    # A monotone cubic is bent up to three times as much as the motion where that begins.
    assert 0.95 * bent < facts["largest_acceleration [m/s2]"] < 3.0 * bent
