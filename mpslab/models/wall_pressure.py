"""Walls whose pressure is extrapolated from the water, option ``scheme.walls = "extrapolated"``.

Between a water particle i and a solid one j the pressure differs by rho (f - a_j) . r_ij, with a_j
the acceleration of the wall and f that of the forcings, such as gravity: the Neumann condition,
pair by pair (Adami, Hu & Adams 2012).  It holds still water exactly.  With wall particles as
unknowns (``"solved"``) it is not held exactly: their rows have water on one side only, and give the
bed half the pressure difference of a layer.
"""

import numpy as np

from mpslab.core.particles import FLUID, add_where
from mpslab.kernels import walls as kernels


def pull(particles, before, force, dt, moving):
    """f - a of every particle, a being the acceleration of the solid, (n, 3) [m/s2].

    Parameters
    ----------
    before : (n, 3) float64 [m/s]
        Velocities at the start of the step; those of the particles are the new ones for walls.
    force : (3,) or (n, 3) float64 [m/s2]
        Sum of the forcings f, such as gravity.
    moving : (n,) bool
        Particles of solids whose acceleration the water feels.
    """
    out, rows = np.zeros_like(before), np.flatnonzero(moving)
    out[rows] = (before.take(rows, 0) - particles.velocity.take(rows, 0)) / dt
    add_where(np.ones(len(out), bool), out, force)
    return out


def predicted_velocity(particles, pull_, dt):
    """u* of all particles, before the pressure acts; of solids too, u* = u_wall + (f - a) dt."""
    velocity = particles.velocity.copy()
    add_where(particles.role != FLUID, velocity, dt * pull_)
    return velocity


def flux(near, stencil, pair_terms, pull_):
    """What the walls' known differences of pressure add to the right-hand side, (n,) [1/s2]."""
    out = np.empty(len(near.particles))
    kernels.flux(near.row, near.solid, near.other, near.straight, near.inverse, stencil, pair_terms,
                 pull_, out)  # fmt: skip
    return out


def fill(near, density, pull_, clip):
    """Give the solids the pressure of the water in front of them, in place; with `clip` not < 0."""
    kernels.extrapolate(near.row, near.solid, near.other, near.straight, near.inverse,
                        near.particles.role, near.stencil, density, pull_, clip,
                        near.particles.pressure, np.empty(len(near.particles)))  # fmt: skip
