"""Integral measures of the water: energy, volume, speed.

`total` is a function that adds (n,) values of the particles; that of the domain adds those of all
ranks.
"""

import numpy as np

from mpslab.core.particles import FACE, FILLER, PISTON, TANK, squares


def particle_volume(stencil):
    """Volume of a particle: d0^Ds; in 2-D that of a slice 1 m wide [m3]."""
    return stencil.spacing**stencil.dim


def max_speed(particles, counts=True):
    """Largest speed of the water and of the faces that move [m/s]; 0 when there are none.

    counts : (n,) bool, of those that count, all by default
    """
    moving = (particles.role != FILLER) & (particles.body != TANK) & counts
    velocity = particles.velocity.take(np.flatnonzero(moving), 0)
    return float(np.sqrt(squares(velocity).max(initial=0.0)))


def max_speed_together(particles):
    """As `max_speed`, without the water that had no neighbour in the last step [m/s].

    The number density of such water is zero; before the first step that of all water is.
    """
    return max_speed(particles, ~particles.fluid | (particles.number_density != 0.0))


def kinetic_energy(particles, stencil, density, total=np.sum):
    """Sum of m u^2 / 2 over the fluid; in 2-D for a slice 1 m wide [J]."""
    square = squares(particles.velocity)
    mass = density * particle_volume(stencil)
    return 0.5 * mass * float(total(np.where(particles.fluid, square, 0.0)))


def potential_energy(particles, stencil, density, gravity, total=np.sum):
    """Sum of m g z over the fluid; in 2-D for a slice 1 m wide [J]."""
    mass = density * particle_volume(stencil)
    height = np.where(particles.fluid, particles.position[:, 2], 0.0)
    return mass * gravity * float(total(height))


def piston_force(particles, stencil, total=np.sum):
    """Force of the piston on the water along x; in 2-D on a slice 1 m wide [N].

    The pressure of the piston's first layer, each particle for a face of d0^(Ds-1).
    """
    area = stencil.spacing ** (stencil.dim - 1)
    face = (particles.role == FACE) & (particles.body == PISTON)
    return area * float(total(np.where(face, particles.pressure, 0.0)))


def volume(particles, stencil, total=np.sum):
    """Volume that the fluid takes up: a particle inside counts as n_r/n of its own [m3].

    n_r is the number density of relaxed water (`Stencil.relaxed`): in 3-D the lattice of the start
    counts as 2.5 % too little.  Surface particles lack neighbours for another reason and count in
    full.
    """
    inside = particles.fluid & (particles.surface == 0) & (particles.number_density > 0.0)
    share = np.where(particles.fluid, 1.0, 0.0)
    np.divide(stencil.relaxed, particles.number_density, out=share, where=inside)
    return particle_volume(stencil) * float(total(share))
