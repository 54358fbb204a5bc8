"""Rotations in space, as unit quaternions (w, x, y, z).

Sums are written out: the same last digits for one point as for many, on any machine.
"""

import numpy as np

STILL = np.array([1.0, 0.0, 0.0, 0.0])


def turned(quaternion, rate, dt):
    """The rotation after a time [s] of turning at a rate (3,) [rad/s] about axes in space."""
    half = 0.5 * dt * np.asarray(rate)
    angle = np.sqrt(np.sum(half * half))
    w, (x, y, z) = np.cos(angle), half * np.sinc(angle / np.pi)
    a, b, c, d = quaternion
    found = np.array([
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    ])  # fmt: skip
    return found / np.sqrt(np.sum(found * found))


def matrix(quaternion):
    """Matrix (3, 3) of a rotation; its columns are where the axes come to."""
    w, x, y, z = quaternion
    return np.array([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ])  # fmt: skip


def apply(matrix_, points):
    """The points (n, 3) turned by a matrix, (n, 3)."""
    x, y, z = np.asarray(points).T
    out = np.empty((len(x), 3))
    for k, (a, b, c) in enumerate(matrix_):
        out[:, k] = a * x + b * y + c * z
    return out


def angles(matrix_):
    """Roll, pitch and yaw [rad] of a rotation: R = yaw about z, then roll, then pitch about x.

    Roll turns x towards z, as that of a solid on a given path does; pitch y towards z, yaw x
    towards y.
    """
    roll = np.arctan2(matrix_[2, 0], np.hypot(matrix_[2, 1], matrix_[2, 2]))
    pitch = np.arctan2(matrix_[2, 1], matrix_[2, 2])
    yaw = np.arctan2(matrix_[1, 0], matrix_[0, 0])
    return np.array([roll, pitch, yaw])
