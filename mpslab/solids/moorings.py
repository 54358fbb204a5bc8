"""Mooring lines: springs from a place to a free body, that go slack or that push as well."""

import numpy as np

from mpslab.core import rotation


class Line:
    """A line ``[[mooring]]`` of a case to a body.

    Attributes
    ----------
    tension : float [N]
        In the last step, before the first one as laid out; < 0 where it pushes; in 2-D of a slice
        1 m wide.
    """

    def __init__(self, given, body):
        self.given, self.body, self.tension = given, body, 0.0
        self.anchor, self.rest = np.array(given.anchor), np.array(given.at) - body.start
        self.force()

    def force(self):
        """Force on the body and moment about its centre, (6,) [N, N m]."""
        body, given = self.body, self.given
        arm = rotation.apply(rotation.matrix(body.turn), self.rest[np.newaxis])[0]
        way = self.anchor - body.center - arm
        length = np.sqrt(np.sum(way * way))
        if length == 0.0:
            self.tension = 0.0
            return np.zeros(6)
        along = way / length
        velocity = body.velocity[:3] + np.cross(body.velocity[3:], arm)
        stretch, rate = length - given.length, -np.sum(along * velocity)
        taut = given.pushes or stretch > 0.0
        pull = given.stiffness * stretch + given.damping * rate if taut else 0.0
        self.tension = float(pull if given.pushes else max(pull, 0.0))
        force = self.tension * along
        return np.concatenate([force, np.cross(arm, force)])


def lines(case, bodies):
    """The lines of a case to its free bodies, in their order."""
    by_name = {body.name: body for body in bodies}
    return [Line(given, by_name[given.on]) for given in case.mooring]
