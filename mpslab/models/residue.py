"""What a uniform pressure does where particles are out of order, in the pressure equation."""

import numpy as np


def stiffness(near, share, density):
    """A share of |e_i|^2/rho, to be added to the diagonal of the pressure equation, (n,) [m/kg].

    The gradient "corrected" makes e_i = (Ds/n0) (S_i + C_i m_i) of a pressure of one everywhere
    (`Neighbourhood.disorder`): nothing in water whose particles are in order.
    Where they are not, the divergence adjoint to it finds sum_i |e_i|^2 in the velocities that this
    makes, but the Laplacian finds nothing. So the pressure corrects too much, the more the smoother
    it is: for a wave length of 2 H by the factor 1 + (|e| H/pi)^2. With a factor above 2 it
    overshoots from step to step, however large that is; with a share of a half or more in the
    matrix the factor stays below 2. All of it would make the projection exact in the mean, but then
    nothing makes good what the noise of the pressure takes from waves (docs/recipe.md, *A uniform
    pressure*).

    The surface is left out: it has a condition of its own.

    Parameters
    ----------
    near : Neighbourhood
        `particles.surface` tells the surface, ghosts' as well.
    share : float
    density : float [kg/m3]
    """
    factor = share * (near.stencil.dim / near.stencil.n0) ** 2 / density
    square = np.einsum("ij,ij->i", near.disorder, near.disorder)
    return factor * square * (near.particles.surface == 0)
