"""Source of the original MPS method: the deviation of the number density, relaxed."""


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = relaxation (n*_i - n0)/(n0 dt^2) (Koshizuka & Oka 1996) [1/s2]."""
    return (number_density / near.stencil.n0 - 1.0) * (scheme.relaxation / dt**2)
