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

import numpy as np

from mpslab.core import plugins
from mpslab.core.keys import shown

_RULE = "must be accelerations [m/s2], of shape (3,) or (n, 3) for n particles"


def forcings_of(case, own=()):
    """The forcings of a case, then the user's own, as a tuple."""
    modules = [plugins.load("forcings", name) for name in plugins.names("forcings")]
    looked_at = (_looked_at(forcing, case.dim) for forcing in own)
    return (*filter(None, (module.make(case) for module in modules)), *looked_at)


def check_own(case, own):
    """Raise ValueError, with its name, if a forcing of the user's own gives no acceleration.

    It is asked for two particles at rest, at t = 0.
    """
    place = np.array([[0.5 * case.tank.length, 0.5 * case.tank.width, case.tank.depth]] * 2)
    for forcing in own:
        if not callable(forcing):
            raise ValueError(f"forcing = {shown(forcing)}: must be a function")
        _looked_at(forcing, case.dim)(place, np.zeros_like(place), 0.0)


def _looked_at(forcing, dim):
    """A forcing of the user's own, which is refused where it gives what none may give."""
    name = getattr(forcing, "__name__", type(forcing).__name__)

    def own(position, velocity, time):
        found = forcing(position, velocity, time)
        try:
            found = np.asarray(found, float)
        except (TypeError, ValueError):
            raise ValueError(f"forcing {name!r}: gave {shown(found)}: {_RULE}") from None
        if found.shape not in ((3,), (len(position), 3)):
            what = f"an array of shape {found.shape} for {len(position)} particles"
            raise ValueError(f"forcing {name!r}: gave {what}: {_RULE}")
        if dim == 2 and np.any(found[..., 1]):
            y = found[..., 1].flat[np.argmax(found[..., 1] != 0.0)]
            raise ValueError(f"forcing {name!r}: gave {y:g} m/s2 along y: must be 0 in a 2-D tank")
        return found

    return own


def total(forcings, particles, time):
    """Sum of the forcings at the particles, (3,) or (n, 3) float64 [m/s2]."""
    return sum(forcing(particles.position, particles.velocity, time) for forcing in forcings)
