"""Linear theory of a body afloat: heave after a small lift, and the force of waves, in 2-D.

The waves that a moving body makes are a potential with K phi = d phi/dz on the surface, K = w^2/g
(Ursell 1949 gave it in series for deep water); here it is found with panels for any depth. From
added mass and damping over the frequency follows the motion in time (Maskell & Ursell 1970), by the
transform of Cummins (1962).
"""

from functools import cache

import numpy as np

from mpslab.theory.waves import group_celerity

BODY, BED = 24, 50  # panels on half of the body and the bed
OUT = 48  # on the two uprights each, which are the shorter the nearer they are to the surface
FAR = 2.0  # depths from the body to the upright where its waves leave
LOWEST, HIGHEST, FREQUENCIES = 0.15, 4.5, 120  # of sqrt(g / half breadth)
PER_WAVE = 10  # panels on the surface to the shortest wave


def cylinder(radius):
    """Outline of a half-immersed cylinder: its right half, from the keel up to the surface."""
    angle = np.linspace(-0.5 * np.pi, 0.0, BODY + 1)
    return tuple(map(tuple, radius * np.column_stack([np.cos(angle), np.sin(angle)])))


@cache
def coefficients(outline, depth, gravity, mode="heave"):
    """Frequencies w [rad/s], added mass and damping over w, of unit density, (n,) each.

    Parameters
    ----------
    outline : tuple of (x, z) [m]
        The wetted right half of a body that is the same on both sides, from the keel up to the
        surface, which is at z = 0: the middles of its panels are not too far apart.
    depth : float [m]
    gravity : float [m/s2]
    mode : str
        The motion, "heave" or "sway". What sways makes the opposite on its other side, so that the
        potential is zero below its middle, where it has no slope across when it heaves.
    """
    ends, kind = _panels(outline, depth)
    single, double = _influence(ends)
    step = np.diff(ends, axis=0)
    length = np.hypot(*step.T)
    # The outward normal, the outline run through clockwise.
    push = (step[:, 0] if mode == "heave" else -step[:, 1]) / length
    body, unknown_slope = kind == "body", (kind == "middle") & (mode == "sway")
    found = []
    for w in np.sqrt(gravity / outline[-1][0]) * np.linspace(LOWEST, HIGHEST, FREQUENCIES):
        wave = _wave_number(w, depth, gravity)
        slope = np.zeros(len(kind), complex)  # d phi/dn over phi
        slope[kind == "surface"] = w * w / gravity
        slope[kind == "out"] = 1j * wave
        matrix = np.where(unknown_slope, single, double + single * slope)
        phi = np.linalg.solve(matrix, -single @ np.where(body, push, 0.0))
        both = 2.0 * np.sum((phi * push * length)[body])
        found.append((w, both.real, both.imag))
    return np.array(found).T


def heave(outline, depth, gravity, mass, water, times):
    """Height over its place at rest, as a share of that from which it is let go, (n,).

    Parameters
    ----------
    outline, depth, gravity
        As of `coefficients`.
    mass : float [kg/m]
    water : float [kg/m3]
        Density.
    times : (n,) float64 [s]
    """
    w, added, damping = coefficients(outline, depth, gravity)
    spring = 2.0 * water * gravity * outline[-1][0]
    answer = 1.0 / (spring - w * w * (mass + water * added) - 1j * w * w * water * damping)
    still, fine = 1.0 / spring, np.linspace(0.0, w[-1], 4000)[1:]
    real = np.interp(fine, np.append(0.0, w), np.append(still, answer.real))
    share = real * np.sin(np.outer(times, fine)) / fine
    return 1.0 - spring * 2.0 / np.pi * np.trapezoid(share, fine, axis=1)


@cache
def wave_force(outline, depth, gravity, period, mode):
    """Force of waves on a body that is held, over rho g times its breadth and their amplitude.

    It gets the force X of waves of amplitude a that, moving itself, makes waves: X^2 = 2 rho g c_g
    b a^2, b being its damping in this mode (Haskind 1957; Newman 1977, section 6.18).

    Parameters
    ----------
    outline, depth, gravity, mode
        As of `coefficients`.
    period : float [s]
    """
    w, speed = 2.0 * np.pi / period, group_celerity(period, depth, gravity)
    frequency, _, damping = coefficients(outline, depth, gravity, mode)
    damping = w * np.interp(w, frequency, damping)
    return float(np.sqrt(2.0 * gravity * speed * damping) / (2.0 * gravity * outline[-1][0]))


def _wave_number(w, depth, gravity):
    k = w * w / gravity
    for _ in range(200):
        k = 0.5 * (k + w * w / (gravity * np.tanh(k * depth)))
    return k


def _panels(outline, depth):
    """Ends of the panels of one half of the water (n + 1, 2), clockwise, and what each is."""
    body, (keel, half) = np.array(outline), (outline[0][1], outline[-1][0])
    shortest = 2.0 * np.pi * half / HIGHEST**2
    far = half + FAR * depth
    count = int((far - half) / shortest * PER_WAVE)
    surface = np.column_stack([np.linspace(half, far, count + 1), np.zeros(count + 1)])
    downward = np.linspace(0.0, 1.0, OUT + 1) ** 2
    out = np.column_stack([np.full(OUT + 1, far), -depth * downward])
    bed = np.column_stack([np.linspace(far, 0.0, BED + 1), np.full(BED + 1, -depth)])
    up = np.column_stack([np.zeros(OUT + 1), np.linspace(-depth, keel, OUT + 1)])
    ends = np.vstack([body[:-1], surface[:-1], out[:-1], bed[:-1], up])
    kinds = np.repeat(["body", "surface", "out", "bed", "middle"],
                      [len(body) - 1, count, OUT, BED, OUT])  # fmt: skip
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
