"""How orderly the water moves: particles on their own, and the roughness of the velocity."""

import numpy as np
import scipy

ALONE = 1.5  # [spacings]: a particle with no other one so near is on its own
NEIGHBOURHOOD = 2.1  # [spacings]


def _tree(position, width):
    """Search tree, periodic across the tank where it has a period."""
    if width == 0.0:
        return scipy.spatial.cKDTree(position)
    folded = position.astype(float)
    folded[:, 1] %= width
    far = 4.0 * (np.ptp(folded, axis=0) + width)
    folded[:, [0, 2]] -= folded[:, [0, 2]].min(axis=0)
    return scipy.spatial.cKDTree(folded, boxsize=[far[0], width, far[2]])


def isolated_share(position, spacing, width=0.0):
    """Share of particles with no other within 1.5 spacings [-].

    Parameters
    ----------
    position : (n, 3) float [m]
        Of the fluid particles.
    spacing, width : float [m]
        Particle spacing, and period across the tank (0 for none).
    """
    if len(position) < 2:
        return float(len(position))
    tree = _tree(position, width)
    nearest = tree.query(tree.data, k=2, distance_upper_bound=ALONE * spacing)[0][:, 1]
    return float(np.mean(np.isinf(nearest)))


def roughness(position, velocity, spacing, width=0.0):
    """Root mean square of u - <u>, <u> being the mean over the neighbours within 2.1 d0 [m/s].

    Parameters
    ----------
    position, velocity : (n, 3) float [m], [m/s]
        Of the fluid particles; those without a neighbour do not count.
    spacing, width : float [m]
        As for `isolated_share`.
    """
    pairs = _tree(position, width).query_pairs(NEIGHBOURHOOD * spacing, output_type="ndarray")
    if not len(pairs):
        return 0.0
    both = np.concatenate([pairs, pairs[:, ::-1]])
    count = np.bincount(both[:, 0], minlength=len(position))
    mean = np.stack(
        [np.bincount(both[:, 0], v[both[:, 1]], len(position)) for v in velocity.T], axis=1
    )
    near = count > 0
    deviation = velocity[near] - mean[near] / count[near, None]
    return float(np.sqrt(np.mean(np.sum(deviation**2, axis=1))))
