"""A sphere afloat, half in the water, that is let go: its heave in water of great depth.

Added mass and damping are those of a heaving hemisphere in linear theory (Hulme 1982, Journal of
Fluid Mechanics 121, 443-463, his table). From the damping follows the memory of the waves (Cummins
1962); the buoyancy is that of the sphere as deep as it is.
"""

import numpy as np

# K a, with K = w^2/g; added mass over that of the water displaced; damping over this and w.
K, ADDED, DAMPING = np.array([
    (0.0, 0.8310, 0.0), (0.05, 0.8764, 0.1036), (0.1, 0.8627, 0.1816), (0.2, 0.7938, 0.2793),
    (0.3, 0.7157, 0.3254), (0.4, 0.6452, 0.3410), (0.5, 0.5861, 0.3391), (0.6, 0.5381, 0.3271),
    (0.7, 0.4999, 0.3098), (0.8, 0.4698, 0.2899), (0.9, 0.4464, 0.2691), (1.0, 0.4284, 0.2484),
    (1.2, 0.4047, 0.2096), (1.4, 0.3924, 0.1756), (1.6, 0.3871, 0.1469), (1.8, 0.3864, 0.1229),
    (2.0, 0.3884, 0.1031), (2.5, 0.3988, 0.0674), (3.0, 0.4111, 0.0452), (4.0, 0.4322, 0.0219),
    (5.0, 0.4471, 0.0116), (6.0, 0.4574, 0.0066), (7.0, 0.4647, 0.0040), (8.0, 0.4700, 0.0026),
    (9.0, 0.4740, 0.0017), (10.0, 0.4771, 0.0012),
]).T  # fmt: skip
AT_ONCE = 0.5  # added mass of a sudden motion
STEPS = 400  # to sqrt(a / g) and frequency


def memory(times):
    """Force by a unit step of the velocity, at times (n,) over sqrt(a/g); of unit mass displaced.

    In units of sqrt(g/a) over sqrt(a/g).
    """
    w = np.linspace(0.0, np.sqrt(K[-1]), 2000)
    damping = w * np.interp(w, np.sqrt(K), DAMPING)
    return 2.0 / np.pi * np.trapezoid(damping * np.cos(np.outer(times, w)), w, axis=1)


def heave(lift, radius, gravity, mass, water, times):
    """Height over its place at rest [m], (n,), of a sphere that is let go at rest at time 0.

    Parameters
    ----------
    lift : float [m]
        Less than the radius.
    radius, gravity, mass, water : float [m], [m/s2], [kg], [kg/m3]
    times : (n,) float64 [s]
    """
    unit = np.sqrt(radius / gravity)
    step = 1.0 / STEPS
    number = int(np.ceil(times.max() / unit / step)) + 1
    past = memory(step * np.arange(number)) * step
    share = mass / (2.0 / 3.0 * np.pi * radius**3 * water)
    inertia = share + AT_ONCE + 0.25 * past[0] * step
    place, speed = np.zeros(number), np.zeros(number)
    place[0] = lift / radius
    for k in range(number - 1):
        middle = place[k] + 0.5 * step * speed[k]
        buoyancy = 1.5 * (middle - middle**3 / 3.0)
        waves = past[: k + 1] @ speed[k::-1] - 0.5 * past[k] * speed[0]
        speed[k + 1] = speed[k] - step * (buoyancy + waves) / inertia
        place[k + 1] = middle + 0.5 * step * speed[k + 1]
    return radius * np.interp(times / unit, step * np.arange(number), place)
