"""Puts the water in order before the start.

The lattice on which it is laid out is no place where particles stay: it gives way within some 20
steps, everywhere at once, and the number density changes with it by some thousandths.  Water that
follows in so short a time needs a pressure of that times the square of the layers: over 60 layers
the pressure fell to nothing and rose to five times its value, over 120 it tore the water apart.
"""

import numpy as np

from mpslab import correction, step
from mpslab.stabilisers import corrected_shifting

SHAKE = 0.1  # spacings: a random displacement, from which the water finds its order


def settle(flow):
    """Shake the water and shift it, ``scheme.settling`` times, to where its particles stay.

    The surface and what has it in reach stay as they are, for shifting leaves them alone.
    Nothing flows meanwhile: velocities and pressures are not touched.
    """
    for turn in range(flow.case.scheme.settling):
        flow.particles, _ = flow.domain.share_out(flow.particles)
        particles = flow.particles
        step.find_neighbors(flow)
        step.find_surface(flow)
        if turn == 0:
            particles.position += _shake(flow)
            flow.domain.refresh(particles.position)
        matrices = correction.matrices(particles, flow.neighbors, flow.stencil)
        corrected_shifting.stabilise(
            particles, None, flow.neighbors, flow.stencil, matrices, 0.0, flow.case.scheme
        )
        if flow.stencil.width > 0.0:
            particles.position[:, 1] %= flow.stencil.width
        flow.particles = flow.domain.without_ghosts(particles)


def _shake(flow):
    """Random displacement of the water away from the surface, by gid, (n, 3) [m]."""
    particles, neighbors, case = flow.particles, flow.neighbors, flow.case
    at_surface = np.append(0, np.cumsum(particles.surface.take(neighbors.indices), dtype=int))
    inside = particles.fluid & (particles.surface == 0)
    inside &= np.diff(at_surface[neighbors.indptr]) == 0
    count = 1 + max(flow.domain.from_all(int(particles.gid.max(initial=0))))
    random = np.random.default_rng([case.particles.seed, 1])
    move = random.uniform(-1.0, 1.0, (count, 3))[particles.gid]
    if flow.stencil.dim == 2:
        move[:, 1] = 0.0
    return SHAKE * case.particles.spacing * inside[:, np.newaxis] * move
