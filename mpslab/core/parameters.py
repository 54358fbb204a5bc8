"""The parameters of a case: one frozen dataclass for each table of its TOML file.

Each table checks its own values when it is made. What depends on several tables is checked in
`mpslab.cases`, which also fills in the values that follow from others (0 or None here).
"""

from dataclasses import dataclass, field, fields

from mpslab.core.bed import elevation
from mpslab.core.drive import Frame, Initial, Wavemaker
from mpslab.core.keys import NAME, CaseError, check_table, check_value, key, shown
from mpslab.core.readings import Force, Gauge, Overtopping, Probe, Runup
from mpslab.core.scheme import Scheme
from mpslab.core.structures import Mooring, Solid


@dataclass(frozen=True, kw_only=True)
class Tank:
    """The tank, from the wavemaker at x = 0 to the end wall; z = 0 is the lowest bed."""

    length: float = key("length, from the wavemaker at rest to the end wall", unit="m", above=0)
    depth: float = key("level of the still water above z = 0", unit="m", above=0)
    width: float = key("width across y; 0 for a 2-D tank (x-z)", 0.0, unit="m", low=0)
    height: float = key(
        "height of the walls; 0 for the larger of 3 depth and top of the bed + depth",
        0.0,
        unit="m",
        low=0,
    )
    bed: tuple = key(
        "bed as points [x, z] from x = 0 to x = length; [] for flat",
        (),
        kind="points",
        unit="m",
        low=0,
    )
    roughness: float = key(
        "equivalent sand roughness of walls and solids, for scheme.wall_law; 0: smooth",
        0.0,
        unit="m",
        low=0,
    )
    periodic: bool = key("true: periodic across y; false: side walls", False)
    lid: bool = key("true: closed on top, at tank.height; not with a wavemaker or a gate", False)

    def __post_init__(self):
        check_table(self)

    def bed_height(self, x):
        """Height of the bed at x [m], by straight lines between the points of the bed."""
        return elevation(self.bed, x)

    @property
    def paddle_depth(self):
        """Depth of the still water at the wavemaker [m], 0 where it is dry."""
        return max(self.depth - (self.bed[0][1] if self.bed else 0.0), 0.0)

    @property
    def deepest(self):
        """Largest depth of the still water [m], 0 where all is dry."""
        return max(self.depth - min((z for _, z in self.bed), default=0.0), 0.0)


@dataclass(frozen=True, kw_only=True)
class Fluid:
    """The fluid and the gravity it is under."""

    density: float = key("density", 1000.0, unit="kg/m3", above=0, high=1e5)
    viscosity: float = key("kinematic viscosity", 1e-6, unit="m2/s", low=0, high=1e3)
    gravity: float = key("acceleration of gravity", 9.81, unit="m/s2", low=0, high=1e3)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Box:
    """A box in the tank."""

    start: tuple = key(
        "corner [x, y, z] with the smallest coordinates; y does not count in 2-D",
        kind="point",
        unit="m",
        low=0,
        name="from",
    )
    end: tuple = key(
        "corner [x, y, z] with the largest coordinates", kind="point", unit="m", low=0, name="to"
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Water(Box):
    """A box of water, or what it encloses; without any, the tank is filled to its still depth."""

    shape: str = key(
        "the box itself, or the disc in x-z that touches its sides, in 3-D a cylinder along y",
        "box",
        choices=("box", "disc"),
    )


@dataclass(frozen=True, kw_only=True)
class Obstacle(Box):
    """A solid box that stands in the tank."""

    name: str | None = key("its name; obstacle-1 and so on if left out", None, **NAME)


@dataclass(frozen=True, kw_only=True)
class Gate:
    """A plate across the tank, lifted straight up; a few spacings thick, onshore of x."""

    x: float = key("place of the face towards the wavemaker", unit="m", above=0)
    speed: float = key("speed at which it is lifted", unit="m/s", above=0, high=1e3)
    opens: float = key("time at which it begins to rise", 0.0, unit="s", low=0)
    lift: float = key(
        "how far it is lifted, as a sluice; 0 for clear of the walls", 0.0, unit="m", low=0
    )
    name: str | None = key("its name; gate-1 and so on if left out", None, **NAME)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Particles:
    """How the tank is filled with particles."""

    spacing: float = key("particle spacing d0", unit="m", above=0)
    layers: int = key(
        "layers of wall and dummy particles; 0 for enough to fill the larger radius",
        0,
        low=0,
        high=20,
    )
    jitter: float = key(
        "random displacement of the fluid at t = 0", 0.001, unit="spacings", low=0, high=0.3
    )
    seed: int = key("seed of the random displacement", 0, low=0, high=10**9)
    bed: str = key(
        "layers of particles along the slope, or on the lattice",
        "smooth",
        choices=("smooth", "staircase"),
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Time:
    """The end of the run and the limits of the time step."""

    end: float = key("end of the run", unit="s", above=0)
    courant: float = key(
        "dt <= courant spacing / largest speed, but for particles without neighbours; 0 for 0.5, "
        "half with projection 'predicted'",
        0.0,
        low=0,
        high=1,
    )
    compression: float = key(
        "dt <= compression / largest rate at which water runs together before the pressure acts, "
        "in the mean over a particle and the water beside it; not with projection 'predicted'",
        0.02,
        above=0,
        high=10,
    )
    viscous: float = key("dt <= viscous spacing^2 / viscosity", 0.1, above=0, high=1)
    growth: float = key("dt <= growth last dt", 1.1, above=1, high=10)
    maximum: float = key(
        "largest dt; 0 for 0.4 spacing / sqrt(gravity depth), 0.1 with projection 'predicted'; "
        "in a tank that moves with the strongest pull on water at rest for gravity; without any "
        "0.2 or 0.1 spacing / largest speed at the start",
        0.0,
        unit="s",
        low=0,
    )
    start: float = key("first dt; 0 for maximum / 10", 0.0, unit="s", low=0)
    minimum: float = key(
        "dt below which the run stops; 0 for maximum / 10000", 0.0, unit="s", low=0
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Parallel:
    """How the tank is shared out among processes."""

    balance: str = key(
        "where to cut the tank among processes; no effect on one",
        "optimal",
        choices=("static", "centroid", "optimal"),
    )
    rebalance_every: int = key(
        "time steps from cut to cut, and from row to row of phases.csv", 20, low=1
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Output:
    """What is written, and when."""

    interval: float = key("time between frames of particles; 0 for end / 50", 0.0, unit="s", low=0)
    fields: tuple = key(
        "fields of a frame",
        ("velocity", "pressure", "kind", "surface"),
        kind="texts",
        choices=("velocity", "pressure", "number_density", "kind", "surface"),
    )
    checkpoint: float = key("time between checkpoints; 0 for end / 5", 0.0, unit="s", low=0)
    gauge_interval: float = key(
        "time between readings of gauges, probes, forces, run-up and overtopping; 0 for every step",
        0.0,
        unit="s",
        low=0,
    )
    pictures: tuple = key(
        "times of the pictures; [] to spread them over the run", (), kind="numbers", unit="s", low=0
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Sponge:
    """A zone in which the water is led to rest; strongest at its end."""

    start: float = key("x where it begins", unit="m", low=0, name="from")
    end: float = key("x where it ends, most often at the end wall", unit="m", low=0, name="to")
    strength: float = key(
        "rate of the damping at its end, in angular frequencies of the wave; 0 for the one that "
        "reflects least by linear theory",
        0.0,
        low=0,
        high=1e3,
    )
    period: float = key("period of the wave; 0 for wavemaker.period", 0.0, unit="s", low=0)

    def __post_init__(self):
        check_table(self)


# Tables of a case, in the order in which they are written; those of LISTS may come several times.
TABLES = {
    "tank": Tank,
    "fluid": Fluid,
    "initial": Initial,
    "wavemaker": Wavemaker,
    "frame": Frame,
    "particles": Particles,
    "scheme": Scheme,
    "time": Time,
    "parallel": Parallel,
    "output": Output,
}
LISTS = {
    "water": Water,
    "obstacle": Obstacle,
    "gate": Gate,
    "solid": Solid,
    "mooring": Mooring,
    "sponge": Sponge,
    "gauge": Gauge,
    "probe": Probe,
    "force": Force,
    "runup": Runup,
    "overtopping": Overtopping,
}


@dataclass(frozen=True, kw_only=True)
class Case:
    """Everything a run needs to know. `mpslab.load_case` makes one with nothing left open."""

    name: str = key("short name of the case", "case", **NAME)
    title: str = key("what the case shows", "")
    tank: Tank
    particles: Particles
    time: Time
    fluid: Fluid = field(default_factory=Fluid)
    initial: Initial = field(default_factory=Initial)
    wavemaker: Wavemaker = field(default_factory=Wavemaker)
    frame: Frame = field(default_factory=Frame)
    scheme: Scheme = field(default_factory=Scheme)
    parallel: Parallel = field(default_factory=Parallel)
    output: Output = field(default_factory=Output)
    water: tuple[Water, ...] = ()
    obstacle: tuple[Obstacle, ...] = ()
    gate: tuple[Gate, ...] = ()
    solid: tuple[Solid, ...] = ()
    mooring: tuple[Mooring, ...] = ()
    sponge: tuple[Sponge, ...] = ()
    gauge: tuple[Gauge, ...] = ()
    probe: tuple[Probe, ...] = ()
    force: tuple[Force, ...] = ()
    runup: tuple[Runup, ...] = ()
    overtopping: tuple[Overtopping, ...] = ()

    def __post_init__(self):
        for item in fields(self):
            value = getattr(self, item.name)
            if item.name in TABLES:
                _require(value, TABLES[item.name], item.name)
            elif item.name in LISTS:
                value = tuple(value)
                for one in value:
                    _require(one, LISTS[item.name], item.name)
            else:
                value = check_value(item.name, value, item.metadata)
            object.__setattr__(self, item.name, value)

    @property
    def dim(self) -> int:
        """Number of space dimensions: 2 for a tank without width."""
        return 3 if self.tank.width > 0.0 else 2


def _require(value, kind, name):
    if not isinstance(value, kind):
        raise CaseError(
            f"{name} = {shown(value)}: must be made of mpslab.core.parameters.{kind.__name__}"
        )
