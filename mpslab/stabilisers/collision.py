"""Collision model: approaching pairs that came too close exchange an impulse."""

import numpy as np

from mpslab.kernels import repulsion

STAGE = "predicted"


def stabilise(particles, before, neighbors, stencil, correction, dt, scheme):
    """Let pairs below ``collision_distance`` bounce (Shibata, Murotani & Koshizuka 2014)."""
    change = np.empty_like(particles.velocity)
    repulsion.collision(
        particles.position, particles.velocity, particles.kind, neighbors.indptr,
        neighbors.indices, stencil, scheme.collision_distance * stencil.spacing,
        scheme.restitution, change,
    )  # fmt: skip
    particles.velocity += change
    particles.position += change * dt
