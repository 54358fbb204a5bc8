"""Mistakes in a case that are found before any work: solids that cannot be, units, sizes."""

import pytest

import mpslab
from mpslab.core import motion_file
from mpslab.core.keys import CaseError
from mpslab.run.preflight import preflight
from mpslab.solids.wavemakers import _record

BLOCK = {"shape": "polygon", "points": [[0.25, 0.05], [0.35, 0.05], [0.35, 0.15], [0.25, 0.15]]}


def load(tmp_path, *solids, **changes):
    """A tank of 0.6 x 0.1 m with solids."""
    path = tmp_path / "case.toml"
    path.write_text(
        "[tank]\nlength = 0.6\ndepth = 0.1\nheight = 0.25\n[particles]\nspacing = 0.01\n"
        "[time]\nend = 0.3\n",
        encoding="utf-8",
    )
    return mpslab.load_case(path, {"solid": list(solids), **changes})


def polygon(*points):
    return {"shape": "polygon", "points": [list(point) for point in points]}


def test_the_tank_itself_is_fine(tmp_path):
    assert len(load(tmp_path, BLOCK).solid) == 1


@pytest.mark.parametrize(
    ("solid", "key", "why"),
    [
        ({**BLOCK, "name": "bed"}, "solid.0.name", "different from those of the tank"),
        (polygon((0.2, 0.05), (0.3, 0.05), (0.4, 0.05)), "solid.0.points", "thick or more"),
        (polygon((0.2, 0.05), (0.4, 0.05), (0.3, 0.054)), "solid.0.points", "thick or more"),
        ({"shape": "cylinder", "center": [0.3, 0.0, 0.05], "radius": 45.0}, "solid.0.radius",
         "no farther than 1.2 m"),
        (polygon((-0.1, -0.1), (0.8, -0.1), (0.8, 0.12), (-0.1, 0.12)), "solid", "room for water"),
        ({**BLOCK, "motion": "sway", "amplitude": 0.4, "period": 1.0}, "solid.0.amplitude",
         "beyond its bed or end walls"),
        ({**BLOCK, "motion": "heave", "amplitude": 0.1, "period": 0.3}, "solid.0.amplitude",
         "beyond its bed or end walls"),
        ({**BLOCK, "motion": "sway", "amplitude": 0.1, "period": 1e-6}, "solid.0.amplitude",
         "a motion slower than"),
        ({**BLOCK, "motion": "free", "density": 500.0, "velocity": [1e6, 0.0, 0.0]},
         "solid.0.velocity", "from -1000 to 1000"),
    ],
)  # fmt: skip
def test_a_solid_that_cannot_be_is_refused(tmp_path, solid, key, why):
    with pytest.raises(CaseError) as caught:
        load(tmp_path, solid)
    assert str(caught.value).startswith(f"{key} = ") and why in str(caught.value)


@pytest.mark.parametrize("heading", ["time [ms],x [m]", "time [s],x [mm]", "time [s],roll [rad]"])
def test_a_motion_in_other_units_is_refused(tmp_path, heading):
    file = tmp_path / "motion.csv"
    file.write_text(f"{heading}\n0,0\n0.1,0.005\n0.2,0\n", encoding="utf-8")
    with pytest.raises(CaseError, match=r"heading .* must be time \[s\]"):
        load(tmp_path, {**BLOCK, "motion": "file", "motion_file": str(file)})


def test_a_motion_without_units_is_taken(tmp_path):
    file = tmp_path / "motion.csv"
    file.write_text("time,x [m]\n0,0\n0.1,0.005\n0.2,0\n", encoding="utf-8")
    load(tmp_path, {**BLOCK, "motion": "file", "motion_file": str(file)})


def test_a_gate_cannot_pass_a_solid(tmp_path):
    gate = {"x": 0.3, "speed": 0.5}
    with pytest.raises(CaseError, match=r"solid\.0\.points = .*outside of gate\.0"):
        load(tmp_path, BLOCK, gate=[gate])


def test_the_piston_needs_room_before_a_solid(tmp_path):
    solid = polygon((0.02, 0.0), (0.10, 0.0), (0.10, 0.15), (0.02, 0.15))
    waves = {"wavemaker.type": "linear", "wavemaker.height": 0.03, "wavemaker.period": 1.0}
    with pytest.raises(ValueError, match=r"solid\.0\.points = .*ahead of the foremost place"):
        preflight(load(tmp_path, solid, **waves))


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"wavemaker.type": "irregular", "wavemaker.start": 1e6}, "wavemaker.start"),
        ({"wavemaker.type": "focused", "wavemaker.time": 1e6}, "wavemaker.time"),
        ({"wavemaker.type": "linear", "wavemaker.period": 1e308}, "wavemaker.period"),
        ({"wavemaker.type": "file", "wavemaker.file": f"{'x' * 300}.csv"}, "wavemaker.file"),
    ],
)
def test_numbers_and_names_beyond_all_use_are_refused(tmp_path, changes, key):
    with pytest.raises(CaseError) as caught:
        load(tmp_path, **changes)
    assert str(caught.value).startswith(f"{key} = ")


def test_a_gauge_sees_the_water_above_a_solid(tmp_path):
    solid = polygon((0.2, 0.0), (0.4, 0.0), (0.4, 0.06), (0.2, 0.06))
    gauge = [{"name": "top", "x": 0.3}]
    short = {"scheme.settling": 20, "time.end": 0.01}
    simulation = mpslab.Simulation(load(tmp_path, solid, gauge=gauge, **short))
    simulation.run()
    levels = simulation.table("gauges")
    assert abs(levels[levels.dtype.names[-1]][-1] - 0.1) < 0.002


@pytest.mark.parametrize(
    ("bed", "why"),
    [
        ([[0, 0], [0.3, 0], [0.3000001, 0.2], [0.3000002, 0], [0.6, 0]], "turns by 165 degrees"),
        ([[0, 0], [0.003, 0.2], [0.6, 0.2]], "room for water"),
    ],
)
def test_a_bed_that_cannot_be_is_refused(tmp_path, bed, why):
    with pytest.raises(CaseError, match=f"tank.bed = .*{why}"):
        load(tmp_path, **{"tank.bed": bed})


def test_a_bed_may_have_steps(tmp_path):
    load(tmp_path, **{"tank.bed": [[0, 0], [0.3, 0], [0.3001, 0.05], [0.6, 0.05]]})


def test_steps_below_the_least_are_told(tmp_path):
    case = load(tmp_path, **{"fluid.viscosity": 1000.0})
    assert any(line.startswith("time.minimum = ") for line in preflight(case).warnings)


@pytest.mark.parametrize(
    ("key", "table", "part"),
    [
        ("gauge", {"name": "b", "x": 0.9}, "gauge.1.x = 0.9: must be from 0"),
        ("gauge", {"name": "b"}, "gauge.1.x is missing"),
        ("gauge", {"name": "a-2", "x": 0.1}, "gauge.1.name = 'a-2': must be different"),
        ("gauge", {"name": "b", "x": ["gauge.2"]}, "gauge.1.x = 'gauge.2': must be a"),
        ("probe", {"name": "b", "x": 0.2, "z": 0.9}, "probe.1.z = 0.9: must be from the bed"),
    ],
)
def test_a_message_has_the_number_of_the_table_in_the_file(tmp_path, key, table, part):
    several = {"name": "a", "x": [0.1, 0.2, 0.3]}
    several = {"gauge": several, "probe": {"name": "a", "x": 0.2, "z": [0.01, 0.02, 0.03]}}[key]
    with pytest.raises(CaseError) as caught:
        load(tmp_path, **{key: [several, table]})
    assert str(caught.value).startswith(part)
    with pytest.raises(CaseError, match=rf"^{key}\.0\.[xz] = 7\.0: must be from"):
        load(tmp_path, **{key: [{**several, "xz"[key == "probe"]: [0.1, 7.0]}]})


@pytest.mark.parametrize("edge", [0.25, 0.26, 0.262, 0.264])
def test_water_inside_a_solid_is_refused(tmp_path, edge):
    solid = polygon((edge, 0.05), (0.6 - edge, 0.05), (0.6 - edge, 0.15), (edge, 0.15))
    box = {"from": [0.264, 0.0, 0.064], "to": [0.335, 0.0, 0.123]}
    with pytest.raises(CaseError, match=r"^solid = \['solid-1'\]: must be .*room for water"):
        load(tmp_path, solid, water=[box])
    load(tmp_path, solid, water=[{**box, "to": [0.335, 0.0, 0.171]}])


@pytest.mark.parametrize("kind", ["solid", "frame", "wavemaker"])
def test_a_file_of_motion_is_read_once_until_it_changes(tmp_path, monkeypatch, kind):
    file = tmp_path / "motion.csv"
    file.write_text("time,x\n0,0\n0.1,0.005\n0.2,0\n", encoding="utf-8")
    solid = [{**BLOCK, "motion": "file", "motion_file": str(file)}] if kind == "solid" else []
    changes = {f"{kind}.type": "file", f"{kind}.file": str(file)} if not solid else {}
    opened = []

    def watched(path, *arguments, **options):
        opened.append(path == str(file))
        return open(path, *arguments, **options)

    for module in (motion_file, _record):
        monkeypatch.setattr(module, "open", watched, raising=False)
    preflight(load(tmp_path, *solid, **changes))
    preflight(load(tmp_path, *solid, **changes))
    assert opened == [True]
    file.write_text("time,x\n0,0\n0.1,never\n0.2,0\n", encoding="utf-8")
    with pytest.raises(ValueError, match="never"):
        preflight(load(tmp_path, *solid, **changes))
