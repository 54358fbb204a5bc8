"""Mean currents at the probes of a run."""

import csv

import numpy as np
import pytest
from seas import write_run

from mpslab import sea as command
from mpslab.cases.reader import from_tables
from mpslab.core.keys import CaseError

PERIOD, END, STEP = 1.5, 30.0, 0.01
WAVES = {"wavemaker.type": "linear", "wavemaker.height": 0.02, "wavemaker.period": PERIOD,
         "wavemaker.start": 1.5}  # fmt: skip
PROBES = [{"name": "deep", "x": 5.0, "z": 0.1}, {"name": "high", "x": 5.0, "z": 0.5},
          {"name": "dry", "x": 5.0, "z": 0.7}]  # fmt: skip


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Waves over a current of -20 mm/s; the second probe is out of the water half of the time."""
    folder = tmp_path_factory.mktemp("currents") / "run"
    time = np.arange(0.0, END + 0.5 * STEP, STEP)
    turn = 2.0 * np.pi * time / PERIOD
    write_run(folder, time, 0.01 * np.cos(turn)[:, None], [5.0], 0.5, WAVES | {"probe": PROBES})
    deep = np.column_stack([100.0 + 0.0 * time, 0.1 * np.cos(turn) - 0.02, 0.0 * time,
                            0.05 * np.sin(turn)])  # fmt: skip
    high = np.where(np.cos(turn)[:, None] > 0.0, deep, np.nan)
    rows = np.column_stack([time, deep, high, np.full_like(deep, np.nan)])
    head = ["time [s]", *(f"{p['name']} {q}" for p in PROBES for q in
                          ("pressure [Pa]", "u [m/s]", "v [m/s]", "w [m/s]"))]  # fmt: skip
    with (folder / "probes.csv").open("w", newline="") as file:
        csv.writer(file).writerows([head, *rows.tolist()])
    return command.look(folder)


def test_mean_is_that_of_whole_waves_and_the_rest_is_told_as_rms(found):
    deep = found.currents[0]
    assert deep["u"] == pytest.approx(-0.02, abs=1e-3)
    assert deep["w"] == pytest.approx(0.0, abs=1e-3)
    assert deep["u rms"] == pytest.approx(0.1 / np.sqrt(2.0), rel=0.01)
    assert deep["w rms"] == pytest.approx(0.05 / np.sqrt(2.0), rel=0.01)
    assert (deep["x"], deep["z"], deep["wet"]) == (5.0, 0.1, 1.0)


def test_probe_that_falls_dry_has_the_mean_of_when_it_was_wet(found):
    high = found.currents[1]
    assert high["wet"] == pytest.approx(0.5, abs=0.01)
    assert high["u"] == pytest.approx(0.1 * 2.0 / np.pi - 0.02, abs=2e-3)
    dry = found.currents[2]
    assert dry["wet"] == 0.0 and np.isnan(dry["u"])


def test_currents_are_written_and_told(found, tmp_path, capsys):
    paths = command.write(found, tmp_path)
    rows = list(csv.reader((tmp_path / "currents.csv").read_text().splitlines()))
    assert rows[0][:5] == ["probe", "x [m]", "y [m]", "z [m]", "u [m/s]"]
    assert [row[0] for row in rows[1:]] == ["deep", "high", "dry"]
    assert "current &#39;deep&#39;" in paths[-1].read_text()
    assert command.main([str(found.run.folder), "--out", str(tmp_path)]) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if "current" in line]
    assert "u = -20 mm/s" in told[0] and "under water for 50 %" in told[1]
    assert not any("'dry'" in line for line in told)


def test_list_of_heights_makes_a_probe_at_each():
    least = {"tank": {"length": 0.5, "depth": 0.1}, "particles": {"spacing": 0.01},
             "time": {"end": 1.0}}  # fmt: skip
    case = from_tables({**least, "probe": [{"name": "p", "x": 0.2, "z": [0.0, 0.03, 0.06]}]})
    assert [(one.name, one.z) for one in case.probe] == [("p-1", 0.0), ("p-2", 0.03), ("p-3", 0.06)]
    with pytest.raises(CaseError, match=r"^probe\.0\.z = \[\]: must be a number, or a list"):
        from_tables({**least, "probe": [{"name": "p", "x": 0.2, "z": []}]})
