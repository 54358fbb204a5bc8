"""Gravity: straight down, the same everywhere."""

import numpy as np


def make(case):
    """Gravity of a case."""
    pull = np.array([0.0, 0.0, -case.fluid.gravity])
    return lambda position, velocity, time: pull
