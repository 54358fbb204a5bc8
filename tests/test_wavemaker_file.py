"""Paddle that replays a record: what its file may hold, and how a bad one is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpslab.solids.wavemakers import file


def replay(name, end=3.0, **given):
    blank = {"type": "file", "height": 0.0, "period": 0.0, "stroke": 0.0, "start": 0.0,
             "offset": 0.0, "smoothing": 0.0, "quantity": "displacement"}  # fmt: skip
    return file.make(SimpleNamespace(**{**blank, "file": name, **given}), 0.04, 9.81, end)


def path(motion, times):
    return np.array([motion.displacement(t) for t in times])


def write(folder, text):
    name = folder / "motion.csv"
    name.write_text(text, encoding="utf-8")
    return name


def test_passes_through_its_rows_and_holds_the_last(tmp_path):
    name = write(tmp_path, "0.5,0.2\n1.0,0.21\n1.5,0.19\n\n2.0,0.205\n")
    motion = replay(name)
    expected = [0.0, 0.0, 0.0, 0.01, -0.01, 0.005, 0.005]
    assert path(motion, [0.2, 0.4, 0.5, 1.0, 1.5, 2.0, 9.0]) == pytest.approx(expected, abs=1e-15)
    assert (motion.backmost, motion.foremost) == pytest.approx((-0.01, 0.01), abs=1e-15)


def test_stays_between_its_rows(tmp_path):
    motion = replay(write(tmp_path, "0,0\n1,0\n1.1,0.1\n2,0.1\n"))
    x = path(motion, np.linspace(0, 2.5, 1001))
    assert np.min(x) == 0.0
    assert np.max(x) == pytest.approx(0.1, abs=1e-16)
    assert np.all(np.diff(x) >= -1e-16)


@pytest.mark.parametrize("top", ["time [s],displacement [m]\n", "\ufeff", "\ufefft,x\n", "\n"])
def test_may_begin_with_a_heading_or_a_byte_order_mark(tmp_path, top):
    plain = replay(write(tmp_path, "0,0\n1,0.1\n2,0\n"))
    topped = replay(write(tmp_path, top + "0,0\n1,0.1\n2,0\n"))
    assert topped.displacement(0.7) == plain.displacement(0.7) > 0.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r": has 0 rows of numbers; must have 2 or more"),
        ("time,displacement\n0,0\n", r": has 1 rows of numbers"),
        ("0,0\n1,abc\n", r", line 2: '1,abc' must be two finite numbers"),
        ("t,x\n0,0\nt,x\n", r", line 3: 't,x' must be two finite numbers"),
        ("0,abc\n1,0\n", r", line 1: '0,abc' must be two finite numbers"),
        ("0,0\n\n1,0,3\n", r", line 3: '1,0,3' must be two finite numbers"),
        ("nan,nan\n0,0\n1,0\n", r", line 1: 'nan,nan' must be two finite numbers"),
        ("0,0\n1,nan\n", r", line 2: '1,nan' must be two finite numbers"),
        ("0,0\n1,0.1\n1,0.2\n", r", line 3: time = 1 s: must be above that of the row before, 1 s"),
        ("0,0\n1,0.1\n0.5,0.2\n", r", line 3: time = 0\.5 s: must be above"),
        ("-1,0\n1,0.1\n", r", line 1: time = -1 s: must not be below 0 s"),
    ],
)
def test_bad_file_is_refused_with_file_and_line(tmp_path, text, message):
    with pytest.raises(ValueError, match=r"^wavemaker\.file = '.*motion\.csv'" + message) as caught:
        replay(write(tmp_path, text))
    assert "\n" not in str(caught.value)


def test_that_cannot_be_read_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"^wavemaker\.file = '.*none\.csv': cannot be read"):
        replay(tmp_path / "none.csv")
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(ValueError, match=r"binary\.csv': cannot be read"):
        replay(tmp_path / "binary.csv")
    with pytest.raises(ValueError, match=r"^wavemaker\.file = '': "):
        replay("")
