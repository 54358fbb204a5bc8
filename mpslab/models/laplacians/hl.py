"""Higher-order Laplacian (HL): the divergence of the smoothed gradient."""


def pair_terms(stencil):
    """L(r) = (5 - Ds) r_e/(n0 r^3) (Khayyer & Gotoh 2010; 3-D 2012) [1/m2].

    In 2-D it tends to 1.5 times the Laplacian as the radius grows, in 3-D to the Laplacian.
    """
    return 0.0, 0.0, (5 - stencil.dim) * stencil.radius / stencil.n0
