"""Profiles of a dam break on a wet bed against a film."""

from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from mpslab.analysis.overturning import find_crest
from mpslab.core.kinds import FLUID
from validation.comparison import Comparison
from validation.data import foremost

DATA = Path(__file__).parent / "data" / "spheric5_janosi_d38mm_profiles.csv"
STILL = 0.038  # [m] level of the layer
FAR = (0.25, 0.20, 0.15, 0.10)  # [m] at the end of a profile, tried in turn: undisturbed if flat
FLAT = 0.004  # [m] between the highest and the lowest point there; the film has 1 to 3 mm
STEP = 0.002  # [m] between points along a profile of the film; it is read every 10 mm
RAISED = 0.010  # [m] above the still level: disturbed
COMPANY = 3  # others within two spacings, without which a particle is spray
TURNED = 0.010  # [m] that a profile turns back: it overhangs
JET_FROM = 0.4  # [s] on: what overhangs in the film is the front; before, the back of the head
NEAR = 0.1  # [m] between the overhangs of film and simulation
EARLIEST, LATEST = 0.15, -0.05  # [s] by which the simulation may be early
SHOWN = (0.219, 0.343, 0.468)  # seconds


def compare(runs):
    """Distance of the profiles, front and jet, of the finest run, shifted in time."""
    result = Comparison()
    film = _film()
    matches = [_Match(name, run, film) for name, run in _from_coarse_to_fine(runs)]
    finest = matches[-1]
    result.measure("shift", 1e3 * finest.shift)
    result.measure("profiles", 1e3 * finest.distance)
    result.measure("front", 1e3 * np.sqrt(np.mean(np.square(finest.ahead))))
    result.measure("jet", finest.jets)
    if len(matches) > 1:
        spacings = [match.run.spacing for match in matches]
        result.converge("Distance of the profiles [m]", spacings, [m.distance for m in matches])
    _hold_front(result, finest)
    _draw(result, finest)
    columns = ["run", "time of the film [s]", "simulation early by [s]", "rms distance [mm]",
               "front ahead [mm]", "film turns back by [mm]", "film turns back at x [m]",
               "particles over air", "at x [m]"]  # fmt: skip
    result.table("Frame by frame", columns, [row for match in matches for row in match.rows()])
    return result


def _from_coarse_to_fine(runs):
    """Names and runs."""
    return sorted(runs.items(), key=lambda pair: -pair[1].spacing)


class _Match:
    """A run beside the film, with the shift in time that brings them nearest.

    Attributes
    ----------
    name : str
    run : validation.run.Run
    film : dict of float to (n, 2) float64
        Profiles by time [m].
    shift : float
        How much earlier the simulation is [s].
    distances : list of float
        Of the surfaces, frame by frame [m].
    ahead : list of float
        How far the front of the simulation is ahead [m].
    """

    def __init__(self, name, run, film):
        self.name, self.run, self.film = name, run, film
        frames = [(frame.time, _surface(frame, run.spacing), _front(frame, run.spacing))
                  for frame in run.frames]  # fmt: skip
        moments, self._surfaces, fronts = zip(*frames, strict=True)
        self._moments, self._fronts = np.array(moments), np.array(fronts)
        step = run.case.output.interval
        shifts = step * np.arange(round(LATEST / step), round(EARLIEST / step) + 1)
        self.shift = min(shifts, key=lambda shift: np.mean(np.square(self._apart(shift))))
        self.distances = self._apart(self.shift)
        self.ahead = [self._fronts[self._next_to(time - self.shift)] - _foremost(film[time])
                      for time in self.times]  # fmt: skip
        self._crests = [self._crest(time) for time in self.times]

    @property
    def times(self):
        """Times of the film that the run reaches [s]."""
        return self._times(self.shift)

    @property
    def distance(self):
        """Mean of the rms distances of the frames [m]."""
        return np.mean(self.distances)

    @property
    def jets(self):
        """Frames in which the fronts of film and simulation overhang at the same place."""
        return sum(self._both_overhang(k) for k, time in enumerate(self.times) if time > JET_FROM)

    def surface(self, time):
        """Surface of the simulation at a time of the film: (n, 2) x and z [m]."""
        return self._surface_of(time - self.shift)

    def front(self):
        """Time of the film [s] and place of the front [m] of the simulation, (n,) each."""
        return self._moments + self.shift, self._fronts

    def rows(self):
        """Lines of the table, one a frame."""
        rows = []
        for k, time in enumerate(self.times):
            back, x = _turn(self.film[time])
            crest = self._crests[k]
            rows.append([self.name, time, self.shift, 1e3 * self.distances[k],
                         1e3 * self.ahead[k], 1e3 * back, x if back >= TURNED else np.nan,
                         crest.jet, crest.x if crest.overturns else np.nan])  # fmt: skip
        return rows

    def _both_overhang(self, k):
        """Whether film and simulation overhang at the same place in a frame."""
        back, x = _turn(self.film[self.times[k]])
        crest = self._crests[k]
        return back >= TURNED and crest.overturns and abs(crest.x - x) < NEAR

    def _surface_of(self, time):
        """Surface of the frame next to a time of the run [s]."""
        return self._surfaces[self._next_to(time)]

    def _next_to(self, time):
        """Number of the frame next to a time of the run [s]."""
        return np.argmin(np.abs(self._moments - time))

    def _times(self, shift):
        last = self.run.case.time.end
        return [time for time in self.film if time - shift <= last]

    def _apart(self, shift):
        """Rms distances of the surfaces [m], one for each frame that the run reaches."""
        return [_distance(self.film[time], self._surface_of(time - shift))
                for time in self._times(shift)]  # fmt: skip

    def _crest(self, time):
        """Where the water of the simulation hangs over air."""
        frame = self.run.frames.at(time - self.shift)
        wet = frame["kind"] == FLUID
        x, z = frame["position"][wet, 0], frame["position"][wet, 2]
        speed = np.linalg.norm(frame["velocity"][wet], axis=1)
        return find_crest(x, z, speed, self.run.spacing)


def _film():
    """Profiles by time: (n, 2) x and z [m] along the surface, the undisturbed level at 38 mm."""
    table = np.loadtxt(DATA, delimiter=",", skiprows=1)
    film, level = {}, STILL
    for time in np.unique(table[:, 0]):
        x, z = table[table[:, 0] == time][:, 2:4].T
        level = _undisturbed(x, z, level)
        film[float(time)] = np.column_stack([x, z + STILL - level])
    return film


def _undisturbed(x, z, before):
    """Level of the longest end of a profile that is flat [m]; where none is, that of before."""
    ends = [z[x > x.max() - far] for far in FAR]
    flat = [end.mean() for end in ends if np.ptp(end) < FLAT]
    return flat[0] if flat else before


def _turn(profile):
    """How far a profile turns back in x above the layer [m], and the x of its inmost point [m]."""
    x = profile[profile[:, 1] > STILL + RAISED, 0]
    back = np.maximum.accumulate(x) - x
    return back.max(), x[np.argmax(back)]


def _surface(frame, spacing):
    """Surface particles, moved half a spacing up: (n, 2) x and z [m]."""
    top = (frame["kind"] == FLUID) & (frame["surface"] == 1)
    x, _, z = frame["position"][top].astype(float).T
    return np.column_stack([x, z + 0.5 * spacing])


def _distance(profile, surface):
    """Rms distance of two surfaces where the film has its profile [m].

    The mean of that of the film from the particles, and that of the particles from the film.
    """
    line = _line(profile)
    within = (surface[:, 0] >= line[:, 0].min()) & (surface[:, 0] <= line[:, 0].max())
    ways = cKDTree(surface).query(line)[0], cKDTree(line).query(surface[within])[0]
    return np.mean([np.sqrt(np.mean(way**2)) for way in ways])


def _line(profile):
    """Points along a profile, (m, 2) [m], a STEP apart."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    places = np.arange(0.0, along[-1], STEP)
    return np.column_stack([np.interp(places, along, column) for column in profile.T])


def _foremost(profile):
    """x [m] of the foremost point of a film's profile that is clearly above the still level."""
    return profile[profile[:, 1] > STILL + RAISED, 0].max()


def _front(frame, spacing):
    """x [m] of the foremost water clearly above the still level, spray left out; NaN for none."""
    x = frame["position"][frame["kind"] == FLUID].astype(float)
    front = foremost(x, spacing, COMPANY, x[:, 2] + 0.5 * spacing > STILL + RAISED)
    return front if np.isfinite(front) else np.nan


def _hold_front(result, match):
    """Put the place of the front over time into the table of errors, the shift taken out."""
    filmed = np.array([_foremost(profile) for profile in match.film.values()])
    label = "place of the front, moved by the fitted shift in time [m], [s]"
    result.hold(label, *match.front(), np.array(list(match.film)), filmed)


def _draw(result, match):
    for time in SHOWN:
        figure = result.figure(f"Surface at t = {time:g} s", "x [m]", "z [m]", equal=True)
        figure.points(f"standard, d0 = {1e3 * match.run.spacing:.2g} mm", *match.surface(time).T)
        figure.dashed("film", *match.film[time].T)
