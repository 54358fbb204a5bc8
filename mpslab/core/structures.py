"""The tables of a case for solids of any shape, and for what ties a free body to a place."""

from dataclasses import dataclass

from mpslab.core.keys import NAME, check_table, key

# How a free body can move: along x, y, z; turning about y, x, z.
MODES = ("x", "y", "z", "roll", "pitch", "yaw")


@dataclass(frozen=True, kw_only=True)
class Solid:
    """A solid of any shape, with smooth faces at any angle; at rest, on a path, or afloat."""

    name: str | None = key("its name; solid-1 and so on if left out", None, **NAME)
    shape: str = key(
        "its shape", choices=("polygon", "cylinder", "sphere", "box", "mesh"), kind="text"
    )
    points: tuple = key(
        "corners of a polygon, closed and without crossings: [x, z], with axis 'z' [x, y]",
        (),
        kind="points",
        unit="m",
    )
    center: tuple | None = key(
        "centre [x, y, z] of a cylinder (along its axis it does not count), sphere or box; of a "
        "mesh where the origin of its file is to be, [0, 0, 0] if left out",
        None,
        kind="point",
        unit="m",
    )
    radius: float = key("radius of a cylinder or sphere", 0.0, unit="m", low=0, high=1e6)
    size: tuple | None = key(
        "lengths [x, y, z] of the sides of a box before it is turned", None, kind="point", unit="m"
    )
    file: str = key(
        "triangles of a mesh: an STL, OBJ or PLY file, relative to the case file",
        "",
        copy="solid-{number}{suffix}",
    )
    unit: str = key("unit of the lengths in this file", "m", choices=("m", "cm", "mm"))
    scale: float = key("factor on these lengths", 1.0, above=0, high=1e6)
    rotation: tuple = key(
        "angles by which a box or mesh is turned about x, then y, then z (axes of the tank through "
        "its center), each right-handed: about y it turns z towards x",
        (0.0, 0.0, 0.0),
        kind="point",
        unit="deg",
        low=-360,
        high=360,
    )
    axis: str = key(
        "axis along which polygon and cylinder are drawn out: across the tank, or upright",
        "y",
        choices=("y", "z"),
    )
    ends: tuple | None = key(
        "where it ends along its axis [low, high]; as far as the tank reaches if left out",
        None,
        kind="place",
        unit="m",
    )
    motion: str = key(
        "a sine along x (sway), z (heave) or about an axis across (roll); any motion from a file; "
        "free for a body that the water moves; none for a solid at rest",
        "none",
        choices=("none", "sway", "heave", "roll", "file", "free"),
    )
    motion_file: str = key(
        "motion from a CSV file with the heading time [s] and any of x [m], z [m] and roll [deg], "
        "relative to the case file; a cubic spline joins its rows, and only what is different from "
        "the start counts",
        "",
        copy="solid-{number}-motion.csv",
    )
    amplitude: float = key("amplitude of the sine", 0.0, unit="m, of roll deg", low=0, high=1e3)
    period: float = key("period of the sine", 0.0, unit="s", low=0, high=1e6)
    start: float = key(
        "time in which the motion fades in; 0 for none", 0.0, unit="s", low=0, high=1e6
    )
    about: tuple = key("axis of the roll [x, z]", (0.0, 0.0), kind="place", unit="m")
    density: float = key("mean density of a free body; or mass", 0.0, unit="kg/m3", low=0, high=1e6)
    mass: float = key("mass of a free body", 0.0, unit="kg, in 2-D kg/m", low=0, high=1e15)
    center_of_mass: tuple | None = key(
        "centre of mass [x, y, z] of a free body; that of its shape if left out",
        None,
        kind="point",
        unit="m",
    )
    inertia: tuple = key(
        "moments of inertia about axes along x, y, z through the centre of mass, [Ixx, Iyy, Izz], "
        "in 2-D [Iyy]; those of an even density if left out",
        (),
        kind="numbers",
        unit="kg m2, in 2-D kg m",
        above=0,
    )
    locked: tuple = key(
        "how a free body cannot move: along axes, or turning about y (roll), x (pitch), z (yaw)",
        (),
        kind="texts",
        choices=MODES,
    )
    velocity: tuple = key(
        "velocity [u, v, w] with which a free body is let go at the start; not with a release",
        (0.0, 0.0, 0.0),
        kind="point",
        unit="m/s",
        low=-1e3,
        high=1e3,
    )
    release: float = key("time until which a free body is held", 0.0, unit="s", low=0)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Mooring:
    """A line from a place to a free body, which pulls when it is longer than at rest."""

    name: str | None = key("its name; mooring-1 and so on if left out", None, **NAME)
    on: str = key("name of the body", kind="text")
    anchor: tuple = key(
        "place [x, y, z] that it is fixed to", kind="point", unit="m", low=-1e6, high=1e6
    )
    at: tuple = key(
        "place [x, y, z] on the body, as it is laid out", kind="point", unit="m", low=-1e6, high=1e6
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
