"""Collision model: approaching pairs that came too close exchange an impulse."""

import numpy as np

from mpslab.kernels import repulsion

STAGE = "predicted"


def stabilise(particles, before, neighbors, stencil, correction, dt, scheme):
    """Let pairs below ``collision_distance`` bounce (Shibata, Murotani & Koshizuka 2014).

    Where the water is so thin that it has no pressure, this alone holds it above the bed.  In 3-D
    the middle of four particles of a wall is 1/sqrt(2) = 0.71 spacings from each: with less, water
    slips through.
    """
    change = np.empty_like(particles.velocity)
    repulsion.collision(
        particles.position, particles.velocity, particles.kind, neighbors.indptr,
        neighbors.indices, stencil, scheme.collision_distance * stencil.spacing,
        scheme.restitution, change,
    )  # fmt: skip
    particles.velocity += change
    particles.position += change * dt
