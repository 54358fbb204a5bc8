"""The tables of what is read in a run: gauges, probes, forces, run-up and overtopping."""

from dataclasses import dataclass

from mpslab.core.keys import NAME, check_table, key


@dataclass(frozen=True, kw_only=True)
class Gauge:
    """A wave gauge: reads the surface elevation at x, y."""

    name: str = key("heading of its column", **NAME)
    x: float = key(
        "distance from the wavemaker at rest; a list for a gauge at each place, NAME-1 and so on",
        unit="m",
        low=0,
    )
    y: float | None = key("place across the tank; mid width if left out", None, unit="m", low=0)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Probe:
    """A probe: reads pressure and velocity at x, y, z."""

    name: str = key("heading of its columns", **NAME)
    x: float = key("distance from the wavemaker at rest", unit="m", low=0)
    y: float | None = key("place across the tank; mid width if left out", None, unit="m", low=0)
    z: float = key(
        "height above z = 0; a list for a probe at each height, NAME-1 and so on", unit="m", low=0
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Force:
    """Force and moment on a solid, the mean since the row before, in forces.csv."""

    name: str = key("heading of its columns", **NAME)
    on: str = key(
        "what it is on: tank, bed, end_wall, piston, or the name of an obstacle, a gate or a solid",
        kind="text",
    )
    about: tuple = key(
        "point [x, y, z] that the moment is taken about; y does not count in 2-D",
        (0.0, 0.0, 0.0),
        kind="point",
        unit="m",
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Runup:
    """How far the water runs up the slope that its still level meets, in runup.csv.

    The highest water that hangs together with the sea and is so thick.
    """

    name: str = key("heading of its columns", **NAME)
    thickness: float = key(
        "how thick the water has to be, at right angles to the bed; 0 for 2 spacings",
        0.0,
        unit="m",
        low=0,
    )
    y: float | None = key("place across the tank; mid width if left out", None, unit="m", low=0)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Overtopping:
    """The water that passes an upright plane across the tank, in overtopping.csv."""

    name: str = key("heading of its columns", **NAME)
    x: float = key("place of the plane, behind a crest", unit="m", above=0)
    drain: bool = key(
        "true: what has passed is taken out of the run, and counted in lost.csv", False
    )

    def __post_init__(self):
        check_table(self)
