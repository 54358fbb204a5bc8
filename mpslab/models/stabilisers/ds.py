"""Dynamic stabilisation (DS): push apart only the pairs that came too close."""

import numpy as np

from mpslab.kernels import repulsion

STAGE = "corrected"
PASSES = 4  # each parts the pairs that the one before has pushed together


def stabilise(near, dt, pace, scheme):
    """Remove the overlap of pairs below ``ds_distance`` (after Tsuruta et al. 2013), and the
    approach that led to it.
    """
    for _ in range(PASSES):
        one_pass(near, dt, pace, scheme)


def one_pass(near, dt, pace, scheme):
    """Part each pair once."""
    particles, closest = near.particles, scheme.ds_distance * near.stencil.spacing
    repulsion.part(
        *near.close(closest), particles.position, near.position, particles.velocity,
        particles.role, near.stencil, closest, dt, np.empty((len(particles), 2, 3)),
    )  # fmt: skip
