"""Higher-order source with error-compensating terms (ECS)."""

import numpy as np

from mpslab.models.sources import hs


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = HS + |e_i| (Dn/Dt)_i/(n0 dt) + |dt (Dn/Dt)_i/n0| e_i/dt^2 [1/s2].

    e_i = (n_i - n0)/n0 (Khayyer & Gotoh 2011).  The compensating terms, too, are evaluated at
    the predicted positions, which differ from those of the start by one step.
    """
    main = hs.source(near, velocity, number_density, dt, rate, scheme)
    error = number_density / near.stencil.n0 - 1.0
    return main * (1.0 + np.abs(error)) + np.abs(main) * error
