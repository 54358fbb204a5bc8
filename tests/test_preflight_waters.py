"""What a preflight says of water that solids keep apart, or shut in."""

import pytest
from tanks import make_case

from mpslab.run.preflight import preflight

TANK = {"tank.length": 0.2, "tank.depth": 0.06, "tank.height": 0.08}
WALLED = {"tank.width": 0.04, "tank.periodic": False}


def block(x0, x1, z0, z1):
    return {"from": [x0, 0.0, z0], "to": [x1, 0.04, z1]}


CHAMBER = [block(0.05, 0.06, 0.0, 0.03), block(0.10, 0.11, 0.0, 0.03),
           block(0.05, 0.11, 0.03, 0.04)]  # fmt: skip


def report(**changes):
    return preflight(make_case({**TANK, **changes}))


@pytest.mark.parametrize("across", [{}, WALLED], ids=["2-D", "3-D"])
def test_wall_through_the_water_makes_two_bodies_of_it(across):
    wall = {"obstacle": [block(0.12, 0.13, 0.0, 0.08)]}
    width = 0.04 if across else 1.0
    found = report(**wall, **across)
    assert found.findings["waters"] == pytest.approx(
        [0.12 * 0.06 * width, 0.07 * 0.06 * width], rel=0.05
    )
    assert "2, of" in dict(found.sections["Particles"])["bodies of water"]
    assert not found.warnings


@pytest.mark.parametrize("across", [{}, WALLED], ids=["2-D", "3-D"])
def test_water_in_a_closed_chamber_is_warned_of_with_its_place(across):
    (warning,) = report(obstacle=CHAMBER, **across).warnings
    assert warning.startswith("0.0012 m2" if not across else "4.8e-05 m3")
    assert "x = 0.08, " in warning and "z = 0.015" in warning and "shut in" in warning


def test_chamber_with_a_door_is_not_shut_in():
    door = [*CHAMBER[:1], block(0.10, 0.11, 0.012, 0.03), CHAMBER[2]]
    found = report(obstacle=door)
    assert not found.warnings
    assert "waters" not in found.findings


def test_gate_keeps_waters_apart_and_a_slab_under_water_does_not():
    boxes = [block(0.0, 0.1, 0.0, 0.06), block(0.1, 0.2, 0.0, 0.03)]
    gate = {"gate": [{"x": 0.1, "speed": 1.0}], "water": boxes}
    assert len(report(**gate).findings["waters"]) == 2
    assert "waters" not in report(obstacle=[block(0.05, 0.15, 0.02, 0.03)]).findings


def test_water_that_meets_itself_across_a_periodic_tank_is_one_body():
    pier = {"name": "pier", "shape": "box", "center": [0.1, 0.02, 0.04], "size": [0.3, 0.02, 0.1]}
    sides = {"tank.width": 0.04, "solid": [pier]}
    assert len(report(**sides, **{"tank.periodic": False}).findings["waters"]) == 2
    assert "waters" not in report(**sides, **{"tank.periodic": True}).findings


def test_tank_full_to_its_lid_has_no_air_to_miss():
    full = {"tank.depth": 0.0795, "tank.lid": True, "obstacle": CHAMBER}
    assert not report(**full).warnings
