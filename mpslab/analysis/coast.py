"""Run-up, overtopping and walls of a run, beside what EurOtop and Goda expect for its waves."""

from dataclasses import dataclass, replace

import numpy as np

from mpslab.analysis import eurotop, goda, shore, windows
from mpslab.core import bed as beds
from mpslab.theory import breaking, waves

FEWEST = 2.0  # periods in a window


@dataclass(frozen=True)
class Coast:
    """What the waves do at the end of the tank.

    Attributes
    ----------
    level : float [m]
        Of the still water.
    window : mpslab.analysis.windows.Window
        It begins when the waves have come to the shore; for regular waves it has whole periods.
    runups : tuple of mpslab.analysis.shore.Runup
    overtopped : tuple of mpslab.analysis.shore.Overtopped
    pushed : tuple of mpslab.analysis.shore.Pushed
    hunt : float [m]
        Run-up of regular waves by Hunt's law, NaN for a sea or without a slope.
    expected : (n,) structured array
        From `mpslab.analysis.eurotop.table`: "R2%" for a sea, and "q", beside what the first run-up
        and the first plane of the case measured.
    notes : tuple of str
    """

    level: float
    window: windows.Window
    runups: tuple
    overtopped: tuple
    pushed: tuple
    hunt: float
    expected: np.ndarray
    notes: tuple


def look(run, level, regular, arrival, window, asked, period, found):
    """What the waves do at the shore.

    Parameters
    ----------
    run : mpslab.analysis.results.Run
    level : float [m]
        Of the still water.
    regular : bool
    arrival : mpslab.analysis.windows.Arrival or None
    window : mpslab.analysis.windows.Window
        Of the gauges.
    asked : bool
        Whether the user asked for this window; if not, it was found.
    period : float [s]
        Of the waves; for a sea the mean.
    found : mpslab.analysis.reflection.Reflection or None
        The incident waves.

    Returns
    -------
    Coast
    """
    case, notes = run.tables, []
    site = Site(case, level)
    if not asked and arrival:
        window, notes = _later(window, arrival, site.place, period)
    if regular:
        whole = int(window.duration / period + 1e-6)
        window = replace(window, end=window.start + whole * period) if whole else window
    count = window.duration / period
    sea = _Incident.of(found, regular, period, site.gravity)
    runups = [_runup(run, one, window, count, site, regular) for one in case.get("runup", ())]
    planes = case.get("overtopping", ())
    passed = [_overtopped(run, one, window, count, site, period) for one in planes]
    pushed = [_pushed(run, one, window, site, sea, arrival) for one in case.get("force", ())]
    runups, passed, pushed = (tuple(filter(None, part)) for part in (runups, passed, pushed))
    return Coast(
        level=level,
        window=window,
        runups=runups,
        overtopped=passed,
        pushed=pushed,
        hunt=_hunt(site, sea) if runups and regular and sea else np.nan,
        expected=_expected(site, sea, regular, runups, passed, planes),
        notes=(*notes, *_notes(runups, passed, count, regular)),
    )


@dataclass(frozen=True)
class _Incident:
    """The incident waves: Hm0, Tm-1,0 and the height of the highest wave."""

    significant: float
    period: float
    highest: float

    @classmethod
    def of(cls, found, regular, period, gravity):
        """The incident waves of a reflection; None if there is no reflection."""
        if found is None or not gravity:
            return None
        height = found.incident_height
        if regular:
            return cls(np.sqrt(2.0) * height, period, height)
        mean = np.nansum(found.incident / found.frequency) / np.nansum(found.incident)
        return cls(height, float(mean), goda.HIGHEST * height)


class Site:
    """Bed and walls of a run's case, from its tables.

    Attributes
    ----------
    level, gravity, density, spacing
        [m], [m/s2], [kg/m3], [m].
    bed : list of [x, z]
    width : float [m]
        1 in 2-D.
    slope : float
        Of the bed where the still water meets it; 0 if it does not meet the bed.
    place, top : float [m]
        x of the still shoreline, or of the first wall; and height of the slope's crest, infinite
        without a slope.
    """

    def __init__(self, case, level):
        self.level, self.case = level, case
        self.gravity, self.density = case["fluid"]["gravity"], case["fluid"]["density"]
        self.spacing = case["particles"]["spacing"]
        length = case["tank"]["length"]
        self.bed = case["tank"].get("bed") or [[0.0, 0.0], [length, 0.0]]
        self.width = case["tank"]["width"] or 1.0
        self.obstacles = case.get("obstacle", ())
        self.slope, self.place, self.top = 0.0, length, np.inf
        edge = beds.shore(self.bed, level)
        if edge:
            x, z = np.array(self.bed).T
            first = int(np.argmax(z > level))
            self.slope = float((z[first] - z[first - 1]) / (x[first] - x[first - 1]))
            self.place = float(x[first] - (z[first] - level) / self.slope)
            self.top = float(beds.elevation(self.bed, edge[1]))
        walls = [one["from"][0] for one in self.obstacles if one["to"][2] > level]
        self.place = min([self.place, *walls])

    def ground(self, x):
        """Height of the highest ground up to a place [m], and which obstacle that is, or None."""
        along = [z for place, z in self.bed if place <= x]
        highest, of = max([*along, float(beds.elevation(self.bed, x))]), None
        for one in self.obstacles:
            if one["from"][0] <= x and one["to"][2] > highest:
                highest, of = one["to"][2], one
        return highest, of

    def wall(self, x, top):
        """The wall at a place [m], whose top is at z [m]."""
        foot = float(beds.elevation(self.bed, x))
        before = [(place, z) for place, z in self.bed if place < x]
        berm, low = x, foot
        while before and before[-1][1] == foot:
            berm = before.pop()[0]
        while before and before[-1][1] < low:
            low = before.pop()[1]
        slope = 0.0
        if berm == x and low < foot:  # no foundation: the sea bed itself slopes up to the wall
            slope, low = float(beds.slope(self.bed, x - 1e-9)), foot
        stands = berm < x and low < foot
        return goda.Wall(
            depth=self.level - low, foot=self.level - foot, over_berm=self.level - foot,
            crest=top - self.level, berm=x - berm if stands else 0.0, slope=slope,
        )  # fmt: skip


def _later(window, arrival, place, period):
    """The part of a window after the waves have come to a place, and notes."""
    start = max(window.start, arrival.at(place))
    if window.end - start >= FEWEST * period:
        reason = f"from when the waves have come to x = {place:.4g} m"
        return windows.Window(start, window.end, reason), []
    return window, [
        f"shore: the waves have come to x = {place:.4g} m at t = {start:.4g} s, and less than two "
        "periods are left: the numbers are of the window of the gauges"
    ]


def _inside(table, window):
    return table[(table["time"] >= window.start) & (table["time"] <= window.end)]


def _runup(run, one, window, count, site, regular):
    part = run.table("runup")
    if not len(_inside(part, window)):
        return None
    level = part[f"{one['name']} level"] - site.level
    return shore.runup(one["name"], part["time"], level, window, one["thickness"], count,
                       site.top - site.level, regular)  # fmt: skip


def _overtopped(run, one, window, count, site, period):
    table = run.table("overtopping")
    if not len(_inside(table, window)):
        return None
    particle = site.spacing ** (3 if site.case["tank"]["width"] else 2)
    freeboard = site.ground(one["x"])[0] - site.level
    return shore.overtopped(one["name"], table, window, freeboard, count, period, particle,
                            site.width, site.spacing)  # fmt: skip


def _pushed(run, one, window, site, sea, arrival):
    """The force on an end wall, or on an obstacle from the bed to above the water; else None."""
    found = [
        box
        for box in site.obstacles
        if box["name"] == one["on"]
        and box["from"][2] <= beds.elevation(site.bed, box["from"][0]) + site.spacing
    ]
    tank = site.case["tank"]
    if found:
        x, top = found[0]["from"][0], found[0]["to"][2]
        across = found[0]["to"][1] - found[0]["from"][1] if tank["width"] else 1.0
    elif one["on"] == "end_wall":
        x, top, across = tank["length"], tank["height"], site.width
    else:
        return None
    table = run.table("forces")
    deep = site.level - float(beds.elevation(site.bed, x))
    if top <= site.level or deep <= 0.0 or not site.gravity or not len(_inside(table, window)):
        return None
    wall = site.wall(x, top)
    expected = None
    if sea:
        length = waves.wavelength(sea.period, wall.depth, site.gravity)
        expected = goda.load(wall, sea.highest, length, site.density, site.gravity)
    still = 0.5 * site.density * site.gravity * deep**2 * across
    before = x / np.sqrt(site.gravity * wall.depth) if arrival else 0.0
    return shore.pushed(one["name"], table, before, window, still, across, expected)


def _hunt(site, sea):
    """Run-up of regular waves by Hunt's law [m]."""
    if not site.slope:
        return np.nan
    deep = site.level - site.bed[0][1]
    height = sea.highest / waves.shoaling_coefficient(sea.period, deep, site.gravity)
    return breaking.hunt_runup(height, sea.period, site.slope, site.gravity)


def _expected(site, sea, regular, runups, passed, planes):
    """What EurOtop expects, a table."""
    found, measured = [], {}
    if sea and site.slope and not regular:
        found.append(eurotop.runup(sea.significant, sea.period, site.slope, site.gravity))
        measured["R2%"] = runups[0].r2 if runups else np.nan
    if sea and passed and passed[0].freeboard >= 0.0:
        one = _discharge(site, sea, passed[0].freeboard, site.ground(planes[0]["x"])[1])
        if one and regular:
            doubt = "regular waves, taken as an irregular sea of the same energy, Hm0 = 1.41 H"
            one = replace(one, doubts=(*one.doubts, doubt))
        found += [one] * bool(one)
        measured["q"] = passed[0].discharge
    return eurotop.table(found, measured)


def _discharge(site, sea, freeboard, obstacle):
    """Discharge that EurOtop expects over the bed or over an obstacle; None for anything else."""
    if obstacle is None:
        if not site.slope:
            return None
        return eurotop.overtopping_of_slope(
            sea.significant, sea.period, site.slope, freeboard, site.gravity
        )
    wall = site.wall(obstacle["from"][0], obstacle["to"][2])
    return eurotop.overtopping_of_wall(
        sea.significant, sea.period, wall.foot, freeboard, site.gravity, foreshore=wall.slope > 0.0
    )


def _notes(runups, passed, count, regular):
    notes = []
    if any(one.crest for one in runups):
        notes.append("run-up: the water has come to the crest, its levels end there")
    if runups and not regular and count < shore.FEW_RUNUPS:
        fit = ", so R2% is that of Rayleigh's distribution" if runups[0].fitted else ""
        notes.append(
            f"run-up: {count:.0f} incident waves; R2% wants {shore.FEW_RUNUPS} or more{fit}"
        )
    notes += [
        f"overtopping '{one.name}': unresolved, the layer is {one.layer:.2g} spacings thick; "
        f"{shore.RESOLVED:g} or more are to be trusted"
        for one in passed
        if len(one.events) and not one.resolved
    ]
    return notes
