"""Prescribed motions in the plane x-z.

A motion is a function (t [s]) -> (3,) float64: displacement along x and z [m] and angle [rad] about
an axis across the tank. A positive angle turns x towards z: it lifts what lies onshore of the axis.
An attribute ``center``, (x, z) [m], says where the axis is at t = 0; without it, it is at the
origin. `Sine` and `Table` also give velocity and acceleration, with derivative = 1 and 2: by
formula, not by differences; and `moments(end)`, the times until `end` [s] to look at for what is
largest in the motion.
"""

import numpy as np

from mpslab.later import scipy

SAMPLES = 1001  # of a sine
AXES = {"sway": 0, "heave": 1, "roll": 2}


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


def oscillation(kind, amplitude, period, start, center):
    """The `Sine` of a kind, "sway", "heave" or "roll"; amplitude [m], of a roll [deg]."""
    size = np.radians(amplitude) if kind == "roll" else amplitude
    return Sine(AXES[kind], size, period, start, center)


class Sine:
    """A sine along x or z, or of the angle, which may fade in.

    Parameters
    ----------
    axis : int
        0 for x, 1 for z, 2 for the angle.
    amplitude : float [m] or [rad]
    period, start : float [s]
        The motion fades in until `start` with s^2 (3 - 2 s), s = t / start.
    center : (x, z) [m]
    """

    def __init__(self, axis, amplitude, period, start=0.0, center=(0.0, 0.0)):
        self.axis, self.amplitude, self.start, self.center = axis, amplitude, start, center
        self.frequency = 2.0 * np.pi / period

    def __call__(self, time, derivative=0):
        w, phase = self.frequency, self.frequency * time
        wave = np.array([np.sin(phase), w * np.cos(phase), -w * w * np.sin(phase)])
        fade = self._fade(time)
        # The rule of Leibniz for the derivatives of a product.
        product = (
            fade[0] * wave[0],
            fade[1] * wave[0] + fade[0] * wave[1],
            fade[2] * wave[0] + 2.0 * fade[1] * wave[1] + fade[0] * wave[2],
        )[derivative]
        out = np.zeros(3)
        out[self.axis] = self.amplitude * product
        return out

    def moments(self, end):
        """The time of fading in and one period; nothing new comes later."""
        return np.linspace(0.0, min(end, self.start + 2.0 * np.pi / self.frequency), SAMPLES)

    def _fade(self, time):
        """The factor that fades the motion in, and its two derivatives."""
        if time >= self.start:
            return 1.0, 0.0, 0.0
        s, rate = time / self.start, 1.0 / self.start
        return s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) * rate, 6.0 * (1.0 - 2.0 * s) * rate**2


class Table:
    """A motion between rows of a table: natural cubic splines; before and after them at rest.

    Parameters
    ----------
    times : (n,) float64 [s]
    values : (n, 3) float64 [m], [m], [rad]
    center : (x, z) [m]
    """

    def __init__(self, times, values, center=(0.0, 0.0)):
        self.first, self.last, self.center = times[0], times[-1], center
        self.curve = scipy.interpolate.CubicSpline(times, values, bc_type="natural")

    def __call__(self, time, derivative=0):
        if derivative and not self.first <= time <= self.last:
            return np.zeros(3)
        return self.curve(min(max(time, self.first), self.last), derivative)

    def moments(self, end):
        """Times of the rows, for between them acceleration is linear.

        Of very many rows only some, and those with the extremes of place, speed and acceleration.
        """
        times = np.clip(self.curve.x, 0.0, end)
        extremes = [times[np.abs(self.curve(times, k)).argmax(axis=0)] for k in range(3)]
        return np.concatenate([[0.0], times[:: len(times) // SAMPLES + 1], *extremes])
