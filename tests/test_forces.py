"""Forces on solids: what they get is what the water gets from them, and what theory says."""

import numpy as np
import pytest
from ranks import start
from tanks import make_case

from mpslab import Simulation, open_run
from mpslab.core.keys import CaseError
from mpslab.output import checkpoint
from mpslab.run import step

GRAVITY, DENSITY = 9.81, 1000.0
STILL = {"particles.jitter": 0.0, "time.start": 1e-5}
SHAKEN = {"particles.jitter": 0.05, "initial.type": "stream", "initial.speed": 0.1}
ALL = [{"name": "all", "on": "tank"}]
PAPER = {"scheme.recipe": "paper", "particles.jitter": 0.05, "time.start": 4e-4}
# What no recipe has: friction at walls, eddies, all stabilisers, and pairs that are not central.
REST = {
    "scheme.gradient": "cmps", "scheme.source": "mixed", "fluid.viscosity": 1e-3,
    "scheme.wall_slip": False, "scheme.smagorinsky": 0.2,
    "scheme.stabiliser": ["collision", "shifting", "ds"],
}  # fmt: skip
SOLIDS = {
    "tank.length": 0.08, "wavemaker.type": "linear", "wavemaker.height": 0.008,
    "wavemaker.period": 0.4, "gate": [{"x": 0.02, "speed": 0.5}],
    "obstacle": [{"from": [0.048, 0.0, 0.0], "to": [0.06, 0.0, 0.01]}],
}  # fmt: skip


def steps(changes, count=6):
    """The forces of some steps of the small tank, and its weight [N]; in 2-D for 1 m of width."""
    run = Simulation(make_case({"force": ALL, **changes}))
    for _ in range(count):
        run.advance()
    stencil = run._flow.stencil
    count = np.count_nonzero(run.particles.fluid)
    return run.table("forces"), count * DENSITY * stencil.spacing**stencil.dim * GRAVITY


def balance(forces, term):
    return np.column_stack([forces[f"water {term} {axis}"] for axis in "xyz"])


def force(forces, name, kind="f"):
    return np.column_stack([forces[f"{name} {kind}{axis}"] for axis in "xyz"])


SCHEMES = {
    "standard": SHAKEN, "paper": PAPER, "rest": SHAKEN | REST,
    "symmetric": SHAKEN | {"scheme.gradient": "symmetric"},
    "corrected with friction": SHAKEN | REST | {"scheme.gradient": "corrected"},
    "piston, gate, obstacle": SOLIDS, "the paper's, with these": SOLIDS | PAPER,
    "3-D": {"tank.width": 0.01, "particles.jitter": 0.05},
    "periodic": {"tank.width": 0.012, "tank.periodic": True, "particles.jitter": 0.05},
}  # fmt: skip


@pytest.mark.parametrize("changes", SCHEMES.values(), ids=SCHEMES)
def test_what_the_water_loses_and_weighs_is_what_solids_get(changes):
    forces, weight = steps(changes)
    got = balance(forces, "-dP/dt") + balance(forces, "weight")
    assert np.abs(balance(forces, "on solids")).max() > 0.1 * weight
    np.testing.assert_allclose(balance(forces, "on solids"), got, rtol=0.0, atol=1e-12 * weight)


def test_the_weight_is_that_of_the_water():
    forces, weight = steps({})
    expected = np.tile([0.0, 0.0, -weight], (len(forces), 1))
    np.testing.assert_allclose(balance(forces, "weight"), expected, atol=1e-9 * weight)


@pytest.mark.parametrize("recipe", ["standard", "paper"])
def test_parts_add_up_to_all_solids(recipe):
    names = ["tank", "piston", "gate-1", "obstacle-1", "bed", "end_wall"]
    asked = [{"name": name, "on": name} for name in names]
    shaken = {"particles.jitter": 0.05, "time.start": 4e-4}
    forces, weight = steps({**SOLIDS, **shaken, "scheme.recipe": recipe, "force": asked})
    each = {name: force(forces, name) for name in names}
    whole = each["tank"] + each["piston"] + each["gate-1"] + each["obstacle-1"]
    np.testing.assert_allclose(whole, balance(forces, "on solids"), atol=1e-12 * weight)
    np.testing.assert_allclose(each["bed"] + each["end_wall"], each["tank"], atol=1e-12 * weight)
    for name, axis, sign in (("piston", 0, -1), ("end_wall", 0, 1), ("bed", 2, -1)):
        assert sign * each[name][-1, axis] > 0.02 * weight, name


def test_collisions_with_a_solid_are_part_of_its_force():
    """Without gravity or pressure, of water that meets the end wall, they are all there is."""
    run = Simulation(make_case({**PAPER, "force": ALL}))
    flow, moving = run._flow, run.particles.fluid
    run.particles.velocity[moving, 0] = 1.0
    run.particles.position[moving, 0] += 0.0012
    flow.reaction.begin(flow.particles, flow.particles.velocity.copy())
    step.find_neighbors(flow)
    step.measure(flow)
    dt = 1e-4
    flow.reaction.find(flow.near)
    step._stabilise(flow, "predicted", dt)
    flow.reaction.end(flow, dt)
    (row,) = run._record.instruments["forces"].read(flow)
    found = dict(zip(run.table("forces").dtype.names, row, strict=True))
    mass = DENSITY * 0.002**2
    assert found["all fx"] > 5 * mass * 1.0 / dt
    assert found["all fx"] == pytest.approx(found["water -dP/dt x"], rel=1e-12)


@pytest.mark.parametrize("layers", [10, 20])
def test_force_on_the_end_wall_of_water_on_the_lattice_is_hydrostatic(layers):
    """Its moment about the foot is that of a third of the depth."""
    depth = 0.02
    wall = [{"name": "wall", "on": "end_wall", "about": [0.04, 0.0, 0.0]}]
    forces, _ = steps({**STILL, "particles.spacing": depth / layers, "force": wall}, 2)
    expected = 0.5 * DENSITY * GRAVITY * depth**2
    assert forces["wall fx"][-1] == pytest.approx(expected, rel=0.005)
    assert forces["wall my"][-1] == pytest.approx(expected * depth / 3.0, rel=0.01)


@pytest.mark.parametrize("width", [0.0, 0.012])
def test_a_box_in_still_water_weighs_less_by_the_water_it_displaces(width):
    box = {"tank.width": width, "tank.periodic": width > 0.0, "tank.length": 0.04,
           "obstacle": [{"from": [0.014, 0.0, 0.006], "to": [0.026, width, 0.014]}],
           "force": [{"name": "box", "on": "obstacle-1",
                      "about": [0.02, 0.5 * width, 0.01]}]}  # fmt: skip
    forces, _ = steps({**STILL, **box}, 2)
    lift = DENSITY * GRAVITY * 0.012 * 0.008 * (width or 1.0)
    np.testing.assert_allclose(force(forces, "box")[-1], [0.0, 0.0, lift], atol=0.01 * lift)
    np.testing.assert_allclose(force(forces, "box", "m")[-1], 0.0, atol=1e-4 * lift * 0.012)


@pytest.mark.parametrize("width", [0.0, 0.01])
def test_moments_about_two_points_differ_by_the_lever_of_the_force(width):
    arm = np.array([0.03, 0.004 if width else 0.0, 0.01])
    asked = [{"name": name, "on": "tank", "about": about}
             for name, about in (("one", [0.0, 0.0, 0.0]), ("other", arm.tolist()))]  # fmt: skip
    forces, weight = steps({"tank.width": width, "particles.jitter": 0.05, "force": asked})
    difference = force(forces, "one", "m") - force(forces, "other", "m")
    np.testing.assert_allclose(difference, np.cross(arm, force(forces, "one")),
                               atol=1e-12 * weight)  # fmt: skip


def test_a_row_is_the_mean_over_the_time_since_the_last_one():
    each = Simulation(make_case({**SHAKEN, "force": ALL, "time.end": 0.02})).run()
    seldom = Simulation(
        make_case({**SHAKEN, "force": ALL, "time.end": 0.02, "output.gauge_interval": 0.005})
    ).run()
    fine, coarse = each.table("forces"), seldom.table("forces")
    assert len(fine) == each.step > 3 * len(coarse) > 6
    spans = np.diff(fine["time"], prepend=0.0)
    at = np.searchsorted(fine["time"], coarse["time"])
    assert fine["time"][at].tolist() == coarse["time"].tolist()
    for name in fine.dtype.names[1:]:
        sums = np.diff(np.cumsum(fine[name] * spans)[at], prepend=0.0)
        expected = sums / np.diff(coarse["time"], prepend=0.0)
        np.testing.assert_allclose(coarse[name], expected, rtol=1e-9, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("width, units", [(0.0, ("N/m", "N m/m")), (0.01, ("N", "N m"))])
def test_headings_name_units_and_in_2d_the_metre_of_width(tmp_path, width, units):
    changes = {"force": ALL, "tank.width": width, "time.end": 0.005}
    run = Simulation(make_case(changes), tmp_path / "run").run(until=0.001)
    heading, first, *_ = (tmp_path / "run/forces.csv").read_text().splitlines()
    said = ["time [s]", *(f"all {kind}{axis} [{unit}]"
                          for kind, unit in zip("fm", units, strict=True) for axis in "xyz")]
    said += [f"water {what} {axis} [{units[0]}]" for what in ("-dP/dt", "weight", "on solids")
             for axis in "xyz"]  # fmt: skip
    assert heading.split(",") == said
    assert float(first.split(",")[0]) == run.steps["time"][0]
    assert open_run(tmp_path / "run").table("forces").tolist() == run.table("forces").tolist()


def test_forces_go_on_to_the_byte_amid_an_interval(tmp_path):
    case = make_case({**SOLIDS, "force": ALL, "output.gauge_interval": 0.004, "time.end": 0.02})
    Simulation(case, tmp_path / "whole").run()
    Simulation(case, tmp_path / "parts").run(until=0.0102)
    _, state = checkpoint.read(tmp_path / "parts/checkpoint.h5")
    assert state["forces.span"] > 0.0
    Simulation.resume(tmp_path / "parts").run()
    whole, parts = ((tmp_path / name / "forces.csv").read_bytes() for name in ("whole", "parts"))
    assert whole == parts and whole.count(b"\n") == 6


def test_forces_are_the_same_on_any_number_of_ranks():
    changes = {**SOLIDS, "tank.length": 0.16, "scheme.solver": "scg", "time.end": 0.004,
               "force": [*ALL, {"name": "box", "on": "obstacle-1"}]}  # fmt: skip
    (one,), several = (start("series", ranks, changes) for ranks in (1, 3))
    assert [found["forces"] for found in several] == [one["forces"]] * 3
    assert len(one["forces"]) > 3


@pytest.mark.parametrize("changes, said", [
    ({"force": [{"name": "a", "on": "pistn"}]},
     "force.0.on = 'pistn': must be one of tank, bed, end_wall"),
    ({"force": [{"name": "a", "on": "obstacle-1"}]}, "force.0.on = 'obstacle-1'"),
    ({"force": [{"name": "a", "on": "piston"}]}, "force.0.on = 'piston'"),
    ({"force": ALL * 2}, "force.1.name = 'all': must be different from force.0.name"),
    ({"force": [{"name": "water", "on": "bed"}]}, "force.0.name = 'water': must be another word"),
    ({"force": [{"name": f"f{i}", "on": "bed"} for i in range(101)]}, "force has 101 entries"),
    ({"force": ALL, "scheme.gradient": "gc"}, "scheme.gradient = 'gc': must be one whose pair"),
    ({"force": [{"name": "a", "on": "bed", "about": [0.0, 1.0]}]}, "force.0.about = [0.0, 1.0]"),
])  # fmt: skip
def test_forces_that_there_are_not_are_refused_in_one_line(changes, said):
    with pytest.raises(CaseError) as caught:
        make_case(changes)
    assert said in str(caught.value) and "\n" not in str(caught.value)
