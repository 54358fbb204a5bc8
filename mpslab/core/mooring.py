"""The table of a case that ties a free body to a place."""

from dataclasses import dataclass

from mpslab.core.keys import NAME, check_table, key

# How a free body can move: along x, y, z; turning about y, x, z.
MODES = ("x", "y", "z", "roll", "pitch", "yaw")


@dataclass(frozen=True, kw_only=True)
class Mooring:
    """A line from a place to a free body, which pulls when it is longer than at rest."""

    name: str | None = key("its name; mooring-1 and so on if left out", None, **NAME)
    on: str = key("name of the body", kind="text")
    anchor: tuple = key("place [x, y, z] that it is fixed to", kind="point", unit="m", low=-1e6)
    at: tuple = key(
        "place [x, y, z] on the body, as it is laid out", kind="point", unit="m", low=-1e6
    )
    stiffness: float = key("force over stretch", unit="N/m, in 2-D N/m2", above=0)
    length: float = key("length at rest", unit="m", low=0)
    damping: float = key(
        "force over rate of stretch, while it is taut", 0.0, unit="N s/m, in 2-D N s/m2", low=0
    )
    pushes: bool = key("true: a spring, which pushes as well; false: a line, which goes slack",
                       False)  # fmt: skip

    def __post_init__(self):
        check_table(self)
