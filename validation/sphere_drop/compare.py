"""Period and decrement of a heaving sphere."""

import numpy as np

from validation.comparison import Comparison
from validation.sphere_drop.theory import heave


def compare(runs):
    """The finest run is judged."""
    result = Comparison()
    figure = result.figure("Height of the sphere", "time since the release [s]", "height / lift")
    spheres = [_Sphere(run) for run in sorted(runs.values(), key=lambda run: -run.spacing)]
    rows = []
    for sphere in spheres:
        figure.line(sphere.run.label, sphere.time, sphere.found.place / sphere.lift)
        seen, right = sphere.found, sphere.theory
        rows.append([sphere.run.label, seen.crest_at, right.crest_at, seen.decrement,
                     right.decrement, sphere.rest])  # fmt: skip
    figure.dashed("linear theory", sphere.time, sphere.theory.place / sphere.lift)
    result.measure("period", rows[-1][1] / rows[-1][2])
    result.measure("decrement", rows[-1][3] / rows[-1][4])
    result.measure("rest", rows[-1][5])
    columns = ["run", "first crest [s]", "in theory", "decrement", "in theory",
               "rest, less that of theory [spacings]"]  # fmt: skip
    result.table("Heave", columns, rows)
    if len(rows) > 1:
        spacings = [sphere.run.spacing for sphere in spheres]
        result.converge("Period", spacings, [row[1] / row[2] - 1.0 for row in rows])
        result.converge("Decrement", spacings, [row[3] / row[4] - 1.0 for row in rows])
    return result


class _Sphere:
    def __init__(self, run):
        (given,), bodies, self.run = run.case.solid, run.table("bodies"), run
        loose = bodies["time"] >= given.release
        self.time = bodies["time"][loose] - given.release
        self.lift = given.center[2] - run.depth
        self.found = _Heave(self.time, bodies["sphere z"][loose] - run.depth)
        place = heave(self.lift, given.radius, run.gravity, given.mass, run.density, self.time)
        self.theory = _Heave(self.time, place)
        self.rest = (self.found.middle - self.theory.middle) / run.spacing


class _Heave:
    """A motion (n,) [m] that goes down, up, and down again."""

    def __init__(self, time, place):
        self.place = place
        low = int(np.argmin(place))
        _, trough = _peak(time, -place, low)
        self.crest_at, crest = _peak(time, place, low + int(np.argmax(place[low:])))
        trough = -trough
        self.decrement = np.log((place[0] - trough) / (crest - trough))
        self.middle = 0.5 * (trough + 0.5 * (place[0] + crest))


def _peak(time, place, row):
    """Time [s] and height [m] of the top of the parabola through five rows about one."""
    rows = slice(max(row - 2, 0), row + 3)
    bend = np.polyfit(time[rows] - time[row], place[rows], 2)
    at = -0.5 * bend[1] / bend[0]
    return time[row] + at, float(np.polyval(bend, at))
