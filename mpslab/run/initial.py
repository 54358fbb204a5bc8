"""Velocities of the water at the start."""

import numpy as np

from mpslab.theory.waves import standing_wave_velocity


def set_velocity(case, particles, total):
    """Give the water the velocities that ``initial.type`` asks for, in place.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    particles : ParticleSet
    total : callable
        Sum of (n,) values over the particles of all ranks.
    """
    if case.initial.type == "rest":
        return
    fluid, start = particles.fluid, case.initial
    x, z = particles.position[fluid, 0], particles.position[fluid, 2]
    if start.type == "standing_wave":
        tank, depth = case.tank, case.tank.paddle_depth
        above_bed = z - (tank.depth - depth)
        u, w = standing_wave_velocity(
            x, above_bed, start.amplitude, start.mode, tank.length, depth, case.fluid.gravity
        )
    elif start.type == "stream":
        u, w = start.speed, 0.0
    else:
        u, w = _linear(start.type, start.rate, x, z, lambda v: _mean(v, fluid, total))
    particles.velocity[fluid, 0], particles.velocity[fluid, 2] = u, w


def _mean(values, fluid, total):
    """Mean over the water of all ranks, of which these are the values of this one."""
    spread = np.zeros(len(fluid))
    spread[fluid] = values
    return total(spread) / total(fluid.astype(float))


def _linear(kind, rate, x, z, mean):
    """Strain or rotation about the centre of mass, without momentum: (n,) each [m/s]."""
    x, z = x - mean(x), z - mean(z)
    u, w = (rate * x, -rate * z) if kind == "strain" else (rate * z, -rate * x)
    return u - mean(u), w - mean(w)
