"""Prescribed motions in the plane x-z: how far, how fast and with which acceleration.

A motion is a function (t [s], derivative=0) -> (3,) float64: displacement along x and z [m] and
angle [rad] about an axis across the tank; with derivative 1 its velocity and with 2 its
acceleration, by formula and not by differences. A positive angle turns x towards z: it lifts what
lies onshore of the axis. An attribute ``center``, (x, z) [m], says where the axis is at t = 0;
without it, it is at the origin.
"""

import numpy as np


def displacement(motion, points, start, end):
    """How points of a body that moves so are displaced from one time to another, (n, 3) [m].

    Parameters
    ----------
    motion : as above
    points : (n, 3) float64 [m]
        Where they are at `start`.
    start, end : float [s]
    """
    before, after = motion(start), motion(end)
    shift = np.array([after[0] - before[0], 0.0, after[1] - before[1]])
    moved = np.broadcast_to(shift, points.shape)
    angle = after[2] - before[2]
    if angle == 0.0:
        return moved
    center = np.add(center_of(motion), before[:2])
    x, z = points[:, 0] - center[0], points[:, 2] - center[1]
    cosine, sine = np.cos(angle) - 1.0, np.sin(angle)
    turned = [cosine * x - sine * z, np.zeros(len(x)), sine * x + cosine * z]
    return moved + np.column_stack(turned)


def center_of(motion):
    """Where the axis of a motion is at t = 0, (x, z) [m]."""
    return getattr(motion, "center", (0.0, 0.0))
