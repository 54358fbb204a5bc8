"""Linear theory of a half-immersed cylinder that is let go: heave after a small lift.

The waves that a heaving body makes are a potential with K phi = d phi/dz on the surface, K = w^2/g
(Ursell 1949 gave it in series for deep water); here it is found with panels for any depth. From
added mass and damping over the frequency follows the motion in time (Maskell & Ursell 1970), by the
transform of Cummins (1962).
"""

from functools import cache

import numpy as np

BODY, BED, OUT = 24, 50, 16  # panels on the quarter circle, the bed, and the two uprights each
LOWEST, HIGHEST, FREQUENCIES = 0.15, 3.2, 90  # of sqrt(g/radius)
PER_WAVE = 10  # panels on the surface to the shortest wave


@cache
def coefficients(radius, depth, gravity):
    """Frequencies w [rad/s], added mass and damping over w, of unit density, (n,) each.

    Parameters
    ----------
    radius, depth : float [m]
        The cylinder's centre is in the surface.
    gravity : float [m/s2]
    """
    ends, kind = _panels(radius, depth)
    single, double = _influence(ends)
    step = np.diff(ends, axis=0)
    length = np.hypot(*step.T)
    up = step[:, 0] / length  # outward normal's z, the outline run through clockwise
    body = kind == "body"
    found = []
    for w in np.sqrt(gravity / radius) * np.linspace(LOWEST, HIGHEST, FREQUENCIES):
        wave = _wave_number(w, depth, gravity)
        slope = np.zeros(len(kind), complex)  # d phi/dn over phi
        slope[kind == "surface"] = w * w / gravity
        slope[kind == "out"] = 1j * wave
        phi = np.linalg.solve(double + single * slope, -single @ np.where(body, up, 0.0))
        both = 2.0 * np.sum((phi * up * length)[body])
        found.append((w, both.real, both.imag))
    return np.array(found).T


def heave(radius, depth, gravity, density, water, times):
    """Height over its place at rest, as a share of that from which it is let go, (n,).

    Parameters
    ----------
    density, water : float [kg/m3]
    times : (n,) float64 [s]
    """
    w, added, damping = coefficients(radius, depth, gravity)
    mass = density * np.pi * radius**2
    spring = 2.0 * water * gravity * radius
    answer = 1.0 / (spring - w * w * (mass + water * added) - 1j * w * w * water * damping)
    still, fine = 1.0 / spring, np.linspace(0.0, w[-1], 4000)[1:]
    real = np.interp(fine, np.append(0.0, w), np.append(still, answer.real))
    share = real * np.sin(np.outer(times, fine)) / fine
    return 1.0 - spring * 2.0 / np.pi * np.trapezoid(share, fine, axis=1)


def _wave_number(w, depth, gravity):
    k = w * w / gravity
    for _ in range(200):
        k = 0.5 * (k + w * w / (gravity * np.tanh(k * depth)))
    return k


def _panels(radius, depth):
    """Ends of the panels of one half of the water (n + 1, 2), clockwise, and what each is."""
    shortest = 2.0 * np.pi * radius / HIGHEST**2
    far = radius + 3.0 * depth
    count = int((far - radius) / shortest * PER_WAVE)
    angle = np.linspace(-0.5 * np.pi, 0.0, BODY + 1)
    arc = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    surface = np.column_stack([np.linspace(radius, far, count + 1), np.zeros(count + 1)])
    out = np.column_stack([np.full(OUT + 1, far), np.linspace(0.0, -depth, OUT + 1)])
    bed = np.column_stack([np.linspace(far, 0.0, BED + 1), np.full(BED + 1, -depth)])
    up = np.column_stack([np.zeros(OUT + 1), np.linspace(-depth, -radius, OUT + 1)])
    ends = np.vstack([arc[:-1], surface[:-1], out[:-1], bed[:-1], up])
    kinds = np.repeat(["body", "surface", "out", "wall", "wall"], [BODY, count, OUT, BED, OUT])
    return ends, kinds


def _influence(ends):
    """Of each panel at the middle of each: the integral of ln r, and less that of its slope along
    the outward normal, (n, n).
    """
    start, step = ends[:-1], np.diff(ends, axis=0)
    length = np.hypot(*step.T)
    along = step / length[:, None]
    out = np.column_stack([-along[:, 1], along[:, 0]])
    middle = start + 0.5 * step
    to = middle[:, None, :] - start
    a = np.sum(to * along, axis=2)
    h = np.sum(to * out, axis=2)
    b = a - length

    def potential(s):
        return 0.5 * s * np.log(s * s + h * h) - s + np.abs(h) * np.arctan2(s, np.abs(h))

    double = np.sign(h) * (np.arctan2(a, np.abs(h)) - np.arctan2(b, np.abs(h)))
    np.fill_diagonal(double, np.pi)
    return potential(a) - potential(b), double
