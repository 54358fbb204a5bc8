"""Puts the water in order before the start.

The lattice on which it is laid out is no place where particles stay: it gives way within some 20
steps, everywhere at once, and the number density changes with it by some thousandths.  Water that
follows in so short a time needs a pressure of that times the square of the layers: over 60 layers
the pressure fell to a third and rose to five times its value, over 120 it tore the water apart.
"""

from mpslab import correction, step
from mpslab.stabilisers import corrected_shifting


def settle(flow):
    """Shift the particles, ``scheme.settling`` times, from where they are to where they stay.

    Nothing flows meanwhile; velocities, pressures and the surface itself are left alone.
    """
    domain = flow.domain
    for _ in range(flow.case.scheme.settling):
        flow.particles, _ = domain.share_out(flow.particles)
        particles = flow.particles
        step.find_neighbors(flow)
        matrices = correction.matrices(particles, flow.neighbors, flow.stencil)
        step.find_surface(flow)
        corrected_shifting.stabilise(
            particles, None, flow.neighbors, flow.stencil, matrices, 0.0, flow.case.scheme
        )
        if flow.stencil.width > 0.0:
            particles.position[:, 1] %= flow.stencil.width
        flow.particles = domain.without_ghosts(particles)
