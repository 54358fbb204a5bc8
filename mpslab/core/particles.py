"""The particles: one array for each property."""

from dataclasses import dataclass, fields

import numpy as np

from mpslab.kernels import vectors as vectors_

# Roles: what a particle is to the equations.
FLUID, FACE, FILLER = range(3)
# Bodies: whose it is. After these come the solids of the case, obstacles before gates.
WATER, TANK, PISTON, FIRST_SOLID = range(4)


def carries_pressure(role):
    """Mask of the roles with a pressure of their own: (n,) int8 -> (n,) bool."""
    return role != FILLER


def add_where(mask, vectors, change):
    """Add a change, (3,) or (n, 3), to those of the vectors (n, 3) that a mask has, in place."""
    change = np.ascontiguousarray(np.atleast_2d(change), float)
    vectors_.add(vectors, change, mask.view(np.uint8))


def put_where(mask, vectors, others):
    """Put others (n, 3) in place of those of the vectors (n, 3) that a mask has."""
    vectors_.put(vectors, others, mask.view(np.uint8))


def squares(vectors):
    """Squares of the lengths of vectors: (n, 3) -> (n,), the same bits on any machine."""
    x, y, z = vectors.T
    return x * x + z * z + y * y


@dataclass
class ParticleSet:
    """Particles as a structure of arrays.

    They are laid out and written to files in the order of gid; within a step they lie in that of
    their cells.

    Attributes
    ----------
    gid : (n,) int64
        Number of a particle; it never changes.
    role : (n,) int8
        FLUID, FACE (first layer of a solid, carries a pressure) or FILLER (layers behind it, fill
        the number density only).
    body : (n,) int16
        WATER, TANK (bed and walls), PISTON, or the number of a solid from FIRST_SOLID on.
    position : (n, 3) float64 [m]
    velocity : (n, 3) float64 [m/s]
    pressure : (n,) float64 [Pa]
    number_density : (n,) float64 [-]
    surface : (n,) uint8
        1 for free-surface particles.
    """

    gid: np.ndarray
    role: np.ndarray
    body: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    pressure: np.ndarray
    number_density: np.ndarray
    surface: np.ndarray

    def __len__(self):
        return len(self.gid)

    @property
    def fluid(self):
        """Mask of the fluid particles, (n,) bool."""
        return self.role == FLUID

    @property
    def carries_pressure(self):
        """Mask of the particles with a pressure of their own, (n,) bool."""
        return carries_pressure(self.role)

    @property
    def moves_with_piston(self):
        """Mask of the particles with the motion of the wavemaker, (n,) bool."""
        return self.body == PISTON

    def take(self, rows):
        """The particles of a mask, index or slice, as a new set; those of a slice share memory."""
        if isinstance(rows, slice):
            return ParticleSet(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})
        if not (isinstance(rows, np.ndarray) and rows.dtype.kind == "i"):
            rows = np.arange(len(self))[rows]
        return ParticleSet(**{f.name: getattr(self, f.name).take(rows, 0) for f in fields(self)})


def no_particles():
    """A set without particles."""
    return make_particles(np.zeros((0, 3)), np.zeros(0))


def make_particles(position, role, body=None):
    """Particles at rest, numbered in the order given; without bodies, of water and tank."""
    n, role = len(position), np.asarray(role, np.int8)
    body = np.where(role == FLUID, WATER, TANK) if body is None else body
    return ParticleSet(
        gid=np.arange(n, dtype=np.int64),
        role=role,
        body=np.asarray(body, np.int16),
        position=np.ascontiguousarray(position, float),
        velocity=np.zeros((n, 3)),
        pressure=np.zeros(n),
        number_density=np.zeros(n),
        surface=np.zeros(n, np.uint8),
    )


def joined(first, second):
    """The particles of two sets as one, in this order."""
    both = {f.name: (getattr(first, f.name), getattr(second, f.name)) for f in fields(ParticleSet)}
    return ParticleSet(**{name: np.concatenate(arrays) for name, arrays in both.items()})
