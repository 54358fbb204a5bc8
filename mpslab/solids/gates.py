"""Gates: plates across the tank that hold back water until they are lifted.

A gate stands on the bed and reaches onshore from its place x.  It is drawn straight up at a
constant speed until it is above the walls, or as far as it is lifted.  It is as thick as an
obstacle has to be, so that the water on one side does not press through to the other.
"""

import numpy as np

from mpslab.core import bed as beds
from mpslab.core import lattice
from mpslab.core.particles import FACE, FILLER
from mpslab.solids.obstacles import least_thickness
from mpslab.solids.solid import Solid


def faces(case):
    """x of the two faces of each gate, rounded to whole spacings: (k, 2) [m]."""
    spacing = case.particles.spacing
    first = np.array([round(gate.x / spacing) for gate in case.gate], float)
    return np.column_stack([first, first + least_thickness(case)]) * spacing


def holds(case, x):
    """Whether places x (n,) [m] are inside a gate, (n,) bool."""
    found = np.zeros(len(x), bool)
    for low, high in faces(case):
        found |= (low < x) & (x < high)
    return found


class Gate(Solid):
    """A gate of the case: vertical columns of particles that stand on the bed.

    The jump of its speed when it opens is no acceleration that the water feels.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    number : int
        Which of ``case.gate`` it is.
    tank : mpslab.solids.tank.Tank
    """

    jumps = True

    def __init__(self, case, number, tank):
        gate = case.gate[number]
        super().__init__(gate.name)
        self.tank = tank
        self.sides = faces(case)[number]
        clear = case.tank.height - beds.lowest(case.tank.bed, *self.sides)
        self.motion = Lift(gate.speed, gate.opens, min(gate.lift or clear, clear))

    def particles(self, case):
        rows, roles = [], []
        columns = lattice.between(case, *self.sides)
        for x in columns:
            rows.append(lattice.stack(case, x, case.tank.height))
            outer = x in (columns[0], columns[-1])
            roles.append(np.full(len(rows[-1]), FACE if outer else FILLER))
        section, role = self.tank.standing(np.vstack(rows), np.concatenate(roles))
        return lattice.across(case, section), np.tile(role, lattice.rows_across(case))

    def holds(self, points):
        low, high = self.sides
        return (low < points[:, 0]) & (points[:, 0] < high)


class Lift:
    """A motion straight up at a constant speed, from a time on, up to a height.

    Parameters
    ----------
    speed : float [m/s]
    opens : float [s]
    height : float [m]
    """

    def __init__(self, speed, opens, height):
        self.speed, self.opens, self.height = speed, opens, height

    def __call__(self, time):
        return np.array([0.0, min(max(self.speed * (time - self.opens), 0.0), self.height), 0.0])


def make(case, tank):
    """The gates of a case, in their order."""
    return [Gate(case, number, tank) for number in range(len(case.gate))]
