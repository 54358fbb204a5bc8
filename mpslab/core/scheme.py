"""The table of a case that names the numerical scheme."""

from dataclasses import dataclass

from mpslab.core.keys import check_table, key


@dataclass(frozen=True, kw_only=True)
class Scheme:
    """The numerical scheme. A recipe fills in the keys that a case does not set."""

    recipe: str = key("set of models that fills in what is not set here", "standard")
    gradient: str = key("pressure gradient", "corrected", family="gradients")
    source: str = key("source of the Poisson equation", "adjoint", family="sources")
    laplacian: str = key("Laplacian of pressure", "standard", family="laplacians")
    solver: str = key("solver of the Poisson equation", "deflated", family="solvers")
    stabiliser: tuple = key(
        "what keeps particles apart",
        ("corrected_shifting", "ds"),
        kind="texts",
        family="stabilisers",
    )
    projection: str = key(
        "where the pressure acts: at the predicted positions (as in MPS), or those of the start",
        "start",
        choices=("predicted", "start"),
    )
    walls: str = key(
        "wall pressure: an unknown of the first layer; the same, and copied from it to the layers "
        "behind; or extrapolated from the water to all layers, whose particles water does not feel "
        "along their face",
        "extrapolated",
        choices=("solved", "copied", "extrapolated"),
    )
    surface: str = key(
        "free surface: p = 0 at marked particles, or a graded pull towards p = 0 above them",
        "graded",
        choices=("marked", "graded"),
    )
    tolerance: float = key("relative residual of the solver", 1e-5, above=0, high=0.1)
    max_iterations: int = key("most iterations of the solver", 2000, low=1)
    effective_radius: float = key(
        "radius of number density and divergence", 2.1, unit="spacings", low=1.5, high=6
    )
    gradient_radius: float = key(
        "radius of the gradient, >= 1.5; 0 for effective_radius",
        0.0,
        unit="spacings",
        low=0,
        high=6,
    )
    laplacian_radius: float = key("radius of the Laplacian", 2.1, unit="spacings", low=1.5, high=6)
    relaxation: float = key("relaxation factor of the source 'density'", 0.2, above=0, high=1)
    gamma: float = key(
        "share of the density error taken back in 0.2 spacing / sqrt(gravity depth), in the "
        "sources 'mixed', 'corrected' and 'adjoint'; over 20 layers of water less, "
        "20 gamma/layers; without gravity the largest speed at the start takes the place of the "
        "root",
        0.005,
        low=0,
        high=1,
    )
    relief: float = key(
        "share of what the number density of water is too high by, over 5 %, that is taken back in "
        "the same time as that of gamma, with projection 'start'",
        0.2,
        low=0,
        high=0.5,
    )
    surface_threshold: float = key(
        "n/n0 below which a particle is free surface, where it is marked", 0.97, above=0, high=1
    )
    shifting_strength: float = key(
        "share of a displacement that 'shifting' and 'corrected_shifting' take back in the same "
        "time",
        0.225,
        low=0,
        high=1,
    )
    settling: int = key(
        "passes of 'corrected_shifting' before the start, which take the water off the lattice",
        160,
        low=0,
        high=10_000,
    )
    ds_distance: float = key("distance kept by 'ds'", 0.8, unit="spacings", above=0, high=1)
    collision_distance: float = key(
        "distance kept by 'collision'; 0 for 0.5, in 3-D 0.8: below 0.71 walls leak",
        0.0,
        unit="spacings",
        low=0,
        high=1,
    )
    restitution: float = key("coefficient of restitution of 'collision'", 0.2, low=0, high=1)
    clip_pressure: bool = key("set negative pressure to zero", True)
    wall_slip: bool = key("leave walls out of viscosity and eddies", True)
    wall_law: bool = key(
        "friction of the walls by the law of the wall, in place of that of viscosity", False
    )
    hyperviscosity: float = key(
        "share of the differences from particle to particle that velocities lose in the same time "
        "as those of gamma and shifting; longer waves lose far less",
        0.3,
        low=0,
        high=0.5,
    )
    residue: float = key(
        "share of what a uniform pressure does where particles are out of order that the pressure "
        "equation knows, with gradient 'corrected' and surface 'graded'; with less than 0.5 the "
        "pressure of agitated water alternates from step to step",
        0.5,
        low=0,
        high=1,
    )
    smagorinsky: float = key(
        "constant C_s of an eddy viscosity (C_s spacing)^2 |S|; 0 for none", 0.0, low=0, high=0.5
    )

    def __post_init__(self):
        check_table(self)

    @property
    def reach(self):
        """The largest radius [spacings]."""
        return max(self.effective_radius, self.radius_of_gradient, self.laplacian_radius)

    @property
    def radius_of_gradient(self):
        """That of the gradient, its own or that of the number density [spacings]."""
        return self.gradient_radius or self.effective_radius
