"""Where to cut the tank among ranks: pure functions of the slabs' loads.

Each function takes the load of every slab, in the order of x, and returns the cuts, (ranks + 1,)
int: rank k owns the slabs ``cuts[k]`` to ``cuts[k + 1] - 1``, one at least.
"""

import numpy as np


def cut(name, load, ranks):
    """Cuts by the method ``parallel.balance`` names: "static", "centroid" or "optimal".

    Parameters
    ----------
    name : str
    load : (slabs,) float
        Cost of each slab, not negative; "centroid" expects numbers of particles.
    ranks : int

    Raises
    ------
    ValueError
        If there are more ranks than slabs, or the method has no answer for that many ranks.
    """
    load = np.asarray(load, float)
    if not 1 <= ranks <= len(load):
        raise ValueError(
            f"ranks = {ranks}: must be from 1 to {len(load)}, the number of slabs of the tank "
            "(each two influence radii wide)"
        )
    return {"static": static, "centroid": centroid, "optimal": optimal}[name](load, ranks)


def static(load, ranks):
    """Parts of equal width, whatever the loads."""
    return np.round(np.linspace(0, len(load), ranks + 1)).astype(int)


def centroid(load, ranks):
    """Bisect at the centre of mass, again and again (section 4 of the paper, DDD).

    The centre of mass follows from the numbers of particles in the slabs and their moments; the
    cut goes to the slab border next to it.

    Raises
    ------
    ValueError
        If the number of ranks is not a power of two.
    """
    if ranks & (ranks - 1):
        raise ValueError(
            f'ranks = {ranks}: must be a power of two with parallel.balance = "centroid", which '
            'bisects; "optimal" and "static" take any number'
        )
    return np.array([*_bisect(load, 0, ranks), len(load)])


def _bisect(load, first, ranks):
    """First slab of each rank; the slabs of `load` begin with number `first`."""
    if ranks == 1:
        return [first]
    half, mass = ranks // 2, load.sum()
    centre = (load @ (np.arange(len(load)) + 0.5)) / mass if mass > 0.0 else 0.5 * len(load)
    middle = int(np.clip(round(centre), half, len(load) - half))
    left = _bisect(load[:middle], first, half)
    return left + _bisect(load[middle:], first + middle, half)


def optimal(load, ranks):
    """Contiguous cuts with the least possible load of the busiest rank, exactly.

    That load is the sum of some run of slabs: bisect among all these sums for the least one that
    a rank after the other, each taking as much as it allows, can keep to.
    """
    total = np.concatenate([[0.0], np.cumsum(load)])
    begin, end = np.triu_indices(len(total), 1)
    bounds = np.unique(total[end] - total[begin])
    low, high = 0, len(bounds) - 1
    while low < high:
        middle = (low + high) // 2
        cuts = _filled(total, ranks, bounds[middle])
        if np.diff(total[cuts]).max() <= bounds[middle]:
            high = middle
        else:
            low = middle + 1
    return _filled(total, ranks, bounds[low])


def _filled(total, ranks, bound):
    """Cuts when each rank takes slabs up to a load, one at least, and leaves one to each other."""
    cuts, slabs = [0], len(total) - 1
    for others in range(ranks - 1, 0, -1):
        most = np.searchsorted(total - total[cuts[-1]], bound, side="right") - 1
        cuts.append(min(max(int(most), cuts[-1] + 1), slabs - others))
    return np.array([*cuts, slabs])


def imbalance(load, cuts):
    """Load of the busiest rank over the mean of all; 1 where there is no load at all."""
    parts = np.add.reduceat(np.asarray(load, float), cuts[:-1])
    return float(parts.max() / parts.mean()) if parts.sum() > 0.0 else 1.0
