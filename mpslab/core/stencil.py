"""Constants of the weight function on the full lattice: n0 and lambda0."""

from dataclasses import dataclass

import numpy as np

# Particles of moving water do not lie on the lattice.  In the arrangement that they find for
# themselves, with the same mass in a volume, the sum of w differs by a few per cent; by how much
# depends on which neighbours on the lattice the radius has just reached.  If water were held at n0,
# it would sink or rise by as much.  Measured in settled water at each of these radii [spacings].
# In 3-D moving water has 0.1 % less than settled water (measured at 2.1), which is included.
RADII = (
    1.5, 1.6, 1.7, 1.75, 1.8, 1.9, 2, 2.05, 2.1, 2.15, 2.2,
    2.25, 2.3, 2.4, 2.45, 2.5, 2.6, 2.7, 2.8, 2.85, 2.9, 3,
    3.1, 3.2, 3.3, 3.4, 3.5, 3.6, 3.8, 4.1, 4.5, 5.1, 6,
)  # fmt: skip
RELAXED = {
    2: (
        1.000, 0.991, 0.975, 0.967, 0.959, 0.968, 0.994, 0.996, 1.001, 1.009, 1.018,
        1.022, 1.012, 1.001, 0.997, 0.994, 0.990, 0.989, 0.993, 0.995, 0.996, 1.000,
        1.003, 1.003, 0.999, 0.997, 0.997, 0.999, 0.995, 1.001, 0.998, 1.000, 0.997,
    ),
    3: (
        1.070, 1.005, 0.992, 0.980, 0.956, 0.946, 0.965, 0.970, 0.9815, 0.997, 1.015,
        1.027, 1.020, 1.018, 1.019, 1.004, 0.986, 0.980, 0.985, 0.988, 0.991, 1.002,
        1.001, 1.002, 1.001, 0.997, 0.996, 0.998, 0.995, 0.996, 0.998, 1.000, 1.000,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Stencil:
    """Weight function w(r) = r_e/r - 1 of one effective radius, and its lattice constants.

    Attributes
    ----------
    dim : int
        Number of space dimensions Ds, 2 (x-z) or 3.
    spacing : float [m]
        Particle spacing d0.
    radius : float [m]
        Effective radius r_e.
    width : float [m]
        Period across the tank, 0 when not periodic.
    n0 : float [-]
        Number density of a particle inside the full lattice.
    lambda0 : float [m2]
        sum w r^2 / sum w over that lattice (Koshizuka & Oka 1996).
    first : float [m]
        sum w r over that lattice.
    restoring : float [1/m2]
        By how much sum w r_ij/r^2 of a particle grows with its displacement from the lattice:
        (1/Ds) sum (r_e/r^3 - (Ds - 2) w/r^2).
    lopsided : float [m]
        |sum w r_ij|/n of the second layer below a flat surface: 0.01 spacings at a radius of 2.1,
        0.2 at 3.1, 0.35 at 4.1.
    """

    dim: int
    spacing: float
    radius: float
    width: float
    n0: float
    lambda0: float
    first: float
    restoring: float
    lopsided: float

    @property
    def relaxed(self):
        """Number density of water at its density, once its particles have left the lattice [-]."""
        return self.n0 * float(np.interp(self.radius / self.spacing, RADII, RELAXED[self.dim]))

    @property
    def floor(self):
        """Distance below which two particles count as this far apart [m]."""
        return 1e-3 * self.spacing


def lattice_offsets(dim, reach):
    """Offsets of the full lattice up to `reach` spacings, the origin left out, (n, 3) [d0]."""
    line = np.arange(-reach, reach + 1.0)
    across = line if dim == 3 else np.zeros(1)
    grid = np.stack(np.meshgrid(line, across, line, indexing="ij"), axis=-1).reshape(-1, 3)
    return grid[np.any(grid != 0.0, axis=1)]


def make_stencil(dim, spacing, radius, width=0.0):
    """Stencil of an effective radius.

    Parameters
    ----------
    dim : int
        2 or 3.
    spacing : float [m]
    radius : float [spacings]
    width : float [m]
        Period across the tank, 0 when not periodic.
    """
    offsets = lattice_offsets(dim, int(np.ceil(radius)) + 1)
    r = np.linalg.norm(offsets, axis=1)
    w = np.maximum(radius / r - 1.0, 0.0)
    n0 = w.sum()
    lambda0 = (w * r * r).sum() / n0 * spacing**2
    restoring = (np.where(w > 0.0, radius / r**3, 0.0) - (dim - 2) * w / r**2).sum()
    restoring /= dim * spacing**2
    seen = w * (offsets[:, 2] <= 1.0)
    lopsided = abs(seen @ offsets[:, 2]) / seen.sum() * spacing
    return Stencil(
        dim=dim,
        spacing=spacing,
        radius=radius * spacing,
        width=width,
        n0=n0,
        lambda0=lambda0,
        first=(w * r).sum() * spacing,
        restoring=restoring,
        lopsided=lopsided,
    )
