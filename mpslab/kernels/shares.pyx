"""Kinds of particles as factors 0 and 1, which a kernel multiplies where it would have to branch.

A loop over neighbours that branches on the role of each is not turned into vector lanes.
"""
import numpy as np

from mpslab.kernels.pair cimport FLUID, has_pressure


def of_water(const signed char[::1] role):
    """1 for water, 0 for solids: (n,) int8 -> (n,) float64."""
    out = np.empty(role.shape[0])
    cdef double[::1] share = out
    cdef Py_ssize_t i
    for i in range(role.shape[0]):
        share[i] = role[i] == FLUID
    return out


def of_loaded(const signed char[::1] role):
    """0 for the layers behind walls, which carry no pressure, else 1: (n,) int8 -> (n,) float64."""
    out = np.empty(role.shape[0])
    cdef double[::1] share = out
    cdef Py_ssize_t i
    for i in range(role.shape[0]):
        share[i] = has_pressure(role[i])
    return out
