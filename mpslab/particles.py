"""The particles: one array for each property."""

from dataclasses import dataclass, fields

import numpy as np

FLUID, WALL, DUMMY, PISTON, PISTON_DUMMY, GATE, GATE_DUMMY = range(7)
KIND_NAMES = ("fluid", "wall", "dummy", "piston", "piston dummy", "gate",
              "gate dummy")  # fmt: skip


def carries_pressure(kind):
    """Mask of the kinds with a pressure of their own: (n,) int8 -> (n,) bool."""
    return (kind == FLUID) | (kind == WALL) | (kind == PISTON) | (kind == GATE)


def on_axes(mask):
    """A mask of particles for their vectors: (n,) bool -> (n, 3) bool."""
    return np.repeat(mask, 3).reshape(-1, 3)


@dataclass
class ParticleSet:
    """Particles as a structure of arrays, in the order of their gid.

    Attributes
    ----------
    gid : (n,) int64
        Number of a particle; it never changes.
    kind : (n,) int8
        FLUID, WALL (first layer, carries pressure), DUMMY (layers behind it, fill the number
        density only), PISTON and PISTON_DUMMY, GATE and GATE_DUMMY (the same two, moving).
    position : (n, 3) float64 [m]
    velocity : (n, 3) float64 [m/s]
    pressure : (n,) float64 [Pa]
    number_density : (n,) float64 [-]
    surface : (n,) uint8
        1 for free-surface particles.
    """

    gid: np.ndarray
    kind: np.ndarray
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
        return self.kind == FLUID

    @property
    def carries_pressure(self):
        """Mask of the particles with a pressure of their own, (n,) bool."""
        return carries_pressure(self.kind)

    @property
    def moves_with_piston(self):
        """Mask of the particles with the motion of the wavemaker, (n,) bool."""
        return (self.kind == PISTON) | (self.kind == PISTON_DUMMY)

    def take(self, rows):
        """The particles of a mask, index or slice, as a new set."""
        rows = np.arange(len(self))[rows]
        return ParticleSet(**{f.name: getattr(self, f.name).take(rows, 0) for f in fields(self)})


def make_particles(position, kind):
    """Particles at rest, numbered in the order given."""
    n = len(position)
    return ParticleSet(
        gid=np.arange(n, dtype=np.int64),
        kind=np.asarray(kind, np.int8),
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
