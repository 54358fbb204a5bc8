"""Water that a blow has pressed together is let go again."""

import numpy as np

from mpslab.core.timestep import share

CROWDED = 0.05  # of the number density of relaxed water, above which water is crowded


def rate(number_density, stencil, relief, dt, pace):
    """Divergence that takes back, in each pace, a share `relief` of what is crowded, (n,) [1/s].

    Where water is thrown against a wall, a few steps are all that there is to bring it to rest, and
    each of them leaves some of the convergence: it is pressed together. `scheme.gamma` would take
    hundreds of steps to undo that, and must not be quicker, for noise of the number density would
    press on the water at rest. That noise is below a twentieth, so that more than it can go at
    once.

    Parameters
    ----------
    number_density : (n,) float64
    stencil : mpslab.core.stencil.Stencil
    relief : float
    dt, pace : float [s]
    """
    crowded = np.maximum(number_density / stencil.relaxed - 1.0 - CROWDED, 0.0)
    return share(relief, dt, pace) / dt * crowded
