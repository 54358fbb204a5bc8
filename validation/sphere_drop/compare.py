"""Period and decrement of a heaving sphere."""

import numpy as np

from validation.comparison import Comparison
from validation.sphere_drop.theory import heave
from validation.swing import first_swing

EXTREME = 0.01  # s before and after an extreme, over which a parabola is fitted


def compare(runs):
    """The finest run is judged."""
    result = Comparison()
    figure = result.figure("Height of the sphere", "time since the release [s]", "height / lift")
    spheres = [_Sphere(run) for run in sorted(runs.values(), key=lambda run: -run.spacing)]
    rows = []
    for sphere in spheres:
        figure.line(sphere.run.label, sphere.time, sphere.place / sphere.lift)
        seen, right = sphere.seen, sphere.right
        rows.append([sphere.run.label, seen.crest_at, right.crest_at,
                     _decrement(sphere.place, seen), _decrement(sphere.expected, right),
                     sphere.rest])  # fmt: skip
    figure.dashed("linear theory", sphere.time, sphere.expected / sphere.lift)
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
        self.place = bodies["sphere z"][loose] - run.depth
        self.expected = heave(
            self.lift, given.radius, run.gravity, given.mass, run.density, self.time
        )
        self.seen, self.right = (
            first_swing(self.time, place, EXTREME) for place in (self.place, self.expected)
        )
        rests = [_rest(place, one) for place, one in
                 ((self.place, self.seen), (self.expected, self.right))]  # fmt: skip
        self.rest = (rests[0] - rests[1]) / run.spacing


def _decrement(place, swing):
    """log of the height of the way down over that of the way up."""
    return float(np.log((place[0] - swing.trough) / (swing.crest - swing.trough)))


def _rest(place, swing):
    """Half-way between the trough and the mean of the two crests [m]."""
    return 0.5 * (swing.trough + 0.5 * (place[0] + swing.crest))
