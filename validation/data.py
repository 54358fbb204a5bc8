"""Measurements from a CSV file, and the place in the water to hold them against."""

import csv

import numpy as np
from scipy.spatial import cKDTree

NEIGHBOURHOOD = 2.0  # [spacings]


def read_columns(path):
    """Columns of a CSV file of numbers, by their headings."""
    with path.open() as file:
        heading = file.readline().strip().split(",")
        return dict(zip(heading, np.loadtxt(file, delimiter=",").T, strict=True))


def read_curves(path):
    """Curves of a CSV file whose rows are a curve's name and a point of it, (2, points) by name.

    Lines that begin with # are remarks; one line of headings.
    """
    with path.open() as file:
        _, *rows = csv.reader(line for line in file if not line.startswith("#"))
    curves = {}
    for name, x, y in rows:
        curves.setdefault(name, []).append((float(x), float(y)))
    return {name: np.transpose(points) for name, points in curves.items()}


def foremost(position, spacing, others, among=True):
    """Largest x of the water that is no spray [m].

    Parameters
    ----------
    position : (n, 3) float64 [m]
    spacing : float [m]
    others : int
        Particles that one needs within two spacings not to be spray.
    among : (n,) bool, optional
        Those whose x counts; all are company.

    Returns
    -------
    float
        -inf if there is none.
    """
    if not len(position):
        return -np.inf
    tree = cKDTree(position)
    around = tree.query_ball_point(position, NEIGHBOURHOOD * spacing, return_length=True) - 1
    return position[(around >= others) & among, 0].max(initial=-np.inf)
