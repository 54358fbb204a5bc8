"""Contact: free bodies do not pass through the tank, other solids or each other.

Points on the faces of a body are held against the distances of everything else. Nothing comes
nearer than a spacing, so that a layer of water always fits between: it carries the lift of a body
that lies on the bed. What meets stays together until something pulls it apart (no restitution), and
slides without friction.
"""

import numpy as np

from mpslab.core import lattice
from mpslab.core.motion import center_of
from mpslab.solids import gates, obstacles
from mpslab.solids.outlines import Polygon
from mpslab.solids.shaped import faces
from mpslab.theory.algebra import dot

APART = 1.0  # spacings: the least distance of two faces
HIGH = 1e3  # tank heights: as far as there is nothing above an open tank
ROUNDS = 200  # most impulses that are given in a step
EXACT = 1e-6  # of the fastest approach: what is left of it


class Tank:
    """Bed, end walls and side walls, and the lid."""

    motion = None

    def __init__(self, case):
        tank = case.tank
        high = tank.height if tank.lid else HIGH * tank.height
        length, far = lattice.effective_length(case), HIGH * tank.length
        first = [] if case.wavemaker.type == "none" else [(-far, tank.bed[0][1])]
        bed = [*first, *((min(x, length), z) for x, z in tank.bed)]
        bed[-1] = (length, bed[-1][1])
        self.room = Polygon([*bed, (length, high), (bed[0][0], high)])
        walled = case.dim == 3 and not tank.periodic
        self.width = lattice.rows_across(case) * case.particles.spacing if walled else np.inf

    def distance(self, points):
        gap = -self.room.distance(points[:, [0, 2]])
        if np.isfinite(self.width):
            gap = np.minimum(gap, np.minimum(points[:, 1], self.width - points[:, 1]))
        return gap


class Box:
    """A box of corners (3,) [m], infinite where it has no end."""

    def __init__(self, low, high):
        self.low, self.high = np.asarray(low, float), np.asarray(high, float)

    def distance(self, points):
        beyond = np.maximum(self.low - points, points - self.high)
        outside = np.sqrt(np.sum(np.maximum(beyond, 0.0) ** 2, axis=1))
        return np.where(outside > 0.0, outside, beyond.max(axis=1))


class Target:
    """What a body can run into: a shape, its motion or None, and the free body that it is of."""

    def __init__(self, name, shape, motion=None, body=None):
        self.name, self.shape, self.motion, self.body = name, shape, motion, body

    def distance(self, points, time):
        """Of places (n, 3) [m] at a time [s], (n,) [m]."""
        if self.body is not None:
            points = self.body.laid_out(points)
        elif self.motion is not None:
            points = _back(self.motion(time), center_of(self.motion), points)
        return self.shape.distance(points)

    def velocity(self, points, time, dt):
        """Mean velocity of what is not a free body over a step, (n, 3) [m/s]."""
        if self.motion is None or self.body is not None:
            return np.zeros_like(points)
        center = center_of(self.motion)
        there = _back(self.motion(time), center, points)
        return (_forth(self.motion(time + dt), center, there) - points) / dt


def _back(moved, center, points):
    """Where places were before a motion of the plane x-z."""
    x, z, angle = moved
    axis, gone = np.array([center[0], 0.0, center[1]]), np.array([x, 0.0, z])
    return axis + _turn(points - axis - gone, -angle)


def _forth(moved, center, points):
    """Where places come to by a motion of the plane x-z."""
    x, z, angle = moved
    axis, gone = np.array([center[0], 0.0, center[1]]), np.array([x, 0.0, z])
    return axis + gone + _turn(points - axis, angle)


def _turn(points, angle):
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y, z = points.T
    return np.column_stack([cosine * x - sine * z, y, sine * x + cosine * z])


def targets(case, solids):
    """All that there is to run into, of the solids of a run; the user's own ones are left out."""
    found = [Target("tank", Tank(case))]
    if solids.piston:
        behind = Box([-np.inf] * 3, [0.0, np.inf, np.inf])
        motion = solids.piston.motion if solids.piston.paddle else None
        found.append(Target("piston", behind, motion))
    for box, ends in zip(case.obstacle, obstacles.blocks(case), strict=True):
        found.append(Target(box.name, Box(*(ends * case.particles.spacing))))
    by_name = {solid.name: solid for solid in solids.bodies.values()}
    for gate, (low, high) in zip(case.gate, gates.faces(case), strict=True):
        foot = case.tank.bed_height(0.5 * (low + high))
        plate = Box([low, -np.inf, foot], [high, np.inf, np.inf])
        found.append(Target(gate.name, plate, by_name[gate.name].motion))
    for given in case.solid:
        one = by_name[given.name]
        body = one if given.motion == "free" else None
        found.append(Target(one.name, one.shape, one.motion, body))
    return found


class Contact:
    """The contacts of the free bodies of a run.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    solids : mpslab.solids.collection.Solids
    bodies : sequence of mpslab.solids.floating.Floating
    """

    def __init__(self, case, solids, bodies):
        spacing = case.particles.spacing
        self.bodies, self.targets = bodies, targets(case, solids)
        self.apart, self.step = APART * spacing, 1e-3 * spacing
        self.axes = np.eye(3)[[0, 2] if case.dim == 2 else [0, 1, 2]]
        self.points = [faces(case, body.number) - body.start for body in bodies]
        self.reach = [np.sqrt(np.sum(points**2, axis=1).max()) for points in self.points]

    def gaps(self, number, time):
        """Least distance of a body to each target but itself, as (name, [m])."""
        body = self.bodies[number]
        places = body.places(self.points[number])
        return [(one.name, float(one.distance(places, time).min()))
                for one in self.targets if one.body is not body]  # fmt: skip

    def limits(self, time, dt, aimed):
        """What contacts ask of the velocities in a step.

        Parameters
        ----------
        aimed : (bodies, 6) float64
            Velocities without contact.

        Returns
        -------
        rows : (k, 6 bodies) float64
        least : (k,) float64 [m/s]
            rows times all velocities has to be this at the least.
        """
        rows, least = [np.zeros((0, 6 * len(self.bodies)))], [np.zeros(0)]
        for number in range(len(self.bodies)):
            fast = np.sqrt(np.sum(aimed[:, :3] ** 2, axis=1))
            fast += self.reach * np.sqrt(np.sum(aimed[:, 3:] ** 2, axis=1))
            for target in self.targets:
                if target.body is not self.bodies[number]:
                    found = self._limits(number, target, time, dt, 2.0 * fast.sum())
                    rows.append(found[0])
                    least.append(found[1])
        return np.vstack(rows), np.concatenate(least)

    def _limits(self, number, target, time, dt, speed):
        """As `limits`, of a body and a target that come together at a speed [m/s] at the most."""
        body = self.bodies[number]
        drive = target.velocity(body.center[np.newaxis], time, dt)
        near = self.apart + dt * (speed + 2.0 * np.sqrt(np.sum(drive**2)))
        nothing = np.zeros((0, 6 * len(self.bodies))), np.zeros(0)
        if target.distance(body.center[np.newaxis], time)[0] > near + self.reach[number]:
            return nothing
        places = body.places(self.points[number])
        gap = target.distance(places, time)
        close = np.flatnonzero(gap < near)
        if not len(close):
            return nothing
        places, gap = places[close], gap[close]
        slope = np.column_stack([target.distance(places + self.step * axis, time) - gap
                                 for axis in self.axes])  # fmt: skip
        slope /= np.maximum(np.sqrt(np.sum(slope**2, axis=1)), 1e-9 * self.step)[:, np.newaxis]
        normal = dot(slope[:, np.newaxis, :], self.axes.T)
        rows = np.zeros((len(close), 6 * len(self.bodies)))
        rows[:, 6 * number : 6 * number + 6] = _lever(normal, places - body.center)
        if target.body is not None:
            other = self.bodies.index(target.body)
            arm = places - target.body.center
            rows[:, 6 * other : 6 * other + 6] = -_lever(normal, arm)
        drive = np.sum(normal * target.velocity(places, time, dt), axis=1)
        return rows, drive - np.maximum(gap - self.apart, 0.0) / dt


def _lever(normal, arm):
    """What a body's velocity is multiplied by for that of a point along a normal, (n, 6)."""
    return np.hstack([normal, np.cross(arm, normal)])


def impulses(rows, least, velocity, mobility):
    """Impulses that keep velocities within their limits, where they act least.

    Parameters
    ----------
    rows, least : as `Contact.limits` gives them
    velocity : (m,) float64
        Without them.
    mobility : (m, m) float64
        Velocity over impulse.

    Returns
    -------
    (m,) float64 [N s, N m s]
    """
    size, total = np.zeros(len(least)), np.zeros(len(velocity))
    lack = least - dot(rows, velocity)
    if not len(lack) or lack.max() <= 0.0:
        return total
    slack = EXACT * lack.max()
    moves = np.array([dot(mobility, row) for row in rows])
    give = np.maximum(np.sum(rows * moves, axis=1), 1e-300)
    for _ in range(ROUNDS):
        lack = least - dot(rows, velocity)
        step = np.maximum(size + lack / give, 0.0) - size
        k = int(np.argmax(np.abs(step * give)))
        if abs(step[k] * give[k]) <= slack:
            break
        size[k] += step[k]
        total += step[k] * rows[k]
        velocity = velocity + step[k] * moves[k]
    return total
