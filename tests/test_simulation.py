"""The run from Python: restart to the byte, failures with reasons, series as arrays."""

import csv
import json

import h5py
import numpy as np
import pytest

import mpslab
from mpslab.output import checkpoint

BREAKER_2D = {
    "tank.width": 0.0,
    "particles.spacing": 0.005,
    "scheme.settling": 20,
    "output.interval": 0.02,
    "output.checkpoint": 0.0,
}
COARSE = {"particles.spacing": 0.004, "scheme.settling": 0}
CASES = {
    "piston and slope, 2-D": ("plunging_breaker", BREAKER_2D, 0.12),
    "periodic, 3-D": (
        "plunging_breaker", {"particles.spacing": 0.005, "scheme.settling": 20}, 0.03
    ),
    "paper's recipe": ("plunging_breaker", BREAKER_2D | {"scheme.recipe": "paper"}, 0.02),
    "side walls, SCG": (
        "dam_break",
        {
            "particles.spacing": 0.03, "scheme.solver": "scg", "scheme.settling": 20,
            "output.checkpoint": 0.0,
        },
        0.04,
    ),
}


def rows_without_seconds(path):
    with path.open(newline="", encoding="utf-8") as file:
        return [
            {k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(file)
        ]


def assert_same_bytes(a, b):
    arrays_a, state_a = checkpoint.read(a)
    arrays_b, state_b = checkpoint.read(b)
    for name in arrays_a:
        assert arrays_a[name].tobytes() == arrays_b[name].tobytes(), name
    for key in state_a:
        assert np.array_equal(state_a[key], state_b[key]), key


@pytest.mark.parametrize("name, changes, end", CASES.values(), ids=CASES)
def test_run_and_resumed_run_give_the_same_bytes(tmp_path, name, changes, end):
    case = mpslab.load_case(name, changes)
    whole = mpslab.Simulation(case, tmp_path / "whole").run(until=end)
    mpslab.Simulation(case, tmp_path / "parts").run(until=end / 2)
    parts = mpslab.Simulation.resume(tmp_path / "parts").run(until=end)
    assert parts.step == whole.step > 10
    assert_same_bytes(tmp_path / "whole/checkpoint.h5", tmp_path / "parts/checkpoint.h5")
    for table in ("steps.csv", "gauges.csv", "probes.csv", "lost.csv"):
        assert rows_without_seconds(tmp_path / "whole" / table) == rows_without_seconds(
            tmp_path / "parts" / table
        )
    with (
        h5py.File(tmp_path / "whole/particles.vtkhdf") as a,
        h5py.File(tmp_path / "parts/particles.vtkhdf") as b,
    ):
        assert np.array_equal(a["VTKHDF/Steps/Values"], b["VTKHDF/Steps/Values"])
        assert np.array_equal(a["VTKHDF/Points"], b["VTKHDF/Points"])


def test_resume_after_a_kill_drops_the_rows_after_the_checkpoint(tmp_path):
    case = mpslab.load_case("plunging_breaker", BREAKER_2D | {"output.checkpoint": 0.02})
    killed = mpslab.Simulation(case, tmp_path / "run")
    while killed.time < 0.05:
        killed.advance()
    killed.folder.flush()
    del killed
    resumed = mpslab.Simulation.resume(tmp_path / "run")
    assert 0.03 < resumed.time < 0.05
    resumed.run(until=0.06)
    steps = [int(row["step"]) for row in rows_without_seconds(tmp_path / "run/steps.csv")]
    assert steps == list(range(1, resumed.step + 1))


def test_resolved_case_runs_again_with_the_same_bytes(tmp_path):
    case = mpslab.load_case("standing_wave", COARSE)
    mpslab.Simulation(case, tmp_path / "a").run(until=0.02)
    again = mpslab.load_case(tmp_path / "a/case.toml")
    mpslab.Simulation(again, tmp_path / "b").run(until=0.02)
    assert_same_bytes(tmp_path / "a/checkpoint.h5", tmp_path / "b/checkpoint.h5")


def test_series_of_a_run_in_memory_are_arrays_with_units_of_si():
    case = mpslab.load_case("hydrostatic", {"particles.spacing": 0.004})
    seen = []
    run = mpslab.Simulation(case).run(until=0.02, progress=lambda s: seen.append(s.time))
    assert len(run.steps) == run.step == len(seen)
    assert np.all(np.diff(run.gauges["time"]) > 0)
    assert run.gauges["middle"][0] == pytest.approx(0.04, abs=4e-4)
    assert run.probes["half_depth pressure"][-1] == pytest.approx(1000 * 9.81 * 0.02, rel=0.2)
    assert run.particles.position.shape == (len(run.particles), 3)
    assert run.outcome == "finished"


def test_stop_request_ends_the_run_with_a_checkpoint(tmp_path):
    case = mpslab.load_case("hydrostatic", COARSE)

    def stop(simulation):
        simulation.stop_requested = simulation.step == 5

    run = mpslab.Simulation(case, tmp_path / "run").run(progress=stop)
    assert (run.step, run.outcome) == (5, "interrupted")
    assert mpslab.Simulation.resume(tmp_path / "run").step == 5


def failing(tmp_path, spoil=None, changes=None):
    case = mpslab.load_case("hydrostatic", COARSE | (changes or {}))
    simulation = mpslab.Simulation(case, tmp_path / "run")
    for _ in range(3 if spoil else 0):
        simulation.advance()
    if spoil:
        spoil(simulation.particles)
    with pytest.raises(mpslab.RunFailed) as failure:
        simulation.run(until=0.1)
    record = json.loads((tmp_path / "run/run.json").read_text())
    assert record["outcome"] == "failed"
    assert record["reason"] == str(failure.value)
    assert (tmp_path / "run/failed.h5").is_file()
    return str(failure.value)


def spoil_speed(particles):
    particles.velocity[np.flatnonzero(particles.fluid)[7]] = np.nan


def spoil_place(particles):
    particles.position[np.flatnonzero(particles.fluid)[:6], 0] = -0.1


def test_not_a_number_stops_the_run_with_step_time_and_place(tmp_path):
    reason = failing(tmp_path, spoil_speed)
    assert "not a number" in reason and "step 3" in reason and "t = " in reason and "x = " in reason


def test_lost_particles_are_recorded_and_stop_the_run(tmp_path):
    reason = failing(tmp_path, spoil_place)
    assert "6 of" in reason and "lost" in reason and "step 4" in reason
    lost = rows_without_seconds(tmp_path / "run/lost.csv")
    assert [row["reason"] for row in lost] == ["behind the wall at x = 0"] * 6


def test_pressure_that_does_not_converge_stops_the_run(tmp_path):
    reason = failing(tmp_path, changes={"scheme.max_iterations": 2})
    assert "did not converge" in reason and "step 1" in reason and "scheme.tolerance" in reason


def test_time_step_below_its_floor_stops_the_run(tmp_path):
    def hurry(particles):
        particles.velocity[np.flatnonzero(particles.fluid)[7], 2] = 1e5

    reason = failing(tmp_path, hurry)
    assert "time.minimum" in reason and "step 4" in reason


def test_resume_sets_a_damaged_frame_file_aside(tmp_path):
    case = mpslab.load_case("hydrostatic", COARSE)
    mpslab.Simulation(case, tmp_path / "run").run(until=0.01)
    (tmp_path / "run/particles.vtkhdf").write_bytes(b"cut off in the middle")
    with pytest.warns(UserWarning, match="set aside"):
        mpslab.Simulation.resume(tmp_path / "run").run(until=0.06)
    assert (tmp_path / "run/particles.damaged.vtkhdf").exists()
    with h5py.File(tmp_path / "run/particles.vtkhdf") as file:
        assert len(file["VTKHDF/Steps/Values"]) == 1


def test_particles_are_in_the_order_of_gid_and_to_look_at_them_changes_nothing():
    case = mpslab.load_case("plunging_breaker", {**COARSE, "tank.width": 0.0})
    seen, unseen = mpslab.Simulation(case), mpslab.Simulation(case)
    for _ in range(5):
        seen.advance()
        unseen.advance()
        assert np.all(np.diff(seen.particles.gid) > 0)
    assert np.any(np.diff(unseen._flow.particles.gid) < 0)
    for key in ("volume", "kinetic_energy", "piston_force"):
        assert seen.last_row[key] == unseen.last_row[key]
    for name, array in vars(seen.particles).items():
        assert array.tobytes() == getattr(unseen.particles, name).tobytes(), name
