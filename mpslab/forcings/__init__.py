"""Forcings: what accelerates the water from outside of it.

A forcing is a function ``forcing(position, velocity, time)`` with

    position, velocity : (n, 3) float64 [m], [m/s], not to be written to
    time : float [s]; a step asks for its middle
    -> (3,) or (n, 3) float64 [m/s2]

It says the same of a particle whatever the others are, so that a run does not depend on its number
of ranks. Walls are asked about as the water is, with the velocity that they have: the pressure in
them goes on as the forcing wants it.

Each module holds one, ``make(case)``, which gives the forcing, or None where a case has none.
"""

from mpslab.core import plugins


def forcings_of(case, own=()):
    """The forcings of a case, then one's own, as a tuple."""
    modules = [plugins.load("forcings", name) for name in plugins.names("forcings")]
    return (*filter(None, (module.make(case) for module in modules)), *own)


def total(forcings, particles, time):
    """Sum of the forcings at the particles, (3,) or (n, 3) float64 [m/s2]."""
    return sum(forcing(particles.position, particles.velocity, time) for forcing in forcings)
