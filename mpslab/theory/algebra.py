"""Sums of products and systems of equations with the same last digits everywhere.

They are numpy's own: those of BLAS and LAPACK may have others on another number of threads.
"""

import numpy as np


def dot(rows, column):
    """Sums of the products along the last axis."""
    return np.sum(rows * column, axis=-1)


def eliminate(matrix, right):
    """Solution of a system of equations by elimination with pivots, (m,); NaN if there is none."""
    table = np.column_stack([matrix, right])
    size = len(right)
    for i in range(size):
        pivot = i + int(np.argmax(np.abs(table[i:, i])))
        table[[i, pivot]] = table[[pivot, i]]
        table[i] /= table[i, i]
        table[i + 1 :] -= table[i + 1 :, i, np.newaxis] * table[i]
    for i in range(size - 1, 0, -1):
        table[:i, -1] -= table[:i, i] * table[i, -1]
    return table[:, -1]
