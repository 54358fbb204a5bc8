"""The level of the still water of a run, from its case."""

import pytest

from mpslab.analysis.still import still_level


def case(maker, *tops, shape="box"):
    boxes = [{"from": [0.0, 0.0, 0.0], "to": [0.5, 0.0, top], "shape": shape} for top in tops]
    return {"tank": {"depth": 0.12}, "particles": {"spacing": 0.01}, "water": boxes,
            "wavemaker": {"type": maker}}  # fmt: skip


@pytest.mark.parametrize(
    ("given", "level"),
    [
        (case("none"), 0.12),
        (case("linear"), 0.12),
        (case("linear", 0.12, 0.122), 0.12),
        (case("linear", 0.12, 0.20), None),
        (case("none", 0.12), None),
        (case("linear", 0.12, shape="disc"), None),
    ],
)
def test_boxes_up_to_the_depth_are_still_water(given, level):
    assert still_level(given) == level
