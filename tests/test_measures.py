"""Measures of a finished run, from the command line and from its folder."""

import csv
import shutil

import numpy as np
import pytest
from tanks import make_case

from mpslab import measures
from mpslab.analysis.pictures import draw_run
from mpslab.analysis.results import open_run
from mpslab.core.diagnostics import piston_force
from mpslab.core.particles import FACE, FILLER, FLUID, PISTON, WATER
from mpslab.core.stencil import make_stencil
from mpslab.simulation import Simulation

STANDING = {
    "initial.type": "standing_wave", "initial.amplitude": 0.002, "time.end": 0.1,
    "output.interval": 0.01,
}  # fmt: skip
DRIVEN = {
    "wavemaker.type": "linear", "wavemaker.height": 0.006, "wavemaker.period": 0.4,
    "time.end": 0.2, "output.interval": 0.05,
}  # fmt: skip


@pytest.fixture(scope="module")
def standing(tmp_path_factory):
    folder = tmp_path_factory.mktemp("standing") / "run"
    Simulation(make_case(STANDING), folder).run()
    return folder


@pytest.fixture(scope="module")
def driven(tmp_path_factory):
    folder = tmp_path_factory.mktemp("driven") / "run"
    Simulation(make_case(DRIVEN), folder).run()
    return folder


def test_command_writes_a_row_for_each_frame_and_prints_the_ledger(standing, capsys):
    assert measures.main([str(standing)]) == 0
    out = capsys.readouterr().out
    assert "rms_speed [m/s]" in out
    assert "dissipated" in out
    with (standing / "measures.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 11
    assert all(float(row["isolated_share"]) == 0.0 for row in rows)


def test_tables_that_a_kill_cut_amid_a_row_are_measured_and_drawn(driven, tmp_path, capsys):
    folder = tmp_path / "cut"
    shutil.copytree(driven, folder)
    for name in ("steps", "gauges", "probes"):
        path = folder / f"{name}.csv"
        path.write_text(path.read_text()[:-4])
    assert measures.main([str(folder)]) == 0
    assert "dissipated" in capsys.readouterr().out
    assert "energy.png" in [path.name for path in draw_run(folder)]


def test_first_mode_follows_linear_theory_for_a_quarter_of_a_period(standing):
    """eta = a sin(wt) cos(kx) in a tank of 0.04 x 0.02 m: w = 26.2 rad/s."""
    rows = [row for row in measures.measure(open_run(standing)) if row["time [s]"] < 0.06]
    k = np.pi / 0.04
    w = np.sqrt(9.81 * k * np.tanh(k * 0.02))
    found = np.array([row["first_mode [m]"] for row in rows])
    expected = 0.002 * np.sin(w * np.array([row["time [s]"] for row in rows]))
    assert np.abs(found - expected).max() < 0.15 * 0.002


def test_bed_pressure_is_that_of_still_water_at_the_bed_particles(tmp_path):
    Simulation(make_case({"time.end": 0.02}), tmp_path / "run").run()
    last = measures.measure(open_run(tmp_path / "run"))[-1]
    assert last["bed_pressure [Pa]"] == pytest.approx(1000.0 * 9.81 * 0.021, rel=0.03)


def test_work_of_the_piston_is_the_energy_that_the_water_gains(driven):
    """Less what the scheme dissipates, a small part in half a period."""
    book = measures.ledger(open_run(driven).steps)
    gained = book["kinetic energy"] + book["potential energy"]
    assert gained > 0.0
    assert book["work of the piston"] == pytest.approx(gained + book["dissipated"])
    assert abs(book["dissipated"]) < 0.15 * book["work of the piston"]


def test_work_is_force_times_stroke(driven):
    steps = open_run(driven).steps
    time, force, work = (steps[k] for k in ("time", "piston_force", "piston_work"))
    assert np.all(force[time > 0.02] > 0.0)
    stroke = work[1:] / force[1:]
    # The piston starts at its rear end and has gone through its stroke after half a period.
    assert stroke.sum() > 0.0
    assert np.all(stroke[time[1:] < 0.19] > 0.0)


@pytest.mark.parametrize(("dim", "face"), [(2, 0.5), (3, 0.25)])
def test_piston_force_is_its_pressure_times_the_face_of_each_particle(dim, face):
    class Particles:
        role = np.array([FACE, FACE, FLUID, FILLER])
        body = np.array([PISTON, PISTON, WATER, PISTON])
        pressure = np.array([2.0, 4.0, 100.0, 100.0])

    assert piston_force(Particles, make_stencil(dim, 0.5, 2.1)) == 6.0 * face


def test_folder_without_a_run_is_refused_in_one_line(tmp_path, capsys):
    assert measures.main([str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"mpslab: '{tmp_path / 'case.toml'}'")
    assert "allowed: the folder of a run" in error


def test_frames_without_velocity_are_refused_by_their_key(tmp_path, capsys):
    Simulation(make_case({"time.end": 0.002, "output.fields": ["kind"]}), tmp_path / "run").run()
    assert measures.main([str(tmp_path / "run")]) == 2
    assert "output.fields = ['kind']: must hold pressure, velocity" in capsys.readouterr().err


def gauges(time, **levels):
    """A series as a run has it."""
    series = np.empty(len(time), [(name, float) for name in ("time", *levels)])
    for name, values in {"time": time, **levels}.items():
        series[name] = values
    return series


def test_harmonics_find_the_first_harmonic_and_the_height_of_a_record():
    time = np.linspace(0.0, 2.0, 801)
    phase = 2.0 * np.pi * time / 0.5
    eta = 0.04 + 0.01 * np.cos(phase - 0.7) + 0.002 * np.sin(2.0 * phase)
    dry = np.where(time > 1.5, np.nan, eta)
    found = measures.harmonics(gauges(time, a=eta, b=dry), 0.5)
    (name, amplitude, height) = found[0]
    assert (len(found), name) == (1, "a")
    assert amplitude == pytest.approx(0.01, rel=1e-3)
    assert height == pytest.approx(np.ptp(eta[time > 1.0]), rel=1e-12)


def test_harmonics_of_a_record_too_short_are_left_out():
    time = np.linspace(0.0, 1.4, 100)
    assert measures.harmonics(gauges(time, a=time), 0.5) == []
