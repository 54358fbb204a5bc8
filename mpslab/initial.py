"""Velocities of the water at the start."""

from mpslab.waves import standing_wave_velocity


def set_velocity(case, particles):
    """Give the water the velocities that ``initial.type`` asks for, in place."""
    if case.initial.type != "standing_wave":
        return
    fluid, wave = particles.fluid, case.initial
    particles.velocity[fluid, 0], particles.velocity[fluid, 2] = standing_wave_velocity(
        particles.position[fluid, 0], particles.position[fluid, 2], wave.amplitude, wave.mode,
        case.tank.length, case.tank.depth, case.fluid.gravity,
    )  # fmt: skip
