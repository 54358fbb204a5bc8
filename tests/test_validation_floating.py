"""Theory that bodies in the water are held against."""

from types import SimpleNamespace

import pytest

from validation.floating import compare


@pytest.mark.parametrize(("shape", "share"), [("cylinder", 1.0), ("sphere", 0.5)])
def test_added_mass_is_that_of_unbounded_water_where_nothing_is_near(shape, share):
    def added(side):
        tank = SimpleNamespace(length=side, width=side, depth=side)
        body = SimpleNamespace(shape=shape, radius=0.06, center=[0.5 * side] * 3)
        return compare.added(SimpleNamespace(solid=[body], tank=tank))

    assert added(6.0) == pytest.approx(share, rel=0.01)
    assert share * 1.01 < added(0.36) < share * 1.3
