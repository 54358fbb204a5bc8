"""Forcings: what accelerates the water from outside.

A forcing is a function ``forcing(position, velocity, time)`` with

    position, velocity : (n, 3) float64 [m], [m/s], not to be written to
    time : float [s], the middle of a step
    -> (3,) or (n, 3) float64 [m/s2]

What it gives for a particle must not depend on the other particles, because each rank asks for its
own. It is asked for walls as well, with the velocity that they have, so that the pressure goes on
into them as the forcing demands.

Each module holds one, ``make(case)``, which gives the forcing, or None where a case has none.
"""

from mpslab.core import plugins


def forcings_of(case, own=()):
    """The forcings of a case, then the user's own, as a tuple."""
    modules = [plugins.load("forcings", name) for name in plugins.names("forcings")]
    return (*filter(None, (module.make(case) for module in modules)), *own)


def total(forcings, particles, time):
    """Sum of the forcings at the particles, (3,) or (n, 3) float64 [m/s2]."""
    return sum(forcing(particles.position, particles.velocity, time) for forcing in forcings)
