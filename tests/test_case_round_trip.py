"""Cases on the way to TOML and back: every key is written, and any valid case comes back equal."""

import re
from dataclasses import fields

from hypothesis import given, settings
from hypothesis import strategies as st

from mpslab import cases
from mpslab.cases.checks import NARROWEST, WIDEST_SOLVED
from mpslab.cases.complete import complete
from mpslab.cases.recipes import RECIPES
from mpslab.core import plugins
from mpslab.core.keys import SMALLEST, toml_name
from mpslab.core.parameters import LISTS, TABLES, Case


def test_every_key_is_written_with_its_unit_and_meaning():
    box = {"from": [0.7, 0.0, 0.0], "to": [0.8, 0.1, 0.1]}
    gate = {"x": 0.6, "speed": 1.0}
    force = {"name": "wall", "on": "end_wall"}
    pile = {"shape": "cylinder", "axis": "z", "center": [0.75, 0.075, 0.0], "radius": 0.03}
    pile |= {"ends": [0.0, 0.3], "size": [0.1, 0.1, 0.1]}
    zone = {"from": 1.0, "to": 1.6, "period": 1.0}
    several = {"obstacle": [box], "gate": [gate], "solid": [pile], "force": [force],
               "sponge": [zone]}  # fmt: skip
    text = cases.dumps(cases.load_case("dam_break", several))
    text += cases.dumps(cases.load_case("overtopping"))
    barge = {"shape": "box", "center": [2.0, 0.0, 0.4], "size": [0.3, 0.1, 0.2], "name": "box",
             "motion": "free", "mass": 30.0, "center_of_mass": [2.0, 0.0, 0.38]}  # fmt: skip
    line = {"on": "box", "anchor": [1.0, 0.0, 0.0], "at": [1.85, 0.0, 0.4], "stiffness": 10.0,
            "length": 1.0}  # fmt: skip
    afloat = {"solid": [barge], "mooring": [line]}
    text += cases.dumps(cases.load_case("floating_box", afloat))
    for kind in (*TABLES.values(), *LISTS.values()):
        for item in fields(kind):
            assert re.search(
                rf"^{toml_name(item)} = .*{re.escape(item.metadata['doc'])}$", text, re.M
            )
    assert re.search(r"^spacing = 0\.01 +# \[m\] particle spacing d0$", text, re.M)


def line():
    return st.text(max_size=30).map(
        lambda words: "".join(c for c in words if c.isprintable()).strip()
    )


def numbers_of(table, *names):
    """Random values in range for the plain numbers of a table, those named left out."""
    return st.fixed_dictionaries(
        {},
        optional={
            item.name: in_range(item.metadata)
            for item in fields(TABLES[table])
            if item.metadata["kind"] in ("number", "integer") and item.name not in names
        },
    )


def in_range(metadata):
    low = metadata.get("low", metadata.get("above"))
    high = metadata.get("high", 1e6)
    if metadata["kind"] == "integer":
        return st.integers(int(low), int(high))
    above = "above" in metadata
    found = st.floats(SMALLEST if above and low == 0 else low, high, exclude_min=above)
    return found.map(no_trifle)


def no_trifle(number):
    """The number, 0 where it is smaller than any that a key may have."""
    return number if abs(number) >= SMALLEST else 0.0


@st.composite
def valid_tables(draw):
    spacing = draw(st.floats(1e-6, 10.0))
    length, depth = (spacing * draw(st.floats(3.1, 60.0)) for _ in range(2))
    width = draw(st.sampled_from((0.0, 20.0 * spacing)))
    place = st.floats(0.0, length).map(no_trifle)
    tank = {"length": length, "depth": depth, "width": width, "periodic": draw(st.booleans())}
    stabilisers = st.permutations(plugins.names("stabilisers"))
    scheme = draw(numbers_of("scheme"))
    scheme["stabiliser"] = draw(stabilisers)[: draw(st.integers(0, 3))]
    scheme["recipe"] = draw(st.sampled_from(tuple(RECIPES)))
    if RECIPES[scheme["recipe"]]["gradient"] == "corrected":
        scheme["gradient_radius"] = 0.0
    else:
        scheme["gradient_radius"] = draw(st.floats(NARROWEST, WIDEST_SOLVED))
    return {
        "title": draw(line()),
        "tank": tank,
        "particles": {"spacing": spacing, **draw(numbers_of("particles", "spacing", "layers"))},
        "time": {"end": draw(st.floats(1e-3, 1e6))},
        "fluid": {"gravity": draw(st.floats(SMALLEST, 1e3))}
        | draw(numbers_of("fluid", "gravity")),
        "scheme": scheme,
        "wavemaker": {
            "type": "still",
            "file": draw(line()),
            **draw(numbers_of("wavemaker", "stroke", "room")),
        },
        "output": draw(numbers_of("output"))
        | {"pictures": draw(st.lists(st.floats(0.0, 1e9).map(no_trifle)))},
        "gauge": [
            {"name": str(i), "x": x} for i, x in enumerate(draw(st.lists(place, max_size=4)))
        ],
    }


@given(valid_tables())
@settings(max_examples=100, deadline=None)
def test_any_case_comes_back_equal_from_its_own_toml(tables):
    case = cases.from_tables(tables)
    assert isinstance(case, Case)
    assert cases.loads(cases.dumps(case)) == case
    assert complete(case) == case
