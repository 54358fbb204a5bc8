"""Where and how high the waves of a run break, and how far they run up."""

import numpy as np

from mpslab.analysis.overturning import JET, find_crest
from mpslab.analysis.snapshots import middle_slice
from mpslab.core import gauges
from validation.data import foremost

HEIGHT, DEEP_HEIGHT = 0.0196, 0.0186  # [m] of the paper, and unshoaled
SLOPE, TOE, BEACH = 0.1, 0.2, 0.55  # [-], [m], [m]: water beyond runs up
ON_SLOPE = 0.3  # [m]: a wave that breaks is beyond, and the next one not there yet
FIRST, SECOND, THIRD = (0.7, 1.2), (1.2, 1.75), (1.9, 2.6)  # seconds in which these waves break
PASSING = 0.05  # [s] from the steepest front to the crest, and to spare
COMPANY = 1  # others within two spacings: the tip of a row has one or two, spray has none
JET_WATER = 32e-6  # [m2] over air: eight particles of 2 mm; at 1 mm as many may be spray
SHALLOW = 2.0  # [spacings] of water: in less, a height over the depth has no meaning


def crests(run):
    """Time [s] and `Crest` of the water on the slope, frame by frame, a list."""
    found = []
    for frame in run.frames:
        piece = middle_slice(frame.time, frame, run.spacing, run.case.tank.width)
        wet = piece.fluid & (piece.x > ON_SLOPE)
        crest = find_crest(piece.x[wet], piece.z[wet], piece.speed[wet], run.spacing)
        found.append((frame.time, crest))
    return found


def overturns(crest, spacing):
    """Whether enough water hangs over air."""
    return crest.jet >= max(JET, JET_WATER / spacing**2)


def moment(found, between, spacing):
    """Time and crest of the first frame in which a wave overturns or, if none does, of the one in
    which it is steepest; NaN and None if there are no frames.
    """
    found = [(time, crest) for time, crest in found if between[0] < time < between[1]]
    jets = [(time, crest) for time, crest in found if overturns(crest, spacing)]
    if jets:
        return jets[0]
    return max(found, key=lambda pair: pair[1].steepness, default=(np.nan, None))


class Breaker:
    """A wave where it overturns, or is steepest if it does not; all NaN without frames of it.

    Attributes
    ----------
    time : float [s]
    x : float
        Middle of what hangs over air, or the place of the steepest front [m].
    depth : float
        Of the still water there [m], below zero beyond the shoreline.
    height : float
        Range of the level there over the period before [m]; of a wave that does not overturn, until
        its crest has followed the front.
    jet : int
        Most particles over air at once, in any frame of the wave.
    overturns : bool
    """

    def __init__(self, run, found, between):
        jets = [crest.jet for time, crest in found if between[0] < time < between[1]]
        self.spacing, self.jet = run.spacing, max(jets, default=0)
        self.x = self.depth = self.height = np.nan
        self.time, crest = moment(found, between, run.spacing)
        self.overturns = crest is not None and overturns(crest, run.spacing)
        if crest:
            self.x = crest.x
            self.depth = run.depth - SLOPE * max(self.x - TOE, 0.0)
            self.height = _range(run, self.x, self.time + (0.0 if self.overturns else PASSING))

    @property
    def seen(self):
        """What was seen of it, in words."""
        if self.overturns:
            return f"overturns, {self.jet} particles over air"
        return f"steepest; {self.jet} particles over air"

    @property
    def index(self):
        """Height over depth; NaN in water of one or two particles."""
        return self.height / self.depth if self.depth > SHALLOW * self.spacing else np.nan


def _range(run, x, time):
    """Range of the level at a place over the period before a time [m]."""
    period, width = run.case.wavemaker.period, run.case.tank.width
    levels = [
        gauges.surface_elevation(
            frame.position.astype(float), frame.kind, run.spacing, x, 0.5 * width, width
        )
        for frame in run.frames
        if time - period < frame.time <= time
    ]
    return np.nanmax(levels) - np.nanmin(levels)


class Waves:
    """What the waves of a run do.

    Attributes
    ----------
    first, second, third : Breaker
    at_toe : float
        First crest less the trough after it, at the toe [m].
    """

    def __init__(self, name, run):
        self.name, self.run = name, run
        self.period = run.case.wavemaker.period
        time, level = run.gauge("toe")
        crest = np.argmax(np.where(time < self.period, level, -np.inf))
        trough = level[crest:][time[crest:] < time[crest] + self.period].min()
        self.at_toe = level[crest] - trough
        found = crests(run)
        self.first = Breaker(run, found, FIRST)
        # What hangs over air on the beach is run-up of the wave before.
        at_sea = [(time, crest) for time, crest in found if crest.x < BEACH]
        self.second = Breaker(run, at_sea, SECOND)
        self.third = Breaker(run, at_sea, THIRD)

    @property
    def later(self):
        """The second and the third wave by their names, those that overturn."""
        waves = {"second": self.second, "third": self.third}
        return {name: wave for name, wave in waves.items() if wave.overturns}

    def runup(self, since=0.0):
        """Highest place that water with others around it reached on the slope after a time [m]."""
        x = max(
            foremost(position[position[:, 0] > BEACH], self.run.spacing, COMPANY)
            for time, position, _ in self.run.water()
            if time >= since
        )
        return SLOPE * (x - TOE) - self.run.depth
