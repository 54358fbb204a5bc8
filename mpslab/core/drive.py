"""The tables of a case that set its water in motion."""

from dataclasses import dataclass

from mpslab.core.keys import check_table, key


@dataclass(frozen=True, kw_only=True)
class Initial:
    """The state at t = 0."""

    type: str = key(
        "water at rest, or with the velocities of a standing wave, a strain, a rotation or a "
        "uniform stream along x",
        "rest",
        choices=("rest", "standing_wave", "strain", "rotation", "stream"),
    )
    amplitude: float = key("amplitude of the standing wave", 0.0, unit="m", low=0)
    mode: int = key("half wavelengths of the standing wave in the tank", 1, low=1)
    rate: float = key(
        "A about the water's centre of mass: strain (A x, -A z), rotation (A z, -A x)",
        0.0,
        unit="1/s",
        low=-1e6,
        high=1e6,
    )
    speed: float = key("speed of the stream", 0.0, unit="m/s", low=-1e3, high=1e3)

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Wavemaker:
    """The piston at x = 0."""

    type: str = key(
        "theory of the piston's motion; none for a fixed wall", "none", family="wavemakers"
    )
    height: float = key("wave height; 0 where a type needs none", 0.0, unit="m", low=0, high=1e3)
    period: float = key("wave period; 0 where a type needs none", 0.0, unit="s", low=0, high=1e4)
    stroke: float = key(
        "stroke of the piston; 0 to follow from height; of a function the farthest it goes",
        0.0,
        unit="m",
        low=0,
    )
    first: str = key(
        "which way the piston goes first; backward with linear and second_order only",
        "forward",
        choices=("forward", "backward"),
    )
    start: float = key("time in which the motion fades in; 0 for none", 0.0, unit="s", low=0)
    second_height: float = key(
        "height of the other wave of type bichromatic; 0 for the same", 0.0, unit="m", low=0
    )
    second_period: float = key("period of the other wave of it", 0.0, unit="s", low=0)
    spectrum: str = key(
        "spectrum of an irregular or focused sea, in which height is Hm0 and period Tp",
        "jonswap",
        choices=("jonswap", "pierson_moskowitz", "tma", "file"),
    )
    gamma: float = key("how much the peak of jonswap and tma is raised", 3.3, low=1, high=20)
    band: tuple = key(
        "lowest and highest frequency of the sea over that of its peak",
        (0.5, 3.0),
        kind="numbers",
        low=0,
    )
    record: float = key(
        "time after which the sea comes again; 0 for 200 periods", 0.0, unit="s", low=0
    )
    amplitudes: str = key(
        "of the sea's waves: each as the spectrum says, or so in the mean (Gaussian)",
        "deterministic",
        choices=("deterministic", "random"),
    )
    seed: int = key("seed of the sea's phases, and of random amplitudes", 0, low=0, high=10**9)
    order: int = key(
        "order of irregular, focused and bichromatic waves; 2 makes no free long waves",
        1,
        low=1,
        high=2,
    )
    place: float = key("x at which a focused wave has its crest", 0.0, unit="m", low=0)
    time: float = key("when it has; 0 for the soonest", 0.0, unit="s", low=0, high=1e4)
    amplitude: float = key(
        "height of that crest; 0 for the highest of largest_of waves", 0.0, unit="m", low=0
    )
    largest_of: int = key("how many waves of the sea it is the highest of", 1000, low=2, high=10**9)
    phase: float = key(
        "turn of all of a focused wave's parts; 180 for a trough", 0.0, unit="degrees", low=-360,
        high=360,
    )
    file: str = key(
        "file of time [s] and displacement or elevation [m], or of a spectrum, frequency [Hz] and "
        'variance density [m2/Hz], such as CSV; "" for none',
        "",
        copy="wavemaker.csv",
    )
    function: str = key(
        'displacement(t) of one\'s own, as "module:name" of what Python can import; "" for none', ""
    )
    quantity: str = key(
        "what the file holds: how far the piston goes, or the surface elevation that it is to make",
        "displacement",
        choices=("displacement", "elevation"),
    )
    offset: float = key("time of the file at t = 0 of the run", 0.0, unit="s", low=-1e9, high=1e9)
    smoothing: float = key(
        "period of wiggles in the file that a spline halves; it takes out shorter ones, 0 for none",
        0.0,
        unit="s",
        low=0,
    )
    absorption: bool = key(
        "true: the piston also gives way to waves that come back to it; regular waves, and those "
        "of types without a theory, are known by period",
        False,
    )
    room: float = key(
        "how far absorption may take the piston off its motion; 0 for twice its longest stroke, "
        "however long the run",
        0.0,
        unit="m",
        low=0,
    )

    def __post_init__(self):
        check_table(self)


@dataclass(frozen=True, kw_only=True)
class Frame:
    """Motion of the tank itself: the run is in the tank, and inertia acts on its water."""

    type: str = key(
        "a sine of sway (along x), heave (up and down) or roll (about an axis across, positive "
        "where it lifts the far end); the record of a file; none for a tank at rest",
        "none",
        choices=("none", "sway", "heave", "roll", "file"),
    )
    amplitude: float = key("amplitude of the sine", 0.0, unit="m, of roll deg", low=0, high=1e3)
    period: float = key("period of the sine", 0.0, unit="s", low=0, high=1e6)
    start: float = key(
        "time in which the motion fades in; 0 for none", 0.0, unit="s", low=0, high=1e6
    )
    center: tuple | None = key(
        "axis of the roll [x, z]; below the middle of the tank, at z = 0, if left out",
        None,
        kind="place",
        unit="m",
    )
    file: str = key(
        "CSV file with a heading: time [s] and any of x [m], z [m] and roll [deg]; "
        '"" for none',
        "",
        copy="frame.csv",
    )

    def __post_init__(self):
        check_table(self)
