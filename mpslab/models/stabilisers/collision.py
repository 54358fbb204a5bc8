"""Collision model: approaching pairs that came too close exchange an impulse."""

import numpy as np

from mpslab.kernels import repulsion

STAGE = "predicted"
DISTANCE = {2: 0.5, 3: 0.8}  # [spacings] where the case has none


def stabilise(near, dt, pace, scheme):
    """Let pairs below ``collision_distance`` bounce (Shibata, Murotani & Koshizuka 2014).

    Where the water is so thin that it has no pressure, only this model holds it above the bed.  A
    particle half-way between two particles of a wall is 0.5 spacings from each, in 3-D in the
    middle of four 1/sqrt(2) spacings: with a smaller distance than that it slips through.
    """
    particles, stencil = near.particles, near.stencil
    closest = (scheme.collision_distance or DISTANCE[stencil.dim]) * stencil.spacing
    change = np.empty_like(particles.velocity)
    repulsion.collision(
        *near.close(closest), particles.position, particles.velocity, particles.role, stencil,
        closest, scheme.restitution, change,
    )  # fmt: skip
    particles.velocity += change
    particles.position += change * dt
