"""Kinds of particles as factors 0 and 1, which a kernel multiplies where it would have to branch.

A loop over neighbours that branches on the kind of each is not turned into vector lanes.
"""

import numpy as np

from mpslab.particles import DUMMY, FLUID, PISTON_DUMMY


def of_water(kind):
    """1 for water, 0 for solids: (n,) int8 -> (n,) float64."""
    return np.equal(kind, FLUID).astype(float)


def of_loaded(kind):
    """0 for the layers behind walls, which carry no pressure, else 1: (n,) int8 -> (n,) float64."""
    return (np.not_equal(kind, DUMMY) & np.not_equal(kind, PISTON_DUMMY)).astype(float)
