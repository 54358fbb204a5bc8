"""Mixed source with the corrected divergence, exact for linear velocities."""

LEAST_DETERMINANT = 0.05


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = -<div u*>_i/dt + s (n_i - n_r)/(n_r dt) [1/s2].

    <div u>_i = (Ds/n0) sum_j u_ij . B_i r_ij w/r^2 with the inverse B of the second moment (Khayyer
    & Gotoh 2011), at the surface too; n_r is the number density of relaxed water
    (`Stencil.relaxed`).
    """
    stencil = near.stencil
    divergence = near.corrected_divergence(velocity, LEAST_DETERMINANT)
    rest = rate * (number_density / stencil.relaxed - 1.0)
    return (rest - stencil.dim / stencil.n0 * divergence) / dt
