"""Mixed source with the divergence that is adjoint to the conservative corrected gradient."""

# At the surface, where neighbours lie on one side, the sum finds a divergence in any wave: there it
# is left out (docs/recipe.md, Waves of few particles a wavelength).
INSIDE_ONLY = True


def source(near, velocity, number_density, dt, rate, scheme):
    """b_i = -<div u*>_i/dt + s (n_i - n_r)/(n_r dt) [1/s2].

    <div u>_i = (Ds/n0) sum_j u_ij . C_j r_ij w/r^2.  The pressure forces of the gradient
    "corrected" do the work sum_i p_i <div u>_i of just this divergence: where it is zero, they
    neither give energy to the water nor take any.  n_r is the number density of relaxed water
    (`Stencil.relaxed`).
    """
    divergence = near.stencil.dim / near.stencil.n0 * near.adjoint_divergence(velocity)
    return (rate * (number_density / near.stencil.relaxed - 1.0) - divergence) / dt
