"""Gates: plates across the tank that hold back water until they are lifted.

A gate stands on the bed, from its place x onshore, and is drawn straight up at a constant speed
until it is clear of the walls.  It is as thick as an obstacle has to be, so that the water on one
side does not press through to the other.
"""

import numpy as np

from mpslab import bed as beds
from mpslab.obstacles import least_thickness
from mpslab.particles import FIRST_SOLID


def first(case):
    """Number of the first gate among the bodies."""
    return FIRST_SOLID + len(case.obstacle)


def faces(case):
    """x of the two faces of each gate, rounded to whole spacings: (k, 2) [m]."""
    spacing = case.particles.spacing
    first = np.array([round(gate.x / spacing) for gate in case.gate], float)
    return np.column_stack([first, first + least_thickness(case)]) * spacing


def holds(case, x):
    """Whether a place x [m] is inside a gate."""
    return any(low < x < high for low, high in faces(case))


def rises(case, start, end):
    """How far each gate rises from one time to another [s]: (k,) [m]."""
    return _lifted(case, end) - _lifted(case, start)


def push(case, particles, time, dt):
    """Give the gates the velocity of their move from time to time + dt, in place."""
    if case.gate:
        moving, which = _find(case, particles)
        particles.velocity[moving, 2] = rises(case, time, time + dt)[which] / dt


def move(case, particles, time, dt):
    """Move the gates as from time to time + dt, in place."""
    if case.gate:
        moving, which = _find(case, particles)
        particles.position[moving, 2] += rises(case, time, time + dt)[which]


def _lifted(case, time):
    """Rise of each gate since the start [m], (k,)."""
    speed = np.array([gate.speed for gate in case.gate])
    opens = np.array([gate.opens for gate in case.gate])
    foot = np.array([beds.lowest(case.tank.bed, *sides) for sides in faces(case)])
    return np.clip(speed * (time - opens), 0.0, case.tank.height - foot)


def _find(case, particles):
    """Rows of the particles of gates, and the number of the gate of each."""
    moving = np.flatnonzero(particles.body >= first(case))
    return moving, particles.body[moving] - first(case)
