"""Recipes: named sets of scheme keys, which fill in what a case does not set itself.

Each recipe sets the same keys, so that one can take the place of another.
"""

RECIPES = {
    # The default: a corrected gradient whose pair forces are equal and opposite (Zhang, Adams & Hu
    # 2024, in MPS form), and particles that are kept in order, which its accuracy rests on.
    "standard": {
        "gradient": "corrected",
        "source": "adjoint",
        "projection": "start",
        "walls": "extrapolated",
        "surface": "graded",
        "laplacian": "standard",
        "solver": "deflated",
        "stabiliser": ["corrected_shifting", "ds"],
        "settling": 160,
        "hyperviscosity": 0.3,
        "residue": 0.5,
        "relief": 0.2,
        "effective_radius": 2.1,
        "gradient_radius": 0.0,
        "laplacian_radius": 2.1,
    },
    # What Gotoh, Khayyer, Ikari and Hori do in the paper.  Equation (4) can be read in several
    # ways, and this decides whether the wave plunges: with this reading it does (docs/cmps.md).
    "paper": {
        "gradient": "cmps_soft",
        "source": "density",
        "projection": "predicted",
        "walls": "copied",
        "surface": "marked",
        "laplacian": "standard",
        "solver": "piccg",
        "stabiliser": ["collision"],
        "settling": 0,
        "hyperviscosity": 0.0,
        "residue": 0.0,
        "relief": 0.0,
        "effective_radius": 2.1,
        "gradient_radius": 3.1,
        "laplacian_radius": 3.1,
    },
}
