"""The groups of the deflation, and their numbers."""

from functools import lru_cache

import numpy as np

from mpslab.later import scipy

# Cells across the tank in the key of a group: far more than there are.
SIDE = 1 << 20


def group_rows(system, merged):
    """Group of each row, (m,) int32, the same numbers on every rank; and the keys of all groups."""
    key = keys(system.blocks.of_rows, system.cell, merged)
    begin, end = system.blocks.own
    own, first = key[begin:end], _runs(key)
    groups, number = number_groups(system.blocks.from_all(np.unique(own[_runs(own)])))
    ordered = np.empty_like(groups)
    ordered[number] = groups
    length = np.diff(first, append=len(key))
    return number[np.searchsorted(groups, key[first])].repeat(length), ordered


def _runs(key):
    """Where the runs of equal keys begin: rows that follow each other are mostly of one group."""
    return np.flatnonzero(np.diff(key, prepend=-1))


def keys(slab, cell, merged):
    """A number for each slab and cell, (m,) int64.

    Parameters
    ----------
    slab : (m,) int
    cell : (m, 2) int
        Across the tank, and upwards.
    merged : int
        Cells that are taken together in either direction.
    """
    part = cell.astype(np.int64) // merged + SIDE // 2
    return (slab * SIDE + part[:, 0]) * SIDE + part[:, 1]


def number_groups(several):
    """Sorted keys of all groups, and the number of each, (groups,) int32.

    Groups are numbered slab by slab, in a slab layer by layer, and in a layer from both sides by
    turns, so that across a periodic tank first and last are near: the band is narrow.
    """
    return _numbered(np.unique(np.concatenate(several)).tobytes())


@lru_cache(maxsize=2)
def _numbered(keys):
    """The same of sorted keys, as bytes: mostly they are those of the last step."""
    groups = np.frombuffer(keys, np.int64)
    slab, aside, up = groups // SIDE**2, groups // SIDE % SIDE, groups % SIDE
    places, aside = np.unique(aside, return_inverse=True)
    aside = np.minimum(2 * aside, 2 * (len(places) - 1 - aside) + 1)
    number = np.empty(len(groups), np.int32)
    number[np.lexsort((aside, up, slab))] = np.arange(len(groups))
    return groups, number


def narrow(groups):
    """Numbers of groups with which those beside each other are near, (groups,) int32.

    Cuthill & McKee's (1969): level by level of the neighbours of a group at one end.

    Parameters
    ----------
    groups : (groups,) int64
        Keys, in the order of their present numbers.
    """
    return _narrowed(groups.tobytes())


@lru_cache(maxsize=2)
def _narrowed(keys):
    groups = np.frombuffer(keys, np.int64)
    order = np.argsort(groups)
    steps = np.array([(x * SIDE + y) * SIDE + z
                      for x in (0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)])  # fmt: skip
    beside = groups[:, np.newaxis] + steps[steps > 0]
    place = np.minimum(np.searchsorted(groups, beside, sorter=order), len(groups) - 1)
    there = groups[order[place]] == beside
    ends = np.nonzero(there)[0], order[place[there]]
    graph = scipy.sparse.coo_array((np.ones(len(ends[0])), ends), (len(groups), len(groups)))
    found = scipy.sparse.csgraph.reverse_cuthill_mckee((graph + graph.T).tocsr(), True)
    number = np.empty(len(groups), np.int32)
    number[found] = np.arange(len(groups))
    return number
