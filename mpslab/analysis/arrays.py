"""Gauges along the tank by which incident and reflected waves can be told apart."""

import numpy as np

ALIKE = 0.01  # share by which depths may differ and still count as one
OFF_PADDLE = 2.0  # depths: nearer to the piston the water is disturbed (evanescent modes)


def asked(wanted, names, x, depth):
    """The gauges that were asked for.

    Parameters
    ----------
    wanted, names : sequence of str
        The gauges asked for, and all gauges.
    x, depth : (gauges,) float64 [m]
        Places of all gauges, and depths of the still water there.

    Returns
    -------
    list of int
        Rows of the gauges asked for.

    Raises
    ------
    ValueError
        If one does not exist, two stand at one place, or the depths differ.
    """
    unknown = [name for name in wanted if name not in names]
    if unknown:
        raise ValueError(f"--gauges {unknown[0]}: must be out of {', '.join(names)}")
    rows = [names.index(name) for name in wanted]
    listed = " ".join(wanted)
    if len(rows) < 2:
        raise ValueError(f"--gauges {listed}: must be 2 or more")
    if len(set(x[rows])) < len(rows):
        raise ValueError(
            f"--gauges {listed}: two stand at one place, x = {_twice(x[rows]):g} m; must be at "
            "different places along the tank"
        )
    if not (depth[rows] > 0.0).all() or np.ptp(depth[rows]) > ALIKE * depth[rows].max():
        deep = ", ".join(f"{d:.4g}" for d in depth[rows])
        raise ValueError(f"--gauges {listed}: must stand in water of one depth, not {deep} m")
    return rows


def _twice(places):
    ordered = np.sort(places)
    return ordered[:-1][np.diff(ordered) == 0.0][0]


def most(x, depth, piston):
    """As many gauges as there are in water of one depth, each at a place of its own.

    Gauges within two depths of a piston are left out, if two others remain.

    Parameters
    ----------
    x, depth : (gauges,) float64 [m]
    piston : bool
        Whether there is a piston at x = 0.

    Returns
    -------
    list of int
        Rows of the gauges, in the order of x.
    """
    groups = []
    for k in np.argsort(x, kind="stable"):
        if not depth[k] > 0.0:
            continue
        for group in groups:
            if abs(depth[k] - depth[group[0]]) <= ALIKE * depth[group[0]]:
                if x[k] != x[group[-1]]:
                    group.append(int(k))
                break
        else:
            groups.append([int(k)])
    best = max(groups, key=len, default=[])
    off = [k for k in best if x[k] >= OFF_PADDLE * depth[k]]
    return off if piston and len(off) > 1 else best
