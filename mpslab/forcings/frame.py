"""Inertia in a tank that moves: the run is in the frame of the tank, where its walls are at rest.

A place r of the tank is at c + X + R(a) (r - c) in the earth's frame, with the displacement X and
the angle a of the tank about the axis c, and R the rotation from x towards z.  So, with J = R(90
degrees) and rho = r - c, the acceleration of the water in the tank's frame is

    R(-a) (g - X'') - a'' J rho + a'^2 rho - 2 a' J u

The first part is gravity, turned, less the acceleration of the axis; then come Euler's, the
centrifugal and Coriolis's acceleration.  Gravity is a forcing of its own; this one gives the rest.
"""

import numpy as np

from mpslab.core import motion_file
from mpslab.core.keys import require
from mpslab.core.motion import oscillation


def make(case):
    """The inertia of a case, None for a tank at rest."""
    if case.frame.type == "none":
        return None
    motion, gravity = motion_of(case.frame), case.fluid.gravity

    def inertia(position, velocity, time):
        angle = motion(time)[2]
        turn = motion(time, 1)[2]
        ax, az, spin = motion(time, 2)
        cosine, sine = np.cos(angle), np.sin(angle)
        x, z = (position[:, k] - c for k, c in zip((0, 2), motion.center, strict=True))
        out = np.zeros_like(position)
        out[:, 0] = -cosine * ax - sine * (gravity + az) + spin * z + turn**2 * x
        out[:, 0] += 2.0 * turn * velocity[:, 2]
        out[:, 2] = sine * ax - cosine * (gravity + az) + gravity - spin * x + turn**2 * z
        out[:, 2] -= 2.0 * turn * velocity[:, 0]
        return out

    return inertia


def strongest(case):
    """Largest acceleration of water at rest in the tank, by gravity and the tank's motion [m/s2].

    Taken at the corners of the water as it is laid out, until the end of the run.
    """
    gravity, inertia = case.fluid.gravity, make(case)
    if inertia is None:
        return gravity
    low = min(z for _, z in case.tank.bed)
    high = max([box.end[2] for box in case.water], default=case.tank.depth)
    corners = np.array([[x, 0.0, z] for x in (0.0, case.tank.length) for z in (low, high)])
    pull, still = np.array([0.0, 0.0, -gravity]), np.zeros_like(corners)
    times = motion_of(case.frame).moments(case.time.end)
    return max(np.linalg.norm(inertia(corners, still, t) + pull, axis=1).max() for t in times)


def motion_of(frame):
    """Motion of the tank that a table [frame] asks for.

    Raises
    ------
    CaseError
        If amplitude or period is 0, or the file cannot be read, or is no such table.
    """
    if frame.type == "file":
        return motion_file.read(frame.file, "frame.file", frame.center)
    rule = f"> 0 for frame.type = {frame.type!r}"
    require(frame.amplitude > 0.0, "frame.amplitude", frame.amplitude, rule)
    require(frame.period > 0.0, "frame.period", frame.period, rule)
    return oscillation(frame.type, frame.amplitude, frame.period, frame.start, frame.center)
