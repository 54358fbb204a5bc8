"""Velocities of the water at the start."""

from mpslab.waves import standing_wave_velocity


def set_velocity(case, particles):
    """Give the water the velocities that ``initial.type`` asks for, in place."""
    if case.initial.type == "rest":
        return
    fluid, start = particles.fluid, case.initial
    x, z = particles.position[fluid, 0], particles.position[fluid, 2]
    if start.type == "standing_wave":
        u, w = standing_wave_velocity(
            x, z, start.amplitude, start.mode, case.tank.length, case.tank.depth, case.fluid.gravity
        )
    else:
        u, w = _linear(start.type, start.rate, x, z)
    particles.velocity[fluid, 0], particles.velocity[fluid, 2] = u, w


def _linear(kind, rate, x, z):
    """Strain or rotation about the centre of mass, without momentum: (n,) each [m/s]."""
    x, z = x - x.mean(), z - z.mean()
    u, w = (rate * x, -rate * z) if kind == "strain" else (rate * z, -rate * x)
    return u - u.mean(), w - w.mean()
